/* Lights that rays can meet, and that hide what is behind them: spheres and quads. Device only. */
#ifndef CS_LIGHT_SHAPES_H
#define CS_LIGHT_SHAPES_H

#include "kernels/found.h"
#include "kernels/light/quad.h"
#include "kernels/light/sphere.h"
#include "kernels/traverse.h"

/* Stands in cs_hit.triangle where a ray met light number `index`. */
static inline cs_i32 cs_shape_hit(cs_u32 index)
{
    return CS_NO_HIT - 1 - (cs_i32)index;
}

/* The unit normal at a point of the shape: outwards, or on the side that shines. */
static inline void cs_shape_normal(CS_GLOBAL const cs_light *light, const cs_vfloat *point,
                                   cs_vfloat *normal)
{
    cs_f32 flat[3];
    if (light->kind == CS_LIGHT_QUAD) cs_quad_normal(light, flat);
    for (int i = 0; i < 3; i++)
        normal[i] = light->kind == CS_LIGHT_QUAD
                        ? (cs_vfloat)(flat[i])
                        : (point[i] - light->position[i]) / light->parameters[0];
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

/* Notes the lights, of `lights`, that the rays met: they reflect nothing, so that their albedo is
 * 0. */
static inline void cs_note_shapes(const cs_scene_buffers *scene, cs_u32 lights, const cs_ray *ray,
                                  const cs_hit *hit, cs_radiance *found)
{
#if CS_HAS(AOVS)
    for (cs_u32 i = 0u; i < lights; i++) {
        CS_GLOBAL const cs_light *light = scene->lights + i;
        cs_vint sees = hit->triangle == (cs_vint)(cs_shape_hit(i));
        if (!cs_is_shape(light) || !cs_any(sees)) continue;
        cs_vfloat point[3], normal[3], distance = cs_shape_distance(light, ray);
        for (int axis = 0; axis < 3; axis++)
            point[axis] = fma(ray->direction[axis], distance, ray->origin[axis]);
        cs_shape_normal(light, point, normal);
        cs_vfloat side =
            cs_dot(normal, ray->direction) > 0.0f ? (cs_vfloat)(-1.0f) : (cs_vfloat)(1.0f);
        for (int axis = 0; axis < 3; axis++) {
            cs_vfloat *noted = found->plane + CS_PLANE_NORMAL + axis;
            *noted = sees ? side * normal[axis] : *noted;
            noted = found->plane + CS_PLANE_POSITION + axis;
            *noted = sees ? point[axis] : *noted;
        }
        found->plane[CS_PLANE_COVERAGE] =
            sees ? (cs_vfloat)(1.0f) : found->plane[CS_PLANE_COVERAGE];
    }
#else
    (void)scene, (void)lights, (void)ray, (void)hit, (void)found;
#endif
}

#endif
