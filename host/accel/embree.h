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

/* Gives the nodes the bounds of their triangles where the shutter opens, and fills in the steps of
 * nodes and triangles. */
clshear_status cs_flat_bvh_refit(const cs_scene *scene, cs_flat_bvh *bvh, cs_error *error);

#endif
