/* Lights that shine from one point or one direction. Device only. */
#ifndef CS_LIGHT_DELTA_H
#define CS_LIGHT_DELTA_H

#include "kernels/light/sample.h"

/* colour: radiant intensity. */
static inline cs_light_sample cs_sample_light_point(CS_GLOBAL const cs_light *light,
                                                    const cs_surface *surface)
{
    cs_light_sample sample;
    for (int axis = 0; axis < 3; axis++) {
        sample.towards[axis] = light->position[axis] - surface->point[axis];
        sample.colour[axis] = (cs_vfloat)(light->colour[axis]);
    }
    cs_vfloat cosine = cs_dot(surface->normal, sample.towards);
    cs_vfloat square = cs_max(cs_dot(sample.towards, sample.towards), (cs_vfloat)(1e-30f));
    sample.weight = cosine / (square * sqrt(square));
    sample.density = (cs_vfloat)(0.0f);
    sample.reach = 1.0f;
    return sample;
}

/* colour: irradiance of a surface that faces the light. */
static inline cs_light_sample cs_sample_light_directional(CS_GLOBAL const cs_light *light,
                                                          const cs_surface *surface)
{
    cs_light_sample sample;
    for (int axis = 0; axis < 3; axis++) {
        sample.towards[axis] = (cs_vfloat)(light->axis[axis]);
        sample.colour[axis] = (cs_vfloat)(light->colour[axis]);
    }
    sample.weight = cs_dot(surface->normal, sample.towards);
    sample.density = (cs_vfloat)(0.0f);
    sample.reach = INFINITY;
    return sample;
}

/* colour: radiant intensity within the inner cone. axis: unit, against the way it shines. The
 * square root of the part that is left falls linearly in the cosine of the angle from the axis
 * (Khronos, KHR_lights_punctual, "inner and outer cone angles"), and so in the squared distance of
 * the unit vectors, 2 - 2 cosine, which has digits where the cosine has none: parameters are scale
 * and offset from that. */
static inline cs_light_sample cs_sample_light_spot(CS_GLOBAL const cs_light *light,
                                                   const cs_surface *surface)
{
    cs_light_sample sample = cs_sample_light_point(light, surface);
    cs_vfloat square = cs_max(cs_dot(sample.towards, sample.towards), (cs_vfloat)(1e-30f));
    cs_vfloat unit = 1.0f / sqrt(square), apart = (cs_vfloat)(0.0f);
    for (int i = 0; i < 3; i++) {
        cs_vfloat step = sample.towards[i] * unit - light->axis[i];
        apart += step * step;
    }
    cs_vfloat inside = cs_clamp(light->parameters[1] - apart * light->parameters[0],
                                (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    sample.weight *= inside * inside;
    return sample;
}

#endif
