/* The next surfaces on paths. Device only. */
#ifndef CS_PATH_NEXT_SURFACE_H
#define CS_PATH_NEXT_SURFACE_H

#include "kernels/hits.h"
#include "kernels/path/state.h"
#include "kernels/wide_walk.h"

/* Where rays to the side of `towards` leave the surface: `origin` is off it on the viewer's side.
 */
static inline void cs_leave_towards(const cs_surface *surface, const cs_vfloat *origin,
                                    const cs_vfloat *towards, cs_vfloat *from)
{
    cs_vint behind = cs_dot(surface->outward, towards) < 0.0f;
    for (int i = 0; i < 3; i++)
        from[i] = behind ? 2.0f * surface->point[i] - origin[i] : origin[i];
}

/* Lanes in which `towards` leads to where light comes from: the side of both normals, or the other
 * side of both where light gets through. */
static inline cs_vint cs_is_open(const cs_surface *surface, const cs_vfloat *towards)
{
    cs_vfloat outer = cs_dot(surface->outward, towards), inner = cs_dot(surface->normal, towards);
    cs_vint front = (outer > 0.0f) & (inner > 0.0f), back = (outer < 0.0f) & (inner < 0.0f);
    return surface->hit & (front | (back & cs_lets_through(surface)));
}

/* The nearest surfaces along the rays up to hit->distance; returns the lanes that have one. Lanes
 * without one get distance 0. lights: their number. camera: 1 for rays from the lens. These walk
 * together: the pixel's footprint in the scene is small, however wide the lens. */
static inline cs_vint cs_find_surfaces(const cs_scene_buffers *scene, cs_u32 lights, int camera,
                                       const cs_ray *ray, cs_hit *hit, cs_surface *surface)
{
    if (camera)
        cs_traverse(scene, ray, 0, hit);
    else
        cs_traverse_either(scene, ray, 0, hit);
#if CS_HAS(LIGHTS)
    cs_meet_shapes(scene, lights, ray, 0, hit);
#else
    (void)lights;
#endif
    cs_vint seen = hit->triangle >= 0;
    hit->distance = seen ? hit->distance : (cs_vfloat)(0.0f);
    if (cs_any(seen)) *surface = cs_describe_hits(scene, ray, hit);
    return seen;
}

#if CS_HAS(MATERIALS)
enum {
    CS_MOST_PASSED = 64 /* surfaces that a ray passes because of their alpha */
};

/* Lanes that pass the surface: alpha is the chance that they do not (Enderton et al. 2010). bits:
 * random. */
static inline cs_vint cs_passes(const cs_surface *surface, cs_vuint bits)
{
    return surface->hit & (surface->alpha < 1.0f) & (cs_unit(bits) >= surface->alpha);
}

/* Random bits for the choices to pass surfaces on the way of the ray that goes on (0), or to a
 * light (from 1 on); apart from all patterns of a path. */
static inline cs_vuint cs_passing(const cs_paths *paths, cs_u32 ray, const cs_path *path)
{
    cs_u32 key = 0x70617373u + paths->depth * 0x10000u + ray;
    return cs_key_families(cs_key_families(path->key, (cs_vuint)(key)), path->index);
}

/* Those for surface number `passed`. */
static inline cs_vuint cs_passing_bits(cs_vuint passing, cs_u32 passed)
{
    return cs_hash_lanes(passing + 0x9e3779b9u * passed);
}
#endif

/* The path's next surfaces, as cs_find_surfaces, but for those that it passes. The ray stays as it
 * was, so that distances are from the surface that it left. */
static inline cs_vint cs_path_hit(const cs_scene_buffers *scene, const cs_paths *paths,
                                  const cs_path *path, cs_hit *hit, cs_surface *surface)
{
    const int camera = paths->depth == 0u;
    const cs_u32 lights = paths->launch->lights;
    cs_vint seen = cs_find_surfaces(scene, lights, camera, &path->ray, hit, surface);
#if CS_HAS(MATERIALS)
    cs_vuint passing = cs_passing(paths, 0u, path);
    cs_vint passes = seen; /* lanes that stopped once have stopped */
    cs_vfloat passed = (cs_vfloat)(0.0f);
    cs_ray ray = path->ray;
    for (cs_u32 n = 0u; cs_any(seen) && n < (cs_u32)CS_MOST_PASSED; n++) {
        passes = passes & cs_passes(surface, cs_passing_bits(passing, n));
        if (!cs_any(passes)) break;
        cs_vfloat origin[3], from[3];
        cs_leave_surface(surface, hit->distance, origin);
        cs_leave_towards(surface, origin, ray.direction, from);
        for (int i = 0; i < 3; i++)
            ray.origin[i] = passes ? from[i] : ray.origin[i];
        passed += passes ? hit->distance : (cs_vfloat)(0.0f);
        hit->distance = path->alive ? (cs_vfloat)(INFINITY) : (cs_vfloat)(-1.0f);
        seen = cs_find_surfaces(scene, lights, camera, &ray, hit, surface);
    }
    hit->distance += passed;
#endif
    return seen;
}

#endif
