/* The guaranteed strata of the samplers. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/device/sampler/sampler.h"
#include "pattern/table_makers.h"

static const cs_u32 counts[] = {1, 2, 3, 5, 7, 16, 49, 64, 101, 512, 1000, 1024};
enum {
    COUNTS = sizeof counts / sizeof *counts,
    DIMENSIONS = 4 /* coordinates with guarantees */
};

#define COUNT_OF(array) (sizeof(array) / sizeof *(array))

/* The samplers of each test. */
static const cs_u32 with_coordinates[] = {CS_SAMPLER_NROOKS, CS_SAMPLER_MJ,  CS_SAMPLER_CMJ,
                                          CS_SAMPLER_OA,     CS_SAMPLER_OA3, CS_SAMPLER_RANK1};
static const cs_u32 with_pairs[] = {CS_SAMPLER_JITTERED, CS_SAMPLER_MJ, CS_SAMPLER_CMJ};
static const cs_u32 with_arrays[] = {CS_SAMPLER_OA, CS_SAMPLER_OA3};
static const cs_u32 nets[] = {CS_SAMPLER_SOBOL, CS_SAMPLER_SOBOL_PAIRS, CS_SAMPLER_SZ};

/* Samplers with tests of their own, or without strata. */
static const cs_u32 others[] = {CS_SAMPLER_HALTON, CS_SAMPLER_JITTERED4D, CS_SAMPLER_RANDOM,
                                CS_SAMPLER_POISSON, CS_SAMPLER_CCVT};

/* A partition of the tuple's cube into cells[0] x ... x cells[3] boxes with equally many points
 * each. */
typedef struct promise {
    cs_u32 sampler;
    cs_u32 count;
    cs_u32 cells[DIMENSIONS];
} promise;

static cs_u32 stratum(cs_f32 value, cs_u32 strata)
{
    return (cs_u32)((double)value * strata);
}

static void expect_kept(const test_pattern *drawn, const promise *p)
{
    const cs_u32 count = drawn->pattern.grid.count;
    cs_u32 boxes = 1;
    for (int d = 0; d < DIMENSIONS; d++)
        boxes *= p->cells[d];
    cs_u32 *hits = calloc(boxes, sizeof *hits);
    assert_int_equal(count % boxes, 0);
    for (cs_u32 key = 0; key < 10; key++) {
        memset(hits, 0, boxes * sizeof *hits);
        for (cs_u32 i = 0; i < count; i++) {
            cs_f32 tuple[CS_DIMENSIONS];
            cs_u32 box = 0;
            test_draw(drawn, cs_hash(key), i, tuple);
            for (int d = 0; d < DIMENSIONS; d++)
                box = box * p->cells[d] + stratum(tuple[d], p->cells[d]);
            hits[box]++;
        }
        for (cs_u32 box = 0; box < boxes; box++)
            if (hits[box] != count / boxes)
                fail_msg("%s, N = %u, %u x %u x %u x %u boxes: %u points in one",
                         cs_sampler_name(p->sampler), count, p->cells[0], p->cells[1], p->cells[2],
                         p->cells[3], hits[box]);
    }
    free(hits);
}

/* Checks all partitions into base^a x base^b x base^c x base^d boxes with a + b + c + d = `total`
 * and each exponent up to most[d]. */
static void expect_elementary(const test_pattern *drawn, cs_u32 base, cs_u32 total,
                              const cs_u32 *most)
{
    cs_u32 e[DIMENSIONS], seen = 0;
    for (e[0] = 0; e[0] <= most[0]; e[0]++)
        for (e[1] = 0; e[1] <= most[1]; e[1]++)
            for (e[2] = 0; e[2] <= most[2]; e[2]++)
                for (e[3] = 0; e[3] <= most[3]; e[3]++) {
                    promise p = {drawn->pattern.sampler, 0, {1, 1, 1, 1}};
                    if (e[0] + e[1] + e[2] + e[3] != total) continue;
                    for (int d = 0; d < DIMENSIONS; d++)
                        for (cs_u32 k = 0; k < e[d]; k++)
                            p.cells[d] *= base;
                    expect_kept(drawn, &p);
                    seen++;
                }
    assert_above(seen, 0);
}

/* Every coordinate has one point in each of N strata. */
static void coordinates_are_stratified(void **state)
{
    (void)state;
    for (size_t s = 0; s < COUNT_OF(with_coordinates); s++)
        for (int k = 0; k < COUNTS; k++) {
            test_pattern drawn = test_pattern_of(with_coordinates[s], counts[k], CS_ORDER_COHERENT);
            for (int d = 0; d < DIMENSIONS; d++) {
                promise p = {with_coordinates[s], 0, {1, 1, 1, 1}};
                p.cells[d] = drawn.pattern.grid.count;
                expect_kept(&drawn, &p);
            }
            test_pattern_free(&drawn);
        }
}

/* Film and lens pairs have one point in each cell of a grid without a partial row. */
static void pairs_are_stratified(void **state)
{
    (void)state;
    for (size_t s = 0; s < COUNT_OF(with_pairs); s++)
        for (int k = 0; k < COUNTS; k++) {
            test_pattern drawn = test_pattern_of(with_pairs[s], counts[k], CS_ORDER_COHERENT);
            const cs_grid *grid = &drawn.pattern.grid;
            const promise film = {with_pairs[s], 0, {grid->columns, grid->rows, 1, 1}};
            const promise lens = {with_pairs[s], 0, {1, 1, grid->columns, grid->rows}};
            if (grid->extra == 0) expect_kept(&drawn, &film), expect_kept(&drawn, &lens);
            test_pattern_free(&drawn);
        }
}

static void hypergrids_are_stratified(void **state)
{
    (void)state;
    for (int k = 0; k < COUNTS; k++) {
        test_pattern drawn = test_pattern_of(CS_SAMPLER_JITTERED4D, counts[k], CS_ORDER_COHERENT);
        promise p = {CS_SAMPLER_JITTERED4D, 0, {0}};
        memcpy(p.cells, drawn.pattern.shape, sizeof p.cells);
        expect_kept(&drawn, &p);
        test_pattern_free(&drawn);
    }
}

/* Strength 2 stratifies every two coordinates, strength 3 every three. Primes and prime powers. */
static void orthogonal_arrays_are_orthogonal(void **state)
{
    static const cs_u32 strong[] = {27, 64, 125, 343, 512, 729};
    static const cs_u32 squares[] = {9, 16, 25, 49, 64, 81, 121, 256, 625, 1024};
    (void)state;
    for (size_t k = 0; k < sizeof squares / sizeof *squares; k++) {
        test_pattern drawn = test_pattern_of(with_arrays[0], squares[k], CS_ORDER_COHERENT);
        const cs_u32 q = drawn.pattern.grid.columns, most[4] = {1, 1, 1, 1};
        assert_int_equal(q * q, squares[k]);
        expect_elementary(&drawn, q, 2, most);
        test_pattern_free(&drawn);
    }
    for (size_t k = 0; k < sizeof strong / sizeof *strong; k++) {
        test_pattern drawn = test_pattern_of(with_arrays[1], strong[k], CS_ORDER_COHERENT);
        const cs_u32 q = drawn.pattern.grid.columns, most[4] = {1, 1, 1, 1};
        assert_int_equal(q * q * q, strong[k]);
        expect_elementary(&drawn, q, 3, most);
        test_pattern_free(&drawn);
    }
}

/* Elementary intervals. (x, y) of all three nets and (u, v) of two of them are (0,2)-sequences in
 * base 2; `sz` is a (0,4)-sequence in base 4; the quality parameter of the first four dimensions of
 * `sobol` is the sum of degree - 1 of its polynomials, 3 (Niederreiter 1992, theorem 4.49). */
static void nets_fill_elementary_intervals(void **state)
{
    (void)state;
    for (cs_u32 bits = 0; bits <= 10; bits++) {
        const cs_u32 film[4] = {bits, bits, 0, 0}, lens[4] = {0, 0, bits, bits};
        const cs_u32 all[4] = {bits, bits, bits, bits};
        for (int s = 0; s < 3; s++) {
            test_pattern drawn = test_pattern_of(nets[s], 1u << bits, CS_ORDER_COHERENT);
            expect_elementary(&drawn, 2, bits, film);
            if (s > 0) expect_elementary(&drawn, 2, bits, lens);
            if (s == 0 && bits >= 3) expect_elementary(&drawn, 2, bits - 3, all);
            if (s == 2 && bits % 2 == 0) expect_elementary(&drawn, 4, bits / 2, all);
            test_pattern_free(&drawn);
        }
    }
}

/* All six dimensions of `sobol`, two at a time: the quality parameter of a pair is the sum of its
 * degrees - 1, and boxes with 2^quality points each have exactly so many (Niederreiter 1992). */
static void sobol_has_six_dimensions(void **state)
{
    static const cs_u32 quality[CS_DIMENSIONS] = {0, 0, 1, 2, 2, 3};
    enum {
        BITS = 9,
        POINTS = 1 << BITS
    };
    static cs_f32 tuples[POINTS][CS_DIMENSIONS];
    test_pattern drawn = test_pattern_of(CS_SAMPLER_SOBOL, POINTS, CS_ORDER_COHERENT);
    (void)state;
    for (cs_u32 i = 0; i < POINTS; i++)
        test_draw(&drawn, 7, i, tuples[i]);
    for (int d = 0; d < CS_DIMENSIONS; d++)
        for (int e = 0; e < d; e++)
            for (cs_u32 wide = 0, bits = BITS - quality[d] - quality[e]; wide <= bits; wide++) {
                cs_u32 hits[POINTS] = {0};
                for (cs_u32 i = 0; i < POINTS; i++) {
                    const cs_u32 column = (cs_u32)(tuples[i][d] * (cs_f32)(1u << wide));
                    const cs_u32 row = (cs_u32)(tuples[i][e] * (cs_f32)(1u << (bits - wide)));
                    hits[row << wide | column]++;
                }
                for (cs_u32 box = 0; box < 1u << bits; box++)
                    assert_int_equal(hits[box], POINTS >> bits);
            }
    test_pattern_free(&drawn);
}

/* Boxes with sides of powers of the bases, as many as points. */
static void halton_fills_elementary_intervals(void **state)
{
    static const promise kept[] = {
        {CS_SAMPLER_HALTON, 420, {4, 3, 5, 7}},    {CS_SAMPLER_HALTON, 1260, {4, 9, 5, 7}},
        {CS_SAMPLER_HALTON, 1296, {16, 81, 1, 1}}, {CS_SAMPLER_HALTON, 1225, {1, 1, 25, 49}},
        {CS_SAMPLER_HALTON, 128, {128, 1, 1, 1}},  {CS_SAMPLER_HALTON, 729, {1, 729, 1, 1}},
        {CS_SAMPLER_HALTON, 625, {1, 1, 625, 1}},  {CS_SAMPLER_HALTON, 343, {1, 1, 1, 343}}};
    (void)state;
    for (size_t k = 0; k < sizeof kept / sizeof *kept; k++) {
        test_pattern drawn = test_pattern_of(CS_SAMPLER_HALTON, kept[k].count, CS_ORDER_COHERENT);
        expect_kept(&drawn, &kept[k]);
        test_pattern_free(&drawn);
    }
}

static double torus_distance(const cs_f32 *a, const cs_f32 *b)
{
    double square = 0.0;
    for (int d = 0; d < 2; d++) {
        double way = fabs((double)a[d] - (double)b[d]);
        if (way > 0.5) way = 1.0 - way;
        square += way * way;
    }
    return sqrt(square);
}

/* Points keep their distance in both pairs: 0.65 (Poisson disk) and 0.5 (equal capacity) of the
 * densest packing's. The closest random points are below a hundredth of it. */
static void blue_noise_keeps_its_distance(void **state)
{
    static const cs_u32 samplers[] = {CS_SAMPLER_POISSON, CS_SAMPLER_CCVT};
    (void)state;
    for (int s = 0; s < 2; s++)
        for (cs_u32 n = 2; n <= 512; n = n * 5 / 2 + 1) {
            test_pattern drawn = test_pattern_of(samplers[s], n, CS_ORDER_COHERENT);
            const double least = (s == 0 ? 0.65 : 0.5) * sqrt(1.1547 / n);
            cs_f32(*tuples)[CS_DIMENSIONS] = malloc(n * sizeof *tuples);
            for (cs_u32 i = 0; i < n; i++)
                test_draw(&drawn, 7, i, tuples[i]);
            for (cs_u32 i = 0; i < n; i++)
                for (cs_u32 j = 0; j < i; j++)
                    for (int pair = 0; pair < 2; pair++)
                        assert_above(torus_distance(tuples[i] + 2 * pair, tuples[j] + 2 * pair),
                                     least);
            free(tuples);
            test_pattern_free(&drawn);
        }
}

/* Equal capacity is visible in the spectrum. Below a fifth of the points' frequency, a blue noise
 * set has less than 2 % of the power of random points, and a Poisson disk set more. */
static void equal_capacity_has_no_low_frequencies(void **state)
{
    enum {
        POINTS = 400
    };
    static cs_f32 x[POINTS], y[POINTS];
    double power[2];
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        int terms = 0;
        assert_true(kind == 0 ? cs_ccvt_points(POINTS, 1, x, y)
                              : cs_poisson_points(POINTS, 1, x, y));
        power[kind] = 0.0;
        for (int a = -4; a <= 4; a++)
            for (int b = -4; b <= 4; b++) {
                double re = 0.0, im = 0.0;
                if ((a == 0 && b == 0) || a * a + b * b > 16) continue;
                for (int i = 0; i < POINTS; i++) {
                    const double phase = 6.283185307179586 * (a * (double)x[i] + b * (double)y[i]);
                    re += cos(phase);
                    im += sin(phase);
                }
                power[kind] += (re * re + im * im) / POINTS;
                terms++;
            }
        power[kind] /= terms;
    }
    assert_below(power[0], 0.02);
    assert_above(power[1], 0.02);
}

/* A new sampler in the table must be listed here, with the test of its strata or among the samplers
 * without strata. */
static void every_sampler_is_tested(void **state)
{
    static const struct {
        const cs_u32 *samplers;
        size_t count;
    } lists[] = {{with_coordinates, COUNT_OF(with_coordinates)},
                 {with_pairs, COUNT_OF(with_pairs)},
                 {with_arrays, COUNT_OF(with_arrays)},
                 {nets, COUNT_OF(nets)},
                 {others, COUNT_OF(others)}};
    (void)state;
    for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++) {
        int found = 0;
        for (size_t l = 0; l < COUNT_OF(lists); l++)
            for (size_t i = 0; i < lists[l].count; i++)
                if (lists[l].samplers[i] == sampler) found = 1;
        if (!found) fail_msg("%s is in no list of this file", cs_sampler_name(sampler));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coordinates_are_stratified),
        cmocka_unit_test(pairs_are_stratified),
        cmocka_unit_test(hypergrids_are_stratified),
        cmocka_unit_test(orthogonal_arrays_are_orthogonal),
        cmocka_unit_test(nets_fill_elementary_intervals),
        cmocka_unit_test(sobol_has_six_dimensions),
        cmocka_unit_test(halton_fills_elementary_intervals),
        cmocka_unit_test(blue_noise_keeps_its_distance),
        cmocka_unit_test(equal_capacity_has_no_low_frequencies),
        cmocka_unit_test(every_sampler_is_tested),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
