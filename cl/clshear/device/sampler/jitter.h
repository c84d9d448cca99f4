/* Patterns with one random point in each stratum: 1D, 2D and 4D strata, and none. */
#ifndef CLSHEAR_DEVICE_SAMPLER_JITTER_H
#define CLSHEAR_DEVICE_SAMPLER_JITTER_H

#include "pattern.h"

#include "../fp_contract_off.h"

/* Independent points. Element numbers, not sample numbers: the sequence can go on. */
static inline void cs_draw_random(const cs_pattern *pattern, cs_sample_table rows, cs_u32 key,
                                  cs_vuint index, cs_u32 pairs, cs_vfloat *tuple)
{
    (void)rows;
    for (cs_u32 d = 0u; d < 2u * pairs; d++)
        tuple[d] = cs_unit(cs_key_lanes(cs_key(key, CS_KEY_DIMENSION + d), pattern->first + index));
}

/* A place in a stratum, by the upper 13 bits, or 10 where there are many strata: so few that
 * rounding stays clear of the stratum's ends. At most 2048 strata. */
static inline cs_vfloat cs_jittered(cs_vuint stratum, cs_u32 strata, cs_vuint bits)
{
    cs_u32 shift = strata > 256u ? 22u : 19u;
    cs_vfloat jitter =
        (cs_to_vfloat(bits >> shift) + 0.5f) * (1.0f / (cs_f32)(1u << (32u - shift)));
    return (cs_to_vfloat(stratum) + jitter) * (1.0f / (cs_f32)strata);
}

/* Jittered pairs, combined at random (Cook 1986). */
static inline void cs_draw_jittered(const cs_pattern *pattern, cs_sample_table rows, cs_u32 key,
                                    cs_vuint index, cs_u32 pairs, cs_vfloat *tuple)
{
    const cs_grid *grid = &pattern->grid;
    (void)rows;
    for (cs_u32 pair = 0u; pair < pairs; pair++) {
        cs_vuint place = index;
        if (pair != CS_PAIR_FIBRE) place = cs_partner(pattern, key, pair, index);
        cs_cell cell =
            pair == CS_PAIR_FIBRE ? cs_cell_in_block_order(grid, place) : cs_cell_of(grid, place);
        cs_vuint bits = cs_key_lanes(cs_key(key, CS_KEY_PAIR + pair), place);
        tuple[2u * pair] = cs_jittered(cell.column, grid->columns, bits);
        tuple[2u * pair + 1u] = cs_jittered(cell.row, grid->rows, bits << 16);
    }
}

/* Jittered in four dimensions: N = a b c d strata, those of a cell of the first pair together. The
 * light gets a jittered pair. */
static inline void cs_draw_jittered4d(const cs_pattern *pattern, cs_sample_table rows, cs_u32 key,
                                      cs_vuint index, cs_u32 pairs, cs_vfloat *tuple)
{
    const cs_u32 *shape = pattern->shape;
    cs_vuint rest = index;
    (void)rows;
    for (cs_u32 d = 4u; d-- > 0u;) {
        cs_vuint next = cs_divide(rest, shape[d], 1.0f / (cs_f32)shape[d]);
        cs_vuint bits = cs_key_lanes(cs_key(key, CS_KEY_DIMENSION + d), index);
        tuple[d] = cs_jittered(rest - next * shape[d], shape[d], bits);
        rest = next;
    }
    if (pairs <= CS_PAIR_EMITTER) return;
    cs_vuint partner = cs_partner(pattern, key, CS_PAIR_EMITTER, index);
    cs_vuint row = cs_divide(partner, pattern->grid.columns, pattern->grid.inverse_columns);
    cs_vuint bits = cs_key_lanes(cs_key(key, CS_KEY_PAIR + CS_PAIR_EMITTER), partner);
    tuple[4] = cs_jittered(partner - row * pattern->grid.columns, pattern->grid.columns, bits);
    tuple[5] = cs_jittered(row, pattern->grid.rows, bits << 16);
}

/* One point in each of N strata of every coordinate, and nothing else (McKay et al. 1979). The
 * first coordinate goes up with the samples' numbers. */
static inline void cs_draw_nrooks(const cs_pattern *pattern, cs_sample_table rows, cs_u32 key,
                                  cs_vuint index, cs_u32 pairs, cs_vfloat *tuple)
{
    const cs_grid *grid = &pattern->grid;
    (void)rows;
    for (cs_u32 d = 0u; d < 2u * pairs; d++) {
        cs_u32 dimension_key = cs_key(key, CS_KEY_DIMENSION + d);
        cs_vuint stratum = index;
        if (d > 0u)
            stratum = cs_permute(index, (cs_vuint)(grid->count), grid->count_domain,
                                 (cs_vuint)(dimension_key));
        tuple[d] = cs_in_stratum(grid, stratum, cs_key_lanes(~dimension_key, stratum) >> 16);
    }
}

#include "../fp_contract_restore.h"

#endif
