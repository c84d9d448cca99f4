/* From accumulated pixels to a film. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/oracle.h"
#include "render/aov.h"
#include "render/motion.h"
#include "render/recipe.h"
#include "render/resume.h"
#include "render/rounds.h"
#include "render/view_metadata.h"

typedef struct planes {
    float *mean[3];
    float *variance[3];
    float *sample_variance[3];
    float *depth[3]; /* centre, near, far */
    float *shear;
    float *blur;
    float *rule;
    float *samples;
} planes;

size_t cs_film_bytes(const cs_job *job)
{
    const size_t fixed = sizeof(planes) / sizeof(float *);
    const size_t others = (job->moves ? 2u : 0u) + (cs_integer(&job->settings, GAIN) != 0);
    return (fixed + others + cs_aov_count(job->planes) + cs_resume_channels(job)) * sizeof(float);
}

static clshear_status add_planes(clshear_film *film, planes *all)
{
    static const char *const letters[3] = {"R", "G", "B"};
    char name[32];
    int good = 1;
    for (int c = 0; c < 3; c++)
        good &= (all->mean[c] = cs_film_add_channel(film, letters[c])) != NULL;
    for (int c = 0; c < 3; c++) {
        snprintf(name, sizeof name, "Variance.%s", letters[c]);
        good &= (all->variance[c] = cs_film_add_channel(film, name)) != NULL;
    }
    for (int c = 0; c < 3; c++) {
        snprintf(name, sizeof name, "SampleVariance.%s", letters[c]);
        good &= (all->sample_variance[c] = cs_film_add_channel(film, name)) != NULL;
    }
    good &= (all->depth[0] = cs_film_add_channel(film, "Z")) != NULL;
    good &= (all->depth[1] = cs_film_add_channel(film, "Z.near")) != NULL;
    good &= (all->depth[2] = cs_film_add_channel(film, "Z.far")) != NULL;
    good &= (all->shear = cs_film_add_channel(film, "Shear")) != NULL;
    good &= (all->blur = cs_film_add_channel(film, "CoC")) != NULL;
    good &= (all->rule = cs_film_add_channel(film, "Oracle")) != NULL;
    good &= (all->samples = cs_film_add_channel(film, "Samples")) != NULL;
    return good ? CLSHEAR_OK
                : cs_fail(cs_thread_error(), CLSHEAR_OUT_OF_MEMORY, "out of memory for the film");
}

/* Samples in a finished pattern of a pixel. */
static uint32_t pattern_of(const cs_job *job, size_t index)
{
    if (job->rounds.open != NULL) return job->rounds.open[index].pending;
    return job->samples != NULL ? job->samples[index]
                                : job->pattern.first + job->pattern.grid.count;
}

/* Writes the means and variances of a pixel to the planes: its sums, divided by its samples and its
 * patterns. */
static void resolve_pixel(const cs_job *job, const cs_pixel *pixel, size_t index, planes *all)
{
    const uint32_t pattern = pattern_of(job, index);
    const double samples = pixel->samples, patterns = pixel->patterns;
    for (int c = 0; c < 3; c++) {
        double finished = (double)pixel->pattern_sum[c] + (double)pixel->pattern_carry[c];
        double pending = (double)pixel->sum[c] + (double)pixel->carry[c];
        if (samples > 0.0) pending += cs_resume_missing(job, index, c);
        if (samples > 0.0) all->mean[c][index] = (float)((finished * pattern + pending) / samples);
        if (job->adaptive.begin > 0)
            all->mean[c][index] = (float)cs_adaptive_mean(job, pixel, index, c);
        if (patterns > 1.0)
            all->variance[c][index] =
                (float)((double)pixel->pattern_m2[c] / (patterns * (patterns - 1.0)));
        if (samples > 1.0)
            all->sample_variance[c][index] = (float)((double)pixel->sample_m2[c] / (samples - 1.0));
    }
    all->samples[index] = (float)samples;
}

/* Removes the variance planes when a pixel has too few patterns to tell. */
static void drop_variance(clshear_film *film)
{
    cs_channel *channels = film->channels.items;
    size_t kept = 0;
    for (size_t i = 0; i < film->channels.count; i++) {
        if (strncmp(channels[i].name, "Variance.", 9) == 0)
            free(channels[i].pixels);
        else
            channels[kept++] = channels[i];
    }
    film->channels.count = kept;
    film->info.channels = kept;
}

static clshear_status read_pixels(cs_job *job, clshear_film *film, planes *all, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    uint32_t fewest = UINT32_MAX;
    cs_pixel *slice = malloc(CS_PIXEL_SLICE * sizeof *slice);
    CS_REQUIRE(slice != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for the film");
    for (size_t first = 0; first < job->pixel_count; first += CS_PIXEL_SLICE) {
        size_t count =
            job->pixel_count - first < CS_PIXEL_SLICE ? job->pixel_count - first : CS_PIXEL_SLICE;
        CS_TRY(cs_rounds_read(job, first, count, slice, error));
        for (size_t i = 0; i < count; i++) {
            resolve_pixel(job, &slice[i], first + i, all);
            film->info.samples += slice[i].samples;
            film->info.shadow_rays += slice[i].shadow_rays;
            if (slice[i].patterns < fewest) fewest = slice[i].patterns;
        }
        if (job->is_over) cs_pixels_release(&job->pixels, first + count); /* the film takes over */
    }
    for (size_t i = 0; i < job->pixel_count; i++) {
        all->depth[0][i] = job->depth[i].centre;
        all->depth[1][i] = job->depth[i].near;
        all->depth[2][i] = job->depth[i].far;
        all->shear[i] = job->shear_px[i];
        all->rule[i] = (float)job->rule[i];
        all->blur[i] = fabsf(cs_job_shear(job, i, CS_RULE_CENTRE));
    }
    const cs_adaptive *adaptive = &job->adaptive;
    const int begins = adaptive->begin > 0 && adaptive->drawn < CS_BEGINNINGS;
    if (fewest < 2 || begins) drop_variance(film);
done:
    free(slice);
    return status;
}

/* Metadata: the settings, and what else is needed to make the image again. */
static clshear_status describe(const cs_job *job, clshear_film *film)
{
    clshear_status status = CLSHEAR_OK;
    const cs_device *device = job->scene->context->device;
    CS_TRY(cs_film_annotate(film, "Software", "clshear " CLSHEAR_VERSION_STRING));
    CS_TRY(cs_film_annotate(film, "clshear.version", CLSHEAR_VERSION_STRING));
    CS_TRY(cs_record_settings(&job->settings, film));
    CS_TRY(cs_film_annotate(film, "clshear.device", cs_device_name(device)));
    CS_TRY(cs_film_annotate(film, "clshear.driver", cs_device_driver(device)));
    CS_TRY(cs_film_set_int(film, "clshear.packet", cs_device_packet(device)));
    CS_TRY(cs_film_set_int(film, "samplesPerPixel",
                           (int32_t)((double)film->info.samples / (double)job->pixel_count + 0.5)));
    CS_TRY(cs_view_describe(job, film));
done:
    return status;
}

/* What a merge of shards must know. */
static clshear_status describe_shard(const cs_job *job, clshear_film *film)
{
    char text[CS_RECIPE_SIZE];
    if (!cs_is_set(&job->settings, SHARD)) return CLSHEAR_OK;
    cs_recipe_of(job, text, sizeof text);
    const clshear_status status = cs_film_annotate(film, "clshear.recipe", text);
    if (status != CLSHEAR_OK) return status;
    return cs_film_set_int(film, "clshear.patterns", (int32_t)cs_job_patterns(job));
}

clshear_status cs_job_resolve(cs_job *job, clshear_film **result, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    clshear_film *film = NULL;
    planes all;
    /* Cancelled before the first pass: what is extended must not be lost. */
    if (job->base != NULL && job->replicates_begun == 0) CS_TRY(cs_resume_begin(job, 0, error));
    CS_TRY(cs_film_create(job->window, job->width, job->height, error, &film));
    CS_TRY(add_planes(film, &all));
    CS_TRY(read_pixels(job, film, &all, error));
    CS_TRY(cs_aov_resolve(job, all.samples, film, error));
    CS_TRY(cs_motion_resolve(job, film, error));
    if (job->gain != NULL) {
        float *gain = cs_film_add_channel(film, "Gain");
        CS_REQUIRE(gain != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for the film");
        memcpy(gain, job->gain, job->pixel_count * sizeof *gain);
    }
    CS_TRY(describe(job, film));
    CS_TRY(cs_resume_describe(job, film));
    CS_TRY(cs_rounds_describe(job, film));
    CS_TRY(describe_shard(job, film));
    film->info.prepass_s = job->prepass_s;
    film->info.pilot_s = job->pilot_s;
    film->info.pilot_samples = (uint64_t)job->pilot_samples;
    film->info.kernel_s = job->kernel_s;
    film->info.host_bytes = (uint64_t)job->memory.host;
    film->info.device_bytes = (uint64_t)job->memory.device;
    *result = film;
    film = NULL;
done:
    cs_film_free(film);
    return status;
}
