/* Whether the samples of lights suffice without the rays that BSDFs draw. Device only.
 *
 * The power heuristic weighs both by the squares of their densities. A light that looks small has
 * much the greater density by its own samples. Where bounds of both densities prove that, the
 * light's samples get the whole weight, and a path's last ray, which only finds lights, is not
 * traced. */
#ifndef CS_LIGHT_SUFFICE_H
#define CS_LIGHT_SUFFICE_H

#include "kernels/bsdf/bsdf.h"
#include "kernels/launch.h"
#include "kernels/light/light.h"

/* Least ratio of a light's density to the BSDF's. The BSDF's weight is then at most 1 / 17. */
#define CS_DENSE_ENOUGH 4.0f

/* A lower bound of the density, per steradian, of an area light's samples for `point`; 0 if none is
 * known. */
static inline cs_vfloat cs_least_area_density(CS_GLOBAL const cs_light *light,
                                              const cs_vfloat *point)
{
    if (light->kind == CS_LIGHT_SUN) return cs_cone_density((cs_vfloat)(light->parameters[0]));
    if (light->kind == CS_LIGHT_SPHERE) return cs_sphere_density(light, point);
    if (light->kind == CS_LIGHT_QUAD) return cs_quad_least_density(light, point);
    return (cs_vfloat)(0.0f);
}

/* The same for any light; INFINITY for one that no ray finds. */
static inline cs_vfloat cs_least_density(CS_GLOBAL const cs_light *light, const cs_vfloat *point)
{
#define DELTA (cs_vfloat)(INFINITY)
#define AREA cs_least_area_density(light, point)
#define CS_LEAST_CASE(identifier, name, suffix, extent) \
    case CS_LIGHT_##identifier:                         \
        return extent;
    switch (light->kind) {
        CS_LIGHT_LIST(CS_LEAST_CASE)
    }
#undef CS_LEAST_CASE
#undef AREA
#undef DELTA
    return (cs_vfloat)(0.0f);
}

/* Lanes in which the samples of all lights suffice. view: of the surface that they light. */
static inline cs_vint cs_lights_suffice(const cs_scene_buffers *scene, const cs_launch *launch,
                                        const cs_bsdf_view *view)
{
    if (launch->only_rays) return (cs_vint)(0);
    cs_vint suffice = view->surface->hit;
    cs_vfloat wanted = CS_DENSE_ENOUGH * cs_bsdf_most_density(view);
    for (cs_u32 i = 0u; i < launch->lights && cs_any(suffice); i++)
        suffice = suffice & (cs_least_density(scene->lights + i, view->surface->point) >= wanted);
    return suffice;
}

#endif
