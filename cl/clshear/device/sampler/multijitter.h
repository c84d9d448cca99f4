/* Multi-jittered pairs of any count.
 *
 * With N = columns * rows: one point in each cell of the grid, one in each of the N strata of x and
 * of y. `mj` has an independent permutation for every column and every row (Chiu, Shirley & Wang
 * 1994), `cmj` one for all columns and one for all rows (Kensler 2013). For other N, unequal
 * columns alone would weight x unevenly, so the strata of x are then rotated by a random number of
 * strata: every estimate stays unbiased and every 1D stratum still holds exactly one point.
 *
 * `oa` is `mj` with the second pair's cell chosen by an orthogonal array instead of at random: with
 * N = q^2 runs of levels (i, j, i + j, i + a j) of the field of q elements, every two coordinates
 * have one point in each of q x q cells (Bose 1938; Jarosz et al. 2019, section 4). */
#ifndef CLSHEAR_DEVICE_SAMPLER_MULTIJITTER_H
#define CLSHEAR_DEVICE_SAMPLER_MULTIJITTER_H

#include "pattern.h"

#include "../fp_contract_off.h"

/* The point in [0, 1)^2 of cell `cell` of the pair named by `key`. `correlated` is 0 for
 * independent permutations (mj) and 1 for one permutation of all columns and one of all rows (cmj).
 */
static inline cs_pair cs_multijitter(const cs_grid *grid, cs_cell cell, cs_u32 key, int correlated)
{
    cs_vuint column_key =
        correlated ? (cs_vuint)(cs_key(key, 0u)) : cs_key_lanes(key, 2u * cell.column);
    cs_vuint row_key =
        correlated ? (cs_vuint)(cs_key(key, 1u)) : cs_key_lanes(key, 2u * cell.row + 1u);
    cs_vuint column_rank = cell.column;
    cs_vuint row_size = (cs_vuint)(grid->columns);
    cs_vuint column_size = (cs_vuint)(grid->rows);
    cs_vuint x_stratum = cell.column * grid->rows;
    if (grid->extra != 0u) {
        cs_vuint before = cs_extra_before(grid, cell.column);
        column_size += cs_extra_before(grid, cell.column + 1u) - before;
        x_stratum += before + cs_mul_hi(cs_hash(key), grid->count);
        column_rank = cell.row == grid->rows ? before : column_rank;
        row_size = cell.row == grid->rows ? (cs_vuint)(grid->extra) : row_size;
    }
    x_stratum += cs_permute(cell.row, column_size, grid->row_domain, column_key);
    x_stratum = x_stratum >= grid->count ? x_stratum - grid->count : x_stratum;
    cs_vuint y_stratum =
        cell.row * grid->columns + cs_permute(column_rank, row_size, grid->column_domain, row_key);
    cs_vuint jitter = cs_key_lanes(~key, x_stratum);
    cs_pair point;
    point.x = cs_in_stratum(&grid->strata, x_stratum, jitter);
    point.y = cs_in_stratum(&grid->strata, y_stratum, cs_hash_lanes(jitter));
    return point;
}

/* A level of the first pair as the array knows it. Levels must be permuted at random in every
 * coordinate: the array's own rows and columns run along diagonals, and so do integrands. */
static inline cs_vuint cs_array_level(const cs_grid *grid, cs_u32 key, cs_u32 dimension,
                                      cs_vuint level)
{
    return cs_permute(level, (cs_vuint)(grid->columns), grid->column_domain,
                      (cs_vuint)(cs_key(key, CS_KEY_DIMENSION + dimension)));
}

/* The cell of the second pair that the orthogonal array gives to the sample in `first`. */
static inline cs_cell cs_array_cell(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                    cs_cell first)
{
    const cs_grid *grid = &pattern->grid;
    cs_vuint run = cs_array_level(grid, key, 0u, first.column) * grid->columns +
                   cs_array_level(grid, key, 1u, first.row);
    cs_vuint levels = cs_sample_word_anywhere(pattern, table, 0u, run);
    cs_cell cell;
    cell.column = cs_array_level(grid, key, 2u, levels >> 16);
    cell.row = cs_array_level(grid, key, 3u, levels & 0xffffu);
    return cell;
}

/* The point of slot `slot` in cell `cell`. */
static inline cs_pair cs_multijitter_slot(const cs_pattern *pattern, cs_cell cell, cs_u32 key,
                                          cs_u32 slot, int correlated)
{
    return cs_multijitter(&pattern->grid, cell, cs_key(key, CS_KEY_PAIR + slot), correlated);
}

/* The cell of a slot's point that goes with sample `index` at random. */
static inline cs_cell cs_partner_cell(const cs_pattern *pattern, cs_u32 key, cs_u32 slot,
                                      cs_vuint index)
{
    return cs_cell_of(&pattern->grid, cs_partner(pattern, key, slot, index));
}

/* A multi-jittered point of slot `slot`, combined with the sample at random. */
static inline cs_pair cs_extra_multijittered(const cs_pattern *pattern, cs_sample_table table,
                                             cs_u32 key, cs_vuint index, cs_u32 slot)
{
    (void)table;
    return cs_multijitter_slot(pattern, cs_partner_cell(pattern, key, slot, index), key, slot, 0);
}

/* A correlated multi-jittered point of slot `slot`, combined with the sample at random. */
static inline cs_pair cs_extra_correlated(const cs_pattern *pattern, cs_sample_table table,
                                          cs_u32 key, cs_vuint index, cs_u32 slot)
{
    (void)table;
    return cs_multijitter_slot(pattern, cs_partner_cell(pattern, key, slot, index), key, slot, 1);
}

/* Film and lens from their cells. */
static inline void cs_draw_cells(const cs_pattern *pattern, cs_cell film, cs_cell lens, cs_u32 key,
                                 int correlated, cs_vfloat *tuple)
{
    cs_put_slot(cs_multijitter_slot(pattern, film, key, CS_SLOT_FILM, correlated), CS_SLOT_FILM,
                tuple);
    cs_put_slot(cs_multijitter_slot(pattern, lens, key, CS_SLOT_LENS, correlated), CS_SLOT_LENS,
                tuple);
}

/* mj: multi-jittered pairs, combined at random. */
static inline void cs_draw_multijittered(const cs_pattern *pattern, cs_sample_table table,
                                         cs_u32 key, cs_vuint index, cs_vfloat *tuple)
{
    cs_cell film = cs_cell_in_block_order(&pattern->grid, index);
    (void)table;
    cs_draw_cells(pattern, film, cs_partner_cell(pattern, key, CS_SLOT_LENS, index), key, 0, tuple);
}

/* cmj: correlated multi-jittered pairs, combined at random. */
static inline void cs_draw_correlated(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                      cs_vuint index, cs_vfloat *tuple)
{
    cs_cell film = cs_cell_in_block_order(&pattern->grid, index);
    (void)table;
    cs_draw_cells(pattern, film, cs_partner_cell(pattern, key, CS_SLOT_LENS, index), key, 1, tuple);
}

/* oa: multi-jittered pairs, combined by an orthogonal array. The table has one word for each run of
 * the array: level of the third column in the upper, of the fourth in the lower 16 bits. */
static inline void cs_draw_array(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                 cs_vuint index, cs_vfloat *tuple)
{
    cs_cell film = cs_cell_in_block_order(&pattern->grid, index);
    cs_draw_cells(pattern, film, cs_array_cell(pattern, table, key, film), key, 0, tuple);
}

/* A value in one of N = q^3 strata: in those of `level`, the samples of a level in random order;
 * `rank` < q^2 numbers them. */
static inline cs_vfloat cs_ranked(const cs_grid *grid, cs_vuint level, cs_vuint rank, cs_u32 key)
{
    rank = cs_permute(rank, (cs_vuint)(grid->rows), grid->row_domain, cs_key_lanes(key, level));
    cs_vuint stratum = level * grid->rows + rank;
    return cs_in_stratum(&grid->strata, stratum, cs_key_lanes(~key, stratum));
}

/* Orthogonal array of strength 3, N = q^3 runs (a, b, c) with the levels of a + b x + c x^2 at four
 * places x: every three coordinates have one point in each of q^3 cells (Bush 1952; Jarosz et al.
 * 2019, section 4.2). a and c are the levels of the first pair, in blocks; b runs fastest. The
 * table has one word for each run: third level in the upper, fourth in the lower 16 bits. */
static inline void cs_draw_strong_array(const cs_pattern *pattern, cs_sample_table table,
                                        cs_u32 key, cs_vuint index, cs_vfloat *tuple)
{
    const cs_grid *grid = &pattern->grid;
    cs_u32 q = grid->columns;
    cs_grid cells = *grid; /* of the first pair: what the order of blocks looks at */
    cells.count = q * q;
    cells.rows = q;
    cs_vuint place = cs_divide(index, q, grid->inverse_columns);
    cs_vuint middle = index - place * q;
    cs_cell first = cs_cell_in_block_order(&cells, place);
    cs_vuint run =
        cs_array_level(grid, key, 0u, first.column) * q + cs_array_level(grid, key, 1u, first.row);
    cs_vuint levels = cs_sample_word_anywhere(pattern, table, 0u, run * q + middle);
    cs_vuint third = cs_array_level(grid, key, 2u, levels >> 16);
    cs_vuint fourth = cs_array_level(grid, key, 3u, levels & 0xffffu);
    cs_vuint rank =
        middle * q + first.row; /* with a level of any coordinate but y, names the run */
    tuple[0] = cs_ranked(grid, first.column, rank, cs_key(key, CS_KEY_PAIR));
    tuple[1] = cs_ranked(grid, first.row, middle * q + first.column, cs_key(key, CS_KEY_PAIR + 1));
    tuple[2] = cs_ranked(grid, third, rank, cs_key(key, CS_KEY_PAIR + 2));
    tuple[3] = cs_ranked(grid, fourth, rank, cs_key(key, CS_KEY_PAIR + 3));
}

/* oa3: a multi-jittered point of slot `slot`, combined with the sample at random. Its keys lie
 * behind those of the four coordinates above. */
static inline cs_pair cs_extra_strong_array(const cs_pattern *pattern, cs_sample_table table,
                                            cs_u32 key, cs_vuint index, cs_u32 slot)
{
    (void)table;
    return cs_multijitter_slot(pattern, cs_partner_cell(pattern, key, slot, index), key,
                               CS_SLOT_WIDEST * slot, 0);
}

#include "../fp_contract_restore.h"

#endif
