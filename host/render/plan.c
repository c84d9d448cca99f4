/* Before the passes: depths, the oracle's shears, how many samples each pixel gets, and the
 * buffers. */
#include <stdlib.h>
#include <string.h>

#include "oracle/oracle.h"
#include "pattern/pattern.h"
#include "render/aov.h"
#include "render/live.h"
#include "render/memory.h"
#include "render/motion.h"
#include "render/pilot.h"
#include "render/resume.h"
#include "render/rounds.h"

/* Rays of the prepass between two questions to the caller: a fraction of a second. */
static const size_t rays_at_once = 1 << 22;

static clshear_status reserve(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_device *device = job->scene->context->device;
    /* Zero, so that a render that is stopped before they are known can be resolved. */
    job->depth = calloc(job->pixel_count, sizeof *job->depth);
    job->shear_px = calloc(job->pixel_count, sizeof *job->shear_px);
    job->rule = calloc(job->pixel_count, 1);
    CS_REQUIRE(job->depth != NULL && job->shear_px != NULL && job->rule != NULL,
               CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels", job->pixel_count);
    CS_TRY(cs_pixels_create(job->scene->context, job->pixel_count,
                            (cs_u32)(job->window[1] - job->window[0]), cs_aov_count(job->planes),
                            &job->pixels, error));
    const cs_array *table = &job->optics.table;
    CS_TRY(cs_buffer_create(device, table->count * table->item_size, table->items,
                            &job->optics_table, error));
    CS_TRY(cs_resume_prepare(job, error));
done:
    return status;
}

/* The depths of all pixels, some rows at a time: between them the caller may stop the render. */
static clshear_status find_depths(cs_job *job, cs_error *error)
{
    const int lens_rays = (int)cs_integer(&job->settings, LENS_RAYS);
    const size_t width = (size_t)(job->window[1] - job->window[0]);
    const size_t rows = rays_at_once / (width * (size_t)(lens_rays + 1)) + 1;
    int band[4] = {job->window[0], job->window[1], job->window[2], job->window[2]};
    cs_depth *depth = job->depth;
    const cs_shapes shapes = cs_lighting_shapes(&job->lighting);
    while (band[3] < job->window[3]) {
        const size_t left = (size_t)(job->window[3] - band[3]);
        band[2] = band[3];
        band[3] += (int)(left < rows ? left : rows);
        clshear_status status =
            cs_accel_depth(job->scene->accel, &shapes, &job->cameras.middle,
                           job->optics.table.items, band, lens_rays, depth, error);
        if (status == CLSHEAR_OK) status = cs_pass_ask(&job->settings, error);
        if (status != CLSHEAR_OK) return status;
        depth += width * (size_t)(band[3] - band[2]);
    }
    return CLSHEAR_OK;
}

/* The middle of a pixel on the raster. */
static void find_middle(const cs_job *job, size_t index, cs_f32 *x, cs_f32 *y)
{
    const size_t width = (size_t)(job->window[1] - job->window[0]);
    const size_t column = (size_t)job->window[0] + index % width;
    const size_t row = (size_t)job->window[2] + index / width;
    *x = (cs_f32)column + 0.5f;
    *y = (cs_f32)row + 0.5f;
}

cs_f32 cs_job_shear(const cs_job *job, size_t index, cs_rule rule)
{
    cs_f32 x, y;
    find_middle(job, index, &x, &y);
    return cs_oracle_shear(&job->camera, x, y, &job->depth[index], rule);
}

/* Rules and shears of all pixels; those of the picture that is extended, if there is one. */
static clshear_status choose_shears(cs_job *job, cs_error *error)
{
    const float *extended = job->base != NULL ? cs_film_channel(job->base, "Shear") : NULL;
    const float *rules = job->base != NULL ? cs_film_channel(job->base, "Oracle") : NULL;
    const int is_given = cs_is_set(&job->settings, SHEAR_PX);
    for (size_t i = 0; i < job->pixel_count; i++) {
        job->rule[i] = rules != NULL ? (uint8_t)rules[i]
                                     : (uint8_t)cs_oracle_rule(job->oracle, &job->depth[i]);
        if (extended != NULL)
            job->shear_px[i] = extended[i];
        else if (is_given)
            job->shear_px[i] = (cs_f32)cs_number(&job->settings, SHEAR_PX);
        else
            job->shear_px[i] = cs_job_shear(job, i, (cs_rule)job->rule[i]);
    }
    return cs_pilot_chooses_shears(job) ? cs_pilot_shears(job, error) : CLSHEAR_OK;
}

/* A batch for each number of samples. */
static clshear_status batch_by_samples(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_u32 width = (cs_u32)(job->window[1] - job->window[0]);
    const cs_u32 height = (cs_u32)(job->pixel_count / width), sampler = job->pattern.sampler;
    cs_u32 *list = malloc(job->pixel_count * sizeof *list);
    CS_REQUIRE(list != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
               job->pixel_count);
    for (cs_u32 wanted = 1; wanted <= CS_MAX_PATTERN; wanted *= 2) {
        size_t count = 0;
        for (size_t i = 0; i < job->pixel_count; i++) {
            const cs_u32 pixel = cs_tiled_pixel((cs_u32)i, width, height);
            if (job->samples[pixel] == wanted) list[count++] = pixel;
        }
        if (count == 0) continue;
        const cs_pattern pattern = cs_pattern_of_length(&job->pattern, wanted);
        job->batch_count++; /* first, so that what a failure leaves is freed */
        CS_TRY(cs_batch_create(job->scene->context, &pattern, list, count, width, 0,
                               &job->batches[job->batch_count - 1], error));
    }
    for (size_t i = 0; i < job->pixel_count; i++)
        job->samples[i] = cs_sampler_count(sampler, job->samples[i]);
done:
    free(list);
    return status;
}

static clshear_status plan_batches(cs_job *job, cs_error *error)
{
    const cs_u32 width = (cs_u32)(job->window[1] - job->window[0]);
    if (cs_integer(&job->settings, ADAPTIVE) != 0) {
        const clshear_status status = cs_adaptive_plan(job, error);
        if (status != CLSHEAR_OK || job->adaptive.begin > 0) return status;
    }
    const int shared = cs_pilot_chooses_samples(job);
    if (cs_integer(&job->settings, ADAPTIVE) != 0 && !shared)
        cs_warn(&job->scene->context->log,
                "%u samples per pixel are too few to allocate adaptively (from %d on)", job->spp,
                CS_LEAST_SPP_TO_ALLOCATE);
    if (!shared) {
        job->batch_count = 1;
        return cs_batch_create(job->scene->context, &job->pattern, NULL, job->pixel_count, width, 0,
                               &job->batches[0], error);
    }
    job->samples = calloc(job->pixel_count, sizeof *job->samples);
    if (job->samples == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
                       job->pixel_count);
    clshear_status status = cs_pilot_samples(job, job->samples, error);
    return status == CLSHEAR_OK ? batch_by_samples(job, error) : status;
}

clshear_status cs_job_plan(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_memory_check(job);
    CS_TRY(cs_wide_scene_make(job->scene, &job->features, error));
    job->memory = cs_memory_of(job);
    CS_TRY(cs_pass_warm_up(job->scene->context->device, job->features, error));
    if (job->planes != 0)
        CS_TRY(cs_pass_warm_up(job->scene->context->device, cs_aov_features(job), error));
    const double start_s = cs_now_s();
    CS_TRY(reserve(job, error));
    CS_TRY(find_depths(job, error));
    CS_TRY(cs_motion_find(job, error));
    job->prepass_s = cs_now_s() - start_s;
    CS_TRY(choose_shears(job, error));
    if (cs_integer(&job->settings, GAIN) != 0) {
        job->gain = calloc(job->pixel_count, sizeof *job->gain);
        CS_REQUIRE(job->gain != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
                   job->pixel_count);
        status = cs_pilot_gain(job, job->gain, error);
        if (status != CLSHEAR_OK) { /* cancelled: no channel rather than a wrong one */
            free(job->gain);
            job->gain = NULL;
            goto done;
        }
    }
    CS_TRY(plan_batches(job, error));
    job->pilot_s = cs_now_s() - start_s - job->prepass_s;
    CS_TRY(cs_buffer_create(job->scene->context->device, job->pixel_count * sizeof *job->shear_px,
                            job->shear_px, &job->shears, error));
    CS_TRY(cs_motion_upload(job, job->rule, &job->velocities, error));
done:
    return status;
}

void cs_job_free(cs_job *job)
{
    free(job->depth);
    free(job->shear_px);
    free(job->rule);
    free(job->gain);
    free(job->samples);
    cs_adaptive_free(&job->adaptive);
    cs_resume_free(job);
    cs_rounds_free(job);
    cs_live_free(job);
    for (size_t b = 0; b < job->batch_count; b++)
        cs_batch_free(&job->batches[b]);
    cs_pixels_free(&job->pixels);
    cs_buffer_free(job->optics_table);
    cs_optics_free(&job->optics);
    cs_buffer_free(job->shears);
    free(job->velocities_px);
    cs_buffer_free(job->velocities);
    cs_lighting_free(&job->lighting);
    cs_settings_free(&job->settings);
}
