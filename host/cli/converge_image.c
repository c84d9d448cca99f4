#include "cli/converge_image.h"

#include <stdlib.h>
#include <string.h>

enum {
    TILE = 8 /* pixels along the side of a part */
};

static const char *const colours[] = {"R", "G", "B"};

static int fail(const char *message)
{
    fprintf(stderr, "clshear: %s\n", message);
    return CLI_FAILED;
}

clshear_options cli_converge_options(const cli_converge_job *job, const char *sampler,
                                     clshear_shear shear, uint32_t pattern)
{
    clshear_options options = job->render.options;
    const double samples = (double)pattern * job->replicates;
    options.sampler = sampler;
    options.shear = shear;
    options.replicates = job->replicates;
    options.spp = samples < 2e9 ? pattern * job->replicates : 2000000001u; /* which is refused */
    options.adaptive = options.gain = options.extendable = 0; /* what is measured is one pattern */
    if (options.oracle == CLSHEAR_ORACLE_PILOT) options.oracle = CLSHEAR_ORACLE_CENTRE;
    return options;
}

/* Adds the variance of one pattern to the tiles' sums, with the square of what the mean is off the
 * reference (NULL: none) by more than that variance accounts for; returns the image's mean. */
static double add_tiles(const clshear_film *film, const clshear_film *reference,
                        uint32_t replicates, size_t columns, double *tiles)
{
    static const char *const planes[] = {"Variance.R", "Variance.G", "Variance.B"};
    const clshear_film_info info = clshear_film_describe(film);
    const size_t width = (size_t)info.width, pixels = width * (size_t)info.height;
    double mean = 0.0;
    for (int c = 0; c < 3; c++) {
        const float *variance = clshear_film_channel(film, planes[c]);
        const float *value = clshear_film_channel(film, colours[c]);
        const float *truth = reference != NULL ? clshear_film_channel(reference, colours[c]) : NULL;
        for (size_t i = 0; i < pixels; i++) {
            const double off = truth != NULL ? (double)value[i] - (double)truth[i] : 0.0;
            const double own = truth != NULL ? (double)variance[i] : 0.0;
            tiles[i / width / TILE * columns + i % width / TILE] +=
                ((double)variance[i] * replicates + off * off - own) / 3.0;
            mean += (double)value[i] / (3.0 * (double)pixels);
        }
    }
    return mean;
}

/* Renders all sizes of a series; parts: sizes x tiles, zeros at first, in the end scaled so that
 * their mean is the mean over pixels. */
static clshear_status render_sizes(const cli_converge_job *job, const cli_view *view,
                                   clshear_shear shear, const clshear_film *reference,
                                   cli_series *series, double *parts, size_t columns, size_t tiles)
{
    for (int k = 0; k < job->size_count; k++) {
        clshear_film *film = NULL;
        const clshear_options options =
            cli_converge_options(job, series->sampler, shear, job->counts[k]);
        clshear_status status = clshear_render(view->scene, &view->camera, &options, &film);
        if (status != CLSHEAR_OK) return status;
        const clshear_film_info info = clshear_film_describe(film);
        double *part = parts + (size_t)k * tiles;
        series->counts[k] =
            (uint32_t)(*clshear_film_channel(film, "Samples") / (float)job->replicates + 0.5f);
        series->mean = add_tiles(film, reference, job->replicates, columns, part);
        for (size_t t = 0; t < tiles; t++)
            part[t] *= (double)tiles / ((double)info.width * (double)info.height);
        clshear_film_free(film);
    }
    return CLSHEAR_OK;
}

/* Reads the reference image, if there is one. */
static int read_reference(const cli_converge_job *job, const cli_view *view, size_t width,
                          size_t height, clshear_film **reference)
{
    if (job->reference_image == NULL) return CLI_DONE;
    if (clshear_film_read(view->context, job->reference_image, reference) != CLSHEAR_OK)
        return fail(clshear_message(view->context));
    const clshear_film_info info = clshear_film_describe(*reference);
    for (int c = 0; c < 3; c++)
        if (clshear_film_channel(*reference, colours[c]) == NULL) {
            fprintf(stderr, "clshear: %s has no channel %s: --reference needs R, G and B\n",
                    job->reference_image, colours[c]);
            return CLI_FAILED;
        }
    if ((size_t)info.width == width && (size_t)info.height == height) return CLI_DONE;
    fprintf(stderr, "clshear: %s is %d x %d pixels: --reference needs %zu x %zu, the image's\n",
            job->reference_image, info.width, info.height, width, height);
    return CLI_FAILED;
}

int cli_study_image(const cli_converge_job *job, const cli_view *view, cli_study *study)
{
    const int *crop = job->render.options.crop;
    const int whole = crop[1] == 0;
    const size_t width = (size_t)(whole ? job->render.options.width : crop[1] - crop[0]);
    const size_t height = (size_t)(whole ? job->render.options.height : crop[3] - crop[2]);
    const size_t columns = (width + TILE - 1) / TILE;
    const size_t tiles = columns * ((height + TILE - 1) / TILE), sizes = (size_t)job->size_count;
    double *parts = malloc(sizes * tiles * sizeof *parts);
    clshear_film *reference = NULL;
    int code = parts != NULL ? CLI_DONE : fail("out of memory");
    if (code == CLI_DONE) code = read_reference(job, view, width, height, &reference);
    for (int i = 0; i < job->sampler_count * job->shear_count && code == CLI_DONE; i++) {
        cli_series *series = &study->series[study->series_count++];
        const int shear = i % job->shear_count;
        snprintf(series->target, sizeof series->target, "image");
        series->sampler = job->samplers[i / job->shear_count];
        series->shear = job->shear_names[shear];
        memset(parts, 0, sizes * tiles * sizeof *parts);
        if (render_sizes(job, view, job->shears[shear], reference, series, parts, columns, tiles) !=
            CLSHEAR_OK)
            code = fail(clshear_message(view->context));
        else if (clshear_fit_slope_of_parts(series->counts, sizes, parts, tiles, series->errors,
                                            &series->fit) != CLSHEAR_OK)
            code = fail(clshear_message(NULL));
    }
    clshear_film_free(reference);
    free(parts);
    return code;
}
