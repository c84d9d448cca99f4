/* The shutter: which time a part of the exposure belongs to. */
#ifndef CLSHEAR_DEVICE_SHUTTER_H
#define CLSHEAR_DEVICE_SHUTTER_H

#include "packet.h"

#include "fp_contract_off.h"

/* How much light the shutter lets in over its time: it grows evenly while the shutter opens, stays,
 * and falls evenly while it closes; a trapezoid, or a box if both parts are 0. */
typedef struct cs_shutter {
    cs_f32 opening; /* part of the time, 0 to 1 */
    cs_f32 closing; /* likewise; both together at most 1 */
} cs_shutter;
CS_SHARED_WORDS(cs_shutter, 2);

/* The time, 0 to 1, before which the part `exposed` of the light has come in, 0 to 1. */
static inline cs_vfloat cs_shutter_time(cs_vfloat exposed, cs_shutter shutter)
{
    if (!(shutter.opening + shutter.closing > 0.0f)) return exposed;
    cs_f32 whole = 1.0f - 0.5f * (shutter.opening + shutter.closing); /* time that it lets in */
    cs_vfloat in = exposed * whole, left = whole - in;
    cs_vfloat first = cs_sqrt(2.0f * shutter.opening * in);
    cs_vfloat last = 1.0f - cs_sqrt(cs_max(2.0f * shutter.closing * left, (cs_vfloat)(0.0f)));
    cs_vfloat time = in + 0.5f * shutter.opening;
    time = in < 0.5f * shutter.opening ? first : time;
    return left < 0.5f * shutter.closing ? last : time;
}

#include "fp_contract_restore.h"

#endif
