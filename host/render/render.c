/* clshear_render: options -> camera -> depth -> oracle -> passes -> film. */
#include "render/job.h"

#include <stdlib.h>

#include "oracle/oracle.h"
#include "render/extend.h"
#include "scene/camera.h"

clshear_options clshear_options_defaults(void)
{
    return (clshear_options){.width = 512,
                             .height = 512,
                             .spp = 256,
                             .shear = CLSHEAR_SHEAR_EQUAL_AREA,
                             .oracle = CLSHEAR_ORACLE_CENTRE,
                             .lens_rays = 16};
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
    CS_TRY(cs_accel_depth(job->scene->accel, &job->camera, job->window, job->options.lens_rays,
                          job->depth, error));
    for (size_t i = 0; i < job->pixel_count; i++)
        job->shear_px[i] =
            cs_oracle_shear(&job->camera, &job->depth[i], (cs_rule)job->options.oracle);
    job->prepass_s = cs_now_s() - start_s;
    CS_TRY(cs_extend_prepare(job, error));
    CS_TRY(cs_batch_create(job->scene->context, &job->pattern, NULL, job->pixel_count,
                           (u32)(job->window[1] - job->window[0]), &job->batches[0], error));
    job->batch_count = 1;
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
    CS_TRY(cs_job_check(&job, error));
    CS_TRY(cs_camera_frame(camera, options->width, options->height, &job.camera, error));
    CS_TRY(cs_extend_check(&job, error));
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
    cs_extend_free(&job);
    for (size_t b = 0; b < job.batch_count; b++)
        cs_batch_free(&job.batches[b]);
    cs_buffer_free(job.pixels);
    cs_buffer_free(job.shears);
    return status;
}
