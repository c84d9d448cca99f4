/* clshear_render: options -> camera -> depth -> oracle -> passes -> film. */
#include "render/job.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/oracle.h"
#include "scene/camera.h"

clshear_options clshear_options_defaults(void)
{
    return (clshear_options){
        .width = 512, .height = 512, .spp = 256, .shear = CLSHEAR_SHEAR_EQUAL_AREA};
}

static clshear_status check_window(cs_job *job, cs_error *error)
{
    const clshear_options *options = &job->options;
    static const int none[4];
    if (options->width < 1 || options->height < 1 || options->width > 65536 ||
        options->height > 65536)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "image size %d x %d: each side must be 1 to 65536", options->width,
                       options->height);
    memcpy(job->window, options->crop, sizeof job->window);
    if (memcmp(options->crop, none, sizeof none) == 0) {
        job->window[1] = options->width;
        job->window[3] = options->height;
    }
    const int *w = job->window;
    if (w[0] < 0 || w[2] < 0 || w[0] >= w[1] || w[2] >= w[3] || w[1] > options->width ||
        w[3] > options->height)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "crop %d,%d,%d,%d: needs 0 <= x0 < x1 <= %d and 0 <= y0 < y1 <= %d", w[0],
                       w[1], w[2], w[3], options->width, options->height);
    job->pixel_count = (size_t)(w[1] - w[0]) * (size_t)(w[3] - w[2]);
    if (job->pixel_count > UINT32_MAX)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "crop of %zu pixels is too large; render it in parts", job->pixel_count);
    return CLSHEAR_OK;
}

static clshear_status check_sampling(cs_job *job, cs_error *error)
{
    clshear_options *options = &job->options;
    if (options->spp < 1)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "0 samples per pixel: must be 1 or more");
    if (options->spp > 2000000000u)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%u samples per pixel: at most 2000000000",
                       options->spp);
    if (options->replicates == 0) options->replicates = options->spp > 1 ? 2 : 1;
    if (options->replicates > options->spp)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%u replicates of %u samples per pixel: must be 1 to %u",
                       options->replicates, options->spp, options->spp);
    if ((uint32_t)options->shear > CLSHEAR_SHEAR_EQUAL_AREA)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "shear %d is not known", (int)options->shear);
    uint32_t pattern = (options->spp - 1) / options->replicates + 1;
    if (pattern > CS_MAX_PATTERN)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%u samples in one pattern: at most %d; use %u replicates or more", pattern,
                       CS_MAX_PATTERN, (options->spp - 1) / CS_MAX_PATTERN + 1);
    job->grid = cs_grid_of(pattern);
    return CLSHEAR_OK;
}

static clshear_status check_lens(const clshear_camera *camera, cs_error *error)
{
    if (!(camera->lens_radius >= 0.0f) || !isfinite(camera->lens_radius))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "lens radius %g: must be 0 or more",
                       (double)camera->lens_radius);
    if (!(camera->focal_distance > 0.0f) || !isfinite(camera->focal_distance))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "focal distance %g: must be above 0",
                       (double)camera->focal_distance);
    return CLSHEAR_OK;
}

/* Depth, oracle and the buffers for the passes. */
static clshear_status prepare(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_device *device = job->scene->context->device;
    const double start_s = cs_now_s();
    job->depth = malloc(job->pixel_count * sizeof *job->depth);
    job->shear_px = malloc(job->pixel_count * sizeof *job->shear_px);
    CS_REQUIRE(job->depth != NULL && job->shear_px != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for %zu pixels", job->pixel_count);
    cs_accel_depth(job->scene->accel, &job->camera, job->window, job->depth);
    cs_oracle_centre(&job->camera, job->depth, job->pixel_count, job->shear_px);
    job->prepass_s = cs_now_s() - start_s;
    CS_TRY(cs_buffer_create(device, job->pixel_count * sizeof *job->shear_px, job->shear_px,
                            &job->shears, error));
    CS_TRY(
        cs_buffer_create(device, job->pixel_count * sizeof(cs_pixel), NULL, &job->pixels, error));
done:
    return status;
}

clshear_status clshear_render(clshear_scene *scene, const clshear_camera *camera,
                              const clshear_options *options, clshear_film **film)
{
    clshear_status status = CLSHEAR_OK, passes = CLSHEAR_OK;
    cs_error *error = &scene->context->error;
    const double start_s = cs_now_s();
    cs_job job = {.scene = scene, .options = *options, .lens = *camera};
    CS_TRY(check_window(&job, error));
    CS_TRY(check_sampling(&job, error));
    CS_TRY(check_lens(camera, error));
    CS_TRY(cs_camera_frame(camera, options->width, options->height, &job.camera, error));
    CS_TRY(prepare(&job, error));
    passes = cs_job_run_passes(&job, error);
    if (passes != CLSHEAR_CANCELLED) CS_TRY(passes);
    CS_TRY(cs_job_resolve(&job, film, error));
    (*film)->info.render_s = cs_now_s() - start_s;
    status = cs_film_set_float(*film, "renderTimeSeconds", (float)(*film)->info.render_s);
    if (status != CLSHEAR_OK) {
        clshear_film_free(*film);
        *film = NULL;
        goto done;
    }
    status = passes;
done:
    free(job.depth);
    free(job.shear_px);
    cs_buffer_free(job.pixels);
    cs_buffer_free(job.shears);
    return status;
}
