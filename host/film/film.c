#include "film/film.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "clshear/clshear.h"
#include "film/shards.h"

clshear_status cs_film_create(const int *window, int full_width, int full_height, cs_error *error,
                              clshear_film **result)
{
    clshear_film *film = calloc(1, sizeof *film);
    if (film == NULL) {
        cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
        return CLSHEAR_OUT_OF_MEMORY;
    }
    cs_message_init(&film->message);
    film->info.complete = 1;
    film->channels.item_size = sizeof(cs_channel);
    film->attributes.item_size = sizeof(cs_attribute);
    memcpy(film->info.window, window, sizeof film->info.window);
    film->info.full_width = full_width;
    film->info.full_height = full_height;
    film->info.width = window[1] - window[0];
    film->info.height = window[3] - window[2];
    *result = film;
    return CLSHEAR_OK;
}

float *cs_film_add_channel(clshear_film *film, const char *name)
{
    size_t count = (size_t)film->info.width * (size_t)film->info.height;
    float *pixels = calloc(count, sizeof *pixels);
    cs_channel *channel = pixels != NULL ? cs_array_extend(&film->channels, 1) : NULL;
    if (channel == NULL) {
        free(pixels);
        return NULL;
    }
    snprintf(channel->name, sizeof channel->name, "%s", name);
    channel->pixels = pixels;
    film->info.channels = film->channels.count;
    return pixels;
}

/* The attribute of that name, emptied, or a new one. Returns NULL when out of memory. */
static cs_attribute *attribute_named(clshear_film *film, const char *name)
{
    cs_attribute *attributes = film->attributes.items;
    for (size_t i = 0; i < film->attributes.count; i++)
        if (strncmp(attributes[i].name, name, sizeof attributes[i].name - 1) == 0) {
            free(attributes[i].text);
            attributes[i].text = NULL;
            return &attributes[i];
        }
    cs_attribute *added = cs_array_extend(&film->attributes, 1);
    if (added != NULL) snprintf(added->name, sizeof added->name, "%s", name);
    return added;
}

static clshear_status out_of_memory(void)
{
    return cs_fail(cs_thread_error(), CLSHEAR_OUT_OF_MEMORY, "out of memory for metadata");
}

clshear_status cs_film_set_int(clshear_film *film, const char *name, int32_t value)
{
    cs_attribute *attribute = attribute_named(film, name);
    if (attribute == NULL) return out_of_memory();
    attribute->kind = CS_ATTRIBUTE_INT;
    attribute->integer = value;
    return CLSHEAR_OK;
}

clshear_status cs_film_set_float(clshear_film *film, const char *name, float value)
{
    cs_attribute *attribute = attribute_named(film, name);
    if (attribute == NULL) return out_of_memory();
    attribute->kind = CS_ATTRIBUTE_FLOAT;
    attribute->numbers[0] = value;
    return CLSHEAR_OK;
}

clshear_status cs_film_set_matrix(clshear_film *film, const char *name, const float *matrix)
{
    cs_attribute *attribute = attribute_named(film, name);
    if (attribute == NULL) return out_of_memory();
    attribute->kind = CS_ATTRIBUTE_MATRIX;
    memcpy(attribute->numbers, matrix, sizeof attribute->numbers);
    return CLSHEAR_OK;
}

clshear_status cs_film_annotate(clshear_film *film, const char *name, const char *text)
{
    char *copy = strdup(text);
    cs_attribute *attribute = copy != NULL ? attribute_named(film, name) : NULL;
    if (attribute == NULL) {
        free(copy);
        return out_of_memory();
    }
    attribute->kind = CS_ATTRIBUTE_TEXT;
    attribute->text = copy;
    return CLSHEAR_OK;
}

const char *cs_film_text(const clshear_film *film, const char *name)
{
    const cs_attribute *attributes = film->attributes.items;
    for (size_t i = 0; i < film->attributes.count; i++)
        if (attributes[i].kind == CS_ATTRIBUTE_TEXT && strcmp(attributes[i].name, name) == 0)
            return attributes[i].text;
    return NULL;
}

int cs_film_int(const clshear_film *film, const char *name, int *value)
{
    const cs_attribute *attributes = film->attributes.items;
    for (size_t i = 0; i < film->attributes.count; i++)
        if (attributes[i].kind == CS_ATTRIBUTE_INT && strcmp(attributes[i].name, name) == 0) {
            *value = attributes[i].integer;
            return 1;
        }
    return 0;
}

float cs_film_float(const clshear_film *film, const char *name)
{
    const cs_attribute *attributes = film->attributes.items;
    for (size_t i = 0; i < film->attributes.count; i++)
        if (attributes[i].kind == CS_ATTRIBUTE_FLOAT && strcmp(attributes[i].name, name) == 0)
            return attributes[i].numbers[0];
    return 0.0f;
}

const char *cs_film_channel_name(const clshear_film *film, size_t index)
{
    const cs_channel *channels = film->channels.items;
    return index < film->channels.count ? channels[index].name : NULL;
}

const float *cs_film_channel(const clshear_film *film, const char *name)
{
    const cs_channel *channels = film->channels.items;
    for (size_t i = 0; i < film->channels.count; i++)
        if (strcmp(channels[i].name, name) == 0) return channels[i].pixels;
    return NULL;
}

/* The tone that the settings in the metadata ask for. */
static cs_tone tone_of(const clshear_film *film)
{
    cs_tone tone = {.exposure = cs_film_float(film, "clshear.exposure")};
    cs_film_int(film, "clshear.autoExposure", &tone.is_auto);
    const char *curve = cs_film_text(film, "clshear.tone");
#define CS_TONE_NAMED(identifier, number, name, meaning) \
    if (curve != NULL && strcmp(curve, name) == 0) tone.curve = CLSHEAR_TONE_##identifier;
    CLSHEAR_TONE_LIST(CS_TONE_NAMED)
#undef CS_TONE_NAMED
    return tone;
}

static clshear_status write_channels(const clshear_film *film, const char *path, const char **names,
                                     const float **planes)
{
    const cs_channel *channels = film->channels.items;
    for (size_t i = 0; i < film->channels.count; i++) {
        names[i] = channels[i].name;
        planes[i] = channels[i].pixels;
    }
    const cs_picture picture = {
        .width = film->info.width,
        .height = film->info.height,
        .x = film->info.window[0],
        .y = film->info.window[2],
        .full_width = film->info.full_width,
        .full_height = film->info.full_height,
        .channel_count = film->channels.count,
        .names = names,
        .planes = planes,
        .attribute_count = film->attributes.count,
        .attributes = film->attributes.items,
        .tone = tone_of(film),
    };
    return cs_image_write(path, &picture, cs_thread_error());
}

clshear_status cs_film_write(clshear_film *film, const char *path)
{
    clshear_status status =
        cs_image_check(path, film->info.width, film->info.height, cs_thread_error());
    if (status != CLSHEAR_OK) return status;
    const char **names = malloc(film->channels.count * sizeof *names);
    const float **planes = malloc(film->channels.count * sizeof *planes);
    status = names != NULL && planes != NULL
                 ? write_channels(film, path, names, planes)
                 : cs_fail(cs_thread_error(), CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    free(names);
    free(planes);
    return status;
}

static clshear_status copy_attribute(clshear_film *film, const cs_attribute *from)
{
    switch (from->kind) {
    case CS_ATTRIBUTE_TEXT:
        return cs_film_annotate(film, from->name, from->text);
    case CS_ATTRIBUTE_INT:
        return cs_film_set_int(film, from->name, from->integer);
    case CS_ATTRIBUTE_MATRIX:
        return cs_film_set_matrix(film, from->name, from->numbers);
    default:
        return cs_film_set_float(film, from->name, from->numbers[0]);
    }
}

clshear_status cs_film_copy_attributes(const clshear_film *from, clshear_film *to)
{
    const cs_attribute *attributes = from->attributes.items;
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; status == CLSHEAR_OK && i < from->attributes.count; i++)
        status = copy_attribute(to, &attributes[i]);
    return status;
}

static clshear_status copy_picture(clshear_film *film, const cs_picture *picture)
{
    const size_t pixels = (size_t)picture->width * (size_t)picture->height;
    for (size_t c = 0; c < picture->channel_count; c++) {
        float *plane = cs_film_add_channel(film, picture->names[c]);
        if (plane == NULL) return out_of_memory();
        memcpy(plane, picture->planes[c], pixels * sizeof *plane);
    }
    for (size_t i = 0; i < picture->attribute_count; i++) {
        const clshear_status status = copy_attribute(film, &picture->attributes[i]);
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}

/* Whether a film that was read has all of its shards: one by itself is a whole render. */
static int has_its_shards(const clshear_film *film)
{
    cs_shards shards;
    cs_error unused;
    const char *text = cs_film_text(film, "clshear.shard");
    if (text == NULL) return 1;
    if (cs_shards_read(text, &shards, &unused) != CLSHEAR_OK) return 0;
    const int whole = shards.held == 1 || shards.held == shards.count;
    cs_shards_free(&shards);
    return whole;
}

/* Sets the samples, the time and the completeness in `info` of a film that was read, from its
 * channels and metadata. */
static void recall_info(clshear_film *film)
{
    const float *samples = cs_film_channel(film, "Samples");
    const size_t pixels = (size_t)film->info.width * (size_t)film->info.height;
    int is_interrupted = 0;
    for (size_t i = 0; samples != NULL && i < pixels; i++)
        if (samples[i] > 0.0f && samples[i] <= 2e9f) film->info.samples += (uint64_t)samples[i];
    cs_film_int(film, "clshear.interrupted", &is_interrupted);
    film->info.complete = !is_interrupted && has_its_shards(film);
    film->info.render_s = (double)cs_film_float(film, "renderTimeSeconds");
}

clshear_status cs_film_read(const char *path, cs_error *error, clshear_film **result)
{
    clshear_status status = CLSHEAR_OK;
    cs_loaded_picture loaded = {0};
    clshear_film *film = NULL;
    CS_TRY(cs_image_read(path, &loaded, error));
    const cs_picture *p = &loaded.picture;
    const int window[4] = {p->x, p->x + p->width, p->y, p->y + p->height};
    CS_TRY(cs_film_create(window, p->full_width, p->full_height, error, &film));
    CS_TRY(copy_picture(film, p));
    recall_info(film);
    film->path = strdup(path);
    CS_REQUIRE(film->path != NULL, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    *result = film;
    film = NULL;
done:
    cs_image_free(&loaded);
    cs_film_free(film);
    return status;
}

void cs_film_free(clshear_film *film)
{
    if (film == NULL) return;
    cs_channel *channels = film->channels.items;
    for (size_t i = 0; i < film->channels.count; i++)
        free(channels[i].pixels);
    cs_attribute *attributes = film->attributes.items;
    for (size_t i = 0; i < film->attributes.count; i++)
        free(attributes[i].text);
    cs_message_destroy(&film->message);
    cs_array_free(&film->channels);
    cs_array_free(&film->attributes);
    free(film->path);
    free(film);
}

static void copy_channel(const clshear_film *film, const float *plane, char *target,
                         size_t pixel_stride, size_t row_stride)
{
    for (size_t y = 0; y < (size_t)film->info.height; y++)
        for (size_t x = 0; x < (size_t)film->info.width; x++)
            memcpy(target + y * row_stride + x * pixel_stride,
                   &plane[y * (size_t)film->info.width + x], sizeof *plane);
}

clshear_status cs_film_copy(const clshear_film *film, const char *const *channels, size_t count,
                            void *target, size_t pixel_stride, size_t row_stride)
{
    cs_error *error = cs_thread_error();
    const size_t row = (size_t)(film->info.width - 1) * pixel_stride + count * sizeof(float);
    if (pixel_stride < count * sizeof(float) || (film->info.height > 1 && row_stride < row))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "strides of %zu and %zu bytes: too small for %zu channels of %d pixels",
                       pixel_stride, row_stride, count, film->info.width);
    for (size_t c = 0; c < count; c++) {
        if (cs_film_channel(film, channels[c]) == NULL)
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "the film has no channel %s", channels[c]);
    }
    for (size_t c = 0; c < count; c++)
        copy_channel(film, cs_film_channel(film, channels[c]), (char *)target + c * sizeof(float),
                     pixel_stride, row_stride);
    return CLSHEAR_OK;
}
