/* Statistics of the depths in a pixel. */
#ifndef CS_BASE_DEPTH_H
#define CS_BASE_DEPTH_H

#include "clshear/device/dialect.h"

/* Camera depths in a pixel, in world units, and a shear. A depth is infinite if the rays hit
 * nothing. */
typedef struct cs_depth {
    cs_f32 centre;   /* along the ray through the middles of pixel and lens */
    cs_f32 near;     /* smallest depth along the pixel's lens rays */
    cs_f32 median;   /* median depth along the lens rays */
    cs_f32 far;      /* largest depth along the lens rays */
    cs_f32 misses;   /* fraction of the lens rays without a hit, 0 to 1 */
    cs_f32 front_px; /* mean shear of the depths before the first gap (cs_front_shear), in pixels;
                        infinite without a gap */
} cs_depth;

#endif
