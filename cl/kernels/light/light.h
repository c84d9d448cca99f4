/* Sampling a light of whatever kind. Device only. */
#ifndef CS_LIGHT_H
#define CS_LIGHT_H

#include "kernels/features.h"
#include "kernels/light/delta.h"
#include "kernels/light/emitters.h"
#include "kernels/light/environment.h"
#include "kernels/light/quad.h"
#include "kernels/light/sphere.h"
#include "kernels/light/triangles.h"

#define CS_SAMPLE_DELTA(suffix) cs_sample_light_##suffix(light, surface)
#define CS_SAMPLE_AREA(suffix) cs_sample_light_##suffix(scene, light, surface, pair)

/* The light that reaches the surface points if nothing is in the way. `pair` is the tuple's pair
 * for area lights: a point of the unit square in each lane. */
static inline cs_light_sample cs_sample_light(const cs_scene_buffers *scene,
                                              CS_GLOBAL const cs_light *light,
                                              const cs_surface *surface, cs_pair pair)
{
    cs_light_sample sample;
#define CS_LIGHT_CASE(identifier, name, suffix, extent) \
    case CS_LIGHT_##identifier:                         \
        sample = CS_SAMPLE_##extent(suffix);            \
        break;
    switch (light->kind) {
        CS_LIGHT_LIST_FEW(CS_LIGHT_CASE)
#if CS_HAS(LIGHTS)
        CS_LIGHT_LIST_MORE(CS_LIGHT_CASE)
#endif
    }
#undef CS_LIGHT_CASE
    return sample;
}

#undef CS_SAMPLE_DELTA
#undef CS_SAMPLE_AREA

#endif
