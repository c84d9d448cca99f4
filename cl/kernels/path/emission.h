/* What the rays of paths find that shines. Device only. */
#ifndef CS_PATH_EMISSION_H
#define CS_PATH_EMISSION_H

#include "kernels/path/state.h"

/* Lanes whose emission reaches more than the camera. */
static inline cs_vint cs_shines_on_surfaces(const cs_surface *surface)
{
#if CS_HAS(MATERIALS)
    return surface->shines_to != (cs_vint)(CS_SHINES_CAMERA);
#else
    (void)surface;
    return (cs_vint)(-1);
#endif
}

/* Adds what surfaces emit towards the path. */
static inline void cs_path_add_emission(const cs_scene_buffers *scene, cs_paths *paths,
                                        const cs_path *path, const cs_surface *surface,
                                        cs_vfloat distance)
{
    cs_vint shines = surface->hit & (cs_luminance(surface->emission) > 0.0f);
    if (paths->depth > 0u) shines = shines & cs_shines_on_surfaces(surface);
    if (!cs_any(shines)) return;
    cs_vfloat weight = (cs_vfloat)(1.0f);
    if (paths->depth > 0u) {
#if CS_HAS(EMITTERS)
        cs_vfloat density = cs_emitters_density(scene, &path->left, surface);
        (void)distance;
#else
        cs_vfloat density =
            cs_emitter_density(scene, paths->launch->lights, surface, &path->ray, distance);
#endif
        weight = cs_power_weight(path->density, density);
    }
    cs_path_add(paths, path, shines ? weight : (cs_vfloat)(0.0f), surface->emission);
}

#if CS_HAS(LIGHTS)
/* Returns the lanes whose rays find light number `i`: a shape that they hit, or, where they hit
 * nothing, an environment or a sun. The camera does not see suns. found: the light's radiance and
 * density in these lanes; it is not set if there are none. */
static inline cs_vint cs_path_escape(const cs_scene_buffers *scene, const cs_path *path,
                                     const cs_hit *hit, cs_u32 i, int from_camera,
                                     cs_escaped *found)
{
    CS_GLOBAL const cs_light *light = scene->lights + i;
    cs_vint escaped = path->alive & (hit->triangle == (cs_vint)(CS_NO_HIT));
    if (cs_is_shape(light)) {
        escaped = path->alive & (hit->triangle == (cs_vint)(cs_shape_hit(i)));
        if (cs_any(escaped)) *found = cs_escape_to_shape(light, &path->ray);
    } else if (light->kind == CS_LIGHT_ENVIRONMENT)
        *found = cs_escape_to_environment(scene, light, &path->ray, path->cosine, path->facing,
                                          !from_camera);
    else if (light->kind == CS_LIGHT_SUN && !from_camera)
        *found = cs_escape_to_sun(light, &path->ray);
    else
        escaped = (cs_vint)(0);
    return escaped;
}

/* Adds the radiance of the lights that the paths' rays find. */
static inline void cs_path_add_escaped(const cs_scene_buffers *scene, cs_paths *paths,
                                       const cs_path *path, const cs_hit *hit)
{
    const int from_camera = paths->depth == 0u;
    if (!cs_any(path->alive & (hit->triangle < 0))) return;
    for (cs_u32 i = 0u; i < paths->launch->lights; i++) {
        cs_escaped found;
        cs_vint escaped = cs_path_escape(scene, path, hit, i, from_camera, &found);
        if (!cs_any(escaped)) continue;
        cs_vfloat weight = (cs_vfloat)(1.0f);
        if (!from_camera) weight = cs_power_weight(path->density, found.density);
        cs_path_add(paths, path, escaped ? weight : (cs_vfloat)(0.0f), found.colour);
    }
}
#endif

#endif
