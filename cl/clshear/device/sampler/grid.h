/* The grid under a stratified pattern, and the orders in which its cells are walked.
 *
 * A pattern of N points lies on a grid of `columns` columns; rows are bands of `columns` strata of
 * height 1/N. For N that is not columns * rows, the last row is partial: its `extra` points go to
 * columns spread evenly, which are one stratum wider. */
#ifndef CLSHEAR_DEVICE_SAMPLER_GRID_H
#define CLSHEAR_DEVICE_SAMPLER_GRID_H

#include "../hash.h"
#include "../packet.h"
#include "strata.h"

#include "../fp_contract_off.h"

/* The grid of a pattern: everything about N that need not be computed for each sample. */
typedef struct cs_grid {
    cs_u32 count;            /* number of points N, 1 to CS_MAX_PATTERN */
    cs_u32 columns;          /* 1 to N */
    cs_u32 rows;             /* full rows */
    cs_u32 extra;            /* points in the partial row: count - columns * rows */
    cs_strata strata;        /* of a coordinate, one for each point */
    cs_f32 inverse_columns;  /* 1 / columns */
    cs_domain count_domain;  /* for permutations of the points */
    cs_domain column_domain; /* for permutations of the columns */
    cs_domain row_domain;    /* for permutations of the rows, the partial one included */
} cs_grid;
CS_SHARED_WORDS(cs_grid, 14);

/* Columns of the grid for `count` points: the largest divisor up to the square root, unless there
 * would be more than 4 rows a column; else the rounded root itself. */
static inline cs_u32 cs_grid_columns(cs_u32 count)
{
    cs_u32 root = 1u;
    while ((root + 1u) * (root + 1u) <= count)
        root++;
    for (cs_u32 columns = root; columns > 1u && 4u * columns * columns >= count; columns--)
        if (count % columns == 0u) return columns;
    return root * (root + 1u) < count ? root + 1u : root;
}

/* A grid of `count` points, 1 to CS_MAX_PATTERN, on `columns` columns, 1 to count. */
static inline cs_grid cs_grid_on(cs_u32 count, cs_u32 columns)
{
    cs_grid grid;
    grid.count = count;
    grid.columns = columns;
    grid.rows = count / grid.columns;
    grid.extra = count % grid.columns;
    grid.strata = cs_strata_of(count);
    grid.inverse_columns = 1.0f / (cs_f32)grid.columns;
    grid.count_domain = cs_domain_of(count);
    grid.column_domain = cs_domain_of(grid.columns);
    grid.row_domain = cs_domain_of(grid.extra > 0u ? grid.rows + 1u : grid.rows);
    return grid;
}

/* The grid that suits `count` points best. */
static inline cs_grid cs_grid_of(cs_u32 count)
{
    return cs_grid_on(count, cs_grid_columns(count));
}

/* a / divisor rounded down, for `a` below 2^24. `inverse` must be 1.0f / divisor. */
static inline cs_vuint cs_divide(cs_vuint a, cs_u32 divisor, cs_f32 inverse)
{
    cs_vuint quotient = cs_to_vuint(cs_to_vfloat(a) * inverse);
    cs_vint rest = cs_as_vint(a - quotient * divisor);
    quotient = rest < 0 ? quotient - 1u : quotient;
    return rest >= (cs_i32)divisor ? quotient + 1u : quotient;
}

/* A cell of the grid. */
typedef struct cs_cell {
    cs_vuint column; /* 0 to columns - 1 */
    cs_vuint row;    /* 0 to rows - 1, or rows in the partial row */
} cs_cell;

/* The partial row's point number e lies in the column where floor(column * extra / columns) steps
 * from e to e + 1. */
static inline cs_cell cs_partial_row_cell(const cs_grid *grid, cs_vuint point)
{
    cs_cell cell;
    cs_u32 extra = grid->extra > 0u ? grid->extra : 1u;
    cell.column = cs_divide((point + 1u) * grid->columns - 1u, extra, 1.0f / (cs_f32)extra);
    cell.row = (cs_vuint)(grid->rows);
    return cell;
}

/* Cell number `index` < count in row-major order. */
static inline cs_cell cs_cell_of(const cs_grid *grid, cs_vuint index)
{
    cs_cell cell;
    cell.row = cs_divide(index, grid->columns, grid->inverse_columns);
    cell.column = index - cell.row * grid->columns;
    if (grid->extra == 0u) return cell;
    cs_u32 full = grid->rows * grid->columns;
    cs_cell partial = cs_partial_row_cell(grid, index >= full ? index - full : (cs_vuint)(0u));
    cell.column = index >= full ? partial.column : cell.column;
    cell.row = index >= full ? partial.row : cell.row;
    return cell;
}

/* Cell number `index` < count in an order that keeps CS_GROUP consecutive indices in a block of 4 x
 * 2 cells wherever the grid allows: neighbours on the film and on the lens, so that a packet of
 * them traces coherently. Pairs of rows are cut into blocks; what is left of a pair is a narrower
 * block, what is left of the rows is in row-major order. */
static inline cs_cell cs_cell_in_block_order(const cs_grid *grid, cs_vuint index)
{
    cs_u32 pair = 2u * grid->columns;
    cs_u32 paired = grid->rows / 2u * pair;
    cs_u32 tail = grid->columns % 4u;
    cs_u32 blocked = pair - 2u * tail;
    cs_vuint pair_row = cs_divide(index, pair, 0.5f * grid->inverse_columns);
    cs_vuint rest = index - pair_row * pair;
    cs_vuint within = rest & 7u;
    cs_cell cell;
    cell.column = (rest >> 3) * 4u + (within & 3u);
    cell.row = 2u * pair_row + (within >> 2);
    if (tail != 0u) {
        cs_vuint narrow = rest >= blocked ? rest - blocked : (cs_vuint)(0u);
        cs_vuint narrow_row = narrow >= tail ? (cs_vuint)(1u) : (cs_vuint)(0u);
        cell.column =
            rest >= blocked ? grid->columns - tail + narrow - narrow_row * tail : cell.column;
        cell.row = rest >= blocked ? 2u * pair_row + narrow_row : cell.row;
    }
    if (paired == grid->count) return cell;
    cs_cell last = cs_cell_of(grid, index);
    cell.column = index >= paired ? last.column : cell.column;
    cell.row = index >= paired ? last.row : cell.row;
    return cell;
}

/* Number of columns before `column` that are one stratum wider: floor(column * extra / columns). */
static inline cs_vuint cs_extra_before(const cs_grid *grid, cs_vuint column)
{
    return cs_divide(column * grid->extra, grid->columns, grid->inverse_columns);
}

/* Two coordinates in [0, 1): a slot of a tuple. */
typedef struct cs_pair {
    cs_vfloat x;
    cs_vfloat y;
} cs_pair;

#include "../fp_contract_restore.h"

#endif
