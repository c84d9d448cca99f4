/* Point sets prepared on the host and shifted on the torus by a random vector for each pixel
 * (Cranley & Patterson 1976). Words of the table are coordinates in units of 2^-32. */
#ifndef CLSHEAR_DEVICE_SAMPLER_SHIFTED_H
#define CLSHEAR_DEVICE_SAMPLER_SHIFTED_H

#include "pattern.h"

#include "../fp_contract_off.h"

/* A shifted coordinate. `dimension` is its number among all slots. */
static inline cs_vfloat cs_shifted(cs_vuint word, cs_u32 key, cs_u32 dimension)
{
    return cs_unit(word + cs_key(key, CS_KEY_DIMENSION + dimension));
}

/* Slot `slot` gets the set's first two coordinates of a random partner. */
static inline cs_pair cs_extra_partner(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                       cs_vuint index, cs_u32 slot)
{
    cs_vuint partner = cs_partner(pattern, key, slot, index);
    cs_pair point;
    point.x = cs_shifted(cs_sample_word_anywhere(pattern, table, 0u, partner), key,
                         CS_SLOT_WIDEST * slot);
    point.y = cs_shifted(cs_sample_word_anywhere(pattern, table, 1u, partner), key,
                         CS_SLOT_WIDEST * slot + 1u);
    return point;
}

/* Four dimensions of a lattice. The table has four words. */
CS_DEFINE_DRAW_WORDS(cs_draw_lattice, cs_shifted)

/* Pairs of one planar set, each shifted by itself and combined at random. The table has two words.
 */
static inline void cs_draw_point_set(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                     cs_vuint index, cs_vfloat *tuple)
{
    cs_pair film;
    film.x = cs_shifted(cs_sample_word(pattern, table, 0u, index), key, 0u);
    film.y = cs_shifted(cs_sample_word(pattern, table, 1u, index), key, 1u);
    cs_put_slot(film, CS_SLOT_FILM, tuple);
    cs_put_slot(cs_extra_partner(pattern, table, key, index, CS_SLOT_LENS), CS_SLOT_LENS, tuple);
}

#include "../fp_contract_restore.h"

#endif
