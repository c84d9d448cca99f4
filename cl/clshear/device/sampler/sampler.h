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

/* The samplers that the functions below draw. With CS_NETS_ONLY defined they are nets: the program
 * is smaller, and compiles sooner. */
#ifdef CS_NETS_ONLY
#define CS_DRAWN_LIST CS_SAMPLER_LIST_NETS
#else
#define CS_DRAWN_LIST CS_SAMPLER_LIST
#endif

/* The key of a pixel's pattern. `seed` belongs to the image, `pixel` numbers its pixels,
 * `replicate` the independent patterns of one pixel. */
static inline cs_u32 cs_pattern_key(cs_u32 seed, cs_u32 pixel, cs_u32 replicate)
{
    return cs_key(cs_key(cs_key(0u, seed), pixel), replicate);
}

/* Index of the sample at place `position` of the order in which a pixel draws its pattern. Blocks
 * come in random order, so that the samples drawn first are an unbiased choice from the pattern and
 * an interrupted render is unbiased too. `position` must be below CS_BLOCK * blocks. An index of
 * grid.count or more is no sample: leave it out. */
static inline cs_vuint cs_index_at(const cs_pattern *pattern, cs_u32 key, cs_vuint position)
{
    cs_vuint block = cs_permute(position / (cs_u32)CS_BLOCK, (cs_vuint)(pattern->blocks),
                                pattern->block_domain, (cs_vuint)(cs_key(key, CS_KEY_ORDER)));
    return block * (cs_u32)CS_BLOCK + position % (cs_u32)CS_BLOCK;
}

/* The film and lens coordinates, in [0, 1), of samples `index` of the pattern named by `key`, into
 * tuple[0] to tuple[CS_MAIN_DIMENSIONS - 1].
 *
 * Every index must be below grid.count. In a packet of several lanes, lanes 0 to 7 and lanes 8 to
 * 15 must have consecutive indices each, as cs_index_at makes them; lanes that are no sample may
 * have index 0 if lanes 0 and 8 are right. Samples are numbered so that CS_GROUP consecutive ones
 * are neighbours on the film wherever the sampler allows, and so are the groups of a block. */
static inline void cs_draw(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                           cs_vuint index, cs_vfloat *tuple)
{
#define CS_DRAW_CASE(identifier, name, draw, light, extra, shape, words, progressive, about) \
    case CS_SAMPLER_##identifier:                                                            \
        cs_draw_##draw(pattern, table, key, index, tuple);                                   \
        break;
    switch (pattern->sampler) {
        CS_DRAWN_LIST(CS_DRAW_CASE)
    }
#undef CS_DRAW_CASE
}

/* A pair in [0, 1) for each of the samples `index`, in an order that is independent of all other
 * pairs (padding: Kollig & Keller 2002, section 3). slot: whose keys it takes. The indices of a
 * packet may be any below grid.count. The other parameters are those of cs_draw. */
static inline cs_pair cs_draw_padding(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                      cs_vuint index, cs_u32 slot)
{
    cs_pair point;
    point.x = (cs_vfloat)(0.0f);
    point.y = (cs_vfloat)(0.0f);
#define CS_EXTRA_CASE(identifier, name, draw, light, extra, shape, words, progressive, about) \
    case CS_SAMPLER_##identifier:                                                             \
        point = cs_extra_##extra(pattern, table, key, index, slot);                           \
        break;
    switch (pattern->sampler) {
        CS_DRAWN_LIST(CS_EXTRA_CASE)
    }
#undef CS_EXTRA_CASE
    return point;
}

/* 1 if cs_draw_padding_lanes draws the sampler's padding, which is that of nets; else 0. A new
 * function for padding gets a line here. */
static inline int cs_pads_lanes(cs_u32 sampler)
{
#define CS_PADS_net_pair 1
#define CS_PADS_random 0
#define CS_PADS_jittered 0
#define CS_PADS_nrooks 0
#define CS_PADS_multijittered 0
#define CS_PADS_correlated 0
#define CS_PADS_strong_array 0
#define CS_PADS_partner 0
#define CS_PADS_point_set 0
#define CS_PADS_CASE(identifier, name, draw, light, extra, shape, words, progressive, about) \
    case CS_SAMPLER_##identifier:                                                            \
        return CS_PADS_##extra;
    switch (sampler) {
        CS_DRAWN_LIST(CS_PADS_CASE)
    }
#undef CS_PADS_CASE
    return 0;
}

/* As cs_draw_padding, for samples of several patterns, with the key of each lane's pattern. The
 * sampler must be one for which cs_pads_lanes is 1. */
static inline cs_pair cs_draw_padding_lanes(const cs_pattern *pattern, cs_sample_table table,
                                            cs_vuint key, cs_vuint index, cs_u32 slot)
{
    return cs_shuffled_pair_lanes(cs_sample_word_anywhere(pattern, table, 0u, index), key, slot);
}

/* The coordinates, in [0, 1), of slot `slot` of samples `index`: CS_SLOT_LIGHT or a later slot. The
 * preconditions are those of cs_draw. A slot of one coordinate has it in x. */
static inline cs_pair cs_draw_extra(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                    cs_vuint index, cs_u32 slot)
{
    if (slot != (cs_u32)CS_SLOT_LIGHT) return cs_draw_padding(pattern, table, key, index, slot);
    cs_pair point;
    point.x = (cs_vfloat)(0.0f);
    point.y = (cs_vfloat)(0.0f);
#define CS_LIGHT_CASE(identifier, name, draw, light, extra, shape, words, progressive, about) \
    case CS_SAMPLER_##identifier:                                                             \
        point = cs_extra_##light(pattern, table, key, index, slot);                           \
        break;
    switch (pattern->sampler) {
        CS_DRAWN_LIST(CS_LIGHT_CASE)
    }
#undef CS_LIGHT_CASE
    return point;
}

/* All slots: CS_DIMENSIONS coordinates. The preconditions are those of cs_draw. */
static inline void cs_draw_all(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                               cs_vuint index, cs_vfloat *tuple)
{
    cs_draw(pattern, table, key, index, tuple);
    for (cs_u32 slot = CS_MAIN_SLOTS; slot < (cs_u32)CS_SLOT_COUNT; slot++)
        cs_put_slot(cs_draw_extra(pattern, table, key, index, slot), slot, tuple);
}

#include "../fp_contract_restore.h"

#endif
