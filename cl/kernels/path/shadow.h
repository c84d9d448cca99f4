/* The light that rays to lights bring to paths. Device only.
 *
 * Rays to lights wait for those of other packets, and are traced in packets of one octant. */
#ifndef CS_PATH_SHADOW_H
#define CS_PATH_SHADOW_H

#include "kernels/light/suffice.h"
#include "kernels/path/emission.h"
#include "kernels/path/next_surface.h"
#include "kernels/path/sort.h"

#if CS_HAS(MATERIALS)
/* As cs_trace_shadow, past surfaces that let the ray pass. */
static inline void cs_shadow_through(const cs_scene_buffers *scene, const cs_paths *paths,
                                     const cs_shadow *shadow, cs_hit *hit)
{
    cs_ray ray = shadow->ray;
    cs_vfloat left = hit->distance; /* to go; negative: blocked or not wanted */
    for (cs_u32 n = 0u; n < (cs_u32)CS_MOST_PASSED; n++) {
        cs_surface surface;
        cs_vfloat origin[3], from[3];
        hit->distance = left;
        cs_vint seen = cs_find_surfaces(scene, paths->launch->lights, 0, &ray, hit, &surface);
        left = hit->triangle < (cs_vint)(CS_NO_HIT) ? (cs_vfloat)(-1.0f) : left;
        if (!cs_any(seen)) break;
        cs_vint passes = cs_passes(&surface, cs_passing_bits(shadow->passing, n));
        cs_vfloat rest =
            passes ? cs_max(left - hit->distance, (cs_vfloat)(1e-20f)) : (cs_vfloat)(-1.0f);
        left = seen ? rest : left;
        cs_leave_surface(&surface, hit->distance, origin);
        cs_leave_towards(&surface, origin, ray.direction, from);
        for (int i = 0; i < 3; i++)
            ray.origin[i] = passes ? from[i] : ray.origin[i];
    }
    hit->distance = left;
}
#endif

/* Makes hit->distance negative in the lanes where something is in the way. */
static inline void cs_trace_shadow(const cs_scene_buffers *scene, const cs_paths *paths,
                                   const cs_shadow *shadow, cs_hit *hit)
{
#if CS_HAS(MATERIALS)
    if (paths->launch->see_through) {
        cs_shadow_through(scene, paths, shadow, hit);
        return;
    }
#endif
    cs_traverse_either(scene, &shadow->ray, 1, hit);
#if CS_HAS(LIGHTS)
    cs_meet_shapes(scene, paths->launch->lights, &shadow->ray, 1, hit);
#else
    (void)paths;
#endif
}

/* Traces the rays to lights that wait, and adds the light of those that arrive. */
static inline void cs_trace_shadows(const cs_scene_buffers *scene, cs_paths *paths)
{
#if CS_PACKET > 1
    if (paths->shadows > 1) cs_sort_shadows(paths);
#endif
    for (int p = 0; p < paths->shadows; p++) {
        const cs_shadow *shadow = paths->shadow + p;
        cs_scene_buffers at = *scene;
        cs_hit hit;
#if CS_HAS(MOVING)
        at.time = shadow->time;
#endif
        hit.distance = shadow->reach;
        cs_trace_shadow(&at, paths, shadow, &hit);
        cs_samples_add(paths, shadow->home, paths->depth + 1u, hit.distance > 0.0f, shadow->light);
    }
    paths->shadows = 0;
}

/* Puts the packet of shadow rays at the end of the queue into it, and traces the queue when it is
 * full. The caller has set the packet's ray and light. wanted: lanes that have a ray. reach:
 * lengths of their directions. number: of the light; the number of lights for last rays. */
static inline void cs_path_wait(const cs_scene_buffers *scene, cs_paths *paths, const cs_path *path,
                                cs_u32 number, cs_vint wanted, cs_vfloat reach)
{
    cs_shadow *shadow = paths->shadow + paths->shadows;
    shadow->reach = wanted ? reach : (cs_vfloat)(-1.0f);
    shadow->home = path->home;
#if CS_HAS(MATERIALS)
    shadow->passing = cs_passing(paths, number + 1u, path);
#endif
#if CS_HAS(MOVING)
    shadow->time = path->time;
#endif
    paths->shadow_light[paths->shadows] = number;
    paths->rays += wanted ? (cs_vfloat)(1.0f) : (cs_vfloat)(0.0f);
    paths->shadows++;
    if (paths->shadows == CS_SHADOWS) cs_trace_shadows(scene, paths);
}

/* Lets what light number `number` reflects towards the path wait for its shadow rays, as
 * cs_add_light adds it for direct light alone. alone: lanes in which the light's samples have the
 * whole weight, since no ray of the BSDF follows. */
static inline void cs_path_add_light(const cs_scene_buffers *scene, cs_paths *paths,
                                     const cs_path *path, const cs_bsdf_view *view,
                                     const cs_vfloat *origin, const cs_light_sample *light,
                                     cs_u32 number, cs_vint alone)
{
    const cs_surface *surface = view->surface;
    cs_vint facing = cs_is_open(surface, light->towards) & (light->weight != 0.0f);
    if (!cs_any(facing)) return;
    cs_shadow *shadow = paths->shadow + paths->shadows;
    cs_bsdf_value bsdf = cs_bsdf_eval(view, light->towards);
    /* Lights that no direction finds have density 0: their sample counts whole. */
    cs_vint shares = (light->density > 0.0f) & ~alone;
    cs_vfloat share = shares ? cs_power_weight(light->density, bsdf.density) : (cs_vfloat)(1.0f);
    cs_vfloat colour[3];
    for (int c = 0; c < 3; c++)
        colour[c] = light->colour[c] * bsdf.colour[c];
    /* Where a polished surface leaves the sample no weight, its value may be infinite. */
    cs_vfloat weight = fabs(light->weight) * bsdf.scale * share;
    cs_path_carry(paths, path, paths->depth + 1u, weight, colour, shadow->light);
    cs_leave_towards(surface, origin, light->towards, shadow->ray.origin);
    for (int axis = 0; axis < 3; axis++) {
        cs_vfloat apart = light->reach < INFINITY ? surface->point[axis] - shadow->ray.origin[axis]
                                                  : (cs_vfloat)(0.0f);
        shadow->ray.direction[axis] = light->towards[axis] + apart;
    }
    cs_path_wait(scene, paths, path, number, facing & (weight > 0.0f), (cs_vfloat)(light->reach));
}

#if CS_HAS(LIGHTS)
/* Queues the paths' last rays as shadow rays. A last ray only finds lights. Where no surface shines
 * (launch.dark), the light at which it would end is computed without tracing; the shadow ray only
 * tests whether something is in the way. Rays that would find no light are not traced. */
static inline void cs_path_seek_lights(const cs_scene_buffers *scene, cs_paths *paths,
                                       const cs_path *path)
{
    const cs_u32 lights = paths->launch->lights;
    cs_shadow *shadow = paths->shadow + paths->shadows;
    cs_hit end;
    if (!cs_any(path->alive)) return;
    end.distance = path->alive ? (cs_vfloat)(INFINITY) : (cs_vfloat)(-1.0f);
    end.triangle = (cs_vint)(CS_NO_HIT);
    cs_meet_shapes(scene, lights, &path->ray, 0, &end);
    for (int c = 0; c < 3; c++)
        shadow->light[c] = (cs_vfloat)(0.0f);
    for (cs_u32 i = 0u; i < lights; i++) {
        cs_escaped found;
        cs_vfloat light[3];
        cs_vint escaped = cs_path_escape(scene, path, &end, i, 0, &found);
        if (!cs_any(escaped)) continue;
        cs_vfloat weight = cs_power_weight(path->density, found.density);
        cs_path_carry(paths, path, paths->depth + 1u, weight, found.colour, light);
        for (int c = 0; c < 3; c++)
            shadow->light[c] += escaped ? light[c] : (cs_vfloat)(0.0f);
    }
    cs_vint wanted = shadow->light[0] + shadow->light[1] + shadow->light[2] > 0.0f;
    if (!cs_any(wanted)) return;
    shadow->ray = path->ray;
    /* Shorter by the rounding of distances: a shape must not hide itself. */
    cs_path_wait(scene, paths, path, lights, wanted, 0.9999f * end.distance);
}
#endif

#endif
