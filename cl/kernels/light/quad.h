/* Parallelograms that shine evenly from one side, the one from which their edges turn against the
 * clock; the other side is black. Device only.
 *
 * cs_light.position: a corner. axis, parameters 0 to 2: the edges from it. parameters 3: the area.
 * colour: radiance. */
#ifndef CS_LIGHT_QUAD_H
#define CS_LIGHT_QUAD_H

#include "kernels/light/sample.h"
#include "kernels/light/shape_distance.h"

/* Density, per steradian, of a uniform point of the quad, which is `towards` away. facing: see
 * cs_quad_facing; 0 or less: a large number, since nothing shines there. */
static inline cs_vfloat cs_quad_density(CS_GLOBAL const cs_light *light, const cs_vfloat *towards,
                                        cs_vfloat facing)
{
    cs_vfloat square = cs_max(cs_dot(towards, towards), (cs_vfloat)(1e-30f));
    return square * sqrt(square) / (light->parameters[3] * cs_max(facing, (cs_vfloat)(1e-20f)));
}

/* A lower bound, per steradian, of cs_quad_density at `point` over all places of the quad. It takes
 * the least distance of a sphere around the quad, and the quad as facing the point. */
static inline cs_vfloat cs_quad_least_density(CS_GLOBAL const cs_light *light,
                                              const cs_vfloat *point)
{
    cs_f32 sum = 0.0f, difference = 0.0f;
    cs_vfloat towards[3];
    for (int i = 0; i < 3; i++) {
        cs_f32 one = light->axis[i], other = light->parameters[i];
        sum += (one + other) * (one + other);
        difference += (one - other) * (one - other);
        towards[i] = light->position[i] + 0.5f * (one + other) - point[i];
    }
    cs_f32 radius = 0.5f * sqrt(sum > difference ? sum : difference);
    cs_vfloat near = cs_max(sqrt(cs_dot(towards, towards)) - radius, (cs_vfloat)(0.0f));
    return near * near / light->parameters[3];
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
