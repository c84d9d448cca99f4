/* Where rays meet spheres and quads. Shared. */
#ifndef CS_LIGHT_SHAPE_DISTANCE_H
#define CS_LIGHT_SHAPE_DISTANCE_H

#include "clshear/device/camera.h"
#include "kernels/light/list.h"
#include "kernels/scene.h"
#include "kernels/vector.h"

/* Where rays first meet the sphere, in lengths of their direction; INFINITY where they do not. The
 * discriminant is taken from the centre's distance from the ray, which does not cancel (Haines et
 * al. 2019, Ray Tracing Gems, chapter 7). */
static inline cs_vfloat cs_sphere_distance(CS_GLOBAL const cs_light *light, const cs_vfloat *origin,
                                           const cs_vfloat *direction)
{
    cs_f32 radius = light->parameters[0];
    cs_vfloat towards[3], apart[3];
    for (int i = 0; i < 3; i++)
        towards[i] = light->position[i] - origin[i];
    cs_vfloat square = cs_dot(direction, direction);
    cs_vfloat middle = cs_dot(towards, direction) / square;
    for (int i = 0; i < 3; i++)
        apart[i] = towards[i] - middle * direction[i];
    cs_vfloat left = radius * radius - cs_dot(apart, apart);
    cs_vfloat half_chord = cs_sqrt(cs_max(left, (cs_vfloat)(0.0f)) / square);
    cs_vfloat outside = cs_dot(towards, towards) - radius * radius;
    /* The larger root by addition, the other by their product (Press et al., section 5.6). */
    cs_vfloat large = middle + (middle < 0.0f ? -half_chord : half_chord);
    cs_vfloat small = outside / (square * large);
    cs_vfloat near = cs_min(large, small), far = cs_max(large, small);
    cs_vfloat first = near > 0.0f ? near : far;
    cs_vint meets = (left > 0.0f) & (first > 0.0f);
    return meets ? first : (cs_vfloat)(INFINITY);
}

/* The unit normal on the side that shines. */
static inline void cs_quad_normal(CS_GLOBAL const cs_light *light, cs_f32 *normal)
{
    CS_GLOBAL const cs_f32 *e1 = light->axis;
    CS_GLOBAL const cs_f32 *e2 = light->parameters;
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        normal[i] = (e1[j] * e2[k] - e1[k] * e2[j]) / light->parameters[3];
    }
}

/* Lengths of a direction towards the side that shines, above 0 where it meets that side. */
static inline cs_vfloat cs_quad_facing(CS_GLOBAL const cs_light *light, const cs_vfloat *direction)
{
    cs_f32 normal[3];
    cs_quad_normal(light, normal);
    return -(direction[0] * normal[0] + direction[1] * normal[1] + direction[2] * normal[2]);
}

/* Where rays meet the quad, in lengths of their direction; INFINITY where they do not. By scaled
 * barycentrics, as cs_hit_triangle has them. */
static inline cs_vfloat cs_quad_distance(CS_GLOBAL const cs_light *light, const cs_vfloat *origin,
                                         const cs_vfloat *direction)
{
    CS_GLOBAL const cs_f32 *e1 = light->axis;
    CS_GLOBAL const cs_f32 *e2 = light->parameters;
    cs_f32 normal[3];
    cs_vfloat to[3], cross[3];
    cs_quad_normal(light, normal);
    for (int i = 0; i < 3; i++)
        to[i] = light->position[i] - origin[i];
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        cross[i] = to[j] * direction[k] - to[k] * direction[j];
    }
    cs_vfloat inverse = -1.0f / cs_quad_facing(light, direction);
    cs_vfloat per_area = inverse / light->parameters[3];
    cs_vfloat u = per_area * (cross[0] * e2[0] + cross[1] * e2[1] + cross[2] * e2[2]);
    cs_vfloat v = -per_area * (cross[0] * e1[0] + cross[1] * e1[1] + cross[2] * e1[2]);
    cs_vfloat distance = inverse * (normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2]);
    cs_vint inside = (u >= 0.0f) & (u <= 1.0f) & (v >= 0.0f) & (v <= 1.0f) & (distance > 0.0f);
    return inside ? distance : (cs_vfloat)(INFINITY);
}

static inline int cs_is_shape(CS_GLOBAL const cs_light *light)
{
    return light->kind == CS_LIGHT_SPHERE || light->kind == CS_LIGHT_QUAD;
}

/* As the two above, for either. */
static inline cs_vfloat cs_shape_distance(CS_GLOBAL const cs_light *light, const cs_ray *ray)
{
    return light->kind == CS_LIGHT_SPHERE ? cs_sphere_distance(light, ray->origin, ray->direction)
                                          : cs_quad_distance(light, ray->origin, ray->direction);
}

#endif
