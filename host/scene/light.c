/* Lights of a scene: added ones, the default one, and the table of emissive triangles. */
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "scene/scene.h"

_Static_assert((int)CLSHEAR_LIGHT_POINT == CS_LIGHT_POINT, "kinds are cast");
_Static_assert((int)CLSHEAR_LIGHT_DIRECTIONAL == CS_LIGHT_DIRECTIONAL, "kinds are cast");

int cs_is_colour(const float *colour)
{
    int good = 1;
    for (int c = 0; c < 3; c++)
        good &= colour[c] >= 0.0f && colour[c] <= 1e15f;
    return good;
}

clshear_status cs_light_make(const clshear_light *light, cs_light *made, cs_error *error)
{
    const int directional = light->kind == CLSHEAR_LIGHT_DIRECTIONAL;
    const float *vector = directional ? light->direction : light->position;
    if (!directional && light->kind != CLSHEAR_LIGHT_POINT)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "light: kind %d is not known",
                       (int)light->kind);
    if (!isfinite(vector[0]) || !isfinite(vector[1]) || !isfinite(vector[2]))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "light: its position must be finite");
    if (!cs_is_colour(light->colour))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "light: colour %g,%g,%g: must be 0 to 1e15",
                       (double)light->colour[0], (double)light->colour[1],
                       (double)light->colour[2]);
    float length = 1.0f;
    if (directional) {
        length = sqrtf(cs_vec_dot(vector, vector));
        if (length == 0.0f)
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "light: its direction has no length");
    }
    memset(made, 0, sizeof *made);
    made->kind = (cs_u32)light->kind;
    float *place = directional ? made->axis : made->position;
    for (int i = 0; i < 3; i++) {
        place[i] = vector[i] / length;
        made->colour[i] = light->colour[i];
    }
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

cs_light cs_scene_default_light(const cs_scene *scene)
{
    cs_light light;
    memset(&light, 0, sizeof light);
    light.kind = CS_LIGHT_POINT;
    float square = 0.0f, largest = 0.0f;
    for (int axis = 0; axis < 3; axis++)
        largest = fmaxf(largest, scene->bounds[1][axis] - scene->bounds[0][axis]);
    for (int axis = 0; axis < 3; axis++) {
        float low = scene->bounds[0][axis], high = scene->bounds[1][axis];
        light.position[axis] = axis == 1 ? low + 0.95f * (high - low) : 0.5f * (low + high);
        /* Flat scenes are lit from above or from the front, not from within their plane. */
        if (axis > 0 && high - low < 0.1f * largest) light.position[axis] = high + 0.5f * largest;
        square += 0.25f * (high - low) * (high - low);
    }
    /* A white surface that faces the light from half a diagonal away has radiance 1. */
    for (int c = 0; c < 3; c++)
        light.colour[c] = CS_PI * square;
    return light;
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
        if (!(luminance(looks[materials[i]].emission) > 0.0f)) continue;
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
