/* Variance against N of every sampler on integrands with known rates, as a table.
 *
 * Integrands: an axis-aligned step in x; a slanted step in (x, y); a disk in (x, y); a smooth
 * function of (x, y); the half-space x + y + u + v < 2; a smooth function of all four. Expected
 * slopes of the variance: -1 for independent points; stratification in d dimensions gives -1 - 1/d
 * for discontinuities and -1 - 2/d for smooth functions (Cook 1986; Singh & Jarosz 2017, table 1).
 *
 * Errors: 300 replicates give each variance a relative standard error of sqrt(2/299) = 0.082 (near
 * normal means; heavier tails at most double it), and a slope over 5 sizes spaced by log 4 one of
 * 0.082 / (log 4 sqrt(10)) = 0.019, or 0.037. The intervals below leave 0.15 or more to either side
 * of the expected slope, 4 standard errors even with heavy tails: false alarms below 1e-4 for each
 * row; seeds are fixed. Where each of N parts of x has a point, the count below
 * 1/3 has the variance 2/9, and the step's slope is -2. "Steeper" is 0.15 as well, of slopes near
 * -3 against -2. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/analysis.h"
#include "clshear/device/sampler/sampler.h"

enum {
    INTEGRANDS = 6,
    SIZES = 5,
    REPLICATES = 300
};

static const char *const names[INTEGRANDS] = {"step",   "slanted",    "disk",
                                              "smooth", "half-space", "smooth 4D"};
static const cs_u32 sizes[SIZES] = {16, 64, 256, 1024, 4096};

static void integrands(const cs_f32 *t, double *values)
{
    const double x = t[0], y = t[1], u = t[2], v = t[3];
    values[0] = x < 1.0 / 3.0; /* a third or two thirds of a stratum for all N here */
    values[1] = x + 0.618 * y < 0.7713;
    values[2] = (x - 0.51) * (x - 0.51) + (y - 0.47) * (y - 0.47) < 0.1153;
    values[3] = exp(sin(6.283185307179586 * (x + 0.1)) + cos(6.283185307179586 * y));
    values[4] = x + y + u + v < 2.0;
    values[5] = exp(-2.0 * ((x - 0.4) * (x - 0.4) + (y - 0.7) * (y - 0.7) + (u - x) * (u - x) +
                            (v - 0.2) * (v - 0.2)));
}

/* Computes the means of patterns of one size for each integrand: means[k][r]. */
static void measure_means(cs_u32 sampler, cs_u32 size, cs_u32 *count, double (*means)[REPLICATES])
{
    test_pattern drawn = test_pattern_of(sampler, size, CS_ORDER_SEQUENCE);
    *count = drawn.pattern.grid.count;
    for (cs_u32 t = 0; t < REPLICATES; t++) {
        double sum[INTEGRANDS] = {0};
        for (cs_u32 i = 0; i < *count; i++) {
            cs_f32 tuple[CS_DIMENSIONS] = {0};
            double values[INTEGRANDS];
            cs_draw(&drawn.pattern, drawn.rows.items, cs_pattern_key(11, t, 0), i, tuple);
            integrands(tuple, values);
            for (int k = 0; k < INTEGRANDS; k++)
                sum[k] += values[k];
        }
        for (int k = 0; k < INTEGRANDS; k++)
            means[k][t] = sum[k] / *count;
    }
    test_pattern_free(&drawn);
}

/* Number of sizes with variances above rounding (1e-14), at least two. */
static int sizes_above_rounding(double (*means)[REPLICATES])
{
    int kept = 2;
    for (; kept < SIZES; kept++) {
        double mean = 0.0, sum = 0.0;
        for (int r = 0; r < REPLICATES; r++)
            mean += means[kept][r] / REPLICATES;
        for (int r = 0; r < REPLICATES; r++)
            sum += pow(means[kept][r] - mean, 2);
        if (sum / (REPLICATES - 1) < 1e-14) break;
    }
    return kept;
}

/* Measures the slopes of one sampler. */
static void measure_slopes(cs_u32 sampler, double *slope)
{
    static double means[SIZES][INTEGRANDS][REPLICATES], of_one[SIZES][REPLICATES];
    cs_u32 count[SIZES];
    for (int i = 0; i < SIZES; i++)
        measure_means(sampler, sizes[i], &count[i], means[i]);
    for (int k = 0; k < INTEGRANDS; k++) {
        double errors[SIZES];
        clshear_fit fit = {.struct_size = sizeof fit};
        for (int i = 0; i < SIZES; i++)
            memcpy(of_one[i], means[i][k], sizeof of_one[i]);
        const int kept = sizes_above_rounding(of_one);
        test_ok(clshear_fit_slope(count, (size_t)kept, of_one[0], REPLICATES, NULL, errors, &fit));
        slope[k] = fit.slope;
    }
}

typedef struct expectation {
    cs_u32 sampler;
    int integrand;
    double low, high; /* bounds of the slope */
} expectation;

static const expectation expected[] = {
    {CS_SAMPLER_HALTON, 2, -1.75, -1.35},      {CS_SAMPLER_HALTON, 4, -1.45, -1.05},
    {CS_SAMPLER_OA3, 2, -1.5, -1.1},           {CS_SAMPLER_OA3, 0, -2.15, -1.85},
    {CS_SAMPLER_RANK1, 0, -2.15, -1.85},       {CS_SAMPLER_RANDOM, 0, -1.15, -0.85},
    {CS_SAMPLER_RANDOM, 3, -1.15, -0.85},      {CS_SAMPLER_RANDOM, 5, -1.15, -0.85},
    {CS_SAMPLER_JITTERED, 1, -1.65, -1.35},    {CS_SAMPLER_JITTERED, 2, -1.65, -1.35},
    {CS_SAMPLER_JITTERED, 3, -2.2, -1.85},     {CS_SAMPLER_JITTERED, 4, -1.15, -0.85},
    {CS_SAMPLER_JITTERED4D, 4, -1.4, -1.1},    {CS_SAMPLER_JITTERED4D, 5, -1.7, -1.35},
    {CS_SAMPLER_NROOKS, 0, -2.15, -1.85},      {CS_SAMPLER_NROOKS, 1, -1.15, -0.85},
    {CS_SAMPLER_NROOKS, 2, -1.15, -0.85},      {CS_SAMPLER_MJ, 0, -2.15, -1.85},
    {CS_SAMPLER_MJ, 2, -1.65, -1.35},          {CS_SAMPLER_MJ, 4, -1.15, -0.85},
    {CS_SAMPLER_CMJ, 4, -1.15, -0.85},         {CS_SAMPLER_OA, 2, -1.65, -1.35},
    {CS_SAMPLER_POISSON, 1, -1.3, -0.85},      {CS_SAMPLER_POISSON, 3, -1.2, -0.85},
    {CS_SAMPLER_CCVT, 2, -1.75, -1.35},        {CS_SAMPLER_CCVT, 4, -1.15, -0.85},
    {CS_SAMPLER_SOBOL, 0, -2.15, -1.85},       {CS_SAMPLER_SOBOL, 2, -1.75, -1.35},
    {CS_SAMPLER_SZ, 2, -1.75, -1.35},          {CS_SAMPLER_SOBOL_PAIRS, 2, -1.75, -1.35},
    {CS_SAMPLER_SOBOL_PAIRS, 4, -1.15, -0.85},
};

/* Samplers with steeper slopes than jittering for smooth functions. */
static const cs_u32 steeper[] = {CS_SAMPLER_CCVT, CS_SAMPLER_SOBOL, CS_SAMPLER_SOBOL_PAIRS,
                                 CS_SAMPLER_SZ};

static void slopes_are_as_in_theory(void **state)
{
    static double slope[CS_SAMPLER_COUNT][INTEGRANDS];
    int wrong = 0;
    (void)state;
    printf("| sampler |");
    for (int k = 0; k < INTEGRANDS; k++)
        printf(" %s |", names[k]);
    printf("\n|---|---|---|---|---|---|---|\n");
    for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++) {
        measure_slopes(sampler, slope[sampler]);
        printf("| %s |", cs_sampler_name(sampler));
        for (int k = 0; k < INTEGRANDS; k++)
            printf(" %.2f |", slope[sampler][k]);
        printf("\n");
        fflush(stdout);
    }
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const expectation *e = &expected[i];
        const double s = slope[e->sampler][e->integrand];
        if (s >= e->low && s <= e->high) continue;
        wrong++;
        printf("%s on %s: %.3f is not in [%g, %g]\n", cs_sampler_name(e->sampler),
               names[e->integrand], s, e->low, e->high);
    }
    for (size_t i = 0; i < sizeof steeper / sizeof *steeper; i++)
        if (!(slope[steeper[i]][3] <= slope[CS_SAMPLER_JITTERED][3] - 0.15)) {
            wrong++;
            printf("%s is not steeper than jittering\n", cs_sampler_name(steeper[i]));
        }
    assert_int_equal(wrong, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(slopes_are_as_in_theory)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
