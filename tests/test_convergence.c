/* The convergence regression: the reason for this program.
 *
 * Two pixels of scenes/cornell.obj, with camera, lens and light from its settings file; one of them
 * through a round aperture too. The variance of one pattern of N samples is measured with
 * REPLICATES independent patterns, for N = 64 ... 4096, and a line is fitted to its logarithm.
 *
 * Errors: the relative standard error of a variance from R = 512 replicates of near-normal means is
 * sqrt(2 / 511) = 0.063. The heavier tails of edges double it at most. The slope over four points
 * spaced by log 4 then has the standard error 0.063 / (log 4 * sqrt(5)) = 0.020, or 0.040 with
 * heavy tails. Seeds are fixed, so a false alarm means a change of code, not of luck. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/analysis.h"

enum {
    REPLICATES = 512,
    SIZES = 4
};

static const uint32_t sizes[SIZES] = {64, 256, 1024, 4096};

typedef struct measurement {
    double slope;
    double error[SIZES]; /* variance of one pattern, in green */
} measurement;

/* Computes the means of the patterns of one size. */
static void measure_size(test_fixture *made, clshear_settings *settings, uint32_t size,
                         double *means)
{
    test_set(settings, CLSHEAR_SPP, "%u", REPLICATES * size);
    clshear_film *film = test_render(made->scene, settings);
    for (int r = 0; r < REPLICATES; r++) {
        char name[32];
        snprintf(name, sizeof name, "Pattern%d.G", r);
        means[r] = (double)*clshear_film_channel(film, name);
    }
    clshear_film_free(film);
}

static measurement measure_pixel(test_fixture *made, int x, int y, const char *aperture,
                                 const char *sampler, clshear_shear shear)
{
    static double means[SIZES][REPLICATES];
    measurement result;
    clshear_fit fit = {.struct_size = sizeof fit};
    clshear_settings *settings = test_settings(made->settings, 512, 512, REPLICATES);
    test_set(settings, CLSHEAR_CROP, "%d,%d,%d,%d", x, x + 1, y, y + 1);
    test_set(settings, CLSHEAR_REPLICATES, "%d", REPLICATES);
    test_set(settings, CLSHEAR_KEEP_PATTERNS, "1");
    test_set(settings, CLSHEAR_SAMPLER, "%s", sampler);
    test_set(settings, CLSHEAR_ORACLE, "centre");
    test_set(settings, CLSHEAR_APERTURE, "%s", aperture);
    test_set_number(settings, CLSHEAR_SHEAR, shear);
    for (int k = 0; k < SIZES; k++)
        measure_size(made, settings, sizes[k], means[k]);
    test_ok(clshear_fit_slope(sizes, SIZES, means[0], REPLICATES, NULL, result.error, &fit));
    result.slope = fit.slope;
    printf("pixel %d,%d %s shear %d: slope %.3f, variance at N = 1024 %.3g\n", x, y, sampler,
           (int)shear, result.slope, result.error[2]);
    clshear_settings_free(settings);
    return result;
}

/* The variance of unsheared pairs falls as 1/N: -1 +- 0.15 is 3.7 standard errors even with heavy
 * tails, a two-sided false-alarm rate of 2e-4 (1e-13 with light tails). With shear, edges give
 * -1.5: -1.35 is 3.7 and 7.5 standard errors away, one-sided 1e-4 and 3e-14. The ratio at N = 1024
 * is 10 or more; a ratio below 5 by chance is 5 standard errors of its logarithm, 6e-7. */
static void expect_gain(test_fixture *made, int x, int y, const char *aperture)
{
    const measurement none = measure_pixel(made, x, y, aperture, "mj", CLSHEAR_SHEAR_NONE);
    const measurement sheared = measure_pixel(made, x, y, aperture, "mj", CLSHEAR_SHEAR_EQUAL_AREA);
    assert_near(none.slope, -1.0, 0.15);
    assert_at_most(sheared.slope, -1.35);
    assert_at_least(none.error[2], 5.0 * sheared.error[2]);
}

/* The textured back wall, out of focus. */
static void back_wall_converges_faster(void **state)
{
    expect_gain(*state, 302, 130, "square");
}

/* The left front edge of the tall box, out of focus: a lit and a dark face meet at one depth. */
static void box_edge_converges_faster(void **state)
{
    expect_gain(*state, 146, 330, "square");
    expect_gain(*state, 146, 330, "disk");
}

/* A 4D net gains from shear too, but less than pairs, because its slope without shear is already
 * below -1. A ratio of 3 falls below 1.5 by chance at 5.5 standard errors, 4e-8. */
static void nets_converge_faster(void **state)
{
    static const char *const samplers[] = {"sobol", "halton", "sz"};
    test_fixture *made = *state;
    for (int i = 0; i < 3; i++) {
        const char *sampler = samplers[i];
        const measurement none =
            measure_pixel(made, 146, 330, "square", sampler, CLSHEAR_SHEAR_NONE);
        const measurement sheared =
            measure_pixel(made, 146, 330, "square", sampler, CLSHEAR_SHEAR_EQUAL_AREA);
        assert_at_most(sheared.slope, -1.35);
        assert_at_least(none.error[2], 1.5 * sheared.error[2]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(back_wall_converges_faster),
        cmocka_unit_test(box_edge_converges_faster),
        cmocka_unit_test(nets_converge_faster),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
