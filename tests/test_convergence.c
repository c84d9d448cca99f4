/* The convergence regression: the reason this program exists.
 *
 * Two pixels of scenes/cornell.obj, as its settings file has camera, lens and light; one of them
 * through a round aperture too. Variance of
 * one pattern of N samples is measured with REPLICATES independent patterns, for N = 64 ... 4096,
 * and a line is fitted to its logarithm.
 *
 * Errors: the relative standard error of a variance from R = 512 replicates of near-normal means is
 * sqrt(2 / 511) = 0.063; heavier tails, which edges have, double it at most. The slope over four
 * points spaced by log 4 then has the standard error 0.063 / (log 4 * sqrt(5)) = 0.020, or 0.040
 * with heavy tails. Seeds are fixed, so a false alarm means a change of code, not of luck. */
#include "support.h"

#include <math.h>
#include <stdio.h>

enum {
    REPLICATES = 512,
    SIZES = 4
};

static const uint32_t sizes[SIZES] = {64, 256, 1024, 4096};

typedef struct fit {
    double slope;
    double variance[SIZES];
    double mean;
} fit;

static fit measure(test_fixture *made, int x, int y, const char *sampler, clshear_shear shear)
{
    fit result = {0};
    double sums[4] = {0}; /* x, y, xx, xy of the logarithms */
    for (int k = 0; k < SIZES; k++) {
        clshear_options options = clshear_options_defaults();
        const int crop[4] = {x, x + 1, y, y + 1};
        clshear_film *film = NULL;
        memcpy(options.crop, crop, sizeof crop);
        options.spp = REPLICATES * sizes[k];
        options.replicates = REPLICATES;
        options.sampler = sampler;
        options.shear = shear;
        options.oracle = CLSHEAR_ORACLE_CENTRE;
        test_ok(made->context, clshear_render(made->scene, &made->camera, &options, &film));
        result.variance[k] = REPLICATES * (double)*clshear_film_channel(film, "Variance.G");
        result.mean = (double)*clshear_film_channel(film, "G");
        clshear_film_free(film);
        double a = log(sizes[k]), b = log(result.variance[k]);
        sums[0] += a, sums[1] += b, sums[2] += a * a, sums[3] += a * b;
    }
    result.slope = (SIZES * sums[3] - sums[0] * sums[1]) / (SIZES * sums[2] - sums[0] * sums[0]);
    printf("pixel %d,%d %s shear %d: slope %.3f, variance at N = 1024 %.3g, mean %.4f\n", x, y,
           sampler, (int)shear, result.slope, result.variance[2], result.mean);
    return result;
}

/* Unsheared pairs fall as 1/N: -1 +- 0.15 is 3.7 standard errors even with heavy tails, two-sided
 * false-alarm rate 2e-4 (1e-13 with light ones). Sheared, edges give -1.5: -1.35 is 3.7 and 7.5
 * standard errors away, one-sided 1e-4 and 3e-14. The ratio at N = 1024 is 10 and more; that it
 * comes out below 5 by chance takes 5 standard errors of its logarithm, 6e-7. */
static void expect_gain(test_fixture *made, int x, int y, clshear_aperture aperture)
{
    made->camera.aperture = aperture;
    fit none = measure(made, x, y, "mj", CLSHEAR_SHEAR_NONE);
    fit sheared = measure(made, x, y, "mj", CLSHEAR_SHEAR_EQUAL_AREA);
    assert_true(fabs(none.slope + 1.0) < 0.15);
    assert_true(sheared.slope <= -1.35);
    assert_true(none.variance[2] >= 5.0 * sheared.variance[2]);
}

/* The textured back wall, out of focus. */
static void back_wall_converges_faster(void **state)
{
    expect_gain(*state, 302, 130, CLSHEAR_APERTURE_SQUARE);
}

/* The left front edge of the tall box, out of focus: a lit and a dark face meet at one depth. */
static void box_edge_converges_faster(void **state)
{
    expect_gain(*state, 146, 330, CLSHEAR_APERTURE_SQUARE);
    expect_gain(*state, 146, 330, CLSHEAR_APERTURE_DISK);
}

/* A 4D net gains from shear too: less than pairs, since it does not start at -1. A ratio of 3 that
 * comes out below 1.5 by chance takes 5.5 standard errors, 4e-8. */
static void nets_converge_faster(void **state)
{
    static const char *const samplers[] = {"sobol", "halton", "sz"};
    test_fixture *made = *state;
    made->camera.aperture = CLSHEAR_APERTURE_SQUARE;
    for (int i = 0; i < 3; i++) {
        fit none = measure(made, 146, 330, samplers[i], CLSHEAR_SHEAR_NONE);
        fit sheared = measure(made, 146, 330, samplers[i], CLSHEAR_SHEAR_EQUAL_AREA);
        assert_true(sheared.slope <= -1.35);
        assert_true(none.variance[2] >= 1.5 * sheared.variance[2]);
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
