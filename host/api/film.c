/* Public functions of films. */
#include <math.h>
#include <stdio.h>

#include "api/arguments.h"
#include "film/film.h"
#include "film/merge.h"
#include "film/shards.h"
#include "image/image_io.h"

void clshear_film_describe(const clshear_film *film, clshear_film_info *info)
{
    if (film != NULL) cs_struct_out(info, &film->info, sizeof film->info);
}

const char *clshear_film_channel_name(const clshear_film *film, size_t index)
{
    return film != NULL ? cs_film_channel_name(film, index) : NULL;
}

const float *clshear_film_channel(const clshear_film *film, const char *name)
{
    return film != NULL && name != NULL ? cs_film_channel(film, name) : NULL;
}

clshear_status clshear_film_copy(clshear_film *film, const char *const *channels, size_t count,
                                 void *target, size_t pixel_stride, size_t row_stride)
{
    CS_NEEDS(film);
    CS_NEEDS(channels);
    CS_NEEDS(target);
    for (size_t i = 0; i < count; i++)
        CS_NEEDS(channels[i]);
    return cs_message_keep(&film->message,
                           cs_film_copy(film, channels, count, target, pixel_stride, row_stride));
}

double clshear_film_mean_variance(const clshear_film *film)
{
    if (film == NULL) return NAN;
    const size_t pixels = (size_t)film->info.width * (size_t)film->info.height;
    double sum = 0.0;
    for (const char *colour = "RGB"; *colour != '\0'; colour++) {
        char name[16];
        snprintf(name, sizeof name, "Variance.%c", *colour);
        const float *plane = cs_film_channel(film, name);
        if (plane == NULL) return NAN;
        for (size_t i = 0; i < pixels; i++)
            sum += (double)plane[i];
    }
    return sum / (3.0 * (double)pixels);
}

clshear_status clshear_film_annotate(clshear_film *film, const char *name, const char *text)
{
    CS_NEEDS(film);
    CS_NEEDS(name);
    CS_NEEDS(text);
    clshear_status status = cs_film_check_name(film, name);
    if (status == CLSHEAR_OK) status = cs_film_annotate(film, name, text);
    return cs_message_keep(&film->message, status);
}

const char *clshear_film_text(const clshear_film *film, const char *name)
{
    return film != NULL && name != NULL ? cs_film_text(film, name) : NULL;
}

const char *clshear_film_text_name(const clshear_film *film, size_t index)
{
    return film != NULL ? cs_film_text_name(film, index) : NULL;
}

clshear_status clshear_film_merge(const clshear_film *const *films, size_t count,
                                  clshear_film **merged)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(films);
    CS_NEEDS(merged);
    if (count == 0)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "there are no films to merge");
    for (size_t i = 0; i < count; i++)
        CS_NEEDS(films[i]);
    return cs_film_merge(films, count, merged, cs_thread_error());
}

void clshear_film_missing(const clshear_film *film, char *text, size_t size)
{
    cs_shards shards;
    if (text == NULL || size == 0) return;
    *text = '\0';
    const char *held = film != NULL ? cs_film_text(film, "clshear.shard") : NULL;
    if (held == NULL) return;
    if (cs_shards_read(held, &shards, cs_thread_error()) != CLSHEAR_OK) {
        snprintf(text, size, "?");
        return;
    }
    cs_shards_print(&shards, 0, text, size);
    cs_shards_free(&shards);
}

clshear_status clshear_film_read(const char *path, clshear_film **film)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS_NAME(path);
    CS_NEEDS(film);
    return cs_film_read(path, cs_thread_error(), film);
}

clshear_status clshear_film_write(clshear_film *film, const char *path)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(film);
    CS_NEEDS_NAME(path);
    return cs_message_keep(&film->message, cs_film_write(film, path));
}

clshear_status clshear_film_check_path(const char *path, int width, int height)
{
    CS_NEEDS_NAME(path);
    return cs_image_check(path, width, height, cs_thread_error());
}

clshear_status clshear_film_write_ratio(clshear_film *film, const char *channel, const char *path)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(film);
    CS_NEEDS(channel);
    CS_NEEDS_NAME(path);
    return cs_message_keep(&film->message, cs_film_write_ratio(film, channel, path));
}

const char *clshear_film_message(const clshear_film *film)
{
    return film != NULL ? cs_message_text(&film->message) : "";
}

void clshear_film_free(clshear_film *film)
{
    cs_film_free(film);
}
