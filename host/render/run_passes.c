/* The passes of a render over its batches. */
#include "optics/shear_mode.h"
#include "render/aov.h"
#include "render/checkpoint.h"
#include "render/live.h"
#include "render/motion.h"
#include "render/resume.h"
#include "render/rounds.h"

/* Whether some surfaces shine that only rays are sure to find: those whose radiance a texture
 * varies, and if emitters are sampled by power, those whose material lets rays pass. */
static int shines_for_rays_only(const cs_job *job)
{
    const cs_device_scene *world = &job->scene->device_scene;
    const int by_power = cs_integer(&job->settings, EMITTERS) == CLSHEAR_EMITTERS_POWER;
    return world->emitters > 0 &&
           (world->needs.textured_emission || (by_power && world->emitters > world->even_emitters));
}

cs_u32 cs_area_lights(const cs_job *job)
{
    return job->lighting.area_count + (cs_u32)shines_for_rays_only(job);
}

cs_pass cs_job_pass(const cs_job *job)
{
    const cs_lighting *lighting = &job->lighting;
    const cs_material_needs *needs = &job->scene->device_scene.needs;
    return (cs_pass){.scene = job->scene,
                     .launch = {.camera = job->camera,
                                .motion = job->motion,
                                .shutter = cs_motion_shutter(job),
                                .seed = job->seed,
                                .image_width = (cs_u32)job->width,
                                .crop_x = (cs_u32)job->window[0],
                                .crop_y = (cs_u32)job->window[2],
                                .crop_width = (cs_u32)(job->window[1] - job->window[0]),
                                .crop_height = (cs_u32)(job->window[3] - job->window[2]),
                                .shear_mode = cs_shear_mode(job->shear_kind),
                                .lights = lighting->count,
                                .area_lights = cs_area_lights(job),
                                .only_rays = (cs_u32)shines_for_rays_only(job),
                                .dark = job->scene->device_scene.emitters == 0,
                                .see_through = (cs_u32)needs->see_through,
                                .bounces = (cs_u32)cs_integer(&job->settings, BOUNCES),
                                .clamp = (float)cs_number(&job->settings, CLAMP)},
                     .optics = job->optics_table,
                     .lighting = lighting,
                     .features = job->features,
                     .start_s = cs_now_s(),
                     .rate = 1e5};
}

/* A job in progress: what its pass calls between launches. */
typedef struct progress {
    cs_job *job;
    cs_pass *pass;
} progress;

static clshear_status between_launches(void *user, cs_error *error)
{
    const progress *now = user;
    const clshear_status status = cs_checkpoint_save(now->job, now->pass, 0, error);
    return status == CLSHEAR_OK ? cs_live_update(now->job, error) : status;
}

cs_u32 cs_job_patterns(const cs_job *job)
{
    return (job->replicates - job->shard - 1) / job->shards + 1;
}

/* All replicates, one after another, from the one in progress on. */
static clshear_status run_replicates(cs_job *job, cs_pass *pass, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    for (cs_u32 *at = &job->rounds.replicate; *at < job->replicates; ++*at) {
        if (*at % job->shards != job->shard) continue;
        if (cs_pass_is_fresh(pass)) CS_TRY(cs_resume_begin(job, *at, error));
        CS_TRY(cs_pass_replicate(pass, job->batches, job->batch_count, *at, error));
        CS_TRY(cs_resume_end(job, *at, error));
    }
done:
    return status;
}

clshear_status cs_job_run_passes(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_pass pass = cs_job_pass(job);
    progress now = {job, &pass};
    double before = 0.0;
    pass.shears = job->shears;
    pass.velocities = job->velocities;
    pass.pixels = &job->pixels;
    pass.settings = &job->settings;
    pass.launch.planes = job->planes;
    pass.features = cs_aov_features(job);
    pass.between = between_launches;
    pass.user = &now;
    for (size_t b = 0; b < job->batch_count; b++)
        pass.total += (double)cs_job_patterns(job) * (double)job->batches[b].pixel_count *
                      job->batches[b].pattern.grid.count;
    CS_TRY(cs_checkpoint_load(job, &pass, error));
    before = pass.done;
    cs_rounds_tell(job, &pass);
    status = job->adaptive.begin > 0         ? cs_adaptive_run(job, &pass, error)
             : cs_stop_has_rules(&job->stop) ? cs_rounds_run(job, &pass, error)
                                             : run_replicates(job, &pass, error);
    if (status == CS_CANCELLED) {
        const clshear_status saved = cs_checkpoint_save(job, &pass, 1, error);
        if (saved != CLSHEAR_OK) status = saved;
    }
done:
    job->kernel_s += pass.kernel_s;
    job->drawn = pass.done - before;
    return status;
}
