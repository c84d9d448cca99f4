/* The passes of a render over its batches. */
#include "optics/shear_mode.h"
#include "render/aov.h"
#include "render/resume.h"

cs_u32 cs_area_lights(const cs_job *job)
{
    return job->lighting.area_count + (cs_u32)job->scene->device_scene.needs.textured_emission;
}

cs_pass cs_job_pass(const cs_job *job)
{
    const cs_lighting *lighting = &job->lighting;
    const cs_material_needs *needs = &job->scene->device_scene.needs;
    return (cs_pass){.scene = job->scene,
                     .launch = {.camera = job->camera,
                                .seed = job->seed,
                                .image_width = (cs_u32)job->width,
                                .crop_x = (cs_u32)job->window[0],
                                .crop_y = (cs_u32)job->window[2],
                                .crop_width = (cs_u32)(job->window[1] - job->window[0]),
                                .crop_height = (cs_u32)(job->window[3] - job->window[2]),
                                .shear_mode = cs_shear_mode(job->shear_kind),
                                .lights = lighting->count,
                                .area_lights = cs_area_lights(job),
                                .see_through = (cs_u32)needs->see_through,
                                .bounces = (cs_u32)cs_integer(&job->settings, BOUNCES),
                                .clamp = (float)cs_number(&job->settings, CLAMP)},
                     .optics = job->optics_table,
                     .lighting = lighting,
                     .features = job->features,
                     .start_s = cs_now_s(),
                     .rate = 1e5};
}

clshear_status cs_job_run_passes(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_u32 replicates = job->replicates;
    cs_pass pass = cs_job_pass(job);
    pass.shears = job->shears;
    pass.pixels = &job->pixels;
    pass.settings = &job->settings;
    pass.launch.planes = job->planes;
    pass.features = cs_aov_features(job);
    for (size_t b = 0; b < job->batch_count; b++)
        pass.total += (double)replicates * (double)job->batches[b].pixel_count *
                      job->batches[b].pattern.grid.count;
    for (cs_u32 replicate = 0; replicate < replicates; replicate++) {
        CS_TRY(cs_resume_begin(job, replicate, error));
        CS_TRY(cs_pass_replicate(&pass, job->batches, job->batch_count, replicate, error));
        CS_TRY(cs_resume_end(job, replicate, error));
    }
done:
    job->kernel_s += pass.kernel_s;
    return status;
}
