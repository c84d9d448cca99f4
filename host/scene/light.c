/* Lights of a scene: added ones, and the table of emissive triangles. */
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "scene/scene.h"

int cs_is_colour(const float *colour)
{
    int good = 1;
    for (int c = 0; c < 3; c++)
        good &= colour[c] >= 0.0f && colour[c] <= 1e15f;
    return good;
}

static const float degree = 0.0174532925f;

/* Whether what the kind reads can be used. */
static clshear_status check_light(const clshear_light *light, cs_error *error)
{
    const int has_place = light->kind != CLSHEAR_LIGHT_DIRECTIONAL;
    const int has_direction = light->kind != CLSHEAR_LIGHT_POINT;
    const float *place = light->position, *direction = light->direction;
    if (light->kind < CLSHEAR_LIGHT_POINT || light->kind > CLSHEAR_LIGHT_SPOT)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "light: kind %d is not known",
                       (int)light->kind);
    for (int i = 0; i < 3; i++)
        if ((has_place && !isfinite(place[i])) || (has_direction && !isfinite(direction[i])))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "light: its position must be finite");
    if (!cs_is_colour(light->colour))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "light: colour %g,%g,%g: must be 0 to 1e15",
                       (double)light->colour[0], (double)light->colour[1],
                       (double)light->colour[2]);
    if (has_direction && !(cs_vec_dot(direction, direction) > 0.0f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "light: its direction has no length");
    if (!has_place && !(light->diameter_deg >= 0.0f && light->diameter_deg <= 180.0f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "light: diameter %g: must be 0 to 180 degrees",
                       (double)light->diameter_deg);
    if (light->kind == CLSHEAR_LIGHT_SPOT &&
        !(light->inner_deg >= 0.0f && light->outer_deg > light->inner_deg &&
          light->outer_deg <= 90.0f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "light: cone %g to %g: must be 0 <= inner < outer <= 90 degrees",
                       (double)light->inner_deg, (double)light->outer_deg);
    return CLSHEAR_OK;
}

/* Scale and offset as KHR_lights_punctual defines them. */
static void make_spot(const clshear_light *light, cs_light *made)
{
    const float outer = cosf(light->outer_deg * degree);
    made->kind = CS_LIGHT_SPOT;
    made->parameters[0] = 1.0f / fmaxf(cosf(light->inner_deg * degree) - outer, 0.001f);
    made->parameters[1] = -outer * made->parameters[0];
    for (int i = 0; i < 3; i++)
        made->axis[i] = -made->axis[i];
}

/* A cone of half angle a, of even radiance L, lights a surface that faces it with pi L sin^2 a. */
static void make_sun(const clshear_light *light, cs_light *made)
{
    const double half = 0.5 * (double)light->diameter_deg * (double)degree;
    const double sine = sin(half), half_sine = sin(0.5 * half);
    made->kind = CS_LIGHT_SUN;
    made->parameters[0] = (float)(2.0 * half_sine * half_sine); /* 1 - cos a */
    for (int c = 0; c < 3; c++)
        made->colour[c] = (float)((double)made->colour[c] / (3.14159265358979 * sine * sine));
}

clshear_status cs_light_make(const clshear_light *light, cs_light *made, cs_error *error)
{
    clshear_status status = check_light(light, error);
    if (status != CLSHEAR_OK) return status;
    const int has_direction = light->kind != CLSHEAR_LIGHT_POINT;
    const float length = sqrtf(cs_vec_dot(light->direction, light->direction));
    memset(made, 0, sizeof *made);
    made->kind = has_direction ? CS_LIGHT_DIRECTIONAL : CS_LIGHT_POINT;
    for (int i = 0; i < 3; i++) {
        if (has_direction) made->axis[i] = light->direction[i] / length;
        if (light->kind != CLSHEAR_LIGHT_DIRECTIONAL) made->position[i] = light->position[i];
        made->colour[i] = light->colour[i];
    }
    if (light->kind == CLSHEAR_LIGHT_SPOT) make_spot(light, made);
    /* Smaller ones are as sharp, and their radiance leaves no room for a colour in a float. */
    if (light->kind == CLSHEAR_LIGHT_DIRECTIONAL && light->diameter_deg > 1e-3f)
        make_sun(light, made);
    return CLSHEAR_OK;
}

clshear_status cs_scene_add_light(cs_scene *scene, const clshear_light *light, cs_error *error)
{
    cs_light made;
    clshear_status status = cs_light_make(light, &made, error);
    if (status != CLSHEAR_OK) return status;
    cs_light *added = cs_array_extend(&scene->lights, 1);
    if (added == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    *added = made;
    return CLSHEAR_OK;
}

static float luminance(const float *colour)
{
    return 0.2126f * colour[0] + 0.7152f * colour[1] + 0.0722f * colour[2];
}

/* Fills in one emitter; returns its power up to a constant. */
static double describe_emitter(const cs_scene *scene, size_t triangle, cs_emitter *emitter)
{
    const uint32_t *corner = ((const uint32_t(*)[3])scene->indices.items)[triangle];
    const float(*positions)[3] = scene->positions.items;
    const uint32_t material = ((const uint32_t *)scene->triangle_materials.items)[triangle];
    const cs_material *look = (const cs_material *)scene->materials.items + material;
    memcpy(emitter->corner, positions[corner[0]], sizeof emitter->corner);
    memcpy(emitter->radiance, look->emission, sizeof emitter->radiance);
    cs_vec_subtract(positions[corner[1]], positions[corner[0]], emitter->edge1);
    cs_vec_subtract(positions[corner[2]], positions[corner[0]], emitter->edge2);
    double e1[3], e2[3], normal[3];
    for (int i = 0; i < 3; i++) {
        e1[i] = (double)emitter->edge1[i];
        e2[i] = (double)emitter->edge2[i];
    }
    cs_vec_cross_double(e1, e2, normal);
    emitter->area = (float)(0.5 * sqrt(cs_vec_dot_double(normal, normal)));
    return (double)emitter->area * (double)luminance(look->emission);
}

clshear_status cs_scene_emitters(const cs_scene *scene, cs_array *emitters, double *total,
                                 cs_error *error)
{
    const uint32_t *materials = scene->triangle_materials.items;
    const cs_material *looks = scene->materials.items;
    double below = 0.0;
    *total = 0.0;
    for (size_t i = 0; i < scene->indices.count; i++) {
        const cs_material *look = &looks[materials[i]];
        /* What a texture varies is found by rays alone. */
        if (!(luminance(look->emission) > 0.0f) || look->emission_texture > 0) continue;
        cs_emitter *emitter = cs_array_extend(emitters, 1);
        if (emitter == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
        double power = describe_emitter(scene, i, emitter);
        emitter->probability = (float)power;
        *total += power;
    }
    cs_emitter *table = emitters->items;
    for (size_t i = 0; i < emitters->count; i++) {
        below += (double)table[i].probability;
        table[i].cumulative = i + 1 < emitters->count ? (float)(below / *total) : 1.0f;
        /* As the search in the rounded table finds it, so that the estimate stays unbiased. */
        table[i].probability = table[i].cumulative - (i > 0 ? table[i - 1].cumulative : 0.0f);
    }
    return CLSHEAR_OK;
}
