/* The light that rays find which were drawn from a BSDF, and with what density the lights' own
 * samples would have found it. Device only. */
#ifndef CS_LIGHT_ESCAPED_H
#define CS_LIGHT_ESCAPED_H

#include "kernels/light/light.h"

/* Density, per steradian, with which the light of emissive triangles draws the point that a ray
 * hit: cs_scene_emitters makes it proportional to luminance. */
static inline cs_vfloat cs_emitter_density(const cs_scene_buffers *scene, cs_u32 lights,
                                           const cs_surface *surface, const cs_ray *ray,
                                           cs_vfloat distance)
{
    cs_f32 per_power = 0.0f;
    for (cs_u32 i = 0u; i < lights; i++)
        if (scene->lights[i].kind == CS_LIGHT_TRIANGLES) per_power = scene->lights[i].parameters[0];
    cs_vfloat square = cs_dot(ray->direction, ray->direction) * distance * distance;
    cs_vfloat cosine = fabs(cs_dot(surface->outward, ray->direction)) /
                       sqrt(cs_dot(ray->direction, ray->direction));
    return per_power * cs_luminance(surface->emission) * square /
           cs_max(cosine, (cs_vfloat)(1e-20f));
}

#endif
