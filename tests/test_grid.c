/* The grid of the stratified samplers, and the permutations of all samplers. */
#include "support.h"

#include <math.h>

#include "clshear/device/sampler/grid.h"

/* Returns 1 if `marks` has each of [0, count) exactly once, else 0. */
static int each_once(const cs_u32 *marks, cs_u32 count)
{
    unsigned char *seen = calloc(count, 1);
    int good = 1;
    for (cs_u32 i = 0; i < count; i++) {
        if (marks[i] < count && !seen[marks[i]])
            seen[marks[i]] = 1;
        else
            good = 0;
    }
    free(seen);
    return good;
}

/* Grids are as square as the count allows, so that counts typed by users have real 2D strata. */
static void grids_are_nearly_square(void **state)
{
    (void)state;
    const cs_u32 expected[][2] = {{16, 4}, {49, 7}, {512, 16}, {1000, 25}, {1024, 32}, {7, 3}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++)
        assert_int_equal(cs_grid_of(expected[i][0]).columns, expected[i][1]);
    for (cs_u32 n = 1; n < 3000; n++) {
        cs_grid grid = cs_grid_of(n);
        assert_int_equal(grid.columns * grid.rows + grid.extra, n);
        assert_below(grid.extra, grid.columns);
        assert_at_most(grid.rows, 4 * grid.columns);
        assert_at_most(grid.columns, 2 * grid.rows + 1);
    }
}

/* The orders of cells are permutations. */
static void orders_are_bijections(void **state)
{
    (void)state;
    for (cs_u32 n = 1; n < 600; n++) {
        const cs_grid grid = cs_grid_of(n);
        cs_u32 *cells = malloc(n * sizeof *cells), *blocks = malloc(n * sizeof *blocks);
        for (cs_u32 i = 0; i < n; i++) {
            cs_cell a = cs_cell_of(&grid, i), b = cs_cell_in_block_order(&grid, i);
            /* The columns of the partial row are spread; number them by their order. */
            cs_u32 a_column = a.row == grid.rows ? cs_extra_before(&grid, a.column) : a.column;
            cs_u32 b_column = b.row == grid.rows ? cs_extra_before(&grid, b.column) : b.column;
            cells[i] = a.row * grid.columns + a_column;
            blocks[i] = b.row * grid.columns + b_column;
        }
        assert_true(each_once(cells, n));
        assert_true(each_once(blocks, n));
        free(cells);
        free(blocks);
    }
}

static void divisions_are_exact(void **state)
{
    (void)state;
    for (cs_u32 divisor = 1; divisor < 1100; divisor += 7)
        for (cs_u32 a = 0; a < CS_MAX_PATTERN; a += 13 * divisor + 1)
            for (cs_u32 near = a > 2 ? a - 2 : 0; near < a + 3; near++)
                assert_int_equal(cs_divide(near, divisor, 1.0f / (cs_f32)divisor), near / divisor);
}

/* The least and the greatest place of each stratum, in units of 2^-24: with one another they cover
 * [0, 1) without gaps, and every place lies in its stratum, by whole numbers. */
static void strata_reach_every_float(void **state)
{
    static const cs_u32 counts[] = {
        1, 2, 3, 7, 16, 49, 1000, 4096, 65537, 99991, 700001, CS_MAX_PATTERN - 1, CS_MAX_PATTERN};
    (void)state;
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        const cs_u32 count = counts[c];
        const cs_strata strata = cs_strata_of(count);
        cs_u32 next = 0;
        for (cs_u32 k = 0; k < count; k++) {
            const cs_u32 low = (cs_u32)(cs_in_stratum(&strata, k, 0u) * 0x1p24f);
            const cs_u32 high = (cs_u32)(cs_in_stratum(&strata, k, 0xffffffffu) * 0x1p24f);
            assert_int_equal(low, next);
            assert_int_equal((uint64_t)low * count >> 24, k);
            assert_int_equal((uint64_t)high * count >> 24, k);
            next = high + 1;
        }
        assert_int_equal(next, 1u << 24);
    }
}

static void permutations_are_bijections(void **state)
{
    (void)state;
    for (cs_u32 size = 1; size < 300; size++)
        for (cs_u32 key = 0; key < 20; key++) {
            cs_u32 *image = malloc(size * sizeof *image);
            for (cs_u32 i = 0; i < size; i++)
                image[i] = cs_permute(i, size, cs_domain_of(size), cs_hash(key));
            assert_true(each_once(image, size));
            free(image);
        }
}

/* Images of two indices are nearly uniform over the n(n-1) possible pairs. The permutation is
 * cheap rather than perfect: the root mean square of the relative deviations may be 15 %. With 400
 * keys per cell, this adds 400 * 0.15^2 = 9 to chi-square per degree of freedom. Chance alone
 * stays below 1.5, so a false alarm is practically impossible. With one round less, the sum is
 * above 20. */
static void permutations_mix_pairs(void **state)
{
    (void)state;
    const cs_u32 sizes[] = {5, 8, 12, 16, 25, 32};
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        const cs_u32 n = sizes[k], keys = 400 * n * (n - 1);
        const cs_domain domain = cs_domain_of(n);
        for (cs_u32 gap = 1; gap < n; gap += n / 4 + 1) {
            cs_u32 *hits = calloc(n * n, sizeof *hits);
            double chi = 0.0, expected = 400.0, dof = (double)n * (n - 1) - 1.0;
            for (cs_u32 t = 0; t < keys; t++) {
                cs_u32 key = cs_key(gap, t);
                hits[cs_permute(0, n, domain, key) * n + cs_permute(gap, n, domain, key)]++;
            }
            for (cs_u32 a = 0; a < n; a++)
                for (cs_u32 b = 0; b < n; b++)
                    if (a != b) chi += pow(hits[a * n + b] - expected, 2) / expected;
            assert_below(chi / dof, 10.0);
            free(hits);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(grids_are_nearly_square),     cmocka_unit_test(orders_are_bijections),
        cmocka_unit_test(divisions_are_exact),         cmocka_unit_test(strata_reach_every_float),
        cmocka_unit_test(permutations_are_bijections), cmocka_unit_test(permutations_mix_pairs),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
