/* Uniform directions of a cone, given by one less the cosine of its half angle: `fall`, above 0, at
 * most 2. Device only. */
#ifndef CS_LIGHT_CONE_H
#define CS_LIGHT_CONE_H

#include "clshear/device/disk.h"
#include "kernels/light/sample.h"

/* A uniform point of the unit disk from one of the unit square. */
static inline void cs_unit_disk(cs_pair pair, cs_vfloat *x, cs_vfloat *y)
{
    *x = pair.x - 0.5f;
    *y = pair.y - 0.5f;
    cs_disk_from_square(x, y);
    *x /= CS_DISK_RADIUS;
    *y /= CS_DISK_RADIUS;
}

/* Per steradian. */
static inline cs_vfloat cs_cone_density(cs_vfloat fall)
{
    return 1.0f / (2.0f * CS_PI * fall);
}

/* A direction around the unit vector `axis`: 1 - cosine grows with the square of the disk's radius
 * (Shirley & Wang 1992). */
static inline void cs_draw_cone(const cs_vfloat *axis, cs_vfloat fall, cs_pair pair,
                                cs_vfloat *direction)
{
    cs_vfloat tangent[3];
    cs_unit_disk(pair, &tangent[0], &tangent[1]);
    cs_vfloat part = (tangent[0] * tangent[0] + tangent[1] * tangent[1]) * fall;
    cs_vfloat outward = sqrt(fall * (2.0f - part));
    tangent[0] *= outward;
    tangent[1] *= outward;
    tangent[2] = 1.0f - part;
    cs_from_local(axis, tangent, direction);
}

#endif
