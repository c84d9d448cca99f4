/* The sampler's promises, for the counts that users ask for and the awkward ones. */
#include "support.h"

#include <math.h>

#include "sampler/sampler.h"

static const u32 counts[] = {1, 2, 3, 5, 7, 16, 49, 64, 101, 512, 1000, 1024};
enum {
    COUNTS = sizeof counts / sizeof *counts,
    PAIRS = 3
};

static u32 stratum(f32 value, u32 strata)
{
    return (u32)((double)value * strata);
}

/* Whether `marks` has each of [0, count) exactly once. */
static int each_once(const u32 *marks, u32 count)
{
    unsigned char *seen = calloc(count, 1);
    int good = 1;
    for (u32 i = 0; i < count; i++) {
        good &= marks[i] < count && !seen[marks[i]];
        if (marks[i] < count) seen[marks[i]] = 1;
    }
    free(seen);
    return good;
}

/* Every coordinate has one sample in each of N strata. */
static void every_coordinate_is_stratified(void **state)
{
    (void)state;
    for (int k = 0; k < COUNTS; k++)
        for (u32 replicate = 0; replicate < 20; replicate++)
            for (u32 pair = 0; pair < PAIRS; pair++) {
                const u32 n = counts[k];
                const cs_grid grid = cs_grid_of(n);
                u32 *x = malloc(n * sizeof *x), *y = malloc(n * sizeof *y);
                for (u32 i = 0; i < n; i++) {
                    cs_pair point = cs_draw_pair(&grid, cs_pattern_key(3, 17, replicate), pair, i);
                    assert_true(point.x >= 0.0f && point.x < 1.0f);
                    assert_true(point.y >= 0.0f && point.y < 1.0f);
                    x[i] = stratum(point.x, n);
                    y[i] = stratum(point.y, n);
                }
                assert_true(each_once(x, n));
                assert_true(each_once(y, n));
                free(x);
                free(y);
            }
}

/* Where N = columns * rows, every pair has one sample in each cell of that grid. */
static void every_pair_is_stratified(void **state)
{
    (void)state;
    for (int k = 0; k < COUNTS; k++) {
        const u32 n = counts[k];
        const cs_grid grid = cs_grid_of(n);
        if (grid.extra != 0) continue;
        for (u32 pair = 0; pair < PAIRS; pair++) {
            u32 *cell = malloc(n * sizeof *cell);
            for (u32 i = 0; i < n; i++) {
                cs_pair point = cs_draw_pair(&grid, cs_pattern_key(0, 5, 1), pair, i);
                cell[i] =
                    stratum(point.y, grid.rows) * grid.columns + stratum(point.x, grid.columns);
            }
            assert_true(each_once(cell, n));
            free(cell);
        }
    }
}

/* Grids are as square as the count allows: counts that users type have real 2D strata. */
static void grids_are_nearly_square(void **state)
{
    (void)state;
    const u32 expected[][2] = {{16, 4}, {49, 7}, {512, 16}, {1000, 25}, {1024, 32}, {7, 3}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        assert_int_equal(cs_grid_of(expected[i][0]).columns, expected[i][1]);
    for (u32 n = 1; n < 3000; n++) {
        cs_grid grid = cs_grid_of(n);
        assert_int_equal(grid.columns * grid.rows + grid.extra, n);
        assert_true(grid.extra < grid.columns);
        assert_true(grid.rows <= 4 * grid.columns && grid.columns <= 2 * grid.rows + 1);
    }
}

/* The orders in which cells and blocks are walked leave nothing out. */
static void orders_are_bijections(void **state)
{
    (void)state;
    for (u32 n = 1; n < 600; n++) {
        const cs_grid grid = cs_grid_of(n);
        const u32 places = grid.blocks * CS_BLOCK;
        u32 *cells = malloc(n * sizeof *cells), *blocks = malloc(n * sizeof *blocks);
        u32 *indices = malloc(places * sizeof *indices);
        for (u32 i = 0; i < n; i++) {
            cs_cell a = cs_cell_of(&grid, i), b = cs_cell_in_block_order(&grid, i);
            /* The partial row's columns are spread: number them by their order. */
            u32 a_column = a.row == grid.rows ? cs_extra_before(&grid, a.column) : a.column;
            u32 b_column = b.row == grid.rows ? cs_extra_before(&grid, b.column) : b.column;
            cells[i] = a.row * grid.columns + a_column;
            blocks[i] = b.row * grid.columns + b_column;
        }
        for (u32 i = 0; i < places; i++)
            indices[i] = cs_index_at(&grid, cs_pattern_key(1, 2, 3), i);
        assert_true(each_once(cells, n));
        assert_true(each_once(blocks, n));
        assert_true(each_once(indices, places));
        free(cells);
        free(blocks);
        free(indices);
    }
}

static void divisions_are_exact(void **state)
{
    (void)state;
    for (u32 divisor = 1; divisor < 1100; divisor += 7)
        for (u32 a = 0; a < CS_MAX_PATTERN; a += 13 * divisor + 1)
            for (u32 near = a > 2 ? a - 2 : 0; near < a + 3; near++)
                assert_int_equal(cs_divide(near, divisor, 1.0f / (f32)divisor), near / divisor);
}

static void permutations_are_bijections(void **state)
{
    (void)state;
    for (u32 size = 1; size < 300; size++)
        for (u32 key = 0; key < 20; key++) {
            u32 *image = malloc(size * sizeof *image);
            for (u32 i = 0; i < size; i++)
                image[i] = cs_permute(i, size, cs_domain_of(size), cs_hash(key));
            assert_true(each_once(image, size));
            free(image);
        }
}

/* Images of two indices are nearly uniform over the n(n-1) possible pairs. The permutation is cheap
 * rather than perfect: the root mean square of the relative deviations may be 15 %, which with 400
 * keys a cell adds 400 * 0.15^2 = 9 to chi-square per degree of freedom. Chance alone stays below
 * 1.5, so a false alarm is out of the question; with a round less the sum is above 20. */
static void permutations_mix_pairs(void **state)
{
    (void)state;
    const u32 sizes[] = {5, 8, 12, 16, 25, 32};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        const u32 n = sizes[k], keys = 400 * n * (n - 1);
        const cs_domain domain = cs_domain_of(n);
        for (u32 gap = 1; gap < n; gap += n / 4 + 1) {
            u32 *hits = calloc(n * n, sizeof *hits);
            double chi = 0.0, expected = 400.0, dof = (double)n * (n - 1) - 1.0;
            for (u32 t = 0; t < keys; t++) {
                u32 key = cs_key(gap, t);
                hits[cs_permute(0, n, domain, key) * n + cs_permute(gap, n, domain, key)]++;
            }
            for (u32 a = 0; a < n; a++)
                for (u32 b = 0; b < n; b++)
                    if (a != b) chi += pow(hits[a * n + b] - expected, 2) / expected;
            assert_true(chi / dof < 10.0);
            free(hits);
        }
    }
}

/* Over many patterns, one sample's point is uniform in the unit square: chi-square on 8 x 8 cells,
 * 63 degrees of freedom, 64 000 patterns. 140 is 6.9 standard deviations above the mean; false
 * alarms below 1e-7 a test. */
static void single_samples_are_uniform(void **state)
{
    (void)state;
    const u32 sizes[] = {1, 7, 16, 101, 1000};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
        for (u32 pair = 0; pair < PAIRS; pair++) {
            const cs_grid grid = cs_grid_of(sizes[k]);
            u32 hits[64] = {0};
            double chi = 0.0;
            for (u32 t = 0; t < 64000; t++) {
                u32 index = t % grid.count;
                cs_pair point = cs_draw_pair(&grid, cs_pattern_key(9, t, 0), pair, index);
                hits[stratum(point.y, 8) * 8 + stratum(point.x, 8)]++;
            }
            for (int i = 0; i < 64; i++)
                chi += pow(hits[i] - 1000.0, 2) / 1000.0;
            assert_true(chi < 140.0);
        }
}

/* Estimates are unbiased for any N, smooth or not: z-test over 4000 patterns, |z| < 5, false alarms
 * 6e-7 for each of the 24 tests. */
static void estimates_are_unbiased(void **state)
{
    (void)state;
    for (int k = 0; k < COUNTS; k++)
        for (int kind = 0; kind < 2; kind++) {
            const cs_grid grid = cs_grid_of(counts[k]);
            double sum = 0.0, squares = 0.0;
            const double truth = kind == 0 ? 0.25 * 3.14159265358979 * 0.64 : 0.25;
            const u32 patterns = grid.count > 200 ? 600 : 4000;
            for (u32 t = 0; t < patterns; t++) {
                double mean = 0.0;
                for (u32 i = 0; i < grid.count; i++) {
                    cs_pair p = cs_draw_pair(&grid, cs_pattern_key(1, t, 5), CS_PAIR_FIBRE, i);
                    double x = p.x, y = p.y;
                    mean += kind == 0 ? (x * x + y * y < 0.64) : x * y;
                }
                mean /= grid.count;
                sum += mean;
                squares += mean * mean;
            }
            double mean = sum / patterns;
            double error = sqrt((squares / patterns - mean * mean) / (patterns - 1.0));
            assert_true(fabs(mean - truth) < 5.0 * error + 1e-6);
        }
}

/* Seeds, pixels, replicates and pairs give unrelated points: correlation over 10 000 patterns of
 * independent uniform values, |r| < 0.05 is 5 standard deviations, false alarms 6e-7 each. (The
 * first pair enumerates its cells in a fixed order, so the lens pair is looked at.) */
static void streams_are_unrelated(void **state)
{
    (void)state;
    const cs_grid grid = cs_grid_of(16);
    const u32 others[][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const u32 count = 10000;
    double r[4] = {0};
    for (u32 t = 0; t < count; t++) {
        u32 i = t % 16;
        cs_pair lens = cs_draw_pair(&grid, cs_pattern_key(0, t, 0), CS_PAIR_LENS, i);
        for (int k = 0; k < 3; k++) {
            u32 key = cs_pattern_key(others[k][0], t + others[k][1], others[k][2]);
            r[k] += (lens.x - 0.5) * (cs_draw_pair(&grid, key, CS_PAIR_LENS, i).x - 0.5);
        }
        cs_pair film = cs_draw_pair(&grid, cs_pattern_key(0, t, 0), CS_PAIR_FIBRE, i);
        r[3] += (lens.x - 0.5) * (film.x - 0.5);
    }
    for (int k = 0; k < 4; k++)
        assert_true(fabs(r[k]) / count * 12.0 < 0.05);
}

/* Each pair has a pattern of its own: no point of one is a point of the other. */
static void pairs_have_their_own_patterns(void **state)
{
    (void)state;
    const cs_grid grid = cs_grid_of(64);
    const u32 key = cs_pattern_key(0, 1, 2);
    for (u32 i = 0; i < grid.count; i++)
        for (u32 j = 0; j < grid.count; j++) {
            cs_pair lens = cs_draw_pair(&grid, key, CS_PAIR_LENS, i);
            assert_true(lens.x != cs_draw_pair(&grid, key, CS_PAIR_FIBRE, j).x);
            assert_true(lens.x != cs_draw_pair(&grid, key, CS_PAIR_EMITTER, j).x);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_coordinate_is_stratified),
        cmocka_unit_test(every_pair_is_stratified),
        cmocka_unit_test(grids_are_nearly_square),
        cmocka_unit_test(orders_are_bijections),
        cmocka_unit_test(divisions_are_exact),
        cmocka_unit_test(permutations_are_bijections),
        cmocka_unit_test(permutations_mix_pairs),
        cmocka_unit_test(single_samples_are_uniform),
        cmocka_unit_test(estimates_are_unbiased),
        cmocka_unit_test(pairs_have_their_own_patterns),
        cmocka_unit_test(streams_are_unrelated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
