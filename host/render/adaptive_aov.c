/* AOVs of a render that shares samples out: as the picture, they are means of the replicates with
 * equal weights, while the device has sums over samples. So the host takes the sums of each
 * replicate off the device, and in the end puts there what divided by the samples is the mean. */
#include <stdlib.h>

#include "render/adaptive.h"
#include "render/render_job.h"

/* What is done to the sums of a pixel: `sums` on the device and `kept` ones of beginnings. */
typedef void (*visit)(cs_job *job, cs_u32 replicate, size_t index, const cs_pixel *pixel,
                      cs_exact_sum *sums);

static cs_exact_sum exact(double value)
{
    const cs_f32 sum = (cs_f32)value;
    return (cs_exact_sum){sum, (cs_f32)(value - (double)sum)};
}

static void take(cs_job *job, cs_u32 replicate, size_t index, const cs_pixel *pixel,
                 cs_exact_sum *sums)
{
    cs_exact_sum *kept = job->adaptive.shares[replicate].aovs + index * job->pixels.planes;
    (void)pixel;
    for (size_t k = 0; k < job->pixels.planes; k++) {
        kept[k] = sums[k];
        sums[k] = exact(0.0);
    }
}

static void put(cs_job *job, cs_u32 replicate, size_t index, const cs_pixel *pixel,
                cs_exact_sum *sums)
{
    const cs_exact_sum *kept = job->adaptive.shares[replicate].aovs + index * job->pixels.planes;
    (void)pixel;
    for (size_t k = 0; k < job->pixels.planes; k++)
        sums[k] = kept[k];
}

static void close(cs_job *job, cs_u32 replicate, size_t index, const cs_pixel *pixel,
                  cs_exact_sum *sums)
{
    const double samples = job->adaptive.shares[replicate].samples[index];
    double *means = job->adaptive.aov_means + index * job->pixels.planes;
    (void)pixel;
    for (size_t k = 0; k < job->pixels.planes; k++) {
        means[k] += cs_exact_total(sums[k]) / samples;
        sums[k] = exact(0.0);
    }
}

/* In a beginning all samples have the same weight. */
static void settle_beginning(const cs_job *job, size_t index, cs_exact_sum *sums)
{
    const size_t planes = job->pixels.planes;
    for (size_t k = 0; k < planes; k++)
        for (cs_u32 b = 0; b < job->adaptive.drawn; b++)
            sums[k] = exact(cs_exact_total(sums[k]) +
                            cs_exact_total(job->adaptive.shares[b].aovs[index * planes + k]));
}

static void settle(cs_job *job, cs_u32 replicate, size_t index, const cs_pixel *pixel,
                   cs_exact_sum *sums)
{
    const cs_adaptive *adaptive = &job->adaptive;
    const size_t planes = job->pixels.planes;
    if (adaptive->drawn < CS_BEGINNINGS) {
        settle_beginning(job, index, sums);
        return;
    }
    const cs_u32 begun_with = cs_adaptive_begun_with(adaptive, index);
    /* The replicate in progress, if there is one. */
    const cs_u32 open = adaptive->begun == adaptive->closed ? 0
                        : pixel->patterns > adaptive->closed
                            ? adaptive->shares[replicate].samples[index]
                            : pixel->pending;
    for (size_t k = 0; k < planes; k++) {
        double sum = adaptive->aov_means[index * planes + k], count = adaptive->closed;
        if (open > 0) sum += cs_exact_total(sums[k]) / open, count++;
        for (cs_u32 b = adaptive->begun; b < CS_BEGINNINGS; b++, count++)
            sum += cs_exact_total(adaptive->shares[b].aovs[index * planes + k]) / begun_with;
        sums[k] = exact(count > 0.0 ? sum / count * pixel->samples : 0.0);
    }
}

static clshear_status visit_all(cs_job *job, visit apply, cs_u32 replicate, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t planes = job->pixels.planes;
    if (planes == 0) return CLSHEAR_OK;
    cs_pixel *pixels = malloc(CS_AOV_PIXEL_SLICE * sizeof *pixels);
    cs_exact_sum *sums = malloc(CS_AOV_PIXEL_SLICE * planes * sizeof *sums);
    CS_REQUIRE(pixels != NULL && sums != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t first = 0; first < job->pixel_count; first += CS_AOV_PIXEL_SLICE) {
        const size_t left = job->pixel_count - first,
                     count = left < CS_AOV_PIXEL_SLICE ? left : CS_AOV_PIXEL_SLICE;
        CS_TRY(cs_pixels_read(&job->pixels, first, count, pixels, error));
        CS_TRY(cs_pixels_read_aovs(&job->pixels, first, count, sums, error));
        for (size_t i = 0; i < count; i++)
            apply(job, replicate, first + i, &pixels[i], sums + i * planes);
        CS_TRY(cs_pixels_write_aovs(&job->pixels, first, count, sums, error));
    }
done:
    free(pixels);
    free(sums);
    return status;
}

clshear_status cs_adaptive_reserve_aovs(cs_job *job, cs_error *error)
{
    const size_t values = job->pixel_count * job->pixels.planes;
    int good = 1;
    if (values == 0) return CLSHEAR_OK;
    for (int k = 0; k < CS_BEGINNINGS; k++) {
        cs_share *share = &job->adaptive.shares[k];
        good &= (share->aovs = malloc(values * sizeof *share->aovs)) != NULL;
    }
    good &= (job->adaptive.aov_means = calloc(values, sizeof *job->adaptive.aov_means)) != NULL;
    return good ? CLSHEAR_OK
                : cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for the AOVs of %zu pixels",
                          job->pixel_count);
}

clshear_status cs_adaptive_take_aovs(cs_job *job, cs_u32 replicate, cs_error *error)
{
    return visit_all(job, take, replicate, error);
}

clshear_status cs_adaptive_put_aovs(cs_job *job, cs_u32 replicate, cs_error *error)
{
    return visit_all(job, put, replicate, error);
}

clshear_status cs_adaptive_close_aovs(cs_job *job, cs_u32 replicate, cs_error *error)
{
    return visit_all(job, close, replicate, error);
}

clshear_status cs_adaptive_settle_aovs(cs_job *job, cs_error *error)
{
    return visit_all(job, settle, job->adaptive.closed, error);
}
