/* Inside of cs_accel, for the files of this folder. */
#ifndef CS_ACCEL_EMBREE_H
#define CS_ACCEL_EMBREE_H

#include <embree3/rtcore.h>

#include "accel/accel.h"

struct cs_accel {
    const cs_scene *scene;
    RTCDevice device;
    RTCScene traced;
    int threads;
    cs_error *error; /* while a build runs: where Embree's errors go */
    int failed;
};

#endif
