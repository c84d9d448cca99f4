/* Ratios in false colours. */
#include <math.h>
#include <stdlib.h>

#include "film/film.h"

/* Blue below 1, white at 1, orange above, in linear light. All kinds of colour vision can
 * distinguish these. */
static void colour_of(float ratio, float *rgb)
{
    static const float low[3] = {0.0f, 0.15f, 0.6f}, high[3] = {0.8f, 0.2f, 0.0f};
    float place = ratio > 0.0f ? log2f(ratio) / 4.0f : -1.0f;
    if (!(place > -1.0f)) place = -1.0f;
    if (place > 1.0f) place = 1.0f;
    const float *end = place < 0.0f ? low : high;
    for (int c = 0; c < 3; c++)
        rgb[c] = 1.0f + fabsf(place) * (end[c] - 1.0f);
}

clshear_status cs_film_write_ratio(clshear_film *film, const char *channel, const char *path)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    static const char *const names[3] = {"R", "G", "B"};
    const size_t pixels = (size_t)film->info.width * (size_t)film->info.height;
    const float *values = cs_film_channel(film, channel);
    float *planes = malloc(3 * pixels * sizeof *planes);
    CS_REQUIRE(planes != NULL, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    CS_REQUIRE(values != NULL, CLSHEAR_BAD_ARGUMENT, "%s: the film has no channel %s", path,
               channel);
    CS_TRY(cs_image_check(path, film->info.width, film->info.height, error));
    for (size_t i = 0; i < pixels; i++) {
        float rgb[3];
        colour_of(values[i], rgb);
        for (size_t c = 0; c < 3; c++)
            planes[c * pixels + i] = rgb[c];
    }
    const float *list[3] = {planes, planes + pixels, planes + 2 * pixels};
    const cs_picture picture = {.width = film->info.width,
                                .height = film->info.height,
                                .full_width = film->info.width,
                                .full_height = film->info.height,
                                .channel_count = 3,
                                .names = names,
                                .planes = list};
    CS_TRY(cs_image_write(path, &picture, error));
done:
    free(planes);
    return status;
}
