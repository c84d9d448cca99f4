/* Parallelograms that shine evenly from one side, the one from which their edges turn against the
 * clock; the other side is black. Device only.
 *
 * cs_light.position: a corner. axis, parameters 0 to 2: the edges from it. parameters 3: the area.
 * colour: radiance. */
#ifndef CS_LIGHT_QUAD_H
#define CS_LIGHT_QUAD_H

#include "kernels/light/sample.h"

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

/* Density, per steradian, of a uniform point of the quad, which is `towards` away. facing: see
 * cs_quad_facing; 0 or less: a large number, since nothing shines there. */
static inline cs_vfloat cs_quad_density(CS_GLOBAL const cs_light *light, const cs_vfloat *towards,
                                        cs_vfloat facing)
{
    cs_vfloat square = cs_max(cs_dot(towards, towards), (cs_vfloat)(1e-30f));
    return square * sqrt(square) / (light->parameters[3] * cs_max(facing, (cs_vfloat)(1e-20f)));
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

/* A uniform point. */
static inline cs_light_sample cs_sample_light_quad(const cs_scene_buffers *scene,
                                                   CS_GLOBAL const cs_light *light,
                                                   const cs_surface *surface, cs_pair pair)
{
    cs_light_sample sample;
    (void)scene;
    for (int i = 0; i < 3; i++) {
        cs_vfloat place =
            light->position[i] + pair.x * light->axis[i] + pair.y * light->parameters[i];
        sample.towards[i] = place - surface->point[i];
        sample.colour[i] = (cs_vfloat)(light->colour[i]);
    }
    cs_vfloat square = cs_max(cs_dot(sample.towards, sample.towards), (cs_vfloat)(1e-30f));
    cs_vfloat facing = cs_quad_facing(light, sample.towards);
    cs_vfloat cosines = cs_dot(surface->normal, sample.towards) * facing;
    sample.weight =
        facing > 0.0f ? cosines * light->parameters[3] / (square * square) : (cs_vfloat)(0.0f);
    sample.density = cs_quad_density(light, sample.towards, facing);
    sample.reach = 0.9999f;
    return sample;
}

#endif
