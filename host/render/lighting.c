#include "render/lighting.h"

enum {
    NUMBERS = 6 /* of a light in the settings: position, colour */
};

static clshear_status add(cs_array *lights, const cs_light *light, cs_error *error)
{
    cs_light *added = cs_array_extend(lights, 1);
    if (added == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for lights");
    *added = *light;
    return CLSHEAR_OK;
}

static clshear_status add_point_light(const double *numbers, cs_array *lights, cs_error *error)
{
    cs_light light;
    clshear_light point = {.struct_size = sizeof point, .kind = CLSHEAR_LIGHT_POINT};
    for (int i = 0; i < 3; i++) {
        point.position[i] = (float)numbers[i];
        point.colour[i] = (float)numbers[3 + i];
    }
    clshear_status status = cs_light_make(&point, &light, error);
    return status == CLSHEAR_OK ? add(lights, &light, error) : status;
}

/* All emissive triangles as one light. Their table makes the density of a point its luminance by
 * the whole power. */
static clshear_status add_emitters(const cs_device_scene *world, cs_array *lights, cs_error *error)
{
    const cs_light light = {.kind = CS_LIGHT_TRIANGLES,
                            .count = world->emitters,
                            .parameters = {(float)(1.0 / world->emitted_power)}};
    return world->emitters > 0 ? add(lights, &light, error) : CLSHEAR_OK;
}

static clshear_status collect(const clshear_scene *scene, const clshear_settings *settings,
                              cs_array *lights, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_array *own = &scene->scene.lights;
    const cs_setting_value *added = &settings->values[CS_INDEX_LIGHT];
    for (size_t i = 0; i < own->count; i++)
        CS_TRY(add(lights, (const cs_light *)own->items + i, error));
    for (size_t i = 0; added->is_set && i < added->count; i += NUMBERS)
        CS_TRY(add_point_light(added->numbers + i, lights, error));
    CS_TRY(add_emitters(&scene->device_scene, lights, error));
    if (lights->count == 0) {
        const cs_light fallback = cs_scene_default_light(&scene->scene);
        CS_TRY(add(lights, &fallback, error));
    }
done:
    return status;
}

/* Whether a light is sampled by a pair. */
static int is_area(cs_u32 kind)
{
#define DELTA 0
#define AREA 1
#define EXTENT(identifier, name, suffix, extent) extent,
    static const int extents[CS_LIGHT_KINDS] = {CS_LIGHT_LIST(EXTENT)};
#undef EXTENT
#undef DELTA
#undef AREA
    return extents[kind];
}

clshear_status cs_lighting_make(const clshear_scene *scene, const clshear_settings *settings,
                                cs_lighting *lighting, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array lights = {.item_size = sizeof(cs_light)};
    CS_TRY(collect(scene, settings, &lights, error));
    lighting->count = (cs_u32)lights.count;
    for (size_t i = 0; i < lights.count; i++)
        lighting->area_count += (cs_u32)is_area(((const cs_light *)lights.items)[i].kind);
    CS_TRY(cs_buffer_create(scene->context->device, lights.count * lights.item_size, lights.items,
                            &lighting->lights, error));
done:
    cs_array_free(&lights);
    return status;
}

void cs_lighting_free(cs_lighting *lighting)
{
    cs_buffer_free(lighting->lights);
    *lighting = (cs_lighting){0};
}

void cs_lit_buffers(const clshear_scene *scene, const cs_lighting *lighting,
                    const cs_buffer *buffers[CS_SCENE_BUFFERS])
{
    for (int i = 0; i < CS_SCENE_BUFFERS; i++)
        buffers[i] = scene->device_scene.buffers[i];
    buffers[CS_SCENE_LIGHTS] = lighting->lights;
}
