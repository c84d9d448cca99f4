/* A pattern: the tuples of one pixel, named by a sampler and a number of samples.
 *
 * Samplers draw from three things: the pattern's constants; the sample table, which the host makes
 * once for all pixels (clshear/kernels.h); and a key, which makes each pixel's pattern its own. */
#ifndef CLSHEAR_DEVICE_SAMPLER_PATTERN_H
#define CLSHEAR_DEVICE_SAMPLER_PATTERN_H

#include "grid.h"
#include "list.h"
#include "slots.h"

#include "../fp_contract_off.h"

enum {
    CS_MOST_WORDS = CS_END_LIGHT + 1 /* words that a part of a sample table has for a sample */
};

/* Families of keys: each random choice in a pattern has a key of its own, cs_key(key, number). */
enum {
    CS_KEY_ORDER = 0,   /* order of the blocks */
    CS_KEY_PAIRING = 1, /* + slot: which point of a slot goes with which sample */
    CS_KEY_PAIR = 8,    /* + slot: the points of a slot; or + coordinate (cs_draw_strong_array) */
    CS_KEY_DIMENSION = 16, /* + CS_SLOT_WIDEST * slot + coordinate within the slot */
    CS_KEY_BOUNCES = 64    /* and above: keys of the patterns that paths draw beyond the tuple */
};

/* Families must not overlap: these fail to compile when there are too many slots. */
typedef char cs_pairings_fit[CS_KEY_PAIRING + CS_SLOT_COUNT <= CS_KEY_PAIR ? 1 : -1];
typedef char
    cs_pairs_fit[CS_KEY_PAIR + CS_SLOT_WIDEST * CS_SLOT_COUNT <= CS_KEY_DIMENSION ? 1 : -1];

typedef char
    cs_slots_fit[CS_KEY_DIMENSION + CS_SLOT_WIDEST * CS_SLOT_COUNT <= CS_KEY_BOUNCES ? 1 : -1];

/* The constants of a pattern. Make it by clshear_pattern_make. */
typedef struct cs_pattern {
    cs_u32 sampler;         /* CS_SAMPLER_ */
    cs_u32 first;           /* element of the sampler's sequence that is sample 0 */
    cs_u32 blocks;          /* number of blocks of CS_BLOCK samples; the last may be partial */
    cs_domain block_domain; /* of `blocks` */
    cs_u32
        shape[CS_MAIN_DIMENSIONS]; /* meaning depends on the sampler; see its cs_draw_ function */
    cs_grid grid;                  /* grid.count is the number of samples */
} cs_pattern;
CS_SHARED_WORDS(cs_pattern, 19 + CS_MAIN_DIMENSIONS);

/* A sample table: word w of sample i is at table[w * blocks * CS_BLOCK + i]. Its words have a
 * meaning that the sampler gives them. A table may have several parts, one after another, each with
 * the words of all samples. A sampler whose `table` in list.h is `none` reads nothing
 * and takes any pointer. */
typedef CS_GLOBAL const cs_u32 *cs_sample_table;

/* Word number `word` of the samples `index` of a packet. Within lanes 0 to 7, and within lanes 8 to
 * 15, the indices must be consecutive, as those of cs_index_at are: only lanes 0 and 8 are looked
 * at. A packet of 4 lanes must have 4 consecutive indices. */
static inline cs_vuint cs_sample_word(const cs_pattern *pattern, cs_sample_table table, cs_u32 word,
                                      cs_vuint index)
{
    cs_sample_table words = table + word * pattern->blocks * (cs_u32)CS_BLOCK;
#if CS_PACKET == 16
    return (cs_vuint)(vload8(0, words + index.s0), vload8(0, words + index.s8));
#elif CS_PACKET == 8
    return vload8(0, words + index.s0);
#elif CS_PACKET == 4
    return vload4(0, words + index.s0);
#else
    return words[index];
#endif
}

/* Word number `word` of the samples `index`, which may be any of the table. */
static inline cs_vuint cs_sample_word_anywhere(const cs_pattern *pattern, cs_sample_table table,
                                               cs_u32 word, cs_vuint index)
{
    cs_sample_table words = table + word * pattern->blocks * (cs_u32)CS_BLOCK;
#if CS_PACKET == 1
    return words[index];
#else
    cs_uint_lanes place, value;
    place.all = index;
    for (cs_u32 lane = 0u; lane < (cs_u32)CS_PACKET; lane++)
        value.lane[lane] = words[place.lane[lane]];
    return value.all;
#endif
}

/* The sample whose point of slot `slot` goes with the main slots of sample `index`: a random
 * permutation of the pattern. `index` must be below grid.count in every lane. */
static inline cs_vuint cs_partner(const cs_pattern *pattern, cs_u32 key, cs_u32 slot,
                                  cs_vuint index)
{
    return cs_permute(index, (cs_vuint)(pattern->grid.count), pattern->grid.count_domain,
                      (cs_vuint)(cs_key(key, CS_KEY_PAIRING + slot)));
}

/* Key of coordinate `coordinate` (0 or 1) of slot `slot`. */
static inline cs_u32 cs_slot_key(cs_u32 key, cs_u32 slot, cs_u32 coordinate)
{
    return cs_key(key, CS_KEY_DIMENSION + CS_SLOT_WIDEST * slot + coordinate);
}

/* Puts the coordinates of a slot into a tuple. A slot of one coordinate takes point.x. */
static inline void cs_put_slot(cs_pair point, cs_u32 slot, cs_vfloat *tuple)
{
    cs_u32 place = cs_slot_place(slot);
    tuple[place] = point.x;
    if (cs_slot_width(slot) > 1u) tuple[place + 1u] = point.y;
}

/* 32 random bits as a float in [0, 1); 24 of them are kept. */
static inline cs_vfloat cs_unit(cs_vuint bits)
{
    return cs_to_vfloat(bits >> 8) * 0x1p-24f;
}

/* Defines a cs_draw_ function that takes the film and lens coordinates of a sample from the first
 * four words of its table, each through `place`(word, key, dimension). */
#define CS_DEFINE_DRAW_WORDS(name, place)                                                 \
    static inline void name(const cs_pattern *pattern, cs_sample_table table, cs_u32 key, \
                            cs_vuint index, cs_vfloat *tuple)                             \
    {                                                                                     \
        for (cs_u32 d = 0u; d < (cs_u32)CS_MAIN_DIMENSIONS; d++)                          \
            tuple[d] = place(cs_sample_word(pattern, table, d, index), key, d);           \
    }

#include "../fp_contract_restore.h"

#endif
