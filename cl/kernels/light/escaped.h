/* The light that rays find which were drawn from a BSDF, and with what density the lights' own
 * samples would have found it. Device only. */
#ifndef CS_LIGHT_ESCAPED_H
#define CS_LIGHT_ESCAPED_H

#include "kernels/light/light.h"
#include "kernels/light/shapes.h"

#if !CS_HAS(EMITTERS)
/* Density, per steradian, with which the light of emissive triangles draws the point that a ray
 * hit: cs_emitters_make makes it proportional to luminance. */
static inline cs_vfloat cs_emitter_density(const cs_scene_buffers *scene, cs_u32 lights,
                                           const cs_surface *surface, const cs_ray *ray,
                                           cs_vfloat distance)
{
    cs_f32 per_power = 0.0f;
    for (cs_u32 i = 0u; i < lights; i++)
        if (scene->lights[i].kind == CS_LIGHT_TRIANGLES) per_power = scene->lights[i].parameters[0];
    cs_vfloat square = cs_dot(ray->direction, ray->direction) * distance * distance;
    cs_vfloat cosine = fabs(cs_dot(surface->outward, ray->direction)) /
                       sqrt(cs_dot(ray->direction, ray->direction));
    cs_vfloat density =
        per_power * cs_luminance(surface->emission) * square / cs_max(cosine, (cs_vfloat)(1e-20f));
#if CS_HAS(MATERIALS)
    density = surface->shines_to == (cs_vint)(CS_SHINES_SAMPLED) ? density : (cs_vfloat)(0.0f);
#endif
    return density;
}
#endif

/* Light that comes from no surface of the scene. */
typedef struct cs_escaped {
    cs_vfloat colour[3];
    cs_vfloat density; /* with which the light's samples would have drawn the direction */
} cs_escaped;

static inline cs_escaped cs_escape_to_sun(CS_GLOBAL const cs_light *light, const cs_ray *ray)
{
    cs_escaped found;
    cs_vfloat apart[3]; /* its square is twice one less the cosine, without the rounding of that */
    for (int i = 0; i < 3; i++)
        apart[i] = ray->direction[i] - light->axis[i];
    cs_vint inside = cs_dot(apart, apart) < (cs_vfloat)(2.0f * light->parameters[0]);
    for (int i = 0; i < 3; i++)
        found.colour[i] = inside ? (cs_vfloat)(light->colour[i]) : (cs_vfloat)(0.0f);
    found.density = cs_cone_density((cs_vfloat)(light->parameters[0]));
    return found;
}

/* Of rays that met the light. */
static inline cs_escaped cs_escape_to_shape(CS_GLOBAL const cs_light *light, const cs_ray *ray)
{
    cs_escaped found;
    cs_vfloat facing = (cs_vfloat)(1.0f);
    if (light->kind == CS_LIGHT_SPHERE) {
        found.density = cs_sphere_density(light, ray->origin);
    } else {
        cs_vfloat towards[3], distance = cs_shape_distance(light, ray);
        for (int i = 0; i < 3; i++)
            towards[i] = ray->direction[i] * distance;
        facing = cs_quad_facing(light, towards);
        found.density = cs_quad_density(light, towards, facing);
    }
    for (int i = 0; i < 3; i++)
        found.colour[i] = facing > 0.0f ? (cs_vfloat)(light->colour[i]) : (cs_vfloat)(0.0f);
    return found;
}

/* cosine, facing (cs_environment_facing): at the surface that the ray left. weighed: whether the
 * density is wanted. */
static inline cs_escaped cs_escape_to_environment(const cs_scene_buffers *scene,
                                                  CS_GLOBAL const cs_light *light,
                                                  const cs_ray *ray, cs_vfloat cosine,
                                                  cs_vint facing, int weighed)
{
    cs_escaped found;
    for (int i = 0; i < 3; i++)
        found.colour[i] = (cs_vfloat)(light->colour[i]);
    found.density = cs_max(cosine, (cs_vfloat)(0.0f)) * CS_INVERSE_PI;
    if (light->count == 0u) return found;
    cs_lat_long image = cs_lat_long_of(light, scene->environment);
    cs_vfloat x, y, radiance[3];
    cs_lat_long_place(&image, ray->direction, &x, &y);
    cs_lat_long_radiance(&image, x, y, radiance);
    if (weighed && image.cells_x > 0u) found.density = cs_lat_long_density(&image, facing, x, y);
    for (int c = 0; c < 3; c++)
        found.colour[c] *= radiance[c];
    return found;
}

#endif
