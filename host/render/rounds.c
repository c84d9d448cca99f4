#include "render/rounds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "film/noise.h"
#include "pattern/pattern.h"
#include "render/resume.h"

enum {
    LOOK_PLANES = 6,  /* mean and variance of three colours */
    FIRST_ROUND = 16, /* samples of a pattern */
    FIRST_PATTERNS = 2,
    SPP_OF_PILOTS = 256 /* where the render may end with few samples */
};

static int draws_rounds(const cs_job *job)
{
    return cs_stop_has_rules(&job->stop) && cs_sampler_is_progressive(job->pattern.sampler);
}

size_t cs_rounds_bytes(const cs_job *job)
{
    return draws_rounds(job) ? job->replicates * sizeof *job->rounds.open : 0;
}

size_t cs_rounds_look_bytes(const cs_job *job)
{
    if (!cs_stop_has_rules(&job->stop)) return 0;
    return LOOK_PLANES * sizeof(float) + (job->stop.pixels > 0.0 ? cs_noise_bytes() : 0);
}

clshear_status cs_rounds_check(cs_job *job, cs_error *error)
{
    if (!cs_stop_has_rules(&job->stop)) return CLSHEAR_OK;
    if (job->pilot_spp > SPP_OF_PILOTS) job->pilot_spp = SPP_OF_PILOTS;
    if (job->replicates < 2)
        return cs_fail(
            error, CLSHEAR_BAD_ARGUMENT,
            "a render that stops by itself needs 2 replicates or more, to see its error");
    if (!draws_rounds(job) && job->replicates <= FIRST_PATTERNS)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "sampler %s can stop between replicates only: give more than %d of them, or "
                       "a progressive sampler",
                       cs_sampler_name(job->pattern.sampler), FIRST_PATTERNS);
    return CLSHEAR_OK;
}

/* Moves the unfinished patterns of the replicate in progress between the device and the host. */
static clshear_status swap_open_patterns(cs_job *job, int to_device, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_open_pattern *patterns = job->rounds.open + job->rounds.replicate * job->pixel_count;
    cs_pixel *slice = malloc(CS_PIXEL_SLICE * sizeof *slice);
    CS_REQUIRE(slice != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t first = 0; first < job->pixel_count; first += CS_PIXEL_SLICE) {
        const size_t left = job->pixel_count - first,
                     count = left < CS_PIXEL_SLICE ? left : CS_PIXEL_SLICE;
        CS_TRY(cs_pixels_read(&job->pixels, first, count, slice, error));
        for (size_t i = 0; i < count; i++) {
            cs_open_pattern *open = &patterns[first + i];
            if (to_device) {
                memcpy(slice[i].sum, open->sum, sizeof open->sum);
                memcpy(slice[i].carry, open->carry, sizeof open->carry);
                slice[i].pending = open->pending;
            } else {
                memcpy(open->sum, slice[i].sum, sizeof open->sum);
                memcpy(open->carry, slice[i].carry, sizeof open->carry);
                open->pending = slice[i].pending;
            }
        }
        if (to_device) CS_TRY(cs_pixels_write(&job->pixels, first, count, slice, error));
    }
done:
    free(slice);
    return status;
}

/* Room for the patterns, with what the extended picture has of them. */
static clshear_status begin(cs_job *job, cs_error *error)
{
    cs_rounds *rounds = &job->rounds;
    rounds->open = calloc(job->replicates * job->pixel_count, sizeof *rounds->open);
    if (rounds->open == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %u patterns of %zu pixels",
                       job->replicates, job->pixel_count);
    for (rounds->replicate = 0; rounds->replicate < job->replicates; rounds->replicate++) {
        clshear_status status = cs_resume_begin(job, rounds->replicate, error);
        if (status == CLSHEAR_OK && job->base != NULL) status = swap_open_patterns(job, 0, error);
        if (status != CLSHEAR_OK) return status;
    }
    rounds->replicate = 0;
    return CLSHEAR_OK;
}

/* The place in a batch's pattern at which `samples` of the job's pattern are drawn. */
static cs_u32 place_in(const cs_job *job, const cs_pattern *whole, cs_u32 samples)
{
    return (cs_u32)((uint64_t)whole->grid.count * samples / job->pattern.grid.count);
}

/* Makes the batches draw what the round adds to their patterns. */
static clshear_status set_patterns(cs_job *job, cs_error *error)
{
    const cs_rounds *rounds = &job->rounds;
    for (size_t b = 0; b < job->batch_count; b++) {
        const cs_pattern *whole = &rounds->whole[b];
        const cs_u32 from = place_in(job, whole, rounds->from);
        const cs_u32 to = place_in(job, whole, rounds->to);
        if (from == to) { /* too few of the pixels' samples for the round to have one */
            job->batches[b].pattern.blocks = 0;
            job->batches[b].pattern.grid.count = 0;
            continue;
        }
        const cs_pattern part = cs_pattern_of(whole->sampler, whole->first + from, to - from);
        const clshear_status status =
            cs_batch_set_pattern(job->scene->context, &part, &job->batches[b], error);
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}

/* Samples of all pixels for one sample of each of the job's patterns. */
static double samples_of_unit(const cs_job *job)
{
    double samples = 0.0;
    for (size_t b = 0; b < job->batch_count; b++)
        samples += (double)job->batches[b].pixel_count * job->rounds.whole[b].grid.count;
    return samples * job->replicates / job->pattern.grid.count;
}

/* Judges the picture so far. */
static clshear_status look(cs_job *job, int *is_reached, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t pixels = job->pixel_count;
    cs_look seen = {.samples = (double)job->pattern.first + job->rounds.from};
    cs_estimate estimate = {.width = job->window[1] - job->window[0],
                            .height = job->window[3] - job->window[2]};
    const cs_tone tone = {.exposure = (float)cs_number(&job->settings, EXPOSURE),
                          .is_auto = (int)cs_integer(&job->settings, AUTO_EXPOSURE),
                          .curve = (int)cs_integer(&job->settings, TONE)};
    float *planes = malloc(LOOK_PLANES * pixels * sizeof *planes);
    cs_pixel *slice = malloc(CS_PIXEL_SLICE * sizeof *slice);
    CS_REQUIRE(planes != NULL && slice != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for %zu pixels", pixels);
    for (size_t first = 0; first < pixels; first += CS_PIXEL_SLICE) {
        const size_t left = pixels - first, count = left < CS_PIXEL_SLICE ? left : CS_PIXEL_SLICE;
        CS_TRY(cs_rounds_read(job, first, count, slice, error));
        for (size_t i = 0; i < 3 * count; i++) {
            const cs_pixel *pixel = &slice[i / 3];
            const size_t c = i % 3, place = c * pixels + first + i / 3;
            const float patterns = (float)pixel->patterns;
            planes[place] = pixel->pattern_sum[c] / patterns;
            planes[3 * pixels + place] = pixel->pattern_m2[c] / (patterns * (patterns - 1.0f));
        }
    }
    for (size_t c = 0; c < 3; c++) {
        estimate.mean[c] = planes + c * pixels;
        estimate.variance[c] = planes + (3 + c) * pixels;
    }
    seen.noise = cs_noise_of_picture(&estimate);
    if (job->stop.pixels > 0.0) CS_TRY(cs_noise_of_pixels(&estimate, &tone, &seen.pixels, error));
    *is_reached = cs_stop_look(&job->stop, &seen);
done:
    free(slice);
    free(planes);
    return status;
}

void cs_rounds_tell(const cs_job *job, cs_pass *pass)
{
    const cs_stop *stop = &job->stop;
    pass->noise = stop->last.noise;
    pass->noise_pixel = stop->last.pixels;
    pass->is_open = cs_stop_has_rules(stop) && !(stop->time_s > 0.0) && !(stop->last.samples > 0.0);
}

/* Plans the next round, which is empty where the render ends, and tells the pass what to expect.
 * `work` says how rounds are cut; samples_of_unit: of all pixels, for one unit of it. */
static void plan(cs_job *job, cs_pass *pass, cs_work work, double samples_of_unit)
{
    const cs_u32 had = job->pattern.first;
    const double now_s = cs_now_s();
    work.done = had + job->rounds.from;
    work.left_s = job->stop.time_s - (now_s - job->start_s);
    if (pass->done > 0.0) work.units_per_s = pass->done / (now_s - pass->start_s) / samples_of_unit;
    const cs_u32 next = cs_stop_next(&job->stop, &work);
    double most = fmin(work.most, cs_stop_expected(&job->stop));
    if (job->stop.time_s > 0.0 && work.units_per_s > 0.0)
        most = fmin(most, work.done + work.left_s * work.units_per_s);
    pass->total = samples_of_unit * (fmax(most, next) - had);
    cs_rounds_tell(job, pass);
    job->rounds.to = next - had;
}

/* One round of all replicates, from its place on. */
static clshear_status draw_round(cs_job *job, cs_pass *pass, cs_error *error)
{
    clshear_status status = set_patterns(job, error);
    cs_rounds *rounds = &job->rounds;
    for (; status == CLSHEAR_OK && rounds->replicate < job->replicates; rounds->replicate++) {
        if (cs_pass_is_fresh(pass)) CS_TRY(swap_open_patterns(job, 1, error));
        CS_TRY(cs_pass_replicate(pass, job->batches, job->batch_count, rounds->replicate, error));
        CS_TRY(swap_open_patterns(job, 0, error));
    }
done:
    return status;
}

/* The means of the patterns, for extensions. */
static void keep_means(cs_job *job)
{
    const size_t pixels = job->pixel_count;
    if (job->pattern_means == NULL) return;
    for (size_t r = 0; r < job->replicates; r++)
        for (size_t i = 0; i < 3 * pixels; i++) {
            const cs_open_pattern *open = &job->rounds.open[r * pixels + i % pixels];
            const size_t c = i / pixels;
            job->pattern_means[3 * r * pixels + i] =
                (float)(((double)open->sum[c] + (double)open->carry[c]) / open->pending);
        }
    job->patterns_kept = job->replicates;
}

static clshear_status run_rounds(cs_job *job, cs_pass *pass, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_rounds *rounds = &job->rounds;
    const cs_work work = {.first = FIRST_ROUND,
                          .grain = CS_BLOCK,
                          .most = job->pattern.first + job->pattern.grid.count};
    int is_reached = 0;
    pass->launch.goes_on = 1;
    if (rounds->open == NULL) {
        CS_TRY(begin(job, error));
        if (job->base != NULL) CS_TRY(look(job, &is_reached, error));
    }
    while (!is_reached) {
        if (rounds->from == rounds->to) plan(job, pass, work, samples_of_unit(job));
        if (rounds->from == rounds->to) break;
        CS_TRY(draw_round(job, pass, error));
        rounds->from = rounds->to;
        rounds->replicate = 0;
        CS_TRY(look(job, &is_reached, error));
    }
    keep_means(job);
done:
    return status;
}

/* Replicate after replicate; rounds are of whole ones. */
static clshear_status run_patterns(cs_job *job, cs_pass *pass, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_rounds *rounds = &job->rounds;
    const cs_work work = {.first = FIRST_PATTERNS, .grain = 1, .most = job->replicates};
    const double samples = samples_of_unit(job) * job->pattern.grid.count / job->replicates;
    int is_reached = 0;
    while (!is_reached) {
        if (rounds->from == rounds->to) plan(job, pass, work, samples);
        if (rounds->from == rounds->to) break;
        for (; rounds->from < rounds->to; rounds->from++) {
            if (cs_pass_is_fresh(pass)) CS_TRY(cs_resume_begin(job, rounds->from, error));
            CS_TRY(cs_pass_replicate(pass, job->batches, job->batch_count, rounds->from, error));
            CS_TRY(cs_resume_end(job, rounds->from, error));
        }
        CS_TRY(look(job, &is_reached, error));
    }
    job->replicates = rounds->from;
    const double drawn = job->replicates;
    CS_TRY(cs_settings_set(&job->settings, CLSHEAR_REPLICATES, &drawn, 1, error));
done:
    return status;
}

clshear_status cs_rounds_run(cs_job *job, cs_pass *pass, cs_error *error)
{
    for (size_t b = 0; b < job->batch_count; b++)
        job->rounds.whole[b] = job->batches[b].pattern;
    return draws_rounds(job) ? run_rounds(job, pass, error) : run_patterns(job, pass, error);
}

/* What the kernel does at the end of a pattern, in the same order. */
static void finish(cs_pixel *pixel, const cs_open_pattern *open)
{
    const cs_f32 patterns = (cs_f32)pixel->patterns;
    for (int c = 0; c < 3; c++) {
        const cs_f32 mean = (open->sum[c] + open->carry[c]) / (cs_f32)open->pending;
        cs_exact_sum means = {pixel->pattern_sum[c], pixel->pattern_carry[c]};
        const cs_f32 before = means.sum / (patterns > 1.0f ? patterns : 1.0f);
        const cs_moments moments = {patterns, before, pixel->pattern_m2[c]};
        pixel->pattern_m2[c] = cs_moments_add(moments, mean).m2;
        means = cs_exact_add(means, mean);
        pixel->pattern_sum[c] = means.sum;
        pixel->pattern_carry[c] = means.carry;
    }
    pixel->patterns++;
}

/* Puts the patterns of all replicates into a pixel that has the one in progress; in the middle of a
 * round they differ in size, and are all taken as one that is not finished. */
static void combine(const cs_job *job, size_t index, cs_pixel *pixel)
{
    const cs_rounds *rounds = &job->rounds;
    const int is_even = rounds->from == rounds->to;
    double sum[3] = {0.0, 0.0, 0.0};
    for (cs_u32 r = 0; r < job->replicates; r++) {
        cs_open_pattern open = rounds->open[r * job->pixel_count + index];
        if (is_even) finish(pixel, &open);
        for (int c = 0; c < 3 && !is_even && r != rounds->replicate; c++)
            sum[c] += (double)open.sum[c] + (double)open.carry[c];
    }
    for (int c = 0; c < 3; c++) {
        if (!is_even) sum[c] += (double)pixel->sum[c] + (double)pixel->carry[c];
        pixel->sum[c] = (cs_f32)sum[c];
        pixel->carry[c] = (cs_f32)(sum[c] - (double)pixel->sum[c]);
    }
    pixel->pending = is_even ? 0 : pixel->samples;
}

clshear_status cs_rounds_read(const cs_job *job, size_t first, size_t count, cs_pixel *pixels,
                              cs_error *error)
{
    const clshear_status status = cs_pixels_read(&job->pixels, first, count, pixels, error);
    for (size_t i = 0; status == CLSHEAR_OK && i < count && job->rounds.open != NULL; i++)
        combine(job, first + i, &pixels[i]);
    return status;
}

/* Samples per pixel with which a promise that is not kept would be; 0: unknown. */
static double spp_expected(const cs_job *job)
{
    const cs_stop *stop = &job->stop;
    const double expected = cs_stop_expected(stop);
    const int is_kept = stop->reason == CS_STOP_NOISE || stop->reason == CS_STOP_PIXELS;
    if (is_kept || !isfinite(expected)) return 0.0;
    const double others = job->rounds.open != NULL ? job->replicates : job->pattern.grid.count;
    return ceil(expected) * others;
}

clshear_status cs_rounds_describe(const cs_job *job, clshear_film *film)
{
    clshear_status status = CLSHEAR_OK;
    const cs_stop *stop = &job->stop;
    clshear_film_info *info = &film->info;
    if (!cs_stop_has_rules(stop)) return CLSHEAR_OK;
    info->stopped_by = cs_stop_words(stop->reason);
    info->noise = stop->last.noise;
    info->noise_pixel = stop->last.pixels;
    info->spp_expected = spp_expected(job);
    CS_TRY(cs_film_annotate(film, "clshear.stoppedBy", info->stopped_by));
    CS_TRY(cs_film_set_float(film, "clshear.noiseReached", (float)info->noise));
    if (stop->pixels > 0.0)
        CS_TRY(cs_film_set_float(film, "clshear.noisePixelReached", (float)info->noise_pixel));
    if (info->spp_expected > 0.0)
        CS_TRY(cs_film_set_float(film, "clshear.sppExpected", (float)info->spp_expected));
done:
    return status;
}

void cs_rounds_free(cs_job *job)
{
    free(job->rounds.open);
}
