/* A small render of some pixels that is thrown away. */
#include "render/pilot_run.h"

#include <stdlib.h>

#include "pattern/pattern.h"
#include "render/motion.h"

/* The variance of a pattern's mean, averaged over colours: from several patterns, or from the
 * samples of one. */
static cs_f32 variance_of(const cs_pixel *pixel)
{
    const int is_one = pixel->patterns == 1;
    const cs_f32 *m2 = is_one ? pixel->sample_m2 : pixel->pattern_m2;
    const cs_f32 count = (cs_f32)(is_one ? pixel->samples : pixel->patterns);
    return (m2[0] + m2[1] + m2[2]) / (3.0f * (count - 1.0f) * (is_one ? count : 1.0f));
}

/* Of the pixels in `list`; NULL: of all. */
static clshear_status read_outcome(const cs_job *job, const cs_pixels *pixels, const cs_u32 *list,
                                   const cs_outcome *result, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_pixel *slice = malloc(CS_PIXEL_SLICE * sizeof *slice);
    CS_REQUIRE(slice != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t i = 0; i < job->pixel_count && list != NULL; i++)
        result->variance[i] = -1.0f;
    for (size_t first = 0; first < pixels->count; first += CS_PIXEL_SLICE) {
        const size_t left = pixels->count - first,
                     count = left < CS_PIXEL_SLICE ? left : CS_PIXEL_SLICE;
        CS_TRY(cs_pixels_read(pixels, first, count, slice, error));
        for (size_t i = 0; i < count; i++) {
            const cs_pixel *p = &slice[i];
            const size_t number = list != NULL ? list[first + i] : first + i;
            cs_f32 sum = 0.0f;
            for (int c = 0; c < 3; c++)
                sum += p->pattern_sum[c];
            result->variance[number] = variance_of(p);
            if (result->intensity != NULL)
                result->intensity[number] = sum / (3.0f * (cs_f32)p->patterns);
        }
    }
done:
    free(slice);
    return status;
}

clshear_status cs_pilot_run(cs_job *job, const cs_trial *how, const cs_u32 *list, size_t count,
                            cs_u32 samples, cs_u32 replicates, const cs_outcome *result,
                            cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    clshear_context *context = job->scene->context;
    cs_buffer *shear_buffer = NULL, *velocities = NULL;
    cs_pixels pixels = {0};
    cs_batch batch = {0};
    const cs_u32 width = (cs_u32)(job->window[1] - job->window[0]);
    const cs_pattern pattern = cs_pattern_of_length(&job->pattern, samples);
    cs_pass pass = cs_job_pass(job);
    if (count > 0) {
        CS_TRY(cs_pixels_create(context, count, width, 0, &pixels, error));
        CS_TRY(cs_buffer_create(context->device, job->pixel_count * sizeof *how->shears,
                                how->shears, &shear_buffer, error));
        CS_TRY(cs_motion_upload(job, how->rules, &velocities, error));
        CS_TRY(cs_batch_create(context, &pattern, list, count, width, list != NULL, &batch, error));
        pass.launch.seed = cs_key(job->seed, 0x70696c6fu); /* its own random numbers */
        pass.shears = shear_buffer;
        pass.velocities = velocities;
        pass.pixels = &pixels;
        pass.settings = &job->settings;
        for (cs_u32 replicate = 0; replicate < replicates; replicate++)
            CS_TRY(cs_pass_replicate(&pass, &batch, 1, replicate, error));
        job->pilot_samples += pass.done;
    }
    CS_TRY(read_outcome(job, &pixels, list, result, error));
done:
    job->kernel_s += pass.kernel_s;
    cs_batch_free(&batch);
    cs_buffer_free(shear_buffer);
    cs_buffer_free(velocities);
    cs_pixels_free(&pixels);
    return status;
}
