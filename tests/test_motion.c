/* Pictures of what moves: their means, their velocities, their noise. */
#include "support.h"

#include <math.h>

#include "clshear/analysis.h"

enum {
    SIDE = 24,
    PIXELS = SIDE * SIDE,
    SLICES = 128,
    BLOCKS = 9 /* of 8 x 8 pixels */
};

static const double eyes[2][6] = {{276.4, 274.4, 800, 276.4, 274.4, 0},
                                  {330.0, 250.0, 780, 340.0, 290.0, 0}};

/* Puts the camera where it is at `time`, 0 to 1. */
static void place_camera(clshear_settings *settings, double time)
{
    double at[6];
    for (int i = 0; i < 6; i++)
        at[i] = eyes[0][i] + time * (eyes[1][i] - eyes[0][i]);
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_EYE, at, 3));
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_TARGET, at + 3, 3));
}

/* Sums of the colours of blocks, and the variances of these sums, with `weight` for the picture. */
typedef struct block_sums {
    double sum[3 * BLOCKS];
    double variance[3 * BLOCKS];
} block_sums;

static void add_blocks(const clshear_film *film, double weight, block_sums *to)
{
    static const char *const names[6] = {"R", "G", "B", "Variance.R", "Variance.G", "Variance.B"};
    for (int c = 0; c < 3; c++) {
        const float *mean = clshear_film_channel(film, names[c]);
        const float *variance = clshear_film_channel(film, names[c + 3]);
        for (int i = 0; i < PIXELS; i++) {
            const int block = 3 * (i / SIDE / 8) + i % SIDE / 8;
            to->sum[3 * block + c] += weight * (double)mean[i];
            to->variance[3 * block + c] += weight * weight * (double)variance[i];
        }
    }
}

/* How much of the light comes in at a time, with ramps that take these parts of it. */
static double openness(double opening, double closing, double time)
{
    double open = 1.0;
    if (time < opening) open = time / opening;
    if (1.0 - time < closing) open = (1.0 - time) / closing;
    return open / (1.0 - 0.5 * (opening + closing));
}

/* The mean of still pictures at the middles of SLICES parts of the shutter. */
static block_sums sum_of_slices(test_fixture *made, const clshear_settings *settings,
                                const double *ramps)
{
    block_sums sums = {{0}, {0}};
    clshear_settings *still = test_settings(settings, SIDE, SIDE, 16);
    for (int i = 0; i < SLICES; i++) {
        place_camera(still, (i + 0.5) / SLICES);
        test_set(still, CLSHEAR_SEED, "%d", i + 1);
        clshear_film *film = test_render(made->scene, still);
        add_blocks(film, openness(ramps[0], ramps[1], (i + 0.5) / SLICES) / SLICES, &sums);
        clshear_film_free(film);
    }
    clshear_settings_free(still);
    return sums;
}

static void compare(const block_sums *a, const block_sums *b)
{
    for (int i = 0; i < 3 * BLOCKS; i++) {
        const double error = sqrt(a->variance[i] + b->variance[i]);
        assert_near(a->sum[i], b->sum[i], 6.0 * error);
    }
}

/* A picture with a moving camera is the mean of still ones, for every map, and with a shear that is
 * wrong. |z| < 6 for 27 sums of 64 pixels each; the error of a sum comes from 64 variances of 8
 * degrees of freedom or more, so z is normal to within a tenth: false alarms below 1e-6 a case. */
static void the_mean_is_that_of_time_slices(void **state)
{
    test_fixture *made = *state;
    static const struct {
        const char *aperture, *radius, *shear, *wrong;
        double ramps[2];
    } cases[] = {{"square", "25", "equal-area", "", {0.0, 0.0}},
                 {"disk", "25", "equal-area", "", {0.0, 0.0}},
                 {"square", "0", "equal-area", "", {0.0, 0.0}},
                 {"square", "25", "equal-area", "9", {0.0, 0.0}},
                 {"square", "25", "equal-area", "", {0.25, 0.5}},
                 {"polygon", "25", "none", "", {0.0, 0.0}}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        clshear_settings *settings = test_settings(made->settings, SIDE, SIDE, 1024);
        test_set(settings, CLSHEAR_APERTURE, "%s", cases[k].aperture);
        test_set(settings, CLSHEAR_LENS_RADIUS, "%s", cases[k].radius);
        test_set(settings, CLSHEAR_SHEAR, "%s", cases[k].shear);
        if (*cases[k].wrong) test_set(settings, CLSHEAR_SHEAR_PX, "%s", cases[k].wrong);
        const block_sums slices = sum_of_slices(made, settings, cases[k].ramps);
        block_sums moving = {{0}, {0}};
        place_camera(settings, 0.0);
        test_set(settings, CLSHEAR_REPLICATES, "16");
        test_ok(clshear_settings_set_numbers(settings, CLSHEAR_CAMERA_TO, eyes[1], 6));
        test_ok(clshear_settings_set_numbers(settings, CLSHEAR_SHUTTER_RAMPS, cases[k].ramps, 2));
        clshear_film *film = test_render(made->scene, settings);
        add_blocks(film, 1.0, &moving);
        compare(&moving, &slices);
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
}

/* A camera that moves to the right by D sees a wall at depth z move to the left by D F / (z w). */
static void velocities_are_those_of_the_film(void **state)
{
    (void)state;
    clshear_context *context = test_context();
    clshear_scene *scene = test_floor(context, 100.0f, 0.5f);
    clshear_settings *settings = test_settings(NULL, SIDE, SIDE, 4);
    test_set(settings, CLSHEAR_EYE, "0,10,0");
    test_set(settings, CLSHEAR_TARGET, "0,0,0");
    test_set(settings, CLSHEAR_UP, "0,0,-1");
    test_set(settings, CLSHEAR_FOV, "60");
    test_set(settings, CLSHEAR_FOCAL_DISTANCE, "7");
    test_set(settings, CLSHEAR_CAMERA_TO, "2,10,1,2,0,1");
    clshear_film *film = test_render(scene, settings);
    const double pixel = 2.0 * 10.0 * tan(30.0 * 3.14159265358979 / 180.0) / SIDE;
    for (int i = 0; i < PIXELS; i++) {
        assert_near(clshear_film_channel(film, "Velocity.X")[i], -2.0 / pixel, 1e-4);
        assert_near(clshear_film_channel(film, "Velocity.Y")[i], -1.0 / pixel, 1e-4);
    }
    clshear_film_free(film);
    clshear_settings_free(settings);
    clshear_scene_free(scene);
    clshear_context_free(context);
}

/* A ball of facets and a lamp over a floor, at `time`; `to`: with where they are at the end. Both
 * turn, move and grow; the ball is smooth. */
enum {
    RINGS = 6,
    AROUND = 10,
    BALL = (RINGS + 1) * AROUND
};

static void make_ball(double time, float *positions, float *normals)
{
    for (int ring = 0; ring <= RINGS; ring++)
        for (int k = 0; k < AROUND; k++) {
            const double up = 3.14159265358979 * ring / RINGS;
            const double around = 6.28318530717959 * k / AROUND;
            const double n[3] = {sin(up) * cos(around), cos(up), sin(up) * sin(around)};
            float *p = positions + 3 * (ring * AROUND + k), *q = normals + 3 * (ring * AROUND + k);
            const double size = 1.0 + 0.5 * time, move[3] = {2.0 * time - 1.0, 0.8 * time, -time};
            for (int i = 0; i < 3; i++) {
                p[i] = (float)(n[i] * size + move[i] + (i == 1 ? 1.5 : 0.0));
                q[i] = (float)(n[i] + 0.7 * time * n[(i + 1) % 3]);
            }
        }
}

/* Returns the number of triangles. */
static size_t make_faces(uint32_t *faces)
{
    size_t count = 0;
    for (uint32_t ring = 0; ring < RINGS; ring++)
        for (uint32_t k = 0; k < AROUND; k++) {
            const uint32_t a = ring * AROUND + k, b = ring * AROUND + (k + 1) % AROUND;
            const uint32_t corners[6] = {a, b, a + AROUND, b, b + AROUND, a + AROUND};
            memcpy(faces + count, corners, sizeof corners);
            count += 6;
        }
    return count / 3;
}

static clshear_scene *ball_scene(clshear_context *context, double time, int moves)
{
    static const float floor_corners[12] = {-6, 0, -6, 6, 0, -6, 6, 0, 6, -6, 0, 6};
    static const uint32_t square[6] = {0, 1, 2, 0, 2, 3};
    float ball[3 * BALL], ball_to[3 * BALL], normals[3 * BALL], normals_to[3 * BALL];
    float lamp[12], lamp_to[12];
    uint32_t faces[6 * RINGS * AROUND];
    const size_t count = make_faces(faces);
    /* Places between the ends are linear, as those of the renderer. */
    make_ball(0.0, ball, normals);
    make_ball(1.0, ball_to, normals_to);
    for (int i = 0; i < 12; i++) {
        lamp[i] = floor_corners[i] / 4.0f + (i % 3 == 1 ? 5.0f : 0.0f);
        lamp_to[i] = floor_corners[i] / 3.0f + (i % 3 == 1 ? 4.5f : 1.0f);
    }
    for (int i = 0; i < 3 * BALL && !moves; i++) {
        ball[i] += (float)time * (ball_to[i] - ball[i]);
        normals[i] += (float)time * (normals_to[i] - normals[i]);
    }
    for (int i = 0; i < 12 && !moves; i++)
        lamp[i] += (float)time * (lamp_to[i] - lamp[i]);
    const clshear_mesh meshes[3] = {{.positions = floor_corners,
                                     .indices = square,
                                     .vertex_count = 4,
                                     .triangle_count = 2,
                                     .diffuse = {0.7f, 0.6f, 0.5f}},
                                    {.positions = ball,
                                     .normals = normals,
                                     .indices = faces,
                                     .vertex_count = BALL,
                                     .triangle_count = count,
                                     .diffuse = {0.8f, 0.3f, 0.3f},
                                     .positions_to = moves ? ball_to : NULL,
                                     .normals_to = moves ? normals_to : NULL},
                                    {.positions = lamp,
                                     .indices = square,
                                     .vertex_count = 4,
                                     .triangle_count = 2,
                                     .emission = {3, 3, 3},
                                     .positions_to = moves ? lamp_to : NULL}};
    return test_meshes(context, meshes, 3);
}

static clshear_settings *ball_settings(uint32_t spp, const char *bounces)
{
    clshear_settings *settings = test_settings(NULL, SIDE, SIDE, spp);
    test_set(settings, CLSHEAR_EYE, "0,4,9");
    test_set(settings, CLSHEAR_TARGET, "0,1.5,0");
    test_set(settings, CLSHEAR_FOV, "45");
    test_set(settings, CLSHEAR_FOCAL_DISTANCE, "11");
    test_set(settings, CLSHEAR_LENS_RADIUS, "0.3");
    test_set(settings, CLSHEAR_BOUNCES, "%s", bounces);
    return settings;
}

/* Surfaces and lights that move give the mean of still pictures, with direct light and with paths.
 * The bound is that of the_mean_is_that_of_time_slices. */
static void moving_surfaces_are_the_mean_of_time_slices(void **state)
{
    test_fixture *made = *state;
    static const char *const bounces[] = {"0", "2"};
    for (int k = 0; k < 2; k++) {
        block_sums slices = {{0}, {0}}, moving = {{0}, {0}};
        for (int i = 0; i < SLICES / 2; i++) {
            clshear_settings *settings = ball_settings(32, bounces[k]);
            clshear_scene *scene = ball_scene(made->context, (i + 0.5) / (SLICES / 2), 0);
            test_set(settings, CLSHEAR_SEED, "%d", i + 1);
            clshear_film *film = test_render(scene, settings);
            add_blocks(film, 2.0 / SLICES, &slices);
            clshear_film_free(film);
            clshear_scene_free(scene);
            clshear_settings_free(settings);
        }
        clshear_settings *settings = ball_settings(2048, bounces[k]);
        clshear_scene *scene = ball_scene(made->context, 0.0, 1);
        test_set(settings, CLSHEAR_REPLICATES, "16");
        clshear_film *film = test_render(scene, settings);
        add_blocks(film, 1.0, &moving);
        compare(&moving, &slices);
        clshear_film_free(film);
        clshear_scene_free(scene);
        clshear_settings_free(settings);
    }
}

/* The integrand of what moves is at each time that of what stands still there, and its velocity is
 * the channel's. */
static void the_integrand_has_the_time(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = test_settings(made->settings, SIDE, SIDE, 4);
    clshear_settings *still = test_settings(made->settings, SIDE, SIDE, 4);
    float points[64][5], rgb[3 * 64], rgb_still[3], velocity[2];
    int moves = 0;
    place_camera(settings, 0.0);
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_CAMERA_TO, eyes[1], 6));
    for (int i = 0; i < 64; i++)
        for (int d = 0; d < 5; d++)
            points[i][d] = (float)((i * (2 * d + 3) + 11 * d) % 64) / 64.0f;
    test_ok(clshear_moving_radiance(made->scene, settings, 9, 13, points[0], 64, rgb));
    int equal = 0;
    for (int i = 0; i < 64; i++) {
        place_camera(still, (double)points[i][4]);
        test_ok(clshear_radiance(made->scene, still, 9, 13, points[i], 1, rgb_still));
        equal += fabsf(rgb[3 * i + 1] - rgb_still[1]) <= 1e-4f * rgb_still[1];
    }
    assert_true(equal >= 62); /* rounding may move two of them over an edge */
    clshear_film *film = test_render(made->scene, settings);
    test_ok(clshear_pixel_motion(made->scene, settings, 9, 13, &moves, velocity));
    assert_true(moves);
    assert_near(velocity[0], clshear_film_channel(film, "Velocity.X")[13 * SIDE + 9], 1e-6);
    assert_near(velocity[1], clshear_film_channel(film, "Velocity.Y")[13 * SIDE + 9], 1e-6);
    test_ok(clshear_pixel_motion(made->scene, still, 9, 13, &moves, velocity));
    assert_true(!moves && velocity[0] == 0.0f && velocity[1] == 0.0f);
    clshear_film_free(film);
    clshear_settings_free(settings);
    clshear_settings_free(still);
}

/* Variance of the moving Cornell box, mean over the darker 95 % of the pixels. */
static int ascending(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return x < y ? -1 : x > y;
}

static double dark_variance(const clshear_film *film)
{
    float values[PIXELS];
    double sum = 0.0;
    memcpy(values, clshear_film_channel(film, "Variance.G"), sizeof values);
    qsort(values, PIXELS, sizeof *values, ascending);
    for (int i = 0; i < PIXELS * 19 / 20; i++)
        sum += (double)values[i];
    return sum / (PIXELS * 19 / 20);
}

/* The shear of lens and time takes more than half of the variance off that of unsheared
 * multi-jittered samples at N = 64, with a square lens and a round one; measured 2.6 times and
 * more. Each mean is over 547 pixels with 7 degrees of freedom, so its relative error is below 10
 * %. */
static void the_shear_of_time_lowers_the_variance(void **state)
{
    test_fixture *made = *state;
    double variance[2];
    for (int way = 0; way < 4; way++) {
        const int sheared = way % 2;
        clshear_settings *settings = test_settings(made->settings, SIDE, SIDE, 8 * 64);
        test_set(settings, CLSHEAR_APERTURE, way < 2 ? "square" : "disk");
        test_set(settings, CLSHEAR_REPLICATES, "8");
        test_set(settings, CLSHEAR_SAMPLER, sheared ? "sz" : "mj");
        test_set(settings, CLSHEAR_SHEAR, sheared ? "equal-area" : "none");
        place_camera(settings, 0.0);
        test_ok(clshear_settings_set_numbers(settings, CLSHEAR_CAMERA_TO, eyes[1], 6));
        clshear_film *film = test_render(made->scene, settings);
        variance[sheared] = dark_variance(film);
        clshear_film_free(film);
        clshear_settings_free(settings);
        if (!sheared) continue;
        print_message("gain over mj: %.2f\n", variance[0] / variance[1]);
        assert_above(variance[0], 2.0 * variance[1]);
    }
}

/* Ramps that take more than all of the time are refused. */
static void ramps_have_to_fit(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = test_settings(made->settings, SIDE, SIDE, 4);
    clshear_film *film = NULL;
    test_set(settings, CLSHEAR_SHUTTER_RAMPS, "0.75,0.5");
    test_refused(clshear_render(made->scene, settings, &film), CLSHEAR_BAD_ARGUMENT,
                 "shutter ramps 0.75,0.5: must be 1 together at most");
    assert_null(film);
    clshear_settings_free(settings);
}

/* Slope of the variance of one pixel over N = 64, 256, 1024, from 2048 patterns of each. */
static double slope_of_pixel(test_fixture *made, const char *sampler, const char *shear)
{
    double slope = 0.0;
    for (int i = 0; i < 3; i++) {
        clshear_settings *settings =
            test_settings(made->settings, SIDE, SIDE, 2048u * 64u << 2 * i);
        test_set(settings, CLSHEAR_REPLICATES, "2048");
        test_set(settings, CLSHEAR_APERTURE, "square");
        test_set(settings, CLSHEAR_ORACLE, "centre");
        test_set(settings, CLSHEAR_SAMPLER, "%s", sampler);
        test_set(settings, CLSHEAR_SHEAR, "%s", shear);
        test_set(settings, CLSHEAR_CROP, "8,9,9,10");
        place_camera(settings, 0.0);
        test_ok(clshear_settings_set_numbers(settings, CLSHEAR_CAMERA_TO, eyes[1], 6));
        clshear_film *film = test_render(made->scene, settings);
        slope += (i - 1) * log((double)*clshear_film_channel(film, "Variance.G"));
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
    return slope / (2.0 * log(4.0));
}

/* Regression of convergence: a pixel of the checkered back wall with lens and motion. The chain is
 * between the -1 of unsheared pairs and the -1.5 of two dimensions. A variance from 2048 patterns
 * has a relative error of sqrt(2 / 2047) = 0.031, with the kurtosis of means of edges at most twice
 * that; a slope therefore one of 0.062 / (sqrt(2) ln 4) = 0.032. The bounds are 5 of them from what
 * was measured, -1.33 and -1.00: false alarms below 1e-6. */
static void a_pixel_converges_as_it_did(void **state)
{
    const double sheared = slope_of_pixel(*state, "sobol", "equal-area");
    const double unsheared = slope_of_pixel(*state, "mj", "none");
    print_message("slopes: %.3f sheared, %.3f without\n", sheared, unsheared);
    assert_near(sheared, -1.33, 0.16);
    assert_near(unsheared, -1.00, 0.16);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_is_that_of_time_slices),
        cmocka_unit_test(moving_surfaces_are_the_mean_of_time_slices),
        cmocka_unit_test(velocities_are_those_of_the_film),
        cmocka_unit_test(the_integrand_has_the_time),
        cmocka_unit_test(the_shear_of_time_lowers_the_variance),
        cmocka_unit_test(ramps_have_to_fit),
        cmocka_unit_test(a_pixel_converges_as_it_did),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
