/* Lights at infinity that have an extent: a sun, and what surrounds the scene. Device only. */
#ifndef CS_LIGHT_ENVIRONMENT_H
#define CS_LIGHT_ENVIRONMENT_H

#include "kernels/bsdf/bsdf.h"
#include "kernels/light/cone.h"
#include "kernels/light/lat_long.h"

/* colour: radiance of the disk. parameters: one less the cosine of the angular radius. */
static inline cs_light_sample cs_sample_light_sun(const cs_scene_buffers *scene,
                                                  CS_GLOBAL const cs_light *light,
                                                  const cs_surface *surface, cs_pair pair)
{
    cs_light_sample sample;
    cs_vfloat axis[3], fall = (cs_vfloat)(light->parameters[0]);
    (void)scene;
    for (int i = 0; i < 3; i++) {
        axis[i] = (cs_vfloat)(light->axis[i]);
        sample.colour[i] = (cs_vfloat)(light->colour[i]);
    }
    cs_draw_cone(axis, fall, pair, sample.towards);
    sample.density = cs_cone_density(fall);
    sample.weight = cs_dot(surface->normal, sample.towards) / sample.density;
    sample.reach = INFINITY;
    return sample;
}

/* Directions as a diffuse surface draws them. */
static inline void cs_draw_around(const cs_vfloat *normal, cs_pair pair, cs_light_sample *sample)
{
    cs_vfloat tangent[3];
    cs_unit_disk(pair, &tangent[0], &tangent[1]);
    cs_vfloat square = 1.0f - tangent[0] * tangent[0] - tangent[1] * tangent[1];
    tangent[2] = sqrt(cs_max(square, (cs_vfloat)(0.0f)));
    cs_from_local(normal, tangent, sample->towards);
    sample->density = tangent[2] * CS_INVERSE_PI;
    sample->weight = (cs_vfloat)(CS_PI);
}

/* Which tables of an image serve the surfaces. */
static inline cs_vint cs_facing_of(const cs_lat_long *image, const cs_surface *surface)
{
    return cs_lets_through(surface) ? (cs_vint)(CS_FACING_ANY)
                                    : cs_lat_long_facing(image, surface->normal);
}

/* The same for the environment among `lights` lights; where its image has no tables, any number. */
static inline cs_vint cs_environment_facing(const cs_scene_buffers *scene, cs_u32 lights,
                                            const cs_surface *surface)
{
    for (cs_u32 i = 0u; i < lights; i++) {
        CS_GLOBAL const cs_light *light = scene->lights + i;
        if (light->kind != CS_LIGHT_ENVIRONMENT || light->count == 0u) continue;
        cs_lat_long image = cs_lat_long_of(light, scene->environment);
        if (image.cells_x > 0u) return cs_facing_of(&image, surface);
    }
    return (cs_vint)(0);
}

/* Directions by the cells of an image; pair becomes their place in it. */
static inline void cs_draw_texels(const cs_lat_long *image, const cs_surface *surface,
                                  cs_pair *pair, cs_light_sample *sample)
{
    cs_vint facing = cs_facing_of(image, surface);
    sample->density = cs_lat_long_draw(image, facing, &pair->x, &pair->y, sample->towards);
    sample->weight = sample->density > 0.0f
                         ? cs_dot(surface->normal, sample->towards) / sample->density
                         : (cs_vfloat)(0.0f);
}

/* colour: radiance, times the image's if there is one (light->count above 0, see cs_lat_long_of).
 * Directions are drawn by its cells if it has some. */
static inline cs_light_sample cs_sample_light_environment(const cs_scene_buffers *scene,
                                                          CS_GLOBAL const cs_light *light,
                                                          const cs_surface *surface, cs_pair pair)
{
    cs_light_sample sample;
    cs_lat_long image = cs_lat_long_of(light, scene->environment);
    sample.reach = INFINITY;
    for (int i = 0; i < 3; i++)
        sample.colour[i] = (cs_vfloat)(light->colour[i]);
    if (image.cells_x > 0u)
        cs_draw_texels(&image, surface, &pair, &sample);
    else
        cs_draw_around(surface->normal, pair, &sample);
    if (image.width == 0u) return sample;
    cs_vfloat radiance[3];
    if (image.cells_x == 0u) cs_lat_long_place(&image, sample.towards, &pair.x, &pair.y);
    cs_lat_long_radiance(&image, pair.x, pair.y, radiance);
    for (int c = 0; c < 3; c++)
        sample.colour[c] *= radiance[c];
    return sample;
}

#endif
