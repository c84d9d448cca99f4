/* Digital nets and sequences in base 2, scrambled.
 *
 * Words hold coordinates as 32 bits in reverse, most significant digit lowest. In that form nested
 * uniform (Owen) scrambling is a hash whose bits depend on lower bits only, and the element number
 * is the van der Corput coordinate itself. */
#ifndef CLSHEAR_DEVICE_SAMPLER_NET_H
#define CLSHEAR_DEVICE_SAMPLER_NET_H

#include "pattern.h"

#include "../fp_contract_off.h"

/* Nested uniform scrambling of reversed digits: the hash of Laine & Karras 2011 with constants by
 * N. Vegdahl ("Building a Better LK Hash", 2021), as Burley 2020 uses it. `seed` is a hash. */
#define CS_DEFINE_SCRAMBLE(name, seed_type)                      \
    static inline cs_vuint name(cs_vuint digits, seed_type seed) \
    {                                                            \
        digits ^= digits * 0x3d20adeau;                          \
        digits += seed;                                          \
        digits *= seed >> 16 | 1u;                               \
        digits ^= digits * 0x05526c56u;                          \
        digits ^= digits * 0x53a22864u;                          \
        return digits;                                           \
    }

CS_DEFINE_SCRAMBLE(cs_scramble_reversed, cs_u32)
CS_DEFINE_SCRAMBLE(cs_scramble_reversed_lanes, cs_vuint)

/* The 32 bits of x in reverse order. */
static inline cs_vuint cs_reverse_bits(cs_vuint x)
{
    x = (x >> 16) | (x << 16);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    return ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
}

/* The second coordinate, reversed, of element `index` of the (0,2)-sequence whose first is the
 * element number reversed: Pascal's matrix modulo 2, which is the fifth Kronecker power of
 * ((1, 1), (0, 1)). */
static inline cs_vuint cs_pascal(cs_vuint index)
{
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    return index ^ (index >> 16);
}

/* A coordinate in [0, 1) from its reversed digits. `dimension` is its number among all slots. */
#define CS_DEFINE_SCRAMBLED(name, key_type, key_of, scramble)                          \
    static inline cs_vfloat name(cs_vuint digits, key_type key, cs_u32 dimension)      \
    {                                                                                  \
        return cs_unit(cs_reverse_bits(                                                \
            scramble(digits, key_of(key, (key_type)(CS_KEY_DIMENSION + dimension))))); \
    }

CS_DEFINE_SCRAMBLED(cs_scrambled, cs_u32, cs_key, cs_scramble_reversed)
CS_DEFINE_SCRAMBLED(cs_scrambled_lanes, cs_vuint, cs_key_families, cs_scramble_reversed_lanes)

/* A (0,2)-pair of slot `slot` for element `element`. The element's place in the sequence is
 * shuffled so that every aligned run of 2^k elements stays one. */
#define CS_DEFINE_SHUFFLED_PAIR(name, key_type, key_of, scramble, scrambled)                     \
    static inline cs_pair name(cs_vuint element, key_type key, cs_u32 slot)                      \
    {                                                                                            \
        cs_vuint shuffled = cs_reverse_bits(                                                     \
            scramble(cs_reverse_bits(element), key_of(key, (key_type)(CS_KEY_PAIRING + slot)))); \
        cs_pair point;                                                                           \
        point.x = scrambled(shuffled, key, CS_SLOT_WIDEST * slot);                               \
        point.y = scrambled(cs_pascal(shuffled), key, CS_SLOT_WIDEST * slot + 1u);               \
        return point;                                                                            \
    }

CS_DEFINE_SHUFFLED_PAIR(cs_shuffled_pair, cs_u32, cs_key, cs_scramble_reversed, cs_scrambled)
CS_DEFINE_SHUFFLED_PAIR(cs_shuffled_pair_lanes, cs_vuint, cs_key_families,
                        cs_scramble_reversed_lanes, cs_scrambled_lanes)

/* A (0,2)-pair of slot `slot`. Word 0 of the table must be the sample's element number. */
static inline cs_pair cs_extra_net_pair(const cs_pattern *pattern, cs_sample_table table,
                                        cs_u32 key, cs_vuint index, cs_u32 slot)
{
    return cs_shuffled_pair(cs_sample_word_anywhere(pattern, table, 0u, index), key, slot);
}

/* The light's pair as two more dimensions of the net that the film and lens coordinates are from.
 * The table has a word for each dimension. */
static inline cs_pair cs_extra_net_words(const cs_pattern *pattern, cs_sample_table table,
                                         cs_u32 key, cs_vuint index, cs_u32 slot)
{
    cs_u32 first = cs_slot_place(slot);
    cs_pair point;
    point.x = cs_scrambled(cs_sample_word(pattern, table, first, index), key, first);
    point.y = cs_scrambled(cs_sample_word(pattern, table, first + 1u, index), key, first + 1u);
    return point;
}

/* Four dimensions of one net: `sobol` and `sz`. The table's first four words are the
 * coordinates, reversed; the first of them is the element number. */
CS_DEFINE_DRAW_WORDS(cs_draw_net, cs_scrambled)

/* Pairs of (0,2)-sequences, each shuffled by itself (Kollig & Keller 2002, section 3; the shuffling
 * of Burley 2020). The table's one word is the element number. */
static inline void cs_draw_net_pairs(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                     cs_vuint index, cs_vfloat *tuple)
{
    cs_vuint element = cs_sample_word(pattern, table, 0u, index);
    cs_pair film;
    film.x = cs_scrambled(element, key, 0u);
    film.y = cs_scrambled(cs_pascal(element), key, 1u);
    cs_put_slot(film, CS_SLOT_FILM, tuple);
    cs_put_slot(cs_shuffled_pair(element, key, CS_SLOT_LENS), CS_SLOT_LENS, tuple);
}

#include "../fp_contract_restore.h"

#endif
