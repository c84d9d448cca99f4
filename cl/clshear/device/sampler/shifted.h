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

/* Slot `slot` gets words `word` and `word` + 1 of a random partner. */
static inline cs_pair cs_shifted_partner(const cs_pattern *pattern, cs_sample_table table,
                                         cs_u32 key, cs_vuint index, cs_u32 slot, cs_u32 word)
{
    cs_vuint partner = cs_partner(pattern, key, slot, index);
    cs_pair point;
    point.x = cs_shifted(cs_sample_word_anywhere(pattern, table, word, partner), key,
                         CS_SLOT_WIDEST * slot);
    point.y = cs_shifted(cs_sample_word_anywhere(pattern, table, word + 1u, partner), key,
                         CS_SLOT_WIDEST * slot + 1u);
    return point;
}

/* Slot `slot` gets the set's first two coordinates of a random partner. */
static inline cs_pair cs_extra_partner(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                       cs_vuint index, cs_u32 slot)
{
    return cs_shifted_partner(pattern, table, key, index, slot, 0u);
}

/* Four dimensions of a lattice. The table has four words. */
CS_DEFINE_DRAW_WORDS(cs_draw_lattice, cs_shifted)

/* First word of the planar set of slot `slot`. The table has shape[0] sets of two words each, a
 * power of two and at least 4. The first slot's set is any of them; the others follow at an odd
 * distance, so that four slots in a row share none. */
static inline cs_u32 cs_set_word(const cs_pattern *pattern, cs_u32 key, cs_u32 slot)
{
    cs_u32 first = cs_key(key, CS_KEY_PAIR), distance = cs_key(key, CS_KEY_PAIR + 1u) | 1u;
    return 2u * ((first + slot * distance) & (pattern->shape[0] - 1u));
}

/* Slot `slot` gets the point of a random partner from the slot's own set. */
static inline cs_pair cs_extra_point_set(const cs_pattern *pattern, cs_sample_table table,
                                         cs_u32 key, cs_vuint index, cs_u32 slot)
{
    return cs_shifted_partner(pattern, table, key, index, slot, cs_set_word(pattern, key, slot));
}

/* Pairs from different planar sets, each shifted by itself and combined at random. */
static inline void cs_draw_point_set(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                     cs_vuint index, cs_vfloat *tuple)
{
    cs_u32 word = cs_set_word(pattern, key, CS_SLOT_FILM);
    cs_pair film;
    film.x = cs_shifted(cs_sample_word(pattern, table, word, index), key, 0u);
    film.y = cs_shifted(cs_sample_word(pattern, table, word + 1u, index), key, 1u);
    cs_put_slot(film, CS_SLOT_FILM, tuple);
    cs_put_slot(cs_extra_point_set(pattern, table, key, index, CS_SLOT_LENS), CS_SLOT_LENS, tuple);
}

#include "../fp_contract_restore.h"

#endif
