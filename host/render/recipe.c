#include "render/recipe.h"

#include <stdio.h>
#include <string.h>

#include "clshear/device/hash.h"
#include "film/film.h"

/* Adds bytes to a fingerprint, four at a time. */
static void add_words(cs_u32 *fingerprint, const void *items, size_t size)
{
    for (size_t i = 0; i < size; i += 4) {
        cs_u32 word = 0;
        memcpy(&word, (const char *)items + i, size - i < 4 ? size - i : 4);
        *fingerprint = cs_key(*fingerprint, word);
    }
}

static void add_array(cs_u32 *fingerprint, const cs_array *array)
{
    add_words(fingerprint, array->items, array->count * array->item_size);
}

/* The lights of the settings; those that are not set change nothing. */
static void add_lights(cs_u32 *fingerprint, const clshear_settings *settings)
{
    static const size_t indices[] = {
#define INDEX(identifier, suffix) CS_INDEX_##identifier,
        CS_LIGHT_SETTING_LIST(INDEX)
#undef INDEX
    };
    for (size_t i = 0; i < sizeof indices / sizeof *indices; i++) {
        const cs_setting_value *value = &settings->values[indices[i]];
        if (value->is_set)
            add_words(fingerprint, value->numbers, value->count * sizeof *value->numbers);
    }
}

void cs_recipe_of(const cs_job *job, char *text, size_t size)
{
    const cs_scene *scene = &job->scene->scene;
    cs_u32 lens = 0, light = 0, world = 0;
    add_array(&lens, &job->optics.table);
    add_array(&light, &scene->lights);
    add_lights(&light, &job->settings);
    add_array(&world, &scene->positions);
    add_array(&world, &scene->vertices);
    add_array(&world, &scene->positions_to);
    add_array(&world, &scene->normals_to);
    add_array(&world, &scene->colours);
    add_array(&world, &scene->indices);
    add_array(&world, &scene->triangle_materials);
    add_array(&world, &scene->triangle_flags);
    add_array(&world, &scene->materials);
    add_array(&world, &scene->textures);
    add_array(&world, &scene->texels);
    cs_record_list(&job->settings, CS_USE_RECIPE, text, size);
    size_t used = strlen(text);
    used += (size_t)snprintf(text + used, size - used, "lens table=%08x;lights=%08x;", lens, light);
    if (job->lighting.environment != NULL && used < size)
        used += (size_t)snprintf(text + used, size - used, "environment image=%08x;",
                                 job->lighting.environment_fingerprint);
    if (used < size) snprintf(text + used, size - used, "scene=%08x", world);
}

/* The picture that is extended. */
static cs_u32 base_of(const cs_job *job)
{
    cs_u32 print = 0;
    for (size_t c = 0; job->base != NULL && c < job->base->channels.count; c++) {
        const cs_channel *channel = (const cs_channel *)job->base->channels.items + c;
        add_words(&print, channel->pixels, job->pixel_count * sizeof *channel->pixels);
    }
    return print;
}

void cs_recipe_of_state(const cs_job *job, char *text, size_t size)
{
    static const size_t others[] = {CS_INDEX_CROP, CS_INDEX_SHARD, CS_INDEX_EXTENDABLE,
                                    CS_INDEX_KEEP_PATTERNS, CS_INDEX_GAIN};
    char value[256];
    size_t used =
        (size_t)snprintf(text, size, "version=%s;packet=%d;base=%08x;", CLSHEAR_VERSION_STRING,
                         cs_device_packet(job->scene->context->device), base_of(job));
    for (size_t i = 0; i < sizeof others / sizeof *others && used < size; i++) {
        cs_settings_print(&job->settings, others[i], value, sizeof value);
        used += (size_t)snprintf(text + used, size - used, "%s=%s;",
                                 cs_setting_table[others[i]].name, value);
    }
    if (used < size) cs_record_list(&job->settings, CS_USE_RECORD, text + used, size - used);
    used = strlen(text);
    cs_recipe_of(job, text + used, size - used);
}
