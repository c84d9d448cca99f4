/* The radiance along a packet of rays, with the light that comes by way of several surfaces.
 * Device only.
 *
 * At every surface each light is sampled, and a direction of the BSDF is followed. What both can
 * find is weighted by the power heuristic (Veach 1997, section 9.2.4, exponent 2). Paths end by
 * Russian roulette (Arvo & Kirk 1990) or after launch.bounces surfaces. */
#ifndef CS_PATH_H
#define CS_PATH_H

#include "kernels/draws.h"
#include "kernels/launch.h"
#include "kernels/radiance.h"

enum {
    CS_ROULETTE_FROM = 3 /* surfaces that a path passes without roulette */
};

typedef struct cs_path {
    cs_ray ray;
    cs_vint alive;           /* lanes whose ray is to be followed */
    cs_vfloat throughput[3]; /* radiance at the lens for one at the end of the ray */
    cs_vfloat density;       /* with which the BSDF drew the ray; of camera rays it is not used */
    cs_vfloat cosine;        /* of the ray at the surface that it left; negative behind it */
#if CS_HAS(EMITTERS)
    cs_vantage left; /* the surface behind the path's end */
#endif
#if CS_HAS(MATERIALS)
    cs_vfloat squeezed; /* by which solids, that the path is in, lower the throughput */
#endif
    cs_u32 depth;         /* surfaces behind the path */
    cs_f32 clamp;         /* as in cs_launch */
    cs_u32 see_through;   /* as in cs_launch */
    cs_u32 lights;        /* as in cs_launch */
    cs_u32 shadows;       /* rays to lights so far */
    cs_radiance radiance; /* found so far */
} cs_path;

/* Weight of a sample with density `own` where another way would have drawn it with `other`. The
 * ratio keeps squares within floats. */
static inline cs_vfloat cs_power_weight(cs_vfloat own, cs_vfloat other)
{
    cs_vfloat ratio = other / cs_max(own, (cs_vfloat)(1e-30f));
    return 1.0f / (1.0f + ratio * ratio);
}

/* Adds `colour` times `weight` at the end of the paths; lanes with weight 0 add nothing. met:
 * surfaces that this light met. */
static inline void cs_path_add(cs_path *path, cs_u32 met, cs_vfloat weight, const cs_vfloat *colour)
{
    cs_vfloat added[3], scale = (cs_vfloat)(1.0f);
    for (int c = 0; c < 3; c++)
        added[c] = path->throughput[c] * weight * colour[c];
    if (path->clamp > 0.0f && path->depth > 0u) {
        cs_vfloat most = cs_max(added[0], cs_max(added[1], added[2]));
        scale = most > path->clamp ? path->clamp / most : scale;
    }
    for (int c = 0; c < 3; c++)
        cs_radiance_add(&path->radiance, met, c,
                        weight > 0.0f ? added[c] * scale : (cs_vfloat)(0.0f));
}

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
static inline void cs_path_add_emission(const cs_scene_buffers *scene, cs_u32 lights,
                                        const cs_surface *surface, cs_vfloat distance,
                                        cs_path *path)
{
    cs_vint shines = surface->hit & (cs_luminance(surface->emission) > 0.0f);
    if (path->depth > 0u) shines = shines & cs_shines_on_surfaces(surface);
    if (!cs_any(shines)) return;
    cs_vfloat weight = (cs_vfloat)(1.0f);
    if (path->depth > 0u) {
#if CS_HAS(EMITTERS)
        cs_vfloat density = cs_emitters_density(scene, &path->left, surface);
        (void)lights;
        (void)distance;
#else
        cs_vfloat density = cs_emitter_density(scene, lights, surface, &path->ray, distance);
#endif
        weight = cs_power_weight(path->density, density);
    }
    cs_path_add(path, path->depth, shines ? weight : (cs_vfloat)(0.0f), surface->emission);
}

#if CS_HAS(LIGHTS)
/* Adds lights that the paths met, and what comes from beyond the scene. The camera does not see
 * suns. */
static inline void cs_path_add_escaped(const cs_scene_buffers *scene, const cs_hit *hit,
                                       cs_path *path)
{
    if (!cs_any(path->alive & (hit->triangle < 0))) return;
    for (cs_u32 i = 0u; i < path->lights; i++) {
        CS_GLOBAL const cs_light *light = scene->lights + i;
        cs_vint escaped = path->alive & (hit->triangle == (cs_vint)(CS_NO_HIT));
        cs_escaped found;
        if (cs_is_shape(light)) {
            escaped = path->alive & (hit->triangle == (cs_vint)(cs_shape_hit(i)));
            if (!cs_any(escaped)) continue;
            found = cs_escape_to_shape(light, &path->ray);
        } else if (light->kind == CS_LIGHT_ENVIRONMENT)
            found = cs_escape_to_environment(scene, light, &path->ray, path->cosine);
        else if (light->kind == CS_LIGHT_SUN && path->depth > 0u)
            found = cs_escape_to_sun(light, &path->ray);
        else
            continue;
        cs_vfloat weight = (cs_vfloat)(1.0f);
        if (path->depth > 0u) weight = cs_power_weight(path->density, found.density);
        cs_path_add(path, path->depth, escaped ? weight : (cs_vfloat)(0.0f), found.colour);
    }
}
#endif

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
 * without one get distance 0. lights: their number. */
static inline cs_vint cs_find_surfaces(const cs_scene_buffers *scene, cs_u32 lights,
                                       const cs_ray *ray, cs_hit *hit, cs_surface *surface)
{
    cs_traverse(scene, ray, 0, hit);
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

/* Lanes that pass the surface: alpha is the chance that they do not (Enderton et al. 2010). */
static inline cs_vint cs_passes(const cs_surface *surface, const cs_draws *draws, cs_u32 key)
{
    cs_vint thin = surface->hit & (surface->alpha < 1.0f);
    if (!cs_any(thin)) return thin;
    return thin & (cs_unit(cs_key_lanes(cs_key(draws->key, key), draws->index)) >= surface->alpha);
}

/* Keys of the choices to pass a surface, apart from all patterns of a path. */
static inline cs_u32 cs_passing_key(cs_u32 depth, cs_u32 ray, cs_u32 passed)
{
    return 0x70617373u + (depth * 256u + ray) * (cs_u32)CS_MOST_PASSED + passed;
}
#endif

/* The path's next surfaces, as cs_find_surfaces, but for those that it passes. The ray stays as it
 * was, so that distances are from the surface that it left. */
static inline cs_vint cs_path_hit(const cs_scene_buffers *scene, const cs_draws *draws,
                                  cs_path *path, cs_hit *hit, cs_surface *surface)
{
    cs_vint seen = cs_find_surfaces(scene, path->lights, &path->ray, hit, surface);
#if CS_HAS(MATERIALS)
    cs_vint passes = seen; /* lanes that stopped once have stopped */
    cs_vfloat passed = (cs_vfloat)(0.0f);
    cs_ray ray = path->ray;
    for (cs_u32 n = 0u; cs_any(seen) && n < (cs_u32)CS_MOST_PASSED; n++) {
        passes = passes & cs_passes(surface, draws, cs_passing_key(path->depth, 0u, n));
        if (!cs_any(passes)) break;
        cs_vfloat origin[3], from[3];
        cs_leave_surface(surface, hit->distance, origin);
        cs_leave_towards(surface, origin, ray.direction, from);
        for (int i = 0; i < 3; i++)
            ray.origin[i] = passes ? from[i] : ray.origin[i];
        passed += passes ? hit->distance : (cs_vfloat)(0.0f);
        hit->distance = path->alive ? (cs_vfloat)(INFINITY) : (cs_vfloat)(-1.0f);
        seen = cs_find_surfaces(scene, path->lights, &ray, hit, surface);
    }
    hit->distance += passed;
#else
    (void)draws;
#endif
    return seen;
}

#if CS_HAS(MATERIALS)
/* As cs_path_shadow, past surfaces that let the ray pass. */
static inline void cs_shadow_through(const cs_scene_buffers *scene, cs_ray *ray,
                                     const cs_draws *draws, cs_path *path, cs_hit *hit)
{
    cs_vfloat left = hit->distance; /* to go; negative: blocked or not wanted */
    path->shadows++;
    for (cs_u32 n = 0u; n < (cs_u32)CS_MOST_PASSED; n++) {
        cs_surface surface;
        cs_vfloat origin[3], from[3];
        hit->distance = left;
        cs_vint seen = cs_find_surfaces(scene, path->lights, ray, hit, &surface);
        left = hit->triangle < (cs_vint)(CS_NO_HIT) ? (cs_vfloat)(-1.0f) : left;
        if (!cs_any(seen)) break;
        cs_vint passes = cs_passes(&surface, draws, cs_passing_key(path->depth, path->shadows, n));
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

/* Makes hit->distance negative in the lanes where something is in the way. */
static inline void cs_path_shadow(const cs_scene_buffers *scene, cs_ray *ray, const cs_draws *draws,
                                  cs_path *path, cs_hit *hit)
{
#if CS_HAS(MATERIALS)
    if (path->see_through) {
        cs_shadow_through(scene, ray, draws, path, hit);
        return;
    }
#endif
    (void)draws;
    cs_traverse(scene, ray, 1, hit);
#if CS_HAS(LIGHTS)
    cs_meet_shapes(scene, path->lights, ray, 1, hit);
#else
    (void)path;
#endif
}

/* Adds what one light reflects towards the path, as cs_add_light does for direct light alone. */
static inline void cs_path_add_light(const cs_scene_buffers *scene, const cs_bsdf_view *view,
                                     const cs_vfloat *origin, const cs_light_sample *light,
                                     const cs_draws *draws, cs_path *path)
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
    cs_path_shadow(scene, &shadow, draws, path, &blocked);
    cs_bsdf_value bsdf = cs_bsdf_eval(view, light->towards);
    /* Lights that no direction finds have density 0: their sample counts whole. */
    cs_vfloat share =
        light->density > 0.0f ? cs_power_weight(light->density, bsdf.density) : (cs_vfloat)(1.0f);
    cs_vfloat weight =
        blocked.distance > 0.0f ? fabs(light->weight) * bsdf.scale * share : (cs_vfloat)(0.0f);
    cs_vfloat colour[3];
    for (int c = 0; c < 3; c++)
        colour[c] = light->colour[c] * bsdf.colour[c];
    cs_path_add(path, path->depth + 1u, weight, colour);
    path->radiance.shadow_rays += facing ? (cs_vfloat)(1.0f) : (cs_vfloat)(0.0f);
}

/* Roulette by the largest channel: lanes go on with that chance, and count for those that do not.
 */
static inline void cs_path_roulette(cs_vfloat chance, cs_path *path)
{
    cs_vfloat most = cs_max(path->throughput[0], cs_max(path->throughput[1], path->throughput[2]));
#if CS_HAS(MATERIALS)
    most *= path->squeezed;
#endif
    cs_vfloat stays = cs_clamp(most, (cs_vfloat)(0.0f), (cs_vfloat)(1.0f));
    path->alive = path->alive & (chance < stays);
    for (int c = 0; c < 3; c++)
        path->throughput[c] /= cs_max(stays, (cs_vfloat)(1e-20f));
}

#if CS_HAS(MATERIALS)
/* Takes off what the inside of a solid absorbed on the way to its surface (Beer). */
static inline void cs_path_absorb(const cs_surface *surface, cs_vfloat distance, cs_path *path)
{
    cs_vint within = surface->hit & surface->inside & (surface->bsdf == (cs_vint)(CS_BSDF_GLASS));
    if (!cs_any(within)) return;
    cs_vfloat way = distance * sqrt(cs_dot(path->ray.direction, path->ray.direction));
    for (int c = 0; c < 3; c++) {
        cs_vfloat left = exp(-way * surface->parameters[CS_PARAMETER_ABSORPTION + c]);
        path->throughput[c] *= within ? left : (cs_vfloat)(1.0f);
    }
}

/* Radiance changes with the square of the index of refraction; roulette has to look at the light
 * that arrives in the end. */
static inline void cs_path_cross(const cs_surface *surface, const cs_vfloat *in, cs_path *path)
{
    cs_vint crosses = surface->hit & (cs_dot(surface->outward, in) < 0.0f) &
                      (surface->bsdf == (cs_vint)(CS_BSDF_GLASS));
    cs_vfloat index = surface->parameters[CS_PARAMETER_INDEX];
    cs_vfloat ratio = surface->inside ? 1.0f / index : index;
    path->squeezed *= crosses ? ratio * ratio : (cs_vfloat)(1.0f);
}
#endif

/* Turns the ray into one that leaves the surface as the BSDF draws it. */
static inline void cs_path_scatter(const cs_bsdf_view *view, const cs_vfloat *origin,
                                   const cs_draws *draws, cs_path *path)
{
    const cs_surface *surface = view->surface;
    cs_pair pair = cs_draw_at(draws, path->depth, CS_DRAW_BSDF);
    cs_pair choice = cs_draw_at(draws, path->depth, CS_DRAW_CHOICE);
    cs_bsdf_direction drawn = cs_bsdf_sample(view, pair, choice.x);
    cs_vfloat cosine = fabs(cs_dot(surface->normal, drawn.in));
    path->alive = cs_is_open(surface, drawn.in) & (drawn.value.density > 0.0f);
    cs_leave_towards(surface, origin, drawn.in, path->ray.origin);
    cs_vfloat weight = path->alive ? cosine * drawn.value.scale / drawn.value.density : (cs_vfloat)(0.0f);
#if CS_HAS(EMITTERS)
    path->left = cs_vantage_of(surface);
#endif
    path->density = drawn.value.density;
    path->cosine = cs_dot(surface->normal, drawn.in);
    for (int i = 0; i < 3; i++) {
        path->throughput[i] *= weight * drawn.value.colour[i];
        path->ray.direction[i] = drawn.in[i];
    }
#if CS_HAS(MATERIALS)
    cs_path_cross(surface, drawn.in, path);
#endif
    if (path->depth >= (cs_u32)CS_ROULETTE_FROM) cs_path_roulette(choice.y, path);
}

static inline cs_path cs_path_begin(const cs_launch *launch, const cs_ray *ray, cs_vint active)
{
    cs_path path;
    path.ray = *ray;
    path.alive = active;
    path.density = (cs_vfloat)(0.0f);
    path.cosine = (cs_vfloat)(0.0f);
#if CS_HAS(MATERIALS)
    path.squeezed = (cs_vfloat)(1.0f);
#endif
    path.depth = 0u;
    path.clamp = launch->clamp;
    path.see_through = launch->see_through;
    path.lights = launch->lights;
    path.shadows = 0u;
    path.radiance = cs_radiance_begin();
    for (int c = 0; c < 3; c++)
        path.throughput[c] = (cs_vfloat)(1.0f);
    return path;
}

/* Follows the rays to the next surfaces; 0 where that ends all paths. */
static inline int cs_path_advance(const cs_scene_buffers *scene, const cs_launch *launch,
                                  cs_pair light_pair, const cs_draws *draws, cs_path *path)
{
    cs_hit hit;
    cs_surface surface;
    hit.distance = path->alive ? (cs_vfloat)(INFINITY) : (cs_vfloat)(-1.0f);
    cs_vint seen = cs_path_hit(scene, draws, path, &hit, &surface);
#if CS_HAS(LIGHTS)
    cs_path_add_escaped(scene, &hit, path);
    if (path->depth == 0u) cs_note_shapes(scene, path->lights, &path->ray, &hit, &path->radiance);
#endif
    if (!cs_any(seen)) return 0;
#if CS_HAS(MATERIALS)
    cs_path_absorb(&surface, hit.distance, path);
#endif
    if (path->depth == 0u) cs_note_surface(&surface, &path->radiance);
    cs_path_add_emission(scene, launch->lights, &surface, hit.distance, path);
    /* The last ray only finds what the lights' samples of the last surface might. */
    if (path->depth > launch->bounces) return 0;
    cs_vfloat origin[3], out[3];
    cs_leave_surface(&surface, hit.distance, origin);
    for (int i = 0; i < 3; i++)
        out[i] = -path->ray.direction[i];
    cs_bsdf_view view = cs_bsdf_view_of(&surface, out);
    cs_pair pair = light_pair;
    if (path->depth > 0u && launch->area_lights > 0u)
        pair = cs_draw_at(draws, path->depth, CS_DRAW_LIGHT);
    for (cs_u32 i = 0u; i < launch->lights; i++) {
        cs_light_sample light = cs_sample_light(scene, scene->lights + i, &surface, pair);
        cs_path_add_light(scene, &view, origin, &light, draws, path);
    }
    if (path->depth == launch->bounces && launch->area_lights == 0u) return 0;
    cs_path_scatter(&view, origin, draws, path);
    path->depth++;
    path->radiance.shadow_rays += path->alive ? (cs_vfloat)(1.0f) : (cs_vfloat)(0.0f);
    return cs_any(path->alive);
}

/* As cs_radiance_along, and with bounces. draws: what the paths draw from beyond the tuple. */
static inline cs_radiance cs_path_along(const cs_scene_buffers *scene, const cs_launch *launch,
                                        const cs_ray *ray, cs_pair light_pair,
                                        const cs_draws *draws, cs_vint active)
{
    cs_path path = cs_path_begin(launch, ray, active);
    while (cs_path_advance(scene, launch, light_pair, draws, &path)) {
    }
    return path.radiance;
}

#endif
