/* Point sets prepared on the host and shifted on the torus by a random vector for each pixel
 * (Cranley & Patterson 1976). Rows hold coordinates in units of 2^-32. */
#ifndef CLSHEAR_DEVICE_SAMPLER_SHIFTED_H
#define CLSHEAR_DEVICE_SAMPLER_SHIFTED_H

#include "pattern.h"

#include "../fp_contract_off.h"

static inline cs_vfloat cs_shifted(cs_vuint word, cs_u32 key, cs_u32 dimension)
{
    return cs_unit(word + cs_key(key, CS_KEY_DIMENSION + dimension));
}

/* The set's point of a random partner. */
static inline void cs_draw_partner(const cs_pattern *pattern, cs_sample_table rows, cs_u32 key,
                                   cs_vuint index, cs_u32 pair, cs_vfloat *tuple)
{
    cs_vuint partner = cs_partner(pattern, key, pair, index);
    for (cs_u32 d = 0u; d < 2u; d++)
        tuple[2u * pair + d] =
            cs_shifted(cs_sample_word_anywhere(pattern, rows, d, partner), key, 2u * pair + d);
}

/* Four dimensions of a lattice. */
static inline void cs_draw_lattice(const cs_pattern *pattern, cs_sample_table rows, cs_u32 key,
                                   cs_vuint index, cs_u32 pairs, cs_vfloat *tuple)
{
    for (cs_u32 d = 0u; d < 4u; d++)
        tuple[d] = cs_shifted(cs_sample_word(pattern, rows, d, index), key, d);
    if (pairs > CS_PAIR_EMITTER) cs_draw_partner(pattern, rows, key, index, CS_PAIR_EMITTER, tuple);
}

/* Pairs of one planar set, each shifted by itself and combined at random. */
static inline void cs_draw_point_set(const cs_pattern *pattern, cs_sample_table rows, cs_u32 key,
                                     cs_vuint index, cs_u32 pairs, cs_vfloat *tuple)
{
    for (cs_u32 d = 0u; d < 2u; d++)
        tuple[d] = cs_shifted(cs_sample_word(pattern, rows, d, index), key, d);
    for (cs_u32 pair = 1u; pair < pairs; pair++)
        cs_draw_partner(pattern, rows, key, index, pair, tuple);
}

#include "../fp_contract_restore.h"

#endif
