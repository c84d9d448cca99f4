/* Where lights' own samples do without the rays that BSDFs draw. Device only.
 *
 * Lights that look small are drawn so much more densely by their own samples that those have nearly
 * all the weight (power heuristic). Where that is certain, they get all of it, and a ray that could
 * only find lights is not traced. */
#ifndef CS_LIGHT_SUFFICE_H
#define CS_LIGHT_SUFFICE_H

#include "kernels/bsdf/bsdf.h"
#include "kernels/launch.h"
#include "kernels/light/light.h"

/* How much denser they are to be: the others' weight is at most 1 in 17. */
#define CS_DENSE_ENOUGH 4.0f

/* What the density of an area light's samples, per steradian, is at least where it shines on
 * `point`; 0: nothing is known of it. */
static inline cs_vfloat cs_least_area_density(CS_GLOBAL const cs_light *light,
                                              const cs_vfloat *point)
{
    if (light->kind == CS_LIGHT_SUN) return cs_cone_density((cs_vfloat)(light->parameters[0]));
    if (light->kind == CS_LIGHT_SPHERE) return cs_sphere_density(light, point);
    if (light->kind == CS_LIGHT_QUAD) return cs_quad_least_density(light, point);
    return (cs_vfloat)(0.0f);
}

/* The same of any light; INFINITY where no ray finds it. */
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

/* Lanes in which the samples of all lights suffice. */
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
