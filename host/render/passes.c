/* The passes of a render over its batches. */
#include "render/extend.h"

cs_sweep cs_job_sweep(const cs_job *job)
{
    const cs_device_world *world = &job->scene->world;
    return (cs_sweep){.scene = job->scene,
                      .frame = {.camera = job->camera,
                                .seed = job->options.seed,
                                .image_width = (u32)job->options.width,
                                .crop_x = (u32)job->window[0],
                                .crop_y = (u32)job->window[2],
                                .crop_width = (u32)(job->window[1] - job->window[0]),
                                .crop_height = (u32)(job->window[3] - job->window[2]),
                                .shear_mode = (u32)job->options.shear,
                                .lights = world->lights,
                                .emitters = world->emitters},
                      .optics = job->optics_table,
                      .start_s = cs_now_s(),
                      .rate = 1e5};
}

clshear_status cs_job_run_passes(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const u32 replicates = job->options.replicates;
    cs_sweep sweep = cs_job_sweep(job);
    sweep.shears = job->shears;
    sweep.pixels = &job->pixels;
    sweep.options = &job->options;
    for (size_t b = 0; b < job->batch_count; b++)
        sweep.total += (double)replicates * (double)job->batches[b].pixel_count *
                       job->batches[b].pattern.grid.count;
    for (u32 replicate = 0; replicate < replicates; replicate++) {
        CS_TRY(cs_extend_begin(job, replicate, error));
        CS_TRY(cs_sweep_replicate(&sweep, job->batches, job->batch_count, replicate, error));
        CS_TRY(cs_extend_end(job, replicate, error));
    }
done:
    job->kernel_s += sweep.kernel_s;
    return status;
}
