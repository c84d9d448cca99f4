/* How surfaces send paths on, or end them. Device only. */
#ifndef CS_PATH_SCATTER_H
#define CS_PATH_SCATTER_H

#include "kernels/bsdf/bsdf.h"
#include "kernels/path/next_surface.h"

enum {
    CS_ROULETTE_FROM = 3 /* surfaces that a path passes without roulette */
};

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
static inline void cs_path_scatter(const cs_paths *paths, const cs_bsdf_view *view,
                                   const cs_vfloat *origin, const cs_numbers *numbers,
                                   cs_path *path)
{
    const cs_surface *surface = view->surface;
    cs_bsdf_direction drawn = cs_bsdf_sample(view, numbers->bsdf, numbers->choice.x);
    cs_vfloat cosine = fabs(cs_dot(surface->normal, drawn.in));
    path->alive = cs_is_open(surface, drawn.in) & (drawn.value.density > 0.0f);
    cs_leave_towards(surface, origin, drawn.in, path->ray.origin);
    cs_vfloat weight =
        path->alive ? cosine * drawn.value.scale / drawn.value.density : (cs_vfloat)(0.0f);
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
    if (paths->depth >= (cs_u32)CS_ROULETTE_FROM) cs_path_roulette(numbers->choice.y, path);
}

#endif
