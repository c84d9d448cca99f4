/* From (seed, pixel, replicate, index) to a tuple: the samplers' common front. Shared.
 *
 * Every coordinate is a pure function of those four numbers, whatever the order, the work-group or
 * the device in which it is asked for. */
#ifndef CS_SAMPLER_H
#define CS_SAMPLER_H

#include "halton.h"
#include "jitter.h"
#include "multijitter.h"
#include "net.h"
#include "shifted.h"

static inline u32 cs_pattern_key(u32 seed, u32 pixel, u32 replicate)
{
    return cs_key(cs_key(cs_key(0u, seed), pixel), replicate);
}

/* Index of the sample at place `position` in the order in which a pixel draws its pattern: blocks
 * in random order, so that the samples drawn first are an unbiased choice from the pattern and an
 * interrupted render is unbiased too. Positions run to CS_BLOCK * blocks; an index of grid.count or
 * more is no sample. */
static inline vuint cs_index_at(const cs_pattern *pattern, u32 key, vuint position)
{
    vuint block = cs_permute(position / (u32)CS_BLOCK, (vuint)(pattern->blocks),
                             pattern->block_domain, (vuint)(cs_key(key, CS_KEY_ORDER)));
    return block * (u32)CS_BLOCK + position % (u32)CS_BLOCK;
}

/* The first `pairs` (2 or 3) pairs of coordinates, in [0, 1), of sample `index` < grid.count of the
 * pattern named by `key`. Samples are numbered so that those of a box of CS_BOX are neighbours in
 * the first pair wherever the sampler allows, and so are the boxes of a block. In a packet of
 * several lanes, lanes 0 to 7 and 8 to 15 must have consecutive indices each; those that are no
 * sample may have index 0. */
static inline void cs_draw(const cs_pattern *pattern, cs_rows rows, u32 key, vuint index, u32 pairs,
                           vfloat *tuple)
{
#define CS_SAMPLER_CASE(identifier, name, draw, counts, rows_of, progressive, about) \
    case CS_SAMPLER_##identifier:                                                    \
        cs_draw_##draw(pattern, rows, key, index, pairs, tuple);                     \
        break;
    switch (pattern->sampler) {
        CS_SAMPLER_LIST(CS_SAMPLER_CASE)
    }
#undef CS_SAMPLER_CASE
}

#endif
