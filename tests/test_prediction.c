/* Predicted variance over four or five coordinates: of waves with known energy, and of pixels. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/analysis.h"
#include "clshear/device/motion.h"

static const double pi = 3.14159265358979323846;

/* Points with x, y, u, v, and also t if they have 5 `dimensions`. */
static clshear_points *drawn(const char *sampler, size_t count, size_t sets, uint32_t seed,
                             int dimensions)
{
    clshear_points *points = NULL;
    if (dimensions == 5) {
        test_ok(clshear_points_draw_moving(sampler, count, sets, seed, 0, &points));
        return points;
    }
    test_ok(clshear_points_draw(sampler, count, sets, seed, &points));
    test_ok(clshear_points_select(points, "xyuv"));
    return points;
}

enum {
    WAVES = 9,
    WAVES_AT_REST = 5
};

/* A wave in each kind of part, with its energy, half the squared amplitude. Those beyond all summed
 * frequencies are in the tail. Functions of four coordinates have the first ones only. */
static const struct {
    const char *part;
    double amplitude;
    int frequency[5];
} waves[WAVES] = {{"u", 1.0, {0, 0, 37, 0, 0}},    {"xy", 0.5, {-3, 2, 0, 0, 0}},
                  {"yv", 0.7, {0, 5, 0, -1, 0}},   {"block", 0.4, {1, -2, 0, 3, 0}},
                  {"tail", 0.3, {2, 1, 5, 0, 0}},  {"t", 0.6, {0, 0, 0, 0, 11}},
                  {"xt", 0.5, {4, 0, 0, 0, -7}},   {"block", 0.3, {-1, 2, 1, -3, 2}},
                  {"block", 0.2, {0, 0, -2, 4, 3}}};

/* *user: 4 or 5 coordinates. */
static clshear_status sum_of_waves(void *user, const float *points, size_t count, float *values)
{
    const int dimensions = *(const int *)user;
    for (size_t i = 0; i < count; i++) {
        double sum = 0.0;
        for (int w = 0; w < (dimensions == 5 ? WAVES : WAVES_AT_REST); w++) {
            double turns = 0.1 * w;
            for (int d = 0; d < dimensions; d++)
                turns += waves[w].frequency[d] * (double)points[(size_t)dimensions * i + (size_t)d];
            sum += waves[w].amplitude * cos(2.0 * pi * turns);
        }
        values[i] = (float)sum;
    }
    return CLSHEAR_OK;
}

/* points_of_part: `points` of clshear_reach. most: the largest error of an energy. */
static void expect_energies(clshear_context *context, int dimensions, uint32_t points_of_part,
                            double most)
{
    const clshear_reach reach = {sizeof reach, 128, 15, 4, points_of_part};
    const size_t sets = dimensions == 5 ? 300 : 2000;
    clshear_points *points = drawn("random", 64, sets, 1, dimensions);
    clshear_prediction *p = NULL;
    double sum = 0.0, energy = 0.0;
    test_ok(clshear_predict_variance_4d(context, points, sum_of_waves, &dimensions, &reach, &p));
    for (size_t part = 0; part < clshear_prediction_parts(p); part++) {
        const char *name = clshear_prediction_part_name(p, part);
        const double found = clshear_prediction_part_energy(p, part);
        double expected = 0.0;
        for (int w = 0; w < (dimensions == 5 ? WAVES : WAVES_AT_REST); w++)
            if (strcmp(waves[w].part, name) == 0)
                expected += 0.5 * waves[w].amplitude * waves[w].amplitude;
        if (fabs(found - expected) > most) fail_msg("%s: %g, not %g", name, found, expected);
        energy += expected;
        sum += clshear_prediction_part_variance(p, part);
    }
    const double variance = clshear_prediction_variance(p);
    assert_near(clshear_prediction_energy(p), energy, most);
    assert_near(variance, sum, 1e-12);
    assert_near(64.0 * variance / energy, 1.0, 4.0 / sqrt((double)sets));
    clshear_prediction_free(p);
    clshear_points_free(points);
}

/* The energy of each wave appears in its own part, for any sampler, with the time and without. The
 * function is sampled 4 million times for each part, and the noise of other waves is at most 1e-3;
 * with the time, 1 million times, and at most 4e-3. For random points, N times the variance is the
 * energy, 1.08 or more, up to the spectrum's error of at most 4 / sqrt(sets). */
static void energies_are_in_their_parts(void **state)
{
    (void)state;
    clshear_context *context = test_context();
    expect_energies(context, 4, 0, 1e-3);
    expect_energies(context, 5, 1u << 17, 4e-3);
    clshear_context_free(context);
}

static clshear_status failing(void *user, const float *points, size_t count, float *values)
{
    (void)user;
    (void)points;
    (void)count;
    (void)values;
    return CLSHEAR_NO_DEVICE;
}

static void wrong_arguments_are_refused(void **state)
{
    (void)state;
    const clshear_reach reach = {sizeof reach, 16, 4, 2, 0}, too_far = {sizeof reach, 16, 4, 16, 0},
                        too_far_in_time = {sizeof reach, 16, 4, 6, 0};
    clshear_context *context = test_context();
    clshear_points *points = drawn("random", 4, 2, 1, 4), *timed = drawn("random", 4, 2, 1, 5);
    clshear_prediction *p = NULL;
    int dimensions = 4;
    assert_int_equal(clshear_predict_variance_4d(context, points, failing, NULL, &reach, &p),
                     CLSHEAR_NO_DEVICE);
    test_refused(
        clshear_predict_variance_4d(context, points, sum_of_waves, &dimensions, &too_far, &p),
        CLSHEAR_BAD_ARGUMENT, "16");
    test_refused(clshear_predict_variance_4d(context, timed, failing, NULL, &too_far_in_time, &p),
                 CLSHEAR_BAD_ARGUMENT, "and 6: must be 1 to 65536, 2047 and 5");
    test_ok(clshear_points_select(points, "xy"));
    test_refused(
        clshear_predict_variance_4d(context, points, sum_of_waves, &dimensions, &reach, &p),
        CLSHEAR_BAD_ARGUMENT, "x, y, u");
    assert_null(p);
    clshear_points_free(timed);
    clshear_points_free(points);
    clshear_context_free(context);
}

typedef struct pixel {
    test_fixture *made;
    int x;
    int y;
    clshear_settings *settings;
    float shear_px;
    float *rgb;
} pixel;

enum {
    MOST = 1 << 17
};

static clshear_status green(void *user, const float *points, size_t count, float *values)
{
    const pixel *p = user;
    assert_at_most(count, MOST);
    const clshear_status status = clshear_radiance_of_samples(
        p->made->scene, p->settings, p->x, p->y, p->shear_px, points, count, p->rgb);
    for (size_t i = 0; i < count; i++)
        values[i] = p->rgb[3 * i + 1];
    return status;
}

static double measured(pixel *p, const char *sampler, size_t count, size_t sets)
{
    clshear_points *points = drawn(sampler, count, sets, 77, 4);
    double *means = calloc(sets, sizeof *means), mean = 0.0, variance = 0.0;
    test_ok(clshear_points_integrate_4d(points, green, p, 1, 5, means));
    for (size_t i = 0; i < sets; i++)
        mean += means[i] / (double)sets;
    for (size_t i = 0; i < sets; i++)
        variance += (means[i] - mean) * (means[i] - mean) / ((double)sets - 1.0);
    clshear_points_free(points);
    free(means);
    return variance;
}

/* Pixels in focus, out of focus, and with two depths; sheared and not. The measured variance of
 * 4000 sets has a relative error of sqrt(2 / 4000) = 2.2 %. The prediction, if all energy is at one
 * frequency, has 1 / sqrt(200) = 7 %. The tolerance of 25 % is 3.4 deviations, false alarms 6 *
 * 7e-4 at worst. */
static void pixels_are_predicted(void **state)
{
    static const int places[3][2] = {{242, 488}, {302, 130}, {154, 213}};
    const clshear_reach reach = {sizeof reach, 1024, 127, 8, 0};
    pixel p = {.made = *state};
    p.settings = test_settings(p.made->settings, 512, 512, 256);
    p.rgb = malloc((size_t)3 * MOST * sizeof *p.rgb);
    printf("pixel     shear       predicted  measured\n");
    for (int i = 0; i < 6; i++) {
        clshear_prediction *prediction = NULL;
        clshear_points *points = drawn("mj", 256, 200, 3, 4);
        p.x = places[i / 2][0];
        p.y = places[i / 2][1];
        test_set(p.settings, CLSHEAR_SHEAR, "equal-area"); /* without shear the oracle gives 0 */
        test_ok(clshear_pixel_shear(p.made->scene, p.settings, p.x, p.y, &p.shear_px));
        if (i % 2 == 0) test_set(p.settings, CLSHEAR_SHEAR, "none");
        test_ok(
            clshear_predict_variance_4d(p.made->context, points, green, &p, &reach, &prediction));
        const double predicted = clshear_prediction_variance(prediction);
        const double truth = measured(&p, "mj", 256, 4000);
        printf("%d,%d   %-10s  %.3g   %.3g\n", p.x, p.y, i % 2 ? "equal-area" : "none", predicted,
               truth);
        if (fabs(predicted / truth - 1.0) > 0.25) fail_msg("%g, not %g", predicted, truth);
        clshear_prediction_free(prediction);
        clshear_points_free(points);
    }
    clshear_settings_free(p.settings);
    free(p.rgb);
}

/* With ramps the shear follows the velocity of the middle of the exposure: samples go where the map
 * takes them with 3/4 of the velocity, for ramps of a quarter. */
static void ramps_shear_by_the_velocity_of_the_middle(void **state)
{
    test_fixture *made = *state;
    enum {
        SAMPLES = 64
    };
    const float velocity[2] = {-9.0f, 4.0f};
    const cs_velocity middle = {0.75f * velocity[0], 0.75f * velocity[1]};
    clshear_settings *settings = test_settings(made->settings, 24, 24, 4);
    const cs_view view = {.aperture = CLSHEAR_APERTURE_DISK};
    cs_optics_tables optics = test_optics(&view, CLSHEAR_FILTER_BOX, 0.0f);
    float samples[SAMPLES][5], places[SAMPLES][5] = {{0}}, rgb[2][3 * SAMPLES];
    int equal = 0;
    test_set(settings, CLSHEAR_LENS_RADIUS, "0");
    test_set(settings, CLSHEAR_CAMERA_TO, "330,250,780,340,290,0");
    test_set(settings, CLSHEAR_SHUTTER_RAMPS, "0.25,0.25");
    for (int i = 0; i < SAMPLES; i++) {
        for (int d = 0; d < 5; d++)
            samples[i][d] = (float)((i * (2 * d + 3) + 11 * d) % SAMPLES) / SAMPLES;
        const float *s = samples[i];
        const cs_camera_sample tuple = {s[0], s[1], s[2], s[3]};
        const cs_moving_sample at = cs_shear_moving(
            tuple, s[4], CS_SHEAR_EQUAL_AREA, &optics.optics, optics.table.items, 0.0f, middle);
        places[i][0] = at.point.x;
        places[i][1] = at.point.y;
        places[i][4] = at.time;
    }
    test_ok(clshear_moving_radiance_of_samples(made->scene, settings, 9, 13, 0.0f, velocity,
                                               samples[0], SAMPLES, rgb[0]));
    test_ok(clshear_moving_radiance(made->scene, settings, 9, 13, places[0], SAMPLES, rgb[1]));
    for (int i = 0; i < SAMPLES; i++)
        equal += fabsf(rgb[0][3 * i] - rgb[1][3 * i]) <= 1e-4f * rgb[1][3 * i];
    assert_at_least(equal, SAMPLES - 2); /* rounding may move two of them over an edge */
    cs_optics_free(&optics);
    clshear_settings_free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energies_are_in_their_parts),
        cmocka_unit_test(wrong_arguments_are_refused),
        cmocka_unit_test_setup_teardown(pixels_are_predicted, test_open_cornell, test_close),
        cmocka_unit_test_setup_teardown(ramps_shear_by_the_velocity_of_the_middle,
                                        test_open_cornell, test_close),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
