/* Spheres that shine evenly in all directions, inwards too. Device only.
 *
 * cs_light.position: the centre. colour: radiance. parameters: the radius. */
#ifndef CS_LIGHT_SPHERE_H
#define CS_LIGHT_SPHERE_H

#include "kernels/light/cone.h"
#include "kernels/light/shape_distance.h"

/* One less the cosine of the half angle of the sphere as seen from `point`; 2, for all directions,
 * from within. towards: from the point to the centre; square: its length squared. */
static inline cs_vfloat cs_sphere_fall(CS_GLOBAL const cs_light *light, const cs_vfloat *point,
                                       cs_vfloat *towards, cs_vfloat *square)
{
    for (int i = 0; i < 3; i++)
        towards[i] = light->position[i] - point[i];
    *square = cs_max(cs_dot(towards, towards), (cs_vfloat)(1e-30f));
    cs_vfloat sine_square = light->parameters[0] * light->parameters[0] / *square;
    cs_vfloat cosine = sqrt(cs_max(1.0f - sine_square, (cs_vfloat)(0.0f)));
    return sine_square < 1.0f ? sine_square / (1.0f + cosine) : (cs_vfloat)(2.0f);
}

/* Density, per steradian, with which cs_sample_light_sphere draws a direction that meets it. */
static inline cs_vfloat cs_sphere_density(CS_GLOBAL const cs_light *light, const cs_vfloat *point)
{
    cs_vfloat towards[3], square;
    return cs_cone_density(cs_sphere_fall(light, point, towards, &square));
}

/* Uniform over the directions that meet the sphere (Shirley, Wang & Zimmerman 1996). */
static inline cs_light_sample cs_sample_light_sphere(const cs_scene_buffers *scene,
                                                     CS_GLOBAL const cs_light *light,
                                                     const cs_surface *surface, cs_pair pair)
{
    cs_light_sample sample;
    cs_vfloat axis[3], square;
    (void)scene;
    cs_vfloat fall = cs_sphere_fall(light, surface->point, axis, &square);
    cs_vfloat inverse = 1.0f / sqrt(square);
    for (int i = 0; i < 3; i++)
        axis[i] *= inverse;
    cs_draw_cone(axis, fall, pair, sample.towards);
    cs_vfloat distance = cs_sphere_distance(light, surface->point, sample.towards);
    /* Rounding lets a few directions at the edge miss it: the tangent's length. */
    cs_vfloat radius = (cs_vfloat)(light->parameters[0]);
    cs_vfloat tangent = sqrt(fabs(square - radius * radius));
    distance = distance < INFINITY ? distance : tangent;
    sample.density = cs_cone_density(fall);
    sample.weight = cs_dot(surface->normal, sample.towards) / sample.density;
    for (int i = 0; i < 3; i++) {
        sample.towards[i] *= distance;
        sample.colour[i] = (cs_vfloat)(light->colour[i]);
    }
    sample.reach = 0.9999f;
    return sample;
}

#endif
