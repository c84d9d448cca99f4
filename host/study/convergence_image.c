/* Convergence of whole images, tile by tile. */
#include <stdlib.h>
#include <string.h>

#include "render/render.h"
#include "study/convergence.h"

enum {
    TILE = 8 /* side of a tile, px */
};

static const char *const colours[] = {"R", "G", "B"};

/* The division of an image into tiles. The bootstrap resamples the tiles. */
typedef struct tiling {
    size_t width; /* px */
    size_t height;
    size_t columns;
    size_t tiles;
} tiling;

static tiling tiling_of(const clshear_settings *settings)
{
    const double *crop = cs_numbers(settings, CROP);
    const int whole = !cs_is_set(settings, CROP);
    tiling t;
    t.width = (size_t)(whole ? cs_number(settings, WIDTH) : crop[1] - crop[0]);
    t.height = (size_t)(whole ? cs_number(settings, HEIGHT) : crop[3] - crop[2]);
    t.columns = (t.width + TILE - 1) / TILE;
    t.tiles = t.columns * ((t.height + TILE - 1) / TILE);
    return t;
}

/* Writes the error of one pattern in each pixel, the mean over the colours, to `map`: its variance,
 * plus the squared difference of the mean from the reference (NULL: none) beyond the mean's own
 * variance. Adds it to the tiles' sums. Returns the image's mean. */
static double map_errors(const clshear_film *film, const clshear_film *reference,
                         uint32_t replicates, size_t columns, float *map, double *tiles)
{
    static const char *const planes[] = {"Variance.R", "Variance.G", "Variance.B"};
    const size_t width = (size_t)film->info.width, pixels = width * (size_t)film->info.height;
    double mean = 0.0;
    for (int c = 0; c < 3; c++) {
        const float *variance = cs_film_channel(film, planes[c]);
        const float *value = cs_film_channel(film, colours[c]);
        const float *truth = reference != NULL ? cs_film_channel(reference, colours[c]) : NULL;
        for (size_t i = 0; i < pixels; i++) {
            const double off = truth != NULL ? (double)value[i] - (double)truth[i] : 0.0;
            const double own = truth != NULL ? (double)variance[i] : 0.0;
            const double error = ((double)variance[i] * replicates + off * off - own) / 3.0;
            tiles[i / width / TILE * columns + i % width / TILE] += error;
            map[i] += (float)error;
            mean += (double)value[i] / (3.0 * (double)pixels);
        }
    }
    return mean;
}

static clshear_status check_reference(const clshear_film *reference, const tiling *t,
                                      cs_error *error)
{
    for (int c = 0; c < 3 && reference != NULL; c++)
        if (cs_film_channel(reference, colours[c]) == NULL)
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "the reference has no channel %s: it needs R, G and B", colours[c]);
    if (reference == NULL ||
        ((size_t)reference->info.width == t->width && (size_t)reference->info.height == t->height))
        return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                   "the reference has %d x %d pixels: it needs the image's size, %zu x %zu",
                   reference->info.width, reference->info.height, t->width, t->height);
}

/* Renders the image with the samples of size number `size` in each pattern. `part` has an entry per
 * tile, initially 0; on return its mean is the mean error of a pixel. */
static clshear_status render_size(clshear_scene *scene, const clshear_settings *given,
                                  const cs_study *study, const tiling *t,
                                  const clshear_film *reference, size_t size,
                                  clshear_convergence *result, double *part, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    clshear_settings settings = {0};
    clshear_film *film = NULL;
    CS_TRY(cs_study_settings(given, study, study->counts[size], &settings, error));
    CS_TRY(cs_render(scene, &settings, NULL, &film, error));
    CS_REQUIRE(film->info.complete, CLSHEAR_BAD_ARGUMENT, "stopped by the progress callback");
    result->counts[size] =
        (uint32_t)(*cs_film_channel(film, "Samples") / (float)study->replicates + 0.5f);
    memcpy(result->window, film->info.window, sizeof result->window);
    result->mean = map_errors(film, reference, study->replicates, t->columns,
                              result->maps + size * t->width * t->height, part);
    for (size_t i = 0; i < t->tiles; i++)
        part[i] *= (double)t->tiles / ((double)t->width * (double)t->height);
done:
    cs_film_free(film);
    cs_settings_free(&settings);
    return status;
}

clshear_status cs_converge_image(clshear_scene *scene, const clshear_settings *settings,
                                 const cs_study *study, const clshear_film *reference,
                                 clshear_convergence *result, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    clshear_settings fallbacks = {0};
    tiling t;
    double *parts = NULL;
    CS_TRY(cs_settings_init(&fallbacks, error));
    t = tiling_of(settings != NULL ? settings : &fallbacks);
    parts = calloc((study->sizes + 1) * t.tiles, sizeof *parts);
    CS_REQUIRE(parts != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    CS_REQUIRE(t.tiles >= 2, CLSHEAR_BAD_ARGUMENT,
               "an image of %zu x %zu pixels: an interval needs more than one tile of %d x %d",
               t.width, t.height, TILE, TILE);
    CS_TRY(check_reference(reference, &t, error));
    CS_TRY(cs_convergence_reserve(study, result, error));
    result->maps = calloc(study->sizes * t.width * t.height, sizeof *result->maps);
    CS_REQUIRE(result->maps != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t k = 0; k < study->sizes; k++)
        CS_TRY(render_size(scene, settings, study, &t, reference, k, result, parts + k * t.tiles,
                           error));
    CS_TRY(cs_convergence_fit(parts, t.tiles, 1, NULL, result));
done:
    cs_settings_free(&fallbacks);
    free(parts);
    return status;
}
