/* From (seed, pixel, replicate, index) to a tuple: the samplers' common front.
 *
 * Every coordinate is a pure function of those four numbers, whatever the order, the work-group or
 * the device in which it is asked for. */
#ifndef CLSHEAR_DEVICE_SAMPLER_SAMPLER_H
#define CLSHEAR_DEVICE_SAMPLER_SAMPLER_H

#include "halton.h"
#include "jitter.h"
#include "multijitter.h"
#include "net.h"
#include "shifted.h"

#include "../fp_contract_off.h"

static inline cs_u32 cs_pattern_key(cs_u32 seed, cs_u32 pixel, cs_u32 replicate)
{
    return cs_key(cs_key(cs_key(0u, seed), pixel), replicate);
}

/* Index of the sample at place `position` in the order in which a pixel draws its pattern: blocks
 * in random order, so that the samples drawn first are an unbiased choice from the pattern and an
 * interrupted render is unbiased too. Positions run to CS_BLOCK * blocks; an index of grid.count or
 * more is no sample. */
static inline cs_vuint cs_index_at(const cs_pattern *pattern, cs_u32 key, cs_vuint position)
{
    cs_vuint block = cs_permute(position / (cs_u32)CS_BLOCK, (cs_vuint)(pattern->blocks),
                                pattern->block_domain, (cs_vuint)(cs_key(key, CS_KEY_ORDER)));
    return block * (cs_u32)CS_BLOCK + position % (cs_u32)CS_BLOCK;
}

/* The first `pairs` (2 or 3) pairs of coordinates, in [0, 1), of sample `index` < grid.count of the
 * pattern named by `key`. Samples are numbered so that those of a box of CS_GROUP are neighbours in
 * the first pair wherever the sampler allows, and so are the boxes of a block. In a packet of
 * several lanes, lanes 0 to 7 and 8 to 15 must have consecutive indices each; those that are no
 * sample may have index 0. */
static inline void cs_draw(const cs_pattern *pattern, cs_sample_table rows, cs_u32 key,
                           cs_vuint index, cs_u32 pairs, cs_vfloat *tuple)
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

#include "../fp_contract_restore.h"

#endif
