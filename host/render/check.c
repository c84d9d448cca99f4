/* Whether what the caller asks for can be rendered. */
#include <math.h>
#include <string.h>

#include "pattern/pattern.h"
#include "render/render_job.h"
#include "scene/camera.h"

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

static clshear_status check_counts(clshear_options *options, cs_error *error)
{
    if (options->spp < 1)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "0 samples per pixel: must be 1 or more");
    if (options->spp > 2000000000u)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%u samples per pixel: at most 2000000000",
                       options->spp);
    int base_replicates;
    if (options->replicates == 0 && options->extend != NULL &&
        cs_film_int(options->extend, "clshear.replicates", &base_replicates))
        options->replicates = (uint32_t)base_replicates;
    if (options->replicates == 0) options->replicates = options->spp > 1 ? 2 : 1;
    if (options->replicates > options->spp)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%u replicates of %u samples per pixel: must be 1 to %u",
                       options->replicates, options->spp, options->spp);
    if ((uint32_t)options->shear > CLSHEAR_SHEAR_EQUAL_AREA)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "shear %d is not known", (int)options->shear);
    if ((uint32_t)options->oracle > CLSHEAR_ORACLE_PILOT)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "oracle %d is not known", (int)options->oracle);
    return CLSHEAR_OK;
}

/* The pattern of a replicate; more samples than asked for where the sampler has no such number. */
static clshear_status choose_pattern(cs_job *job, cs_error *error)
{
    clshear_options *options = &job->options;
    const cs_log *log = &job->scene->context->log;
    cs_u32 sampler;
    clshear_status status = cs_sampler_find(options->sampler, &sampler, error);
    if (status != CLSHEAR_OK) return status;
    const cs_u32 wanted = (options->spp - 1) / options->replicates + 1;
    const cs_u32 count = cs_sampler_count(sampler, wanted);
    if (count == 0) {
        const cs_u32 most = cs_sampler_most(sampler);
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%u samples in one pattern of %s: at most %u; use %u replicates or more",
                       wanted, cs_sampler_name(sampler), most, (options->spp - 1) / most + 1);
    }
    if (count != wanted)
        cs_warn(log, "sampler %s has no patterns of %u samples: %u replicates of %u",
                cs_sampler_name(sampler), wanted, options->replicates, count);
    if ((double)count * options->replicates > 2e9)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%u replicates of %u samples per pixel are more than 2000000000",
                       options->replicates, count);
    job->pattern = cs_pattern_of(sampler, 0, count);
    return CLSHEAR_OK;
}

/* Limits keep rays within what floats and Embree (1.8e18) can follow. */
static clshear_status check_lens(const clshear_camera *camera, cs_error *error)
{
    const double radius = (double)camera->lens_radius, focus = (double)camera->focal_distance;
    if (!(radius >= 0.0 && radius <= 1e12))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "lens radius %g: must be 0 to 1e12", radius);
    if (!(focus >= 1e-12 && focus <= 1e12))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "focal distance %g: must be above 0, 1e-12 to 1e12", focus);
    if (radius > 1e6 * focus)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "lens radius %g: must be at most a million times the focal distance, %g",
                       radius, focus);
    return CLSHEAR_OK;
}

static clshear_status make_camera(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const clshear_options *options = &job->options;
    CS_TRY(
        cs_optics_make(&job->lens, options->filter, options->filter_width_px, &job->optics, error));
    CS_REQUIRE(options->shear != CLSHEAR_SHEAR_TOROIDAL || job->optics.optics.has_closed_form,
               CLSHEAR_BAD_ARGUMENT,
               "the toroidal shear knows square and disk apertures and box filters 1 px wide only; "
               "use equal-area");
    CS_TRY(cs_camera_frame(&job->lens, options->width, options->height, &job->camera, error));
    job->camera.optics = job->optics.optics;
done:
    return status;
}

clshear_status cs_job_check(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    CS_TRY(check_window(job, error));
    CS_TRY(check_counts(&job->options, error));
    CS_TRY(choose_pattern(job, error));
    CS_TRY(check_lens(&job->lens, error));
    CS_TRY(make_camera(job, error));
done:
    return status;
}
