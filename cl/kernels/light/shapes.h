/* Lights that rays can meet, and that hide what is behind them: spheres and quads. Device only. */
#ifndef CS_LIGHT_SHAPES_H
#define CS_LIGHT_SHAPES_H

#include "kernels/light/quad.h"
#include "kernels/light/sphere.h"
#include "kernels/traverse.h"

/* Stands in cs_hit.triangle where a ray met light number `index`. */
static inline cs_i32 cs_shape_hit(cs_u32 index)
{
    return CS_NO_HIT - 1 - (cs_i32)index;
}

static inline int cs_is_shape(CS_GLOBAL const cs_light *light)
{
    return light->kind == CS_LIGHT_SPHERE || light->kind == CS_LIGHT_QUAD;
}

static inline cs_vfloat cs_shape_distance(CS_GLOBAL const cs_light *light, const cs_ray *ray)
{
    return light->kind == CS_LIGHT_SPHERE ? cs_sphere_distance(light, ray->origin, ray->direction)
                                          : cs_quad_distance(light, ray->origin, ray->direction);
}

/* What cs_traverse did with the scene's triangles, with its lights. lights: their number. */
static inline void cs_meet_shapes(const cs_scene_buffers *scene, cs_u32 lights, const cs_ray *ray,
                                  const int any_hit, cs_hit *hit)
{
    for (cs_u32 i = 0u; i < lights; i++) {
        CS_GLOBAL const cs_light *light = scene->lights + i;
        if (!cs_is_shape(light)) continue;
        cs_vfloat distance = cs_shape_distance(light, ray);
        cs_vint nearer = distance < hit->distance;
        if (any_hit) {
            hit->distance = nearer ? (cs_vfloat)(-1.0f) : hit->distance;
        } else {
            hit->distance = nearer ? distance : hit->distance;
            hit->triangle = nearer ? (cs_vint)(cs_shape_hit(i)) : hit->triangle;
        }
    }
}

#endif
