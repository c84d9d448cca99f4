/* Lanes of a packet one by one, for what has no vector form: loads from places of their own.
 * Shared.
 *
 *     cs_float_each x;
 *     x.all = packet;
 *     for (int lane = 0; lane < CS_PACKET; lane++)
 *         CS_LANE(x) = table[(cs_u32)CS_LANE(x)]; */
#ifndef CS_KERNELS_LANES_H
#define CS_KERNELS_LANES_H

#include "clshear/device/packet.h"

#ifdef CS_DEVICE
#define CS_LANE(value) ((value).lane[lane])
typedef cs_float_lanes cs_float_each;
#else
#define CS_LANE(value) ((value).all)
typedef struct cs_float_each {
    cs_vfloat all;
} cs_float_each;
#endif

#endif
