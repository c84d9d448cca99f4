#include "scene/environment.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/number.h"
#include "base/pi.h"
#include "base/vec.h"
#include "image/image_io.h"
#include "scene/environment_tables.h"
#include "scene/scene.h"

enum {
    MOST_CELLS = 1024, /* across; down half as many */
    SKY_WIDTH = 4,     /* texels of a gradient, whose rows are even */
    SKY_HEIGHT = 256
};

static const float most_radiance = 1e15f;

/* An environment of a colour, as it is. */
static void describe(const float *colour, cs_light *light)
{
    *light = (cs_light){.kind = CS_LIGHT_ENVIRONMENT, .parameters = {[3] = 1.0f}};
    memcpy(light->colour, colour, sizeof light->colour);
}

void cs_environment_show(const cs_environment_view *view, cs_light *light)
{
    const double angle = view->rotation_deg * (CS_PI_DOUBLE / 180.0);
    for (int c = 0; c < 3; c++)
        light->colour[c] = (float)((double)light->colour[c] * view->strength);
    light->parameters[3] = (float)cos(angle);
    light->parameters[4] = (float)sin(angle);
    light->axis[1] = view->z_up ? 0.0f : 1.0f;
    light->axis[2] = view->z_up ? 1.0f : 0.0f;
}

/* What a channel of a texel shines: 0 where it is no number or negative. Files of halves have
 * infinity for all that is brighter than the largest half. */
static float radiance_of(float channel)
{
    if (!(channel > 0.0f)) return 0.0f;
    if (isinf(channel)) return CS_LARGEST_HALF;
    return channel > most_radiance ? most_radiance : channel;
}

static void copy_texels(const float *texels, size_t count, float *copy)
{
    for (size_t i = 0; i < 3 * count; i++)
        copy[i] = radiance_of(texels[i]);
}

/* Whether directions that a diffuse surface draws serve better than cells. Over all ways that a
 * surface can face, the second moment of radiance times cosine by density is pi / 4 times the
 * integral of the squared radiance if directions are drawn by the cosine, and a sixth of the square
 * of its integral if by radiance. */
static int is_even(const float *texels, size_t width, size_t height)
{
    double whole = 0.0, square = 0.0;
    for (size_t y = 0; y < height; y++) {
        const double above = cos(CS_PI_DOUBLE * (double)y / (double)height);
        const double below = cos(CS_PI_DOUBLE * (double)(y + 1) / (double)height);
        const double part = (above - below) * 2.0 * CS_PI_DOUBLE / (double)width; /* sr */
        for (size_t x = 0; x < width; x++) {
            const float *texel = texels + 3 * (y * width + x);
            const double luminance =
                cs_luminance_double((double)texel[0], (double)texel[1], (double)texel[2]);
            whole += luminance * part;
            square += luminance * luminance * part;
        }
    }
    return 0.25 * CS_PI_DOUBLE * square < whole * whole / 6.0;
}

/* Cells of the fewest texels each that leave at most `most` of them and are all alike; if that
 * would be very large ones, a cell is a texel. */
static size_t cells_of(size_t texels, size_t most)
{
    for (size_t step = 1; step <= 64; step++)
        if (texels % step == 0 && texels / step <= most) return texels / step;
    return texels;
}

clshear_status cs_environment_make(const float *texels, size_t width, size_t height,
                                   cs_environment *environment, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const float white[3] = {1.0f, 1.0f, 1.0f};
    if (width == 0 || height == 0)
        return cs_fail(error, CLSHEAR_BAD_FILE, "environment: an image without texels");
    environment->image = (cs_array){.item_size = sizeof(cs_f32)};
    float *copy = cs_array_extend(&environment->image, 3 * width * height);
    CS_REQUIRE(copy != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for an environment of %zu x %zu texels", width, height);
    copy_texels(texels, width * height, copy);
    describe(white, &environment->light);
    environment->light.count = (cs_u32)width;
    environment->light.parameters[0] = (float)height;
    if (is_even(copy, width, height)) {
        /* One number at least behind the texels, which are read four at a time. */
        CS_REQUIRE(cs_array_extend(&environment->image, 1) != NULL, CLSHEAR_OUT_OF_MEMORY,
                   "out of memory for an environment");
    } else {
        const size_t across = cells_of(width, MOST_CELLS), down = cells_of(height, MOST_CELLS / 2);
        environment->light.parameters[1] = (float)across;
        environment->light.parameters[2] = (float)down;
        CS_TRY(cs_environment_tabulate(width, height, across, down, &environment->image, error));
    }
done:
    return status;
}

/* Whether the text is so many numbers with commas between them, around which blanks may stand, and
 * nothing else. */
static int read_numbers(const char *text, int count, float *numbers)
{
    const char *end = text + strlen(text);
    for (int i = 0; i < count; i++) {
        double number = 0.0;
        if (i > 0) text += strspn(text, " \t");
        if (i > 0 && *text++ != ',') return 0;
        text += strspn(text, " \t");
        const char *behind = cs_parse_number(text, end, &number);
        if (behind == text) return 0;
        numbers[i] = (float)number;
        text = behind;
    }
    return text == end;
}

/* A sky: `colours` has its zenith and its horizon, which the ground continues. In between, radiance
 * is linear in the sine of the elevation, so that a surface that faces up is lit in closed form. */
static clshear_status make_gradient(const float *colours, cs_environment *environment,
                                    cs_error *error)
{
    float texels[3 * SKY_WIDTH * SKY_HEIGHT];
    for (int y = 0; y < SKY_HEIGHT; y++) {
        const double sine = cos(CS_PI_DOUBLE * ((double)y + 0.5) / (double)SKY_HEIGHT);
        const float up = (float)(sine > 0.0 ? sine : 0.0);
        for (int i = 0; i < 3 * SKY_WIDTH; i++)
            texels[3 * SKY_WIDTH * y + i] = up * colours[i % 3] + (1.0f - up) * colours[3 + i % 3];
    }
    return cs_environment_make(texels, SKY_WIDTH, SKY_HEIGHT, environment, error);
}

/* Whether the text is a gradient: this word and six numbers. */
static int read_gradient(const char *text, float *colours)
{
    static const char word[] = "gradient:";
    return strncmp(text, word, sizeof word - 1) == 0 &&
           read_numbers(text + sizeof word - 1, 6, colours);
}

clshear_status cs_environment_read(const char *text, cs_environment *environment, cs_error *error)
{
    float colour[3], sky[6], *texels = NULL;
    size_t width = 0, height = 0;
    if (read_numbers(text, 3, colour)) {
        if (!cs_is_colour(colour))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "environment %.60s: must be three numbers, 0 to 1e15", text);
        environment->image = (cs_array){.item_size = sizeof(cs_f32)};
        describe(colour, &environment->light);
        return CLSHEAR_OK;
    }
    if (read_gradient(text, sky)) {
        if (!cs_is_colour(sky) || !cs_is_colour(sky + 3))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "environment %.120s: must be six numbers, 0 to 1e15", text);
        return make_gradient(sky, environment, error);
    }
    if (access(text, R_OK) != 0)
        return cs_fail(error, CLSHEAR_BAD_FILE,
                       "environment %.200s: neither R,G,B nor a file "
                       "that can be read: %s",
                       text, strerror(errno));
    clshear_status status = cs_image_read_colours(text, &texels, &width, &height, error);
    if (status == CLSHEAR_OK)
        status = cs_environment_make(texels, width, height, environment, error);
    free(texels);
    return status;
}

void cs_environment_free(cs_environment *environment)
{
    cs_array_free(&environment->image);
}
