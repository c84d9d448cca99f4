/* A pattern: the tuples of one pixel, named by a sampler and a number of samples.
 *
 * What the samplers draw from: the pattern's constants, a table of rows that the host prepared for
 * every pixel alike, and a key that makes each pixel's pattern its own. */
#ifndef CLSHEAR_DEVICE_SAMPLER_PATTERN_H
#define CLSHEAR_DEVICE_SAMPLER_PATTERN_H

#include "grid.h"
#include "list.h"

#include "../fp_contract_off.h"

enum {
    CS_DIMENSIONS = 6, /* of a tuple: film, lens, and a pair for the light */
    CS_MOST_WORDS = 4  /* of a row */
};

/* Pairs of coordinates of a tuple. */
enum {
    CS_PAIR_FIBRE = 0, /* film; after an equal-area shear, the position across the fibres */
    CS_PAIR_LENS = 1,  /* lens; after an equal-area shear, the position along the fibres */
    CS_PAIR_EMITTER = 2
};

/* What the parts of a pattern's random choices are keyed by. */
enum {
    CS_KEY_ORDER = 0,     /* the order of its blocks */
    CS_KEY_PAIRING = 1,   /* + pair: which of a pair's points goes with which sample */
    CS_KEY_PAIR = 8,      /* + pair: the points of a pair */
    CS_KEY_DIMENSION = 16 /* + dimension */
};

typedef struct cs_pattern {
    cs_u32 sampler; /* CS_SAMPLER_ */
    cs_u32 first;  /* the sequence's element that is sample 0; not 0 in a render that is extended */
    cs_u32 blocks; /* of CS_BLOCK samples; the last may be partial */
    cs_domain block_domain;
    cs_u32 shape[4]; /* jittered4d: strata of each coordinate; halton: digits of each base in use */
    cs_grid grid;    /* with the number of samples */
} cs_pattern;
CS_SHARED_WORDS(cs_pattern, 23);

/* The rows of a pattern's table: word w of sample i is at words[w * blocks * CS_BLOCK + i]. */
typedef CS_GLOBAL const cs_u32 *cs_sample_table;

/* A word of the rows of a packet. Its samples must be consecutive in each block, as cs_index_at has
 * them: lanes 0 and 8 say where the loads begin. */
static inline cs_vuint cs_sample_word(const cs_pattern *pattern, cs_sample_table rows, cs_u32 word,
                                      cs_vuint index)
{
    cs_sample_table words = rows + word * pattern->blocks * (cs_u32)CS_BLOCK;
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

/* The same for samples anywhere in the table. */
static inline cs_vuint cs_sample_word_anywhere(const cs_pattern *pattern, cs_sample_table rows,
                                               cs_u32 word, cs_vuint index)
{
    cs_sample_table words = rows + word * pattern->blocks * (cs_u32)CS_BLOCK;
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

/* The sample whose point of `pair` goes with the first pair's point of sample `index`: a random
 * permutation. */
static inline cs_vuint cs_partner(const cs_pattern *pattern, cs_u32 key, cs_u32 pair,
                                  cs_vuint index)
{
    return cs_permute(index, (cs_vuint)(pattern->grid.count), pattern->grid.count_domain,
                      (cs_vuint)(cs_key(key, CS_KEY_PAIRING + pair)));
}

/* 32 random bits as a float in [0, 1); 24 of them are kept. */
static inline cs_vfloat cs_unit(cs_vuint bits)
{
    return cs_to_vfloat(bits >> 8) * 0x1p-24f;
}

#include "../fp_contract_restore.h"

#endif
