#include "render/lighting.h"

#include <string.h>

#include "kernels/features.h"
#include "render/camera_choice.h"
#include "scene/environment.h"

static clshear_status add(cs_array *lights, const cs_light *light, cs_error *error)
{
    cs_light *added = cs_array_extend(lights, 1);
    if (added == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for lights");
    *added = *light;
    return CLSHEAR_OK;
}

static clshear_status add_made(const clshear_light *light, const char *name, cs_array *lights,
                               cs_error *error)
{
    cs_light made;
    clshear_status status = cs_light_make(light, name, &made, error);
    return status == CLSHEAR_OK ? add(lights, &made, error) : status;
}

/* Reads `count` numbers of a vector; returns what follows. */
static const double *take(const double *numbers, int count, float *vector)
{
    for (int i = 0; i < count; i++)
        vector[i] = (float)numbers[i];
    return numbers + count;
}

/* Each fills in a light, but for its position, from one value of its setting, in the order of the
 * flag; returns the place of the colour. */
static const double *read_point(const double *numbers, clshear_light *light)
{
    light->kind = CLSHEAR_LIGHT_POINT;
    return numbers + 3;
}

static const double *read_sun(const double *numbers, clshear_light *light)
{
    light->kind = CLSHEAR_LIGHT_DIRECTIONAL;
    light->diameter_deg = (float)numbers[6];
    return take(numbers, 3, light->direction);
}

static const double *read_sphere(const double *numbers, clshear_light *light)
{
    light->kind = CLSHEAR_LIGHT_SPHERE;
    return take(numbers + 3, 1, &light->radius);
}

static const double *read_quad(const double *numbers, clshear_light *light)
{
    light->kind = CLSHEAR_LIGHT_QUAD;
    return take(take(numbers + 3, 3, light->edge1), 3, light->edge2);
}

static const struct {
    size_t setting;
    const double *(*read)(const double *numbers, clshear_light *light);
} readers[] = {
#define READER(identifier, suffix) {CS_INDEX_##identifier, read_##suffix},
    CS_LIGHT_SETTING_LIST(READER)
#undef READER
};

/* The lights of the settings, which are in coordinates of the file. */
static clshear_status add_settings(const clshear_settings *settings, const double *origin,
                                   cs_array *lights, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    for (size_t r = 0; r < sizeof readers / sizeof *readers; r++) {
        const cs_setting_value *value = &settings->values[readers[r].setting];
        const size_t each = (size_t)cs_setting_table[readers[r].setting].values;
        for (size_t i = 0; value->is_set && i < value->count; i += each) {
            const double *numbers = value->numbers + i;
            clshear_light light = {.struct_size = sizeof light};
            take(readers[r].read(numbers, &light), 3, light.colour);
            for (int c = 0; c < 3; c++)
                light.position[c] = (float)(numbers[c] - origin[c]);
            CS_TRY(add_made(&light, cs_setting_table[readers[r].setting].name, lights, error));
        }
    }
done:
    return status;
}

/* All emissive triangles as one light: by the tree all of them, by power those whose density is
 * their luminance by the whole power. */
static clshear_status add_emitters(const cs_device_scene *world, const clshear_settings *settings,
                                   cs_lighting *lighting, cs_array *lights, cs_error *error)
{
    const int by_power = cs_integer(settings, EMITTERS) == CLSHEAR_EMITTERS_POWER;
    cs_light light = {.kind = CS_LIGHT_TRIANGLES, .count = world->emitters};
    if (by_power ? world->even_emitters == 0 : world->emitters == 0) return CLSHEAR_OK;
    if (by_power)
        light.parameters[0] = (float)(1.0 / world->emitted_power);
    else
        lighting->features |= CS_FEATURE_EMITTERS;
    return add(lights, &light, error);
}

static clshear_status add_environment(const clshear_scene *scene, const clshear_settings *settings,
                                      cs_lighting *lighting, cs_array *lights, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_environment_view view = {.rotation_deg = cs_number(settings, ENVIRONMENT_ROTATION),
                                      .strength = cs_number(settings, ENVIRONMENT_STRENGTH),
                                      .z_up = cs_z_is_up(&scene->scene, settings)};
    const char *text = cs_text(settings, ENVIRONMENT);
    cs_light light;
    if (text == NULL || strcmp(text, "none") == 0) return CLSHEAR_OK;
    CS_TRY(cs_environment_cache_find(&scene->context->environments, scene->context->device, text,
                                     &light, &lighting->environment,
                                     &lighting->environment_fingerprint, error));
    cs_environment_show(&view, &light);
    CS_REQUIRE(cs_is_colour(light.colour), CLSHEAR_BAD_ARGUMENT,
               "environment-strength %g: times the environment's colour it must be at most 1e15",
               view.strength);
    CS_TRY(add(lights, &light, error));
done:
    return status;
}

static clshear_status collect(const clshear_scene *scene, const clshear_settings *settings,
                              cs_lighting *lighting, cs_array *lights, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_array *own = &scene->scene.lights;
    for (size_t i = 0; i < own->count; i++)
        CS_TRY(add(lights, (const cs_light *)own->items + i, error));
    CS_TRY(add_settings(settings, scene->scene.origin, lights, error));
    CS_TRY(add_environment(scene, settings, lighting, lights, error));
    CS_TRY(add_emitters(&scene->device_scene, settings, lighting, lights, error));
done:
    return status;
}

/* What the kinds of light ask of the kernels. */
static const struct {
    int is_area;
    cs_u32 features;
} kinds[CS_LIGHT_KINDS] = {
#define DELTA 0
#define AREA 1
#define FEW(identifier, name, suffix, extent) {extent, 0u},
#define MORE(identifier, name, suffix, extent) {extent, CS_FEATURE_LIGHTS},
    CS_LIGHT_LIST_FEW(FEW) CS_LIGHT_LIST_MORE(MORE)
#undef MORE
#undef FEW
#undef AREA
#undef DELTA
};

clshear_status cs_lighting_make(const clshear_scene *scene, const clshear_settings *settings,
                                cs_lighting *lighting, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array *lights = &lighting->list;
    lights->item_size = sizeof(cs_light);
    CS_TRY(collect(scene, settings, lighting, lights, error));
    lighting->count = (cs_u32)lights->count;
    for (size_t i = 0; i < lights->count; i++) {
        const cs_u32 kind = ((const cs_light *)lights->items)[i].kind;
        lighting->area_count += (cs_u32)kinds[kind].is_area;
        lighting->features |= kinds[kind].features;
    }
    CS_TRY(cs_buffer_create(scene->context->device, lights->count * lights->item_size,
                            lights->items, &lighting->lights, error));
done:
    return status;
}

cs_shapes cs_lighting_shapes(const cs_lighting *lighting)
{
    return (cs_shapes){lighting->list.items, lighting->list.count};
}

void cs_lighting_free(cs_lighting *lighting)
{
    cs_array_free(&lighting->list);
    cs_buffer_free(lighting->lights);
    cs_buffer_free(lighting->environment);
    *lighting = (cs_lighting){0};
}

void cs_lit_buffers(const clshear_scene *scene, const cs_lighting *lighting,
                    const cs_buffer *buffers[CS_SCENE_BUFFERS])
{
    for (int i = 0; i < CS_SCENE_BUFFERS; i++)
        buffers[i] = scene->device_scene.buffers[i];
    buffers[CS_SCENE_LIGHTS] = lighting->lights;
    buffers[CS_SCENE_ENVIRONMENT] = lighting->environment;
    cs_wide_scene_buffers(scene->wide, buffers);
}
