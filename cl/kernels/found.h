/* What a packet of samples finds: radiance, and with the feature AOVS the planes. Device only. */
#ifndef CS_KERNELS_FOUND_H
#define CS_KERNELS_FOUND_H

#include "kernels/aov.h"
#include "kernels/motion.h"
#include "kernels/surface.h"
#include "kernels/vector.h"

typedef struct cs_radiance {
    cs_vfloat channel[3];
    cs_vfloat shadow_rays; /* traced, a lane */
#if CS_HAS(AOVS)
    cs_vfloat plane[CS_PLANES]; /* 0 in lanes that see no surface */
#endif
} cs_radiance;

static inline cs_radiance cs_radiance_begin(void)
{
    cs_radiance found;
    found.shadow_rays = (cs_vfloat)(0.0f);
    for (int c = 0; c < 3; c++)
        found.channel[c] = (cs_vfloat)(0.0f);
#if CS_HAS(AOVS)
    for (int p = 0; p < CS_PLANES; p++)
        found.plane[p] = (cs_vfloat)(0.0f);
#endif
    return found;
}

/* Adds light to a colour. met: surfaces that it met on its way; 0 is emission, 1 direct light. */
static inline void cs_radiance_add(cs_radiance *found, cs_u32 met, int colour, cs_vfloat light)
{
    found->channel[colour] += light;
#if CS_HAS(AOVS)
    int first = met == 0u ? CS_PLANE_EMISSION : met == 1u ? CS_PLANE_DIRECT : CS_PLANE_INDIRECT;
    found->plane[first + colour] += light;
#else
    (void)met;
#endif
}

/* The same in one lane. */
static inline void cs_radiance_add_lane(cs_radiance *found, int lane, cs_u32 met, int colour,
                                        cs_f32 light)
{
    ((cs_f32 *)&found->channel[colour])[lane] += light;
#if CS_HAS(AOVS)
    int first = met == 0u ? CS_PLANE_EMISSION : met == 1u ? CS_PLANE_DIRECT : CS_PLANE_INDIRECT;
    ((cs_f32 *)&found->plane[first + colour])[lane] += light;
#else
    (void)met;
#endif
}

/* Keeps what the planes tell of the surfaces that are seen first; other lanes stay. */
static inline void cs_note_surface(const cs_surface *surface, cs_radiance *found)
{
#if CS_HAS(AOVS)
    for (int i = 0; i < 3; i++) {
        found->plane[CS_PLANE_ALBEDO + i] =
            surface->hit ? surface->albedo[i] : found->plane[CS_PLANE_ALBEDO + i];
        found->plane[CS_PLANE_NORMAL + i] =
            surface->hit ? surface->normal[i] : found->plane[CS_PLANE_NORMAL + i];
        found->plane[CS_PLANE_POSITION + i] =
            surface->hit ? surface->point[i] : found->plane[CS_PLANE_POSITION + i];
    }
    found->plane[CS_PLANE_COVERAGE] =
        surface->hit ? (cs_vfloat)(1.0f) : found->plane[CS_PLANE_COVERAGE];
#else
    (void)surface;
    (void)found;
#endif
}

/* Camera depth of the noted surfaces. */
static inline void cs_note_depth(const cs_eye *camera, cs_radiance *found)
{
#if CS_HAS(AOVS)
    cs_vfloat covered = found->plane[CS_PLANE_COVERAGE], depth = (cs_vfloat)(0.0f);
    for (int i = 0; i < 3; i++)
        depth +=
            (found->plane[CS_PLANE_POSITION + i] - covered * camera->eye[i]) * camera->forward[i];
    found->plane[CS_PLANE_DEPTH] = depth;
#else
    (void)camera;
    (void)found;
#endif
}

#endif
