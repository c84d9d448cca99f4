/* The time of a tuple: one coordinate more for what moves.
 *
 * Samplers that stratify film and lens together give the time their third coordinate; the place on
 * the fibre then has the fourth and one from beside, which for `sobol` is the fifth of the same
 * net. The others have pairs anyway, and the time is one more. */
#ifndef CLSHEAR_DEVICE_SAMPLER_TIME_H
#define CLSHEAR_DEVICE_SAMPLER_TIME_H

#include "../camera_sample.h"
#include "sampler.h"

#include "../fp_contract_off.h"

enum {
    CS_KEY_TIME = 0x74696d65 /* of the pair beside the tuple, apart from the keys of a pattern */
};

/* Whether the sampler stratifies film and lens together, not in pairs. */
static inline int cs_is_joint(cs_u32 sampler)
{
    return sampler == (cs_u32)CS_SAMPLER_SOBOL || sampler == (cs_u32)CS_SAMPLER_SZ ||
           sampler == (cs_u32)CS_SAMPLER_HALTON || sampler == (cs_u32)CS_SAMPLER_RANK1;
}

/* The time's number of a tuple, in [0, 1); the tuple's lens pair may change. key: of the pattern.
 * has_light: whether the slot of lights is taken; else the time may use its numbers. The other
 * parameters are those of cs_draw. */
static inline cs_vfloat cs_draw_time(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                     cs_vuint index, int has_light, cs_camera_sample *tuple)
{
    cs_pair beside;
    if (has_light)
        beside = cs_draw_padding(pattern, table, cs_key(key, CS_KEY_TIME), index, CS_SLOT_LIGHT);
    else
        beside = cs_draw_extra(pattern, table, key, index, CS_SLOT_LIGHT);
    if (!cs_is_joint(pattern->sampler)) return beside.x;
    cs_vfloat time = tuple->u;
    tuple->u = tuple->v;
    tuple->v = beside.x;
    return time;
}

#include "../fp_contract_restore.h"

#endif
