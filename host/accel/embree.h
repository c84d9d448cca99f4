/* The definition of cs_accel, private to this folder. */
#ifndef CS_ACCEL_EMBREE_H
#define CS_ACCEL_EMBREE_H

#include <embree3/rtcore.h>

#include "accel/accel.h"

struct cs_accel {
    const cs_scene *scene;
    RTCDevice device;
    RTCScene traced;
    int threads;
    cs_error *error; /* destination of Embree's errors during a build */
    int failed;
};

#endif
