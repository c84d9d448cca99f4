/* From (seed, pixel, replicate, index) to a tuple: the samplers' common front. Shared.
 *
 * Every coordinate is a pure function of those four numbers, whatever the order, the work-group or
 * the device in which it is asked for. */
#ifndef CS_SAMPLER_H
#define CS_SAMPLER_H

#include "multijitter.h"

/* What the parts of a pattern's random choices are keyed by. */
enum {
    CS_KEY_ORDER = 0,   /* the order of its blocks */
    CS_KEY_PAIRING = 1, /* + pair: which cell of a pair goes with which sample */
    CS_KEY_PAIR = 8     /* + pair: the strata of a pair */
};

enum {
    CS_PAIR_FIBRE = 0, /* film; after an equal-area shear, the position across the fibres */
    CS_PAIR_LENS = 1,  /* lens; after an equal-area shear, the position along the fibres */
    CS_PAIR_EMITTER = 2
};

static inline u32 cs_pattern_key(u32 seed, u32 pixel, u32 replicate)
{
    return cs_key(cs_key(cs_key(0u, seed), pixel), replicate);
}

/* Index of the sample at place `position` in the order in which a pixel draws its pattern: blocks
 * in random order, so that the samples drawn first are an unbiased choice from the pattern and an
 * interrupted render is unbiased too. Positions run to CS_BLOCK * grid->blocks; an index of
 * grid->count or more is no sample. */
static inline vuint cs_index_at(const cs_grid *grid, u32 pattern_key, vuint position)
{
    vuint block = cs_permute(position / (u32)CS_BLOCK, (vuint)(grid->blocks), grid->block_domain,
                             (vuint)(cs_key(pattern_key, CS_KEY_ORDER)));
    return block * (u32)CS_BLOCK + position % (u32)CS_BLOCK;
}

/* Pair number `pair` of sample `index` < grid->count, in [0, 1)^2. The first pair's cells are
 * enumerated in blocks; the others are paired with it at random. */
static inline cs_pair cs_draw_pair(const cs_grid *grid, u32 pattern_key, u32 pair, vuint index)
{
    u32 key = cs_key(pattern_key, CS_KEY_PAIR + pair);
    if (pair == CS_PAIR_FIBRE)
        return cs_multijitter(grid, cs_cell_in_block_order(grid, index), key);
    vuint partner = cs_permute(index, (vuint)(grid->count), grid->count_domain,
                               (vuint)(cs_key(pattern_key, CS_KEY_PAIRING + pair)));
    return cs_multijitter(grid, cs_cell_of(grid, partner), key);
}

#endif
