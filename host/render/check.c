/* Whether what the caller asks for can be rendered. */
#include <math.h>
#include <string.h>

#include "film/shards.h"
#include "pattern/pattern.h"
#include "render/aov.h"
#include "render/camera_choice.h"
#include "render/motion.h"
#include "render/render_job.h"
#include "render/resume.h"
#include "render/studio.h"
#include "scene/camera.h"
#include "settings/view.h"

static clshear_status check_window(cs_job *job, cs_error *error)
{
    const double *crop = cs_numbers(&job->settings, CROP);
    const int whole[4] = {0, job->width, 0, job->height};
    int *w = job->window;
    for (int i = 0; i < 4; i++)
        w[i] = cs_is_set(&job->settings, CROP) ? (int)crop[i] : whole[i];
    if (w[0] >= w[1] || w[2] >= w[3] || w[1] > job->width || w[3] > job->height)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "crop %d,%d,%d,%d: needs 0 <= x0 < x1 <= %d and 0 <= y0 < y1 <= %d", w[0],
                       w[1], w[2], w[3], job->width, job->height);
    job->pixel_count = (size_t)(w[1] - w[0]) * (size_t)(w[3] - w[2]);
    if (job->pixel_count > UINT32_MAX)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "crop of %zu pixels is too large; render it in parts", job->pixel_count);
    return CLSHEAR_OK;
}

/* Samples per pixel of a render that rules may end, where none are asked for. */
static const double most_spp = 65536.0;

/* Reads which part of the render the job is. */
static clshear_status check_shard(cs_job *job, cs_error *error)
{
    static const size_t excluded[] = {CS_INDEX_NOISE, CS_INDEX_NOISE_PIXEL, CS_INDEX_TIME,
                                      CS_INDEX_EXTENDABLE, CS_INDEX_KEEP_PATTERNS};
    const char *text = cs_text(&job->settings, SHARD);
    cs_shards shards;
    job->shards = 1;
    if (text == NULL) return CLSHEAR_OK;
    const clshear_status status = cs_shards_read(text, &shards, error);
    if (status != CLSHEAR_OK) return status;
    job->shard = (cs_u32)shards.first - 1;
    job->shards = (cs_u32)shards.count;
    const int held = shards.held;
    cs_shards_free(&shards);
    if (held != 1)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "shard %.40s: a render is one of them", text);
    if (job->base != NULL)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%s: a shard cannot extend it; leave out --shard", cs_resume_name(job));
    for (size_t i = 0; i < sizeof excluded / sizeof *excluded; i++)
        if (*job->settings.values[excluded[i]].numbers > 0.0) /* those that are not set are 0 */
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "a shard cannot have %s",
                           cs_setting_table[excluded[i]].name);
    return CLSHEAR_OK;
}

/* Without a number of replicates: that of the film that is continued, or two, or one for each
 * shard. */
static clshear_status check_counts(cs_job *job, cs_error *error)
{
    int before = 0;
    clshear_status status = check_shard(job, error);
    if (status != CLSHEAR_OK) return status;
    job->stop = cs_stop_of(&job->settings);
    if (cs_stop_has_rules(&job->stop) && !cs_is_set(&job->settings, SPP)) {
        status = cs_settings_set(&job->settings, CLSHEAR_SPP, &most_spp, 1, error);
        if (status != CLSHEAR_OK) return status;
    }
    job->spp = (cs_u32)cs_integer(&job->settings, SPP);
    job->pilot_spp = job->spp;
    job->replicates = (cs_u32)cs_integer(&job->settings, REPLICATES);
    if (job->replicates == 0 && job->base != NULL &&
        cs_film_int(job->base, "clshear.replicates", &before))
        job->replicates = (cs_u32)before;
    if (job->replicates == 0) job->replicates = job->spp > 1 ? 2 : 1;
    if (!cs_is_set(&job->settings, REPLICATES) && job->replicates < job->shards)
        job->replicates = job->shards;
    if (job->replicates < job->shards)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%u shards of %u replicates: must be %u at most", job->shards,
                       job->replicates, job->replicates);
    if (job->replicates > job->spp)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%u replicates of %u samples per pixel: must be 1 to %u", job->replicates,
                       job->spp, job->spp);
    const double resolved = job->replicates;
    return cs_settings_set(&job->settings, CLSHEAR_REPLICATES, &resolved, 1, error);
}

/* Without a sampler's name: `sobol` where lights have a size or something moves, because its six
 * dimensions include theirs or the time; elsewhere the sampler that is best in four. */
static clshear_status choose_sampler(cs_job *job, cs_error *error)
{
    const double of_six = CS_SAMPLER_SOBOL;
    if (cs_is_set(&job->settings, SAMPLER) || (cs_area_lights(job) == 0 && !job->moves))
        return CLSHEAR_OK;
    return cs_settings_set(&job->settings, CLSHEAR_SAMPLER, &of_six, 1, error);
}

/* The pattern of a replicate; more samples than asked for where the sampler has no such number. */
static clshear_status choose_pattern(cs_job *job, cs_error *error)
{
    const cs_log *log = &job->scene->context->log;
    const cs_u32 sampler = (cs_u32)cs_integer(&job->settings, SAMPLER);
    const cs_u32 wanted = (job->spp - 1) / job->replicates + 1;
    const cs_u32 count = cs_sampler_count(sampler, wanted);
    if (count == 0) {
        const cs_u32 most = cs_sampler_most(sampler);
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%u samples in one pattern of %s: at most %u; use %u replicates or more",
                       wanted, cs_sampler_name(sampler), most, (job->spp - 1) / most + 1);
    }
    if (count != wanted)
        cs_warn(log, "sampler %s has no patterns of %u samples: %u replicates of %u",
                cs_sampler_name(sampler), wanted, job->replicates, count);
    if ((double)count * job->replicates > 2e9)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%u replicates of %u samples per pixel are more than 2000000000",
                       job->replicates, count);
    job->pattern = cs_pattern_of(sampler, 0, count);
    if (!cs_sampler_is_net(sampler)) job->features |= CS_FEATURE_SAMPLERS;
    if (cs_integer(&job->settings, FRESH_SETS))
        cs_pattern_refresh(&job->pattern, (cs_u32)cs_integer(&job->settings, SEED));
    return CLSHEAR_OK;
}

/* The limit keeps rays within what floats and Embree (1.8e18) can follow. */
static clshear_status check_lens(const cs_view *view, cs_error *error)
{
    if ((double)view->lens_radius > 1e6 * (double)view->focal_distance)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "lens radius %g: must be at most a million times the focal distance, %g",
                       (double)view->lens_radius, (double)view->focal_distance);
    return CLSHEAR_OK;
}

static clshear_status make_camera(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const clshear_settings *settings = &job->settings;
    cs_view view;
    cs_view_of(settings, job->scene->scene.origin, &view);
    CS_TRY(check_lens(&view, error));
    CS_TRY(cs_optics_make(&view, (clshear_filter)cs_integer(settings, FILTER),
                          (float)cs_number(settings, FILTER_WIDTH), &job->optics, error));
    CS_REQUIRE(job->shear_kind != CLSHEAR_SHEAR_TOROIDAL || job->optics.optics.has_closed_form,
               CLSHEAR_BAD_ARGUMENT,
               "the toroidal shear knows square and disk apertures and box filters 1 px wide only; "
               "use equal-area");
    CS_TRY(cs_camera_frame(&view, job->width, job->height, &job->camera, error));
    job->camera.optics = job->optics.optics;
    CS_TRY(cs_motion_begin(job, &view, error));
    const double width_px = (double)job->camera.optics.filter_width;
    CS_TRY(cs_settings_set(&job->settings, CLSHEAR_FILTER_WIDTH, &width_px, 1, error));
done:
    return status;
}

/* The oracle, if none is given: the pilot for a scene that moves, since depths do not tell whether
 * the shear should follow the motion, the depth or both; else `edge`. */
static clshear_status choose_oracle(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const double pilot = CLSHEAR_ORACLE_PILOT;
    if (!cs_is_set(&job->settings, ORACLE) && job->moves)
        CS_TRY(cs_settings_set(&job->settings, CLSHEAR_ORACLE, &pilot, 1, error));
    job->oracle = (clshear_oracle)cs_integer(&job->settings, ORACLE);
done:
    return status;
}

/* What the kernels must be compiled with. */
static cs_u32 features_of(const cs_job *job)
{
    cs_u32 features = job->lighting.features | job->scene->device_scene.needs.features;
    if (cs_integer(&job->settings, BOUNCES) > 0) features |= CS_FEATURE_PATHS;
    return features | cs_wide_feature(job->scene, features);
}

clshear_status cs_job_begin(cs_job *job, clshear_scene *scene, const clshear_settings *settings,
                            const clshear_film *base, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    job->scene = scene;
    job->base = base;
    CS_REQUIRE(scene->is_complete, CLSHEAR_BAD_ARGUMENT,
               "the scene is not complete: call clshear_scene_complete first");
    CS_TRY(settings != NULL ? cs_settings_copy(settings, &job->settings, error)
                            : cs_settings_init(&job->settings, error));
    job->width = (int)cs_integer(&job->settings, WIDTH);
    job->height = (int)cs_integer(&job->settings, HEIGHT);
    job->seed = (cs_u32)cs_integer(&job->settings, SEED);
    job->shear_kind = (clshear_shear)cs_integer(&job->settings, SHEAR);
    CS_TRY(check_window(job, error));
    CS_TRY(cs_camera_complete(scene, &job->settings, error));
    CS_TRY(cs_studio_complete(scene, &job->settings, error));
    CS_TRY(cs_lighting_make(scene, &job->settings, &job->lighting, error));
    job->features = features_of(job);
    job->planes = cs_aov_planes(&job->settings);
    CS_TRY(make_camera(job, error));
    CS_TRY(choose_oracle(job, error));
done:
    return status;
}

clshear_status cs_job_choose_samples(cs_job *job, cs_error *error)
{
    clshear_status status = check_counts(job, error);
    if (status == CLSHEAR_OK) status = choose_sampler(job, error);
    if (status == CLSHEAR_OK) status = choose_pattern(job, error);
    return status == CLSHEAR_OK ? cs_adaptive_complete(job, error) : status;
}
