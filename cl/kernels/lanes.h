/* Loads from a place of its own in each lane, which have no vector form. Shared.
 *
 * Everything around them, places and weights, is computed for all lanes at once. */
#ifndef CS_KERNELS_LANES_H
#define CS_KERNELS_LANES_H

#include "clshear/device/packet.h"

/* Integer parts of floats in [0, 2^31), as signed integers. */
static inline cs_vint cs_whole(cs_vfloat x)
{
    return cs_as_vint(cs_to_vuint(x));
}

#ifdef CS_DEVICE

static inline cs_vfloat cs_from_whole(cs_vint x)
{
    return CS_OVER_LANES(convert_float)(x);
}

/* table[index] in each lane. */
static inline cs_vfloat cs_gather(CS_GLOBAL const cs_f32 *table, cs_vint index)
{
    cs_int_lanes place;
    cs_float_lanes found;
    place.all = index;
    for (int lane = 0; lane < CS_PACKET; lane++)
        found.lane[lane] = table[place.lane[lane]];
    return found.all;
}

/* Four neighbours from table[first] on and four from table[second] on, blended linearly: `part` is
 * the weight of the second ones, 0 to 1. */
static inline void cs_blend_four(CS_GLOBAL const cs_f32 *table, cs_vint first, cs_vint second,
                                 cs_vfloat part, cs_vfloat *found)
{
    cs_int_lanes one, other;
    cs_float_lanes weight, blended[4];
    one.all = first;
    other.all = second;
    weight.all = part;
    for (int lane = 0; lane < CS_PACKET; lane++) {
        float4 value = vload4(0, table + one.lane[lane]);
        value += weight.lane[lane] * (vload4(0, table + other.lane[lane]) - value);
        blended[0].lane[lane] = value.x;
        blended[1].lane[lane] = value.y;
        blended[2].lane[lane] = value.z;
        blended[3].lane[lane] = value.w;
    }
    for (int i = 0; i < 4; i++)
        found[i] = blended[i].all;
}

#else

static inline cs_vfloat cs_from_whole(cs_vint x)
{
    return (cs_vfloat)x;
}

static inline cs_vfloat cs_gather(const cs_f32 *table, cs_vint index)
{
    return table[index];
}

static inline void cs_blend_four(const cs_f32 *table, cs_vint first, cs_vint second, cs_vfloat part,
                                 cs_vfloat *found)
{
    for (cs_i32 i = 0; i < 4; i++)
        found[i] = table[first + i] + part * (table[second + i] - table[first + i]);
}

#endif

#endif
