/* The table of emissive triangles. */
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "scene/scene.h"

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

/* What a texture varies is found by rays alone. */
int cs_scene_is_emitter(const cs_scene *scene, size_t triangle)
{
    const uint32_t material = ((const uint32_t *)scene->triangle_materials.items)[triangle];
    const cs_material *look = (const cs_material *)scene->materials.items + material;
    return luminance(look->emission) > 0.0f && look->emission_texture == 0;
}

clshear_status cs_scene_emitters(const cs_scene *scene, cs_array *emitters, double *total,
                                 cs_error *error)
{
    double below = 0.0;
    *total = 0.0;
    for (size_t i = 0; i < scene->indices.count; i++) {
        if (!cs_scene_is_emitter(scene, i)) continue;
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
