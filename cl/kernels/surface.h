/* What a packet of rays hit, as lights and BSDFs see it. Shared. */
#ifndef CS_SURFACE_H
#define CS_SURFACE_H

#include "clshear/device/packet.h"
#include "kernels/features.h"
#include "kernels/scene.h"

/* Who finds what a surface emits. */
enum {
    CS_SHINES_SAMPLED, /* the samples of its light, and rays */
    CS_SHINES_RAYS,    /* rays that happen to hit it; with the feature EMITTERS samples too */
    CS_SHINES_CAMERA   /* rays of the camera */
};

typedef struct cs_surface {
    cs_vint hit; /* lanes that hit anything; the others hold zeros */
    cs_vfloat point[3];
    cs_vfloat outward[3]; /* unit geometric normal on the viewer's side */
    cs_vfloat normal[3];  /* unit shading normal on the viewer's side */
    cs_vfloat albedo[3];
    cs_vfloat emission[3];
#if CS_HAS(EMITTERS)
    cs_vint emitter; /* number from 1 on, or 0 */
#endif
#if CS_HAS(MATERIALS)
    cs_vint bsdf;                                 /* CS_BSDF_ kind */
    cs_vfloat parameters[CS_MATERIAL_PARAMETERS]; /* of the material, for its BSDF */
    cs_vfloat alpha;                              /* chance that a ray does not pass */
    cs_vint inside;    /* lanes that came from behind: the triangle's normal points away */
    cs_vint shines_to; /* CS_SHINES_ */
    CS_GLOBAL const cs_f32 *albedos; /* see cs_albedo_at */
#endif
} cs_surface;

/* Turns a vector whose third axis is the unit vector `normal` into world space; the other axes are
 * any that make a right-handed frame (Duff et al. 2017). */
static inline void cs_from_local(const cs_vfloat *normal, const cs_vfloat *tangent,
                                 cs_vfloat *world)
{
    cs_vfloat sign = normal[2] < 0.0f ? (cs_vfloat)(-1.0f) : (cs_vfloat)(1.0f);
    cs_vfloat a = -1.0f / (sign + normal[2]);
    cs_vfloat b = normal[0] * normal[1] * a;
    world[0] = tangent[0] * (1.0f + sign * normal[0] * normal[0] * a) + tangent[1] * b +
               tangent[2] * normal[0];
    world[1] = tangent[0] * (sign * b) + tangent[1] * (sign + normal[1] * normal[1] * a) +
               tangent[2] * normal[1];
    world[2] = tangent[2] * normal[2] - tangent[0] * (sign * normal[0]) - tangent[1] * normal[1];
}

#endif
