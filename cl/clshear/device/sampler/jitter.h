/* Patterns with one random point in each stratum: 1D, 2D and 4D strata, and none. */
#ifndef CLSHEAR_DEVICE_SAMPLER_JITTER_H
#define CLSHEAR_DEVICE_SAMPLER_JITTER_H

#include "pattern.h"

#include "../fp_contract_off.h"

/* Independent coordinates of a slot. They are keyed by the element, not by the sample, so that the
 * sequence can go on. */
static inline cs_pair cs_extra_random(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                      cs_vuint index, cs_u32 slot)
{
    cs_pair point;
    (void)table;
    point.x = cs_unit(cs_key_lanes(cs_slot_key(key, slot, 0u), pattern->first + index));
    point.y = cs_unit(cs_key_lanes(cs_slot_key(key, slot, 1u), pattern->first + index));
    return point;
}

/* Independent points. */
static inline void cs_draw_random(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                  cs_vuint index, cs_vfloat *tuple)
{
    for (cs_u32 slot = 0u; slot < (cs_u32)CS_MAIN_SLOTS; slot++)
        cs_put_slot(cs_extra_random(pattern, table, key, index, slot), slot, tuple);
}

/* A random place in stratum number `stratum` of `count`. */
static inline cs_vfloat cs_jittered(cs_vuint stratum, cs_u32 count, cs_vuint bits)
{
    cs_strata strata = cs_strata_of(count);
    return cs_in_stratum(&strata, stratum, bits);
}

/* The jittered point of slot `slot` in cell `cell` of the grid, which is number `place`. */
static inline cs_pair cs_jittered_point(const cs_grid *grid, cs_cell cell, cs_u32 key, cs_u32 slot,
                                        cs_vuint place)
{
    cs_vuint bits = cs_key_lanes(cs_key(key, CS_KEY_PAIR + slot), place);
    cs_pair point;
    point.x = cs_jittered(cell.column, grid->columns, bits);
    point.y = cs_jittered(cell.row, grid->rows, cs_hash_lanes(bits));
    return point;
}

/* A jittered point of slot `slot`, combined with the sample at random. */
static inline cs_pair cs_extra_jittered(const cs_pattern *pattern, cs_sample_table table,
                                        cs_u32 key, cs_vuint index, cs_u32 slot)
{
    cs_vuint place = cs_partner(pattern, key, slot, index);
    (void)table;
    return cs_jittered_point(&pattern->grid, cs_cell_of(&pattern->grid, place), key, slot, place);
}

/* Jittered pairs, combined at random (Cook 1986). */
static inline void cs_draw_jittered(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                    cs_vuint index, cs_vfloat *tuple)
{
    const cs_grid *grid = &pattern->grid;
    cs_cell first = cs_cell_in_block_order(grid, index);
    cs_put_slot(cs_jittered_point(grid, first, key, CS_SLOT_FILM, index), CS_SLOT_FILM, tuple);
    cs_put_slot(cs_extra_jittered(pattern, table, key, index, CS_SLOT_LENS), CS_SLOT_LENS, tuple);
}

/* Jittered in four dimensions: N = a b c d strata, those of a cell of the film together.
 * pattern->shape holds a, b, c, d. */
static inline void cs_draw_jittered4d(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                      cs_vuint index, cs_vfloat *tuple)
{
    const cs_u32 *shape = pattern->shape;
    cs_vuint rest = index;
    (void)table;
    for (cs_u32 d = CS_MAIN_DIMENSIONS; d-- > 0u;) {
        cs_vuint next = cs_divide(rest, shape[d], 1.0f / (cs_f32)shape[d]);
        cs_vuint bits = cs_key_lanes(cs_key(key, CS_KEY_DIMENSION + d), index);
        tuple[d] = cs_jittered(rest - next * shape[d], shape[d], bits);
        rest = next;
    }
}

/* A coordinate with one point in each of N strata. `number` is the coordinate's among all slots;
 * coordinate 0 goes up with the samples' numbers. */
static inline cs_vfloat cs_nrooks_axis(const cs_grid *grid, cs_u32 key, cs_vuint index,
                                       cs_u32 number)
{
    cs_u32 axis_key = cs_key(key, CS_KEY_DIMENSION + number);
    cs_vuint stratum = index;
    if (number > 0u)
        stratum =
            cs_permute(index, (cs_vuint)(grid->count), grid->count_domain, (cs_vuint)(axis_key));
    return cs_in_stratum(&grid->strata, stratum, cs_key_lanes(~axis_key, stratum));
}

/* Coordinates of slot `slot` with one point in each of N strata. */
static inline cs_pair cs_extra_nrooks(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                      cs_vuint index, cs_u32 slot)
{
    cs_pair point;
    (void)table;
    point.x = cs_nrooks_axis(&pattern->grid, key, index, CS_SLOT_WIDEST * slot);
    point.y = cs_nrooks_axis(&pattern->grid, key, index, CS_SLOT_WIDEST * slot + 1u);
    return point;
}

/* One point in each of N strata of every coordinate, and nothing else (McKay et al. 1979). */
static inline void cs_draw_nrooks(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                  cs_vuint index, cs_vfloat *tuple)
{
    for (cs_u32 slot = 0u; slot < (cs_u32)CS_MAIN_SLOTS; slot++)
        cs_put_slot(cs_extra_nrooks(pattern, table, key, index, slot), slot, tuple);
}

#include "../fp_contract_restore.h"

#endif
