/* Spectra against closed forms and direct sums, predicted against measured variance, and slope
 * fits. */
#include "support.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>

#include "clshear/analysis.h"
#include "clshear/device/hash.h"

static const double pi = 3.14159265358979323846;

static clshear_points *drawn(const char *sampler, size_t count, size_t sets, const char *names)
{
    clshear_points *points = NULL;
    test_ok(clshear_points_draw(sampler, count, sets, 3, &points));
    test_ok(clshear_points_select(points, names));
    return points;
}

static clshear_spectrum *measured(const clshear_points *points, size_t width, size_t height)
{
    clshear_context *context = test_context();
    clshear_spectrum *spectrum = NULL;
    test_ok(clshear_spectrum_measure(context, points, width, height, &spectrum));
    clshear_context_free(context);
    return spectrum;
}

/* Spectra with any number of points, sides and sets equal direct sums in double precision, up to
 * 1e-6 sqrt(N) for single precision. */
static void spectra_are_direct_sums(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 7, 1000, 1024, 2500},
                        sides[][2] = {{2, 2}, {33, 18}, {64, 7}};
    for (int c = 0; c < 5; c++)
        for (int s = 0; s < 3; s++) {
            clshear_points *points = drawn("random", counts[c], 2, "xu");
            clshear_spectrum *spectrum = measured(points, sides[s][0], sides[s][1]);
            for (size_t i = 0; i < sides[s][0] * sides[s][1]; i++) {
                const double x = (double)(i % sides[s][0]) - (double)(sides[s][0] / 2);
                const double y = (double)(i / sides[s][0]) - (double)(sides[s][1] / 2);
                double power = 0.0;
                for (size_t set = 0; set < 2; set++) {
                    double re = 0.0, im = 0.0;
                    for (size_t j = 0; j < counts[c]; j++) {
                        const float *p = clshear_points_values(points) + 2 * (set * counts[c] + j);
                        const double phase = 2.0 * pi * (x * (double)p[0] + y * (double)p[1]);
                        re += cos(phase);
                        im += sin(phase);
                    }
                    power += 0.5 * (re * re + im * im) / (double)counts[c];
                }
                assert_near(clshear_spectrum_power(spectrum)[i], power, 2e-4 * (1.0 + power));
            }
            const size_t dc = sides[s][1] / 2 * sides[s][0] + sides[s][0] / 2;
            assert_near(clshear_spectrum_power(spectrum)[dc], (double)counts[c], 1e-3);
            clshear_spectrum_free(spectrum);
            clshear_points_free(points);
        }
}

static double sinc2(double x)
{
    return fabs(x) < 1e-9 ? 1.0 : pow(sin(pi * x) / (pi * x), 2);
}

/* Expected power of random points, of one jittered point in each of 8 x 8 strata, and of 64 rooks.
 * Two rooks are in different columns and rows, so their correlation is -1/63 in each direction. */
static double closed_form(int which, int x, int y)
{
    const double column = sinc2(x / 64.0), row = sinc2(y / 64.0);
    if (which == 0) return 1.0;
    if (which == 1) return 1.0 - sinc2(x / 8.0) * sinc2(y / 8.0);
    if (x == 0) return 1.0 - row;
    return y == 0 ? 1.0 - column : 1.0 + column * row / 63.0;
}

/* A mean of M = 400 periodograms has the relative variance 1/M at each frequency. The mean over K
 * = 1860 frequencies of M (P / E - 1)^2 is therefore 1 with standard deviation sqrt(2 / K) =
 * 0.033; the tolerance of 0.23 is seven of these. A formula with an error of 5 % everywhere would
 * give 2. */
static void spectra_match_closed_forms(void **state)
{
    (void)state;
    static const char *const samplers[] = {"random", "jittered", "nrooks"};
    const int side = 61, sets = 400;
    for (int which = 0; which < 3; which++) {
        clshear_points *points = drawn(samplers[which], 64, (size_t)sets, "xy");
        clshear_spectrum *spectrum = measured(points, (size_t)side, (size_t)side);
        double sum = 0.0, count = 0.0;
        for (int y = 0; y <= side / 2; y++)
            for (int x = y == 0 ? 1 : -side / 2; x <= side / 2; x++) {
                const size_t at = (size_t)((y + side / 2) * side + x + side / 2);
                const double expected = closed_form(which, x, y);
                sum += sets * pow((double)clshear_spectrum_power(spectrum)[at] / expected - 1.0, 2);
                count++;
            }
        if (fabs(sum / count - 1.0) > 0.23) fail_msg("%s: %g", samplers[which], sum / count);
        clshear_spectrum_free(spectrum);
        clshear_points_free(points);
    }
}

/* Rings of random points are at 1 and -10 dB; 100 sets of 256 points. The mean of a ring with k
 * frequencies has a standard error of 0.1 / sqrt(k), and its relative variance one of sqrt(2 / k):
 * 0.63 dB at k = 100. */
static void rings_and_directions_are_read_off(void **state)
{
    (void)state;
    float mean[32], anisotropy[32], along[32];
    clshear_points *points = drawn("random", 256, 100, "xy");
    clshear_spectrum *spectrum = measured(points, 65, 80);
    assert_int_equal(clshear_spectrum_radius(spectrum), 32);
    clshear_spectrum_radial(spectrum, mean, anisotropy);
    for (int r = 20; r < 32; r++) {
        assert_near(mean[r], 1.0f, 0.08f);
        assert_near(anisotropy[r], -10.0f, 4.0f);
    }
    clshear_spectrum_along(spectrum, 0.0, 1.0, along);
    for (size_t r = 0; r < 32; r++)
        assert_near(along[r], clshear_spectrum_power(spectrum)[(40 + r + 1) * 65 + 32], 0);
    clshear_spectrum_along(spectrum, 1.0, -3.0, along); /* 6 steps within radius 20 */
    assert_near(along[19], clshear_spectrum_power(spectrum)[(40 - 18) * 65 + 32 + 6], 0);
    clshear_spectrum_free(spectrum);
    clshear_points_free(points);
}

static double variance_of(const double *values, size_t count)
{
    double mean = 0.0, sum = 0.0;
    for (size_t i = 0; i < count; i++)
        mean += values[i] / (double)count;
    for (size_t i = 0; i < count; i++)
        sum += pow(values[i] - mean, 2);
    return sum / (double)(count - 1);
}

enum {
    SAMPLERS = 5,
    SIDE = 2048,
    SETS = 8000
};

/* The step points along x, the direction of the hairlines of nrooks and mj; the others are at an
 * angle. */
static clshear_integrand integrand_called(int which)
{
    static const char *const names[] = {"step", "box", "disk", "gaussian", "tent", "plane-wave"};
    clshear_integrand integrand = {.struct_size = sizeof integrand};
    test_ok(clshear_integrand_find(names[which], &integrand));
    integrand.angle_deg = which == 0 ? 0.0 : 20.0;
    return integrand;
}

/* The tail, which is the last part. */
static double tail_of(const clshear_prediction *prediction)
{
    const size_t last = clshear_prediction_parts(prediction) - 1;
    assert_string_equal(clshear_prediction_part_name(prediction, last), "tail");
    return clshear_prediction_part_variance(prediction, last);
}

/* Six integrands, five samplers: 8000 shifted sets of 64 points against the spectrum of 2000 other
 * sets. The relative standard error of a variance is sqrt((kurtosis - 1) / 8000): 0.016 for normal
 * means, up to 0.025 if few frequencies dominate. The prediction's error is at most 0.02, if one
 * frequency dominates. The tolerance of 10 % is at least three standard errors; seeds are fixed. */
static void prediction_equals_measurement(void **state)
{
    (void)state;
    static const char *const samplers[SAMPLERS] = {"random", "jittered", "nrooks", "mj", "sobol"};
    clshear_spectrum *spectra[SAMPLERS];
    clshear_points *points[SAMPLERS];
    float *cells = malloc((size_t)SIDE * SIDE * sizeof *cells);
    double *means = malloc(2 * SETS * sizeof *means);
    for (int s = 0; s < SAMPLERS; s++) {
        points[s] = drawn(samplers[s], 64, 2000, "xy");
        spectra[s] = measured(points[s], 255, 255);
        clshear_points_free(points[s]);
        points[s] = drawn(samplers[s], 64, 2 * SETS, "xy");
    }
    for (int f = 0; f < 6; f++) {
        const clshear_integrand integrand = integrand_called(f);
        double mean_square;
        test_ok(clshear_integrand_tabulate(&integrand, SIDE, cells, &mean_square));
        for (int s = 0; s < SAMPLERS; s++) {
            clshear_prediction *predicted = NULL;
            test_ok(clshear_predict_variance(spectra[s], cells, SIDE, mean_square, &predicted));
            const double expected = clshear_prediction_variance(predicted);
            const double tail = tail_of(predicted);
            clshear_prediction_free(predicted);
            clshear_points_integrate(points[s], &integrand, 1, 5, means);
            const double variance = variance_of(means + SETS, SETS);
            const double ratio = expected / variance;
            printf("%-9s %d at %.0f: predicted %.3e measured %.3e ratio %.3f, tail %.0f %%\n",
                   samplers[s], f, integrand.angle_deg, expected, variance, ratio,
                   100.0 * tail / expected);
            if (fabs(ratio - 1.0) > 0.1) fail_msg("%s, integrand %d: %g", samplers[s], f, ratio);
        }
    }
    for (int s = 0; s < SAMPLERS; s++) {
        clshear_spectrum_free(spectra[s]);
        clshear_points_free(points[s]);
    }
    free(cells);
    free(means);
}

/* Normal means of variance N^-1.5: the fit finds the slope, and its interval contains it. 200
 * replicates at four sizes: standard error 0.032. */
static void slopes_are_fitted(void **state)
{
    (void)state;
    static const uint32_t counts[] = {16, 64, 256, 1024};
    double means[4 * 200], errors[4];
    const double reference = 1.0;
    clshear_fit fit = {.struct_size = sizeof fit};
    for (cs_u32 i = 0; i < 800; i++) {
        const double a = 0x1p-32 * (cs_key(i, 1) + 0.5), b = 0x1p-32 * cs_key(i, 2);
        means[i] = 1.0 + pow(counts[i / 200], -0.75) * sqrt(-2.0 * log(a)) * cos(2.0 * pi * b);
    }
    for (int with = 0; with < 2; with++) {
        assert_int_equal(
            clshear_fit_slope(counts, 4, means, 200, with ? &reference : NULL, errors, &fit),
            CLSHEAR_OK);
        assert_near(fit.slope, -1.5, 0.16);
        assert_below(fit.slope_low, -1.5);
        assert_below(-1.5, fit.slope_high);
        assert_above(fit.slope_high - fit.slope_low, 0.05);
        assert_below(fit.slope_high - fit.slope_low, 0.3);
    }
    assert_int_equal(clshear_fit_slope(counts, 1, means, 200, NULL, errors, &fit),
                     CLSHEAR_BAD_ARGUMENT);
    const uint32_t same[] = {16, 16};
    assert_int_equal(clshear_fit_slope(same, 2, means, 200, NULL, errors, &fit),
                     CLSHEAR_BAD_ARGUMENT);
    for (int i = 0; i < 800; i++) /* parts with means of exactly N^-1.5 */
        means[i] = pow(counts[i / 200], -1.5) * (1.0 + i % 200);
    assert_int_equal(clshear_fit_slope_of_parts(counts, 4, means, 200, errors, &fit), CLSHEAR_OK);
    assert_near(fit.slope, -1.5, 1e-9);
    assert_near(fit.slope_low, -1.5, 1e-9);
    assert_near(errors[1], pow(64.0, -1.5) * 100.5, 1e-9);
}

/* Computes spectra of one wave per side. Returns NULL if their power is in two frequencies. */
static void *transform_waves(void *argument)
{
    const size_t first = *(const size_t *)argument;
    float values[40 * 40];
    for (size_t side = first; side < 40; side++) {
        clshear_spectrum *spectrum = NULL;
        for (size_t i = 0; i < side * side; i++)
            values[i] = (float)cos(2.0 * pi * (double)(i % side) / (double)side);
        if (clshear_spectrum_of_grid(values, side, side, &spectrum) != CLSHEAR_OK) return argument;
        const float *power = clshear_spectrum_power(spectrum);
        const size_t middle = side / 2 * side + side / 2;
        const double expected = 0.5 * (double)(side * side - 1);
        const int good = fabs((double)power[middle - 1] / expected - 1.0) < 1e-4 &&
                         fabs((double)power[middle + 1] / expected - 1.0) < 1e-4;
        clshear_spectrum_free(spectrum);
        if (!good) return argument;
    }
    return NULL;
}

/* All threads of a process share FFTW's planner. */
static void threads_share_the_planner(void **state)
{
    enum {
        THREADS = 8,
        ROUNDS = 20
    };
    pthread_t threads[THREADS];
    size_t first[THREADS];
    (void)state;
    for (int round = 0; round < ROUNDS; round++) {
        for (size_t t = 0; t < THREADS; t++) {
            first[t] = 4 + t;
            assert_int_equal(pthread_create(&threads[t], NULL, transform_waves, &first[t]), 0);
        }
        for (size_t t = 0; t < THREADS; t++) {
            void *wrong;
            assert_int_equal(pthread_join(threads[t], &wrong), 0);
            assert_null(wrong);
        }
    }
}

/* N-rooks are good along the axes alone. On a step along one, the isotropic formula is far too
 * high; more cones of directions bring the sum down to the prediction, which knows every frequency.
 */
static void many_cones_are_the_anisotropic_sum(void **state)
{
    (void)state;
    const clshear_integrand step = {
        .struct_size = sizeof step, .kind = CLSHEAR_INTEGRAND_STEP, .extent = 0.137};
    float *cells = malloc((size_t)SIDE * SIDE * sizeof *cells);
    clshear_points *points = drawn("nrooks", 64, 100, "xy");
    clshear_spectrum *spectrum = measured(points, 255, 255);
    clshear_prediction *p = NULL;
    double mean_square;
    test_ok(clshear_integrand_tabulate(&step, SIDE, cells, &mean_square));
    test_ok(clshear_predict_variance(spectrum, cells, SIDE, mean_square, &p));
    const double variance = clshear_prediction_variance(p);
    assert_true(clshear_prediction_in_cones(p, 0) == clshear_prediction_isotropic(p));
    assert_true(clshear_prediction_in_cones(p, 9) == variance);
    assert_above(clshear_prediction_in_cones(p, 0), 10.0 * variance);
    for (size_t level = 2; level <= 8; level++)
        assert_below(clshear_prediction_in_cones(p, level),
                     clshear_prediction_in_cones(p, level - 1));
    assert_near(clshear_prediction_in_cones(p, 8), variance, 0.15 * variance);
    clshear_prediction_free(p);
    clshear_spectrum_free(spectrum);
    clshear_points_free(points);
    free(cells);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spectra_are_direct_sums),
        cmocka_unit_test(spectra_match_closed_forms),
        cmocka_unit_test(rings_and_directions_are_read_off),
        cmocka_unit_test(prediction_equals_measurement),
        cmocka_unit_test(many_cones_are_the_anisotropic_sum),
        cmocka_unit_test(slopes_are_fitted),
        cmocka_unit_test(threads_share_the_planner),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
