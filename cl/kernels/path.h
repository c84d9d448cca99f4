/* The radiance along packets of rays, with the light that comes by way of several surfaces.
 * Device only.
 *
 * At every surface each light is sampled, and a direction of the BSDF is followed. What both can
 * find is weighted by the power heuristic (Veach 1997, section 9.2.4, exponent 2). Paths end by
 * Russian roulette (Arvo & Kirk 1990) or after launch.bounces surfaces. */
#ifndef CS_PATH_H
#define CS_PATH_H

#include "kernels/path/emission.h"
#include "kernels/path/scatter.h"
#include "kernels/path/shadow.h"

/* The points opposite in the unit square, by half its side along both axes. That takes the boxes of
 * a net to each other, so these points are as well stratified with the rest of their tuples. */
static inline cs_pair cs_opposite(cs_pair pair)
{
    pair.x += pair.x < 0.5f ? 0.5f : -0.5f;
    pair.y += pair.y < 0.5f ? 0.5f : -0.5f;
    return pair;
}

/* What a surface on a path draws. The first one has the tuple's own pair for lights and, opposite
 * of it, for the direction that goes on: what both find is added up, never multiplied. */
static inline cs_numbers cs_draw_numbers(const cs_paths *paths, int p)
{
    const cs_launch *launch = paths->launch;
    const cs_path *path = paths->path + p;
    const cs_draws draws = {&launch->pattern, paths->table, path->key, path->index};
    cs_numbers numbers;
    numbers.light = paths->light[p];
    if (paths->depth > 0u && launch->area_lights > 0u)
        numbers.light = cs_draw_at(&draws, paths->depth, CS_DRAW_LIGHT);
    if (paths->depth == 0u && paths->paired)
        numbers.bsdf = cs_opposite(numbers.light);
    else
        numbers.bsdf = cs_draw_at(&draws, paths->depth, CS_DRAW_BSDF);
    numbers.choice = cs_draw_at(&draws, paths->depth, CS_DRAW_CHOICE);
    return numbers;
}

/* Adds packet `p` of samples: camera rays in the lanes that are active. light: the tuple's pair for
 * area lights. */
static inline void cs_path_begin(cs_paths *paths, int p, const cs_ray *ray, cs_pair light,
                                 const cs_draws *draws, cs_vint active)
{
    cs_path *path = paths->path + p;
    path->ray = *ray;
    path->alive = active;
    path->home = p * CS_PACKET + cs_as_vint(CS_LANE_INDEX);
    path->key = draws->key;
    path->index = draws->index;
    path->density = (cs_vfloat)(0.0f);
    path->cosine = (cs_vfloat)(0.0f);
#if CS_HAS(LIGHTS)
    path->facing = (cs_vint)(0);
#endif
#if CS_HAS(MATERIALS)
    path->squeezed = (cs_vfloat)(1.0f);
#endif
    for (int c = 0; c < 3; c++)
        path->throughput[c] = (cs_vfloat)(1.0f);
    paths->table = draws->table;
    paths->light[p] = light;
    paths->found[p] = cs_radiance_begin();
}

/* Follows the rays of packet `p` of the paths to the next surfaces and turns them there; paths that
 * end are not alive any more. */
static inline void cs_path_advance(const cs_scene_buffers *scene, cs_paths *paths, int p)
{
    const cs_launch *launch = paths->launch;
    cs_path *path = paths->path + p;
    cs_hit hit;
    cs_surface surface;
    hit.distance = path->alive ? (cs_vfloat)(INFINITY) : (cs_vfloat)(-1.0f);
    cs_vint seen = cs_path_hit(scene, paths, path, &hit, &surface);
#if CS_HAS(LIGHTS)
    cs_path_add_escaped(scene, paths, path, &hit);
    if (paths->depth == 0u)
        cs_note_shapes(scene, launch->lights, &path->ray, &hit, paths->found + p);
#endif
    path->alive = seen;
    if (!cs_any(seen)) return;
#if CS_HAS(MATERIALS)
    cs_path_absorb(&surface, hit.distance, path);
#endif
    if (paths->depth == 0u) cs_note_surface(&surface, paths->found + p);
    cs_path_add_emission(scene, paths, path, &surface, hit.distance);
    path->alive = (cs_vint)(0);
    if (paths->depth > launch->bounces) return;
    cs_vfloat origin[3], out[3];
    cs_leave_surface(&surface, hit.distance, origin);
    for (int i = 0; i < 3; i++)
        out[i] = -path->ray.direction[i];
    cs_bsdf_view view = cs_bsdf_view_of(&surface, out);
    cs_numbers numbers = cs_draw_numbers(paths, p);
    /* The last ray only finds lights. */
    const int last = paths->depth == launch->bounces;
    cs_vint alone = last ? cs_lights_suffice(scene, launch, &view) : (cs_vint)(0);
    for (cs_u32 i = 0u; i < launch->lights; i++) {
        cs_light_sample light = cs_sample_light(scene, scene->lights + i, &surface, numbers.light);
        cs_path_add_light(scene, paths, path, &view, origin, &light, i, alone);
    }
    if (last && !cs_any(seen & ~alone)) return;
    cs_path_scatter(paths, &view, origin, &numbers, path);
#if CS_HAS(LIGHTS)
    path->facing = cs_environment_facing(scene, launch->lights, &surface);
#endif
    path->alive = path->alive & ~alone;
#if CS_HAS(LIGHTS)
    if (last && launch->dark) {
        cs_path_seek_lights(scene, paths, path);
        path->alive = (cs_vint)(0);
    }
#endif
    paths->rays += path->alive ? (cs_vfloat)(1.0f) : (cs_vfloat)(0.0f);
}

/* Follows paths that have begun to their ends; what the samples find is in paths->found. samples:
 * packets of them. */
static inline void cs_follow_paths(const cs_scene_buffers *scene, cs_paths *paths, int samples)
{
    paths->count = samples;
    paths->shadows = 0;
    paths->rays = (cs_vfloat)(0.0f);
    for (paths->depth = 0u; paths->count > 0; paths->depth++) {
        for (int p = 0; p < paths->count; p++) {
            cs_scene_buffers at = *scene;
#if CS_HAS(MOVING)
            at.time = paths->path[p].time;
#endif
            cs_path_advance(&at, paths, p);
        }
        cs_trace_shadows(scene, paths);
#if CS_PACKET > 1
        if (samples > 1) {
            cs_sort_paths(paths);
            continue;
        }
#endif
        paths->count = cs_any(paths->path[0].alive) ? 1 : 0;
    }
    paths->found[0].shadow_rays = paths->rays;
}

#endif
