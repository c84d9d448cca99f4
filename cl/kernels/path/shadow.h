/* The light that lights' own samples bring to paths. Device only. */
#ifndef CS_PATH_SHADOW_H
#define CS_PATH_SHADOW_H

#include "kernels/path/next_surface.h"

#if CS_HAS(MATERIALS)
/* As cs_path_shadow, past surfaces that let the ray pass. */
static inline void cs_shadow_through(const cs_scene_buffers *scene, const cs_paths *paths,
                                     const cs_path *path, cs_u32 number, cs_ray *ray, cs_hit *hit)
{
    cs_vfloat left = hit->distance; /* to go; negative: blocked or not wanted */
    for (cs_u32 n = 0u; n < (cs_u32)CS_MOST_PASSED; n++) {
        cs_surface surface;
        cs_vfloat origin[3], from[3];
        hit->distance = left;
        cs_vint seen = cs_find_surfaces(scene, paths->launch->lights, ray, hit, &surface);
        left = hit->triangle < (cs_vint)(CS_NO_HIT) ? (cs_vfloat)(-1.0f) : left;
        if (!cs_any(seen)) break;
        cs_vint passes = cs_passes(&surface, cs_passing_key(paths, number + 1u, n), path->index);
        cs_vfloat rest =
            passes ? cs_max(left - hit->distance, (cs_vfloat)(1e-20f)) : (cs_vfloat)(-1.0f);
        left = seen ? rest : left;
        cs_leave_surface(&surface, hit->distance, origin);
        cs_leave_towards(&surface, origin, ray->direction, from);
        for (int i = 0; i < 3; i++)
            ray->origin[i] = passes ? from[i] : ray->origin[i];
    }
    hit->distance = left;
}
#endif

/* Makes hit->distance negative in the lanes where something is in the way. number: of the light. */
static inline void cs_path_shadow(const cs_scene_buffers *scene, const cs_paths *paths,
                                  const cs_path *path, cs_u32 number, cs_ray *ray, cs_hit *hit)
{
#if CS_HAS(MATERIALS)
    if (paths->launch->see_through) {
        cs_shadow_through(scene, paths, path, number, ray, hit);
        return;
    }
#endif
    (void)path;
    (void)number;
    cs_traverse(scene, ray, 1, hit);
#if CS_HAS(LIGHTS)
    cs_meet_shapes(scene, paths->launch->lights, ray, 1, hit);
#else
    (void)paths;
#endif
}

/* Adds what light number `number` reflects towards the path, as cs_add_light does for direct light
 * alone. */
static inline void cs_path_add_light(const cs_scene_buffers *scene, cs_paths *paths,
                                     const cs_path *path, const cs_bsdf_view *view,
                                     const cs_vfloat *origin, const cs_light_sample *light,
                                     cs_u32 number)
{
    const cs_surface *surface = view->surface;
    cs_vint facing = cs_is_open(surface, light->towards) & (light->weight != 0.0f);
    if (!cs_any(facing)) return;
    cs_ray shadow;
    cs_leave_towards(surface, origin, light->towards, shadow.origin);
    for (int axis = 0; axis < 3; axis++) {
        shadow.direction[axis] = light->towards[axis];
        if (light->reach < INFINITY)
            shadow.direction[axis] += surface->point[axis] - shadow.origin[axis];
    }
    cs_hit blocked;
    blocked.distance = facing ? (cs_vfloat)(light->reach) : (cs_vfloat)(-1.0f);
    cs_path_shadow(scene, paths, path, number, &shadow, &blocked);
    cs_bsdf_value bsdf = cs_bsdf_eval(view, light->towards);
    /* Lights that no direction finds have density 0: their sample counts whole. */
    cs_vfloat share =
        light->density > 0.0f ? cs_power_weight(light->density, bsdf.density) : (cs_vfloat)(1.0f);
    cs_vfloat weight =
        blocked.distance > 0.0f ? fabs(light->weight) * bsdf.scale * share : (cs_vfloat)(0.0f);
    cs_vfloat colour[3];
    for (int c = 0; c < 3; c++)
        colour[c] = light->colour[c] * bsdf.colour[c];
    cs_path_add(paths, path, paths->depth + 1u, weight, colour);
    paths->rays += facing ? (cs_vfloat)(1.0f) : (cs_vfloat)(0.0f);
}

#endif
