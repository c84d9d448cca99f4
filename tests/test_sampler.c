/* Requirements of every sampler: uniform, unbiased, independent, and the same in any order. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/device/sampler/sampler.h"

static const cs_u32 counts[] = {1, 2, 3, 5, 7, 16, 49, 64, 101, 512, 1000, 1024};
enum {
    COUNTS = sizeof counts / sizeof *counts
};

static cs_u32 stratum(cs_f32 value, cs_u32 strata)
{
    return (cs_u32)((double)value * strata);
}

/* Over many patterns, the pairs of one sample are uniform in the unit square: chi-square on 8 x 8
 * cells, 63 degrees of freedom, 64 000 patterns. The limit of 140 is 6.9 standard deviations above
 * the mean; false alarms below 1e-7 for each of 225 tests. */
static void single_samples_are_uniform(void **state)
{
    static const cs_u32 sizes[] = {1, 7, 16, 101, 1000};
    (void)state;
    for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++)
        for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
            test_pattern drawn = test_pattern_of(sampler, sizes[k], CS_ORDER_COHERENT);
            cs_u32 hits[3][64] = {{0}};
            for (cs_u32 t = 0; t < 64000; t++) {
                cs_f32 tuple[CS_DIMENSIONS];
                test_draw(&drawn, cs_pattern_key(9, t, 0), t % drawn.pattern.grid.count, tuple);
                for (int pair = 0; pair < 3; pair++)
                    hits[pair][stratum(tuple[2 * pair + 1], 8) * 8 + stratum(tuple[2 * pair], 8)]++;
            }
            for (int pair = 0; pair < 3; pair++) {
                double chi = 0.0;
                for (int i = 0; i < 64; i++)
                    chi += pow(hits[pair][i] - 1000.0, 2) / 1000.0;
                if (chi >= 140.0)
                    fail_msg("%s, N = %u, pair %d: chi-square %g", cs_sampler_name(sampler),
                             sizes[k], pair, chi);
            }
            test_pattern_free(&drawn);
        }
}

/* Integrands: a 4D ball, a slanted half of the hypercube, a smooth product, and a mixed moment of
 * the light's pair. */
enum {
    INTEGRANDS = 4
};

static void integrands(const cs_f32 *t, double *values)
{
    const double x = t[0], y = t[1], u = t[2], v = t[3];
    values[0] = x * x + y * y + u * u + v * v < 1.0;
    values[1] = x + y - u - v > 0.0;
    values[2] = 16.0 * x * y * u * v;
    values[3] = 4.0 * t[4] * t[5];
}

static const double integrals[INTEGRANDS] = {0.308425137534042, 0.5, 1.0, 1.0};

static void estimate(const test_pattern *drawn, cs_u32 key, double *mean)
{
    const cs_u32 count = drawn->pattern.grid.count;
    memset(mean, 0, INTEGRANDS * sizeof *mean);
    for (cs_u32 i = 0; i < count; i++) {
        cs_f32 tuple[CS_DIMENSIONS];
        double values[INTEGRANDS];
        test_draw(drawn, key, i, tuple);
        integrands(tuple, values);
        for (int k = 0; k < INTEGRANDS; k++)
            mean[k] += values[k] / count;
    }
}

/* Estimates are unbiased for any N: z-test over the patterns, |z| < 5, false alarms 6e-7 for each
 * of 720 tests. */
static void estimates_are_unbiased(void **state)
{
    (void)state;
    for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++)
        for (int c = 0; c < COUNTS; c++) {
            test_pattern drawn = test_pattern_of(sampler, counts[c], CS_ORDER_COHERENT);
            double sum[INTEGRANDS] = {0}, squares[INTEGRANDS] = {0};
            const cs_u32 patterns = counts[c] > 60 ? 250 : 2000;
            for (cs_u32 t = 0; t < patterns; t++) {
                double mean[INTEGRANDS];
                estimate(&drawn, cs_pattern_key(1, t, 5), mean);
                for (int k = 0; k < INTEGRANDS; k++) {
                    sum[k] += mean[k];
                    squares[k] += mean[k] * mean[k];
                }
            }
            for (int k = 0; k < INTEGRANDS; k++) {
                const double mean = sum[k] / patterns;
                const double error = sqrt((squares[k] / patterns - mean * mean) / (patterns - 1.0));
                if (fabs(mean - integrals[k]) > 5.0 * error + 1e-6)
                    fail_msg("%s, N = %u, integrand %d: %g +- %g, not %g", cs_sampler_name(sampler),
                             counts[c], k, mean, error, integrals[k]);
            }
            test_pattern_free(&drawn);
        }
}

/* Patterns of neighbouring seeds, pixels and replicates are unrelated: the errors of their
 * estimates do not correlate. 4000 pairs; |r| < 0.09 is 5.7 standard deviations, false alarms 1e-8
 * for each of 180 tests. */
static void patterns_are_unrelated(void **state)
{
    static const cs_u32 others[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const cs_u32 pairs = 4000;
    (void)state;
    for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++) {
        test_pattern drawn = test_pattern_of(sampler, 16, CS_ORDER_COHERENT);
        for (int o = 0; o < 3; o++) {
            double ab[INTEGRANDS] = {0}, aa[INTEGRANDS] = {0}, bb[INTEGRANDS] = {0};
            for (cs_u32 t = 0; t < pairs; t++) {
                double a[INTEGRANDS], b[INTEGRANDS];
                const cs_u32 pixel = 2 * t;
                estimate(&drawn, cs_pattern_key(4, pixel, 2), a);
                estimate(&drawn,
                         cs_pattern_key(4 + others[o][0], pixel + others[o][1], 2 + others[o][2]),
                         b);
                for (int k = 0; k < INTEGRANDS; k++) {
                    a[k] -= integrals[k];
                    b[k] -= integrals[k];
                    ab[k] += a[k] * b[k];
                    aa[k] += a[k] * a[k];
                    bb[k] += b[k] * b[k];
                }
            }
            for (int k = 0; k < INTEGRANDS; k++)
                if (fabs(ab[k]) >= 0.09 * sqrt(aa[k] * bb[k]) + 1e-9)
                    fail_msg("%s: correlation %g with pattern %d", cs_sampler_name(sampler),
                             ab[k] / sqrt(aa[k] * bb[k]), o);
        }
        test_pattern_free(&drawn);
    }
}

/* The order of blocks is a permutation, and the table in drawing order has the same samples as the
 * table in the order of the sequence. */
static void orders_hold_the_same_samples(void **state)
{
    (void)state;
    for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++)
        for (cs_u32 n = 1; n < 300; n += 1 + n / 3) {
            test_pattern drawn = test_pattern_of(sampler, n, CS_ORDER_COHERENT);
            test_pattern sequence = test_pattern_of(sampler, n, CS_ORDER_SEQUENCE);
            const cs_u32 places = drawn.pattern.blocks * CS_BLOCK, count = drawn.pattern.grid.count;
            unsigned char *seen = calloc(places, 1);
            double sum[2] = {0};
            for (cs_u32 i = 0; i < places; i++) {
                const cs_u32 index = cs_index_at(&drawn.pattern, 99, i);
                assert_below(index, places);
                assert_true(!seen[index]);
                seen[index] = 1;
                if (index >= count || !cs_sampler_is_progressive(sampler)) continue;
                cs_f32 a[CS_DIMENSIONS], b[CS_DIMENSIONS];
                test_draw(&drawn, 5, index, a);
                test_draw(&sequence, 5, index, b);
                sum[0] += cs_hash(cs_as_vuint(a[0]) + cs_hash(cs_as_vuint(a[3])));
                sum[1] += cs_hash(cs_as_vuint(b[0]) + cs_hash(cs_as_vuint(b[3])));
            }
            assert_near(sum[0], sum[1], 0); /* whole numbers: exact */
            free(seen);
            test_pattern_free(&drawn);
            test_pattern_free(&sequence);
        }
}

/* Progressive samplers: a longer pattern begins with the shorter one's samples, and a pattern from
 * element `first` continues the sequence. */
static void progressive_samplers_go_on(void **state)
{
    cs_error error;
    (void)state;
    for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++) {
        if (!cs_sampler_is_progressive(sampler)) continue;
        test_pattern whole = test_pattern_of(sampler, 5000, CS_ORDER_SEQUENCE);
        test_pattern start = test_pattern_of(sampler, 300, CS_ORDER_SEQUENCE);
        test_pattern rest = {.pattern = cs_pattern_of(sampler, 300, 4700)};
        assert_int_equal(cs_sample_table_make(&rest.pattern, CS_ORDER_SEQUENCE, &rest.rows, &error),
                         CLSHEAR_OK);
        for (cs_u32 i = 0; i < 5000; i++) {
            cs_f32 a[CS_DIMENSIONS], b[CS_DIMENSIONS];
            test_draw(&whole, 31, i, a);
            test_draw(i < 300 ? &start : &rest, 31, i < 300 ? i : i - 300, b);
            assert_memory_equal(a, b, sizeof a);
        }
        test_pattern_free(&whole);
        test_pattern_free(&start);
        test_pattern_free(&rest);
    }
}

/* Constructions are valid for large and awkward counts too: points are inside the cube, and
 * lattices are not diagonals. */
static void large_patterns_are_sound(void **state)
{
    static const cs_u32 numbers[] = {3194, 59000, 674041, CS_MAX_PATTERN};
    (void)state;
    for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++)
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
            if (cs_sampler_count(sampler, numbers[k]) == 0) continue;
            if (sampler == CS_SAMPLER_CCVT && k > 0) continue; /* slow */
            test_pattern drawn = test_pattern_of(sampler, numbers[k], CS_ORDER_COHERENT);
            const cs_u32 count = drawn.pattern.grid.count;
            double products = 0.0;
            for (cs_u32 i = 0; i < count; i++) {
                cs_f32 t[CS_DIMENSIONS];
                test_draw(&drawn, 12, i, t);
                for (int d = 0; d < CS_DIMENSIONS; d++)
                    assert_true(t[d] >= 0.0f && t[d] < 1.0f);
                products += ((double)t[0] - 0.5) * ((double)t[2] - 0.5) * 12.0 / count;
            }
            /* A correlation of 0.1 is 5.6 standard errors for 3194 random points. */
            assert_below(fabs(products), 0.1);
            test_pattern_free(&drawn);
        }
}

/* The samplers whose coordinates lie in strata, with a place in them at random. */
static const cs_u32 on_grids[] = {CS_SAMPLER_JITTERED, CS_SAMPLER_JITTERED4D, CS_SAMPLER_NROOKS,
                                  CS_SAMPLER_MJ,       CS_SAMPLER_CMJ,        CS_SAMPLER_OA,
                                  CS_SAMPLER_OA3};
enum {
    LOW_BITS = 4 /* of 24: with 2^20 strata no more are at random */
};

/* Chi-square per degree of freedom of the last LOW_BITS bits of coordinate `dimension`, from
 * `patterns` patterns. */
static double low_bits_chi(const test_pattern *drawn, cs_u32 patterns, int dimension)
{
    double hits[1 << LOW_BITS] = {0}, chi = 0.0;
    const cs_u32 count = drawn->pattern.grid.count;
    for (cs_u32 t = 0; t < patterns; t++)
        for (cs_u32 i = 0; i < count; i++) {
            cs_f32 tuple[CS_DIMENSIONS];
            test_draw(drawn, cs_pattern_key(8, t, 0), i, tuple);
            hits[(cs_u32)(tuple[dimension] * 0x1p24f) % (1u << LOW_BITS)] += 1.0;
        }
    const double expected = (double)patterns * count / (1 << LOW_BITS);
    for (int b = 0; b < 1 << LOW_BITS; b++)
        chi += (hits[b] - expected) * (hits[b] - expected) / expected;
    return chi / ((1 << LOW_BITS) - 1);
}

/* Coordinates of grids are as fine as a float's, at every N: the last bits are at random, each
 * value of them as often as any other. Chi-square with 15 degrees of freedom is above 4.3 times
 * their number with a chance of 1e-7; bits that are always 0 give thousands. */
static void coordinates_are_whole_floats(void **state)
{
    static const cs_u32 numbers[] = {16, 101, 4096, CS_MAX_PATTERN};
    (void)state;
    for (size_t s = 0; s < sizeof on_grids / sizeof *on_grids; s++)
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
            const cs_u32 count = cs_sampler_count(on_grids[s], numbers[k]);
            if (count == 0) continue;
            test_pattern drawn = test_pattern_of(on_grids[s], count, CS_ORDER_SEQUENCE);
            for (int d = 0; d<CS_DIMENSIONS; d += count> 4096 ? 3 : 1) {
                const double chi = low_bits_chi(&drawn, count < 65536 ? 65536 / count : 1, d);
                if (chi > 4.3)
                    fail_msg("%s, N = %u, coordinate %d: chi-square %g of the last bits",
                             cs_sampler_name(on_grids[s]), count, d, chi);
            }
            test_pattern_free(&drawn);
        }
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* The largest distance of the distribution of `count` numbers in [0, 1) from the uniform one. */
static double distance_from_uniform(double *values, size_t count)
{
    double most = 0.0;
    qsort(values, count, sizeof *values, by_size);
    for (size_t i = 0; i < count; i++) {
        most = fmax(most, fabs(values[i] - (double)i / (double)count));
        most = fmax(most, fabs(values[i] - (double)(i + 1) / (double)count));
    }
    return most;
}

/* Places within the strata are uniform (Kolmogorov & Smirnov), and those of x and y independent:
 * the fraction of their sum is uniform too. 16384 points: a distance above 2.9 / sqrt(16384) has a
 * chance of 2 exp(-2 * 2.9^2) = 1e-7. */
static void places_in_strata_are_uniform(void **state)
{
    enum {
        POINTS = 16384
    };
    static double of_x[POINTS], of_sum[POINTS];
    static const cs_u32 numbers[] = {16, 256, 1024};
    (void)state;
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        const cs_u32 count = numbers[k];
        test_pattern drawn = test_pattern_of(CS_SAMPLER_MJ, count, CS_ORDER_SEQUENCE);
        for (cs_u32 i = 0; i < POINTS; i++) {
            cs_f32 t[CS_DIMENSIONS];
            test_draw(&drawn, cs_pattern_key(9, i / count, 0), i % count, t);
            of_x[i] = fmod((double)t[0] * count, 1.0);
            of_sum[i] = fmod((double)t[0] * count + (double)t[1] * count, 1.0);
        }
        assert_below(distance_from_uniform(of_x, POINTS), 2.9 / 128.0);
        assert_below(distance_from_uniform(of_sum, POINTS), 2.9 / 128.0);
        test_pattern_free(&drawn);
    }
}

/* Every name is found, and the message about an unknown name lists all of them. */
static void names_are_found(void **state)
{
    cs_error error;
    clshear_sampler_info info = {.struct_size = sizeof info};
    cs_u32 number, defaults = 0;
    (void)state;
    for (cs_u32 i = 0; i < CS_SAMPLER_COUNT; i++) {
        assert_int_equal(clshear_sampler_describe(i, &info), 1);
        assert_int_equal(cs_sampler_find(info.name, &number, &error), CLSHEAR_OK);
        assert_int_equal(number, i);
        defaults += info.is_default != 0;
        assert_int_equal(cs_sampler_count(i, CS_MAX_PATTERN + 1), 0);
        assert_at_most(cs_sampler_count(i, 1), 27);
        assert_int_equal(cs_sampler_count(i, cs_sampler_most(i)), cs_sampler_most(i));
    }
    assert_int_equal(defaults, 1);
    assert_int_equal(clshear_sampler_describe(CS_SAMPLER_COUNT, &info), 0);
    assert_int_equal(cs_sampler_find("dice", &number, &error), CLSHEAR_BAD_ARGUMENT);
    assert_non_null(strstr(error.message, "sobol-pairs"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(single_samples_are_uniform),
        cmocka_unit_test(estimates_are_unbiased),
        cmocka_unit_test(patterns_are_unrelated),
        cmocka_unit_test(orders_hold_the_same_samples),
        cmocka_unit_test(progressive_samplers_go_on),
        cmocka_unit_test(large_patterns_are_sound),
        cmocka_unit_test(coordinates_are_whole_floats),
        cmocka_unit_test(places_in_strata_are_uniform),
        cmocka_unit_test(names_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
