/* What is known of the depths that a pixel sees. */
#ifndef CS_BASE_DEPTH_H
#define CS_BASE_DEPTH_H

#include "clshear/device/dialect.h"

/* What a pixel sees, as camera depths; infinite where that is nothing. */
typedef struct cs_depth {
    cs_f32 centre; /* through the pixel's centre and the lens's */
    cs_f32 near;   /* the nearest, median and farthest hit of rays all over pixel and lens */
    cs_f32 median;
    cs_f32 far;
    cs_f32 misses; /* fraction of those rays that see nothing */
} cs_depth;

#endif
