#include "render/lighting.h"

#include <stdlib.h>
#include <string.h>

enum {
    NUMBERS = 6 /* of a light in the settings: position, colour */
};

/* Settings are in coordinates of the file. */
static clshear_status point_light(const double *numbers, const double *origin, cs_light *light,
                                  cs_error *error)
{
    clshear_light point = {.struct_size = sizeof point, .kind = CLSHEAR_LIGHT_POINT};
    for (int i = 0; i < 3; i++) {
        point.position[i] = (float)(numbers[i] - origin[i]);
        point.colour[i] = (float)numbers[3 + i];
    }
    return cs_light_make(&point, light, error);
}

clshear_status cs_lighting_make(const clshear_scene *scene, const clshear_settings *settings,
                                cs_lighting *lighting, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_setting_value *added = &settings->values[CS_INDEX_LIGHT];
    const cs_array *own = &scene->scene.lights;
    cs_light *all = NULL;
    if (!added->is_set) {
        lighting->lights = cs_buffer_retain(scene->device_scene.buffers[CS_SCENE_LIGHTS]);
        lighting->count = scene->device_scene.lights;
        return CLSHEAR_OK;
    }
    const size_t count = own->count + added->count / NUMBERS;
    all = malloc(count * sizeof *all);
    CS_REQUIRE(all != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu lights", count);
    if (own->count > 0) memcpy(all, own->items, own->count * sizeof *all);
    for (size_t i = own->count; i < count; i++)
        CS_TRY(point_light(added->numbers + NUMBERS * (i - own->count), scene->scene.origin,
                           &all[i], error));
    CS_TRY(cs_buffer_create(scene->context->device, count * sizeof *all, all, &lighting->lights,
                            error));
    lighting->count = (cs_u32)count;
done:
    free(all);
    return status;
}

void cs_lighting_free(cs_lighting *lighting)
{
    cs_buffer_free(lighting->lights);
    *lighting = (cs_lighting){0};
}
