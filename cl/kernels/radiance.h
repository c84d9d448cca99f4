/* The radiance along a packet of rays. Device only.
 *
 * Two-sided surfaces; direct light with shadow rays; emission seen directly counts. */
#ifndef CS_RADIANCE_H
#define CS_RADIANCE_H

#include "kernels/bsdf/bsdf.h"
#include "kernels/found.h"
#include "kernels/hits.h"
#include "kernels/light/escaped.h"

/* Adds what a light reflects from the surface that is in view. The shadow ray begins at `origin`,
 * off the surface, and ends where `light->towards` does: what the light gives does not shift.
 * lights: their number. */
static inline void cs_add_light(const cs_scene_buffers *scene, cs_u32 lights,
                                const cs_bsdf_view *view, const cs_vfloat *origin,
                                const cs_light_sample *light, cs_radiance *radiance)
{
    const cs_surface *surface = view->surface;
    cs_vint facing =
        surface->hit & (light->weight > 0.0f) & (cs_dot(surface->outward, light->towards) > 0.0f);
    if (!cs_any(facing)) return;
    cs_ray shadow;
    for (int axis = 0; axis < 3; axis++) {
        shadow.origin[axis] = origin[axis];
        shadow.direction[axis] = light->towards[axis];
        if (light->reach < INFINITY) shadow.direction[axis] += surface->point[axis] - origin[axis];
    }
    cs_hit blocked;
    blocked.distance = facing ? (cs_vfloat)(light->reach) : (cs_vfloat)(-1.0f);
    cs_traverse(scene, &shadow, 1, &blocked);
#if CS_HAS(LIGHTS)
    cs_meet_shapes(scene, lights, &shadow, 1, &blocked);
#else
    (void)lights;
#endif
    cs_bsdf_value bsdf = cs_bsdf_eval(view, light->towards);
    cs_vfloat weight = blocked.distance > 0.0f ? light->weight * bsdf.scale : (cs_vfloat)(0.0f);
    for (int c = 0; c < 3; c++)
        cs_radiance_add(radiance, 1u, c, weight * light->colour[c] * bsdf.colour[c]);
    radiance->shadow_rays += facing ? (cs_vfloat)(1.0f) : (cs_vfloat)(0.0f);
}

#if CS_HAS(LIGHTS)
/* Adds the lights, of `lights`, that the camera's rays see: shapes that they met and, in the lanes
 * in `active`, the environment. */
static inline void cs_add_escaped(const cs_scene_buffers *scene, cs_u32 lights, const cs_ray *ray,
                                  const cs_hit *hit, cs_vint active, cs_radiance *radiance)
{
    if (!cs_any(active & (hit->triangle < 0))) return;
    for (cs_u32 i = 0u; i < lights; i++) {
        CS_GLOBAL const cs_light *light = scene->lights + i;
        cs_vint sees = active & (hit->triangle == (cs_vint)(CS_NO_HIT));
        cs_escaped found;
        if (light->kind == CS_LIGHT_ENVIRONMENT) {
            found = cs_escape_to_environment(scene, light, ray, (cs_vfloat)(0.0f), (cs_vint)(0), 0);
        } else if (cs_is_shape(light)) {
            sees = hit->triangle == (cs_vint)(cs_shape_hit(i));
            found = cs_escape_to_shape(light, ray);
        } else {
            continue;
        }
        for (int c = 0; c < 3; c++)
            cs_radiance_add(radiance, 0u, c, sees ? found.colour[c] : (cs_vfloat)(0.0f));
    }
}
#endif

/* Radiance that arrives at the lens along each ray. lights: their number. light_pair: the tuple's
 * pair for area lights. */
static inline cs_radiance cs_radiance_along(const cs_scene_buffers *scene, cs_u32 lights,
                                            const cs_ray *ray, cs_pair light_pair, cs_vint active)
{
    cs_hit hit;
    hit.distance = active ? (cs_vfloat)(INFINITY) : (cs_vfloat)(-1.0f);
    cs_traverse(scene, ray, 0, &hit);
    cs_radiance radiance = cs_radiance_begin();
#if CS_HAS(LIGHTS)
    cs_meet_shapes(scene, lights, ray, 0, &hit);
    cs_add_escaped(scene, lights, ray, &hit, active, &radiance);
    cs_note_shapes(scene, lights, ray, &hit, &radiance);
#endif
    cs_vint seen = hit.triangle >= 0;
    if (!cs_any(seen)) return radiance;
    hit.distance = seen ? hit.distance : (cs_vfloat)(0.0f);
    cs_surface surface = cs_describe_hits(scene, ray, &hit);
    cs_vfloat origin[3], out[3];
    cs_leave_surface(&surface, hit.distance, origin);
    cs_note_surface(&surface, &radiance);
    for (int i = 0; i < 3; i++) {
        cs_radiance_add(&radiance, 0u, i, surface.emission[i]);
        out[i] = -ray->direction[i];
    }
    cs_bsdf_view view = cs_bsdf_view_of(&surface, out);
    for (cs_u32 i = 0u; i < lights; i++) {
        cs_light_sample light = cs_sample_light(scene, scene->lights + i, &surface, light_pair);
        cs_add_light(scene, lights, &view, origin, &light, &radiance);
    }
    return radiance;
}

#endif
