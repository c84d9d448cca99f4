/* Multi-jittered pairs of any count. Shared.
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
#ifndef CS_MULTIJITTER_H
#define CS_MULTIJITTER_H

#include "pattern.h"

/* The point of `cell`, in [0, 1)^2, of the pair named by `key`. */
static inline cs_pair cs_multijitter(const cs_grid *grid, cs_cell cell, u32 key, int correlated)
{
    vuint column_key = correlated ? (vuint)(cs_key(key, 0u)) : cs_key_lanes(key, 2u * cell.column);
    vuint row_key = correlated ? (vuint)(cs_key(key, 1u)) : cs_key_lanes(key, 2u * cell.row + 1u);
    vuint column_rank = cell.column;
    vuint row_size = (vuint)(grid->columns);
    vuint column_size = (vuint)(grid->rows);
    vuint x_stratum = cell.column * grid->rows;
    if (grid->extra != 0u) {
        vuint before = cs_extra_before(grid, cell.column);
        column_size += cs_extra_before(grid, cell.column + 1u) - before;
        x_stratum += before + cs_mul_hi(cs_hash(key), grid->count);
        column_rank = cell.row == grid->rows ? before : column_rank;
        row_size = cell.row == grid->rows ? (vuint)(grid->extra) : row_size;
    }
    x_stratum += cs_permute(cell.row, column_size, grid->row_domain, column_key);
    x_stratum = x_stratum >= grid->count ? x_stratum - grid->count : x_stratum;
    vuint y_stratum =
        cell.row * grid->columns + cs_permute(column_rank, row_size, grid->column_domain, row_key);
    vuint jitter = cs_key_lanes(~key, x_stratum);
    cs_pair point;
    point.x = cs_in_stratum(grid, x_stratum, jitter >> 16);
    point.y = cs_in_stratum(grid, y_stratum, jitter & 0xffffu);
    return point;
}

/* The cell of the second pair that the orthogonal array gives to a sample, its levels permuted. The
 * first pair's levels need no permutation: that of the others makes every combination of levels
 * equally likely. */
static inline cs_cell cs_array_cell(const cs_pattern *pattern, cs_rows rows, u32 key, vuint index)
{
    const cs_grid *grid = &pattern->grid;
    vuint levels = cs_row(pattern, rows, 0u, index);
    vuint size = (vuint)(grid->columns);
    cs_cell cell;
    cell.column = cs_permute(levels >> 16, size, grid->column_domain,
                             (vuint)(cs_key(key, CS_KEY_DIMENSION + 2)));
    cell.row = cs_permute(levels & 0xffffu, size, grid->column_domain,
                          (vuint)(cs_key(key, CS_KEY_DIMENSION + 3)));
    return cell;
}

static inline void cs_draw_multijitter(const cs_pattern *pattern, cs_rows rows, u32 key,
                                       vuint index, u32 pairs, vfloat *tuple)
{
    const cs_grid *grid = &pattern->grid;
    int correlated = pattern->sampler == CS_SAMPLER_CMJ;
    for (u32 pair = 0u; pair < pairs; pair++) {
        cs_cell cell;
        if (pair == CS_PAIR_FIBRE)
            cell = cs_cell_in_block_order(grid, index);
        else if (pair == CS_PAIR_LENS && pattern->sampler == CS_SAMPLER_OA)
            cell = cs_array_cell(pattern, rows, key, index);
        else
            cell = cs_cell_of(grid, cs_partner(pattern, key, pair, index));
        cs_pair point = cs_multijitter(grid, cell, cs_key(key, CS_KEY_PAIR + pair), correlated);
        tuple[2u * pair] = point.x;
        tuple[2u * pair + 1u] = point.y;
    }
}

/* A value in one of N = q^3 strata: those of level `word >> 16`, in a random order within the
 * level; `word & 0xffff` numbers the samples of a level. */
static inline vfloat cs_ranked(const cs_grid *grid, vuint word, u32 key, int permuted)
{
    vuint level = word >> 16;
    vuint rank =
        cs_permute(word & 0xffffu, (vuint)(grid->rows), grid->row_domain, cs_key_lanes(key, level));
    if (permuted)
        level =
            cs_permute(level, (vuint)(grid->columns), grid->column_domain, (vuint)(cs_hash(key)));
    vuint stratum = level * grid->rows + rank;
    return cs_in_stratum(grid, stratum, cs_key_lanes(~key, stratum) >> 16);
}

/* Orthogonal array of strength 3, N = q^3: every three coordinates have one point in each of q^3
 * cells (Bush 1952; Jarosz et al. 2019, section 4.2). The pair of the light is multi-jittered. */
static inline void cs_draw_strong_array(const cs_pattern *pattern, cs_rows rows, u32 key,
                                        vuint index, u32 pairs, vfloat *tuple)
{
    for (u32 d = 0u; d < 4u; d++)
        tuple[d] = cs_ranked(&pattern->grid, cs_row(pattern, rows, d, index),
                             cs_key(key, CS_KEY_DIMENSION + d), d >= 2u);
    if (pairs <= CS_PAIR_EMITTER) return;
    cs_cell cell = cs_cell_of(&pattern->grid, cs_partner(pattern, key, CS_PAIR_EMITTER, index));
    cs_pair point =
        cs_multijitter(&pattern->grid, cell, cs_key(key, CS_KEY_PAIR + CS_PAIR_EMITTER), 0);
    tuple[4] = point.x;
    tuple[5] = point.y;
}

#endif
