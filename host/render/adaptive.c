#include "render/adaptive.h"

#include <stdlib.h>

#include "oracle/allocate.h"
#include "pattern/pattern.h"
#include "render/aov.h"
#include "render/background.h"
#include "render/pilot.h"
#include "render/render_job.h"
#include "render/resume.h"
#include "render/visit.h"

/* Samples of a beginning: a quarter of a pattern, but enough to tell something and to fill the
 * lanes of a packet, which fewer would leave idle; if the pixels that are not certain can have as
 * many on average. */
static cs_u32 beginning_of(cs_u32 pattern, double affordable)
{
    const cs_u32 whole = cs_power_of_two(pattern);
    const cs_u32 least = affordable >= 16.0 ? 16 : whole < 16 ? whole : 16;
    return whole / 4 > least ? whole / 4 : least;
}

/* How many samples a beginning has. certain: the number of certain pixels. */
static void choose_beginning(cs_job *job, double certain)
{
    cs_adaptive *adaptive = &job->adaptive;
    const cs_u32 pattern = job->pattern.grid.count;
    const double all = (double)job->pixel_count;
    adaptive->few = pattern / 32 > 2 ? cs_power_of_two(pattern / 32) : 2;
    adaptive->begin = beginning_of(
        pattern, all > certain ? (all * pattern - certain * adaptive->few) / (all - certain) : 0.0);
}

/* Stop rules, shards and checkpoints need all patterns to be planned before the first sample. */
static int is_planned_ahead(const cs_job *job)
{
    return job->base != NULL || job->shards > 1 || cs_stop_has_rules(&job->stop) ||
           cs_is_set(&job->settings, CHECKPOINT);
}

/* Whether it could share out if that is wanted. */
static int can_share_out(const cs_job *job)
{
    return cs_sampler_is_progressive(job->pattern.sampler) && job->replicates == CS_BEGINNINGS &&
           job->pattern.grid.count >= CS_LEAST_TO_SHARE_OUT && !is_planned_ahead(job);
}

clshear_status cs_adaptive_complete(cs_job *job, cs_error *error)
{
    const double shares = can_share_out(job) && cs_integer(&job->settings, EXTENDABLE) == 0 &&
                          job->pattern.grid.count >= CS_LEAST_TO_SHARE_OUT_UNASKED;
    if (cs_is_set(&job->settings, ADAPTIVE)) return CLSHEAR_OK;
    job->adaptive.is_unasked = shares != 0.0;
    return cs_settings_set(&job->settings, CLSHEAR_ADAPTIVE, &shares, 1, error);
}

int cs_adaptive_shares(const cs_job *job)
{
    return cs_integer(&job->settings, ADAPTIVE) != 0 && can_share_out(job);
}

size_t cs_adaptive_bytes(const cs_job *job)
{
    const size_t colours =
        sizeof *job->adaptive.shares->samples + 3 * sizeof *job->adaptive.shares->beginning;
    const size_t plane =
        CS_BEGINNINGS * sizeof *job->adaptive.shares->aovs + sizeof *job->adaptive.aov_means;
    return sizeof *job->adaptive.certain + CS_BEGINNINGS * colours +
           cs_aov_count(job->planes) * plane;
}

/* Samples that patterns may have. */
static cs_range range_of(const cs_job *job)
{
    const cs_adaptive *adaptive = &job->adaptive;
    const cs_u32 mean = job->pattern.grid.count;
    return (cs_range){.certain = adaptive->few,
                      .least = adaptive->begin,
                      .even = mean > adaptive->begin ? mean : adaptive->begin,
                      .mean = mean,
                      .most = cs_sampler_most(job->pattern.sampler)};
}

/* Whether sharing out promises its price. A pattern in two parts takes 5 to 20 % more time than one
 * that is drawn at once, since its packets are less coherent, and pixels that need more samples
 * take more time for each. Where much is background, it always pays. */
static clshear_status ask_whether_it_pays(cs_job *job, double certain, int *pays, cs_error *error)
{
    const double least_gain = 1.25, much = 0.25;
    const cs_range range = range_of(job);
    double gain = 0.0;
    *pays = 1;
    if (certain >= much * (double)job->pixel_count) return CLSHEAR_OK;
    const clshear_status status =
        cs_pilot_promise(job, job->adaptive.certain, &range, &gain, error);
    *pays = gain >= least_gain;
    return status;
}

/* Chooses even samples after all. */
static clshear_status revoke(cs_job *job, cs_error *error)
{
    const double even = 0.0;
    free(job->adaptive.certain);
    job->adaptive = (cs_adaptive){0};
    return cs_settings_set(&job->settings, CLSHEAR_ADAPTIVE, &even, 1, error);
}

static clshear_status reserve(cs_job *job, cs_error *error)
{
    cs_adaptive *adaptive = &job->adaptive;
    for (int k = 0; k < CS_BEGINNINGS; k++) {
        cs_share *share = &adaptive->shares[k];
        share->samples = malloc(job->pixel_count * sizeof *share->samples);
        share->beginning = malloc(3 * job->pixel_count * sizeof *share->beginning);
        if (share->samples == NULL || share->beginning == NULL)
            return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
                           job->pixel_count);
    }
    for (size_t i = 0; i < CS_BEGINNINGS * job->pixel_count; i++)
        adaptive->shares[i % CS_BEGINNINGS].samples[i / CS_BEGINNINGS] =
            cs_adaptive_begun_with(adaptive, i / CS_BEGINNINGS);
    return cs_adaptive_reserve_aovs(job, error);
}

clshear_status cs_adaptive_plan(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_adaptive *adaptive = &job->adaptive;
    double certain = 0.0;
    int pays = 1;
    if (!can_share_out(job)) return CLSHEAR_OK;
    adaptive->certain = malloc(job->pixel_count);
    CS_REQUIRE(adaptive->certain != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
               job->pixel_count);
    CS_TRY(cs_background_find(job, adaptive->certain, error));
    for (size_t i = 0; i < job->pixel_count; i++)
        certain += adaptive->certain[i];
    choose_beginning(job, certain);
    if (adaptive->is_unasked) CS_TRY(ask_whether_it_pays(job, certain, &pays, error));
    return pays ? reserve(job, error) : revoke(job, error);
done:
    return status;
}

cs_u32 cs_adaptive_begun_with(const cs_adaptive *adaptive, size_t index)
{
    return adaptive->certain[index] ? adaptive->few : adaptive->begin;
}

static void free_batches(cs_share *share)
{
    for (size_t b = 0; b < share->batch_count; b++)
        cs_batch_free(&share->batches[b]);
    share->batch_count = 0;
}

void cs_adaptive_free(cs_adaptive *adaptive)
{
    for (int k = 0; k < CS_BEGINNINGS; k++) {
        cs_share *share = &adaptive->shares[k];
        free_batches(share);
        free(share->samples);
        free(share->beginning);
        free(share->aovs);
    }
    free(adaptive->certain);
    free(adaptive->aov_means);
}

/* Where a beginning's statistics go, each a value for each pixel. */
typedef struct finding {
    cs_exact_sum *sums;
    cs_f32 *variance; /* of the mean, if samples were independent; averaged over colours */
    cs_f32 *intensity;
    const struct finding *before; /* the beginning that was drawn before; NULL: none */
} finding;

/* Squared deviations of a beginning's `count` samples from their mean, summed over colours. The
 * pixel has those of the beginning before too: the merge of moments (stats.h) taken back. */
static double deviations_of(const finding *found, size_t index, const cs_pixel *pixel, double count)
{
    const finding *before = found->before;
    double all = 0.0, between = 0.0;
    for (size_t c = 0; c < 3; c++) {
        all += (double)pixel->sample_m2[c];
        if (before == NULL) continue;
        const double gap =
            (double)found->sums[3 * index + c].sum - (double)before->sums[3 * index + c].sum;
        between += gap * gap / (2.0 * count);
    }
    if (before != NULL) between += 3.0 * count * (count - 1.0) * (double)before->variance[index];
    return all > between ? all - between : 0.0;
}

/* Takes a beginning out of the pixel. */
static void take_out(cs_job *job, void *user, size_t index, cs_pixel *pixel)
{
    const finding *found = user;
    const double count = cs_adaptive_begun_with(&job->adaptive, index);
    double sum = 0.0;
    for (size_t c = 0; c < 3; c++) {
        found->sums[3 * index + c] = (cs_exact_sum){pixel->sum[c], pixel->carry[c]};
        sum += (double)pixel->sum[c];
        pixel->sum[c] = pixel->carry[c] = 0.0f;
    }
    pixel->pending = 0;
    found->variance[index] =
        (cs_f32)(deviations_of(found, index, pixel, count) / (3.0 * count * (count - 1.0)));
    found->intensity[index] = (cs_f32)(sum / (3.0 * count));
}

/* The least size of a replicate's patterns above `size`; 0: there is none. */
static cs_u32 next_size(const cs_job *job, const cs_share *share, cs_u32 size)
{
    cs_u32 next = 0;
    for (size_t i = 0; i < job->pixel_count; i++)
        if (share->samples[i] > size && (next == 0 || share->samples[i] < next))
            next = share->samples[i];
    return next;
}

/* Batches of the pixels whose patterns have more than `had` samples, one for each size, which draw
 * what follows these. */
static clshear_status make_batches(cs_job *job, cs_share *share, cs_u32 had, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_u32 width = (cs_u32)(job->window[1] - job->window[0]);
    const cs_u32 height = (cs_u32)(job->pixel_count / width);
    cs_u32 *list = malloc(job->pixel_count * sizeof *list);
    CS_REQUIRE(list != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
               job->pixel_count);
    for (cs_u32 size = next_size(job, share, had); size > 0; size = next_size(job, share, size)) {
        size_t count = 0;
        for (size_t i = 0; i < job->pixel_count; i++) {
            const cs_u32 pixel = cs_tiled_pixel((cs_u32)i, width, height);
            if (share->samples[pixel] == size) list[count++] = pixel;
        }
        const cs_pattern pattern = cs_pattern_of(job->pattern.sampler, had, size - had);
        share->batch_count++; /* first, so that what a failure leaves is freed */
        CS_TRY(cs_batch_create(job->scene->context, &pattern, list, count, width, 0,
                               &share->batches[share->batch_count - 1], error));
    }
done:
    free(list);
    return status;
}

/* Draws the beginning of a replicate. */
static clshear_status draw_beginning(cs_job *job, cs_pass *pass, cs_u32 replicate, finding *found,
                                     cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_visit taking = {take_out, found, 1};
    cs_share *share = &job->adaptive.shares[replicate];
    CS_TRY(make_batches(job, share, 0, error));
    pass->launch.goes_on = 1;
    CS_TRY(cs_pass_replicate(pass, share->batches, share->batch_count, replicate, error));
    pass->launch.goes_on = 0;
    CS_TRY(cs_visit_pixels(job, &taking, error));
    CS_TRY(cs_adaptive_take_aovs(job, replicate, error));
    job->adaptive.drawn++;
done:
    free_batches(share);
    return status;
}

/* The sizes of a replicate's patterns, from that of the beginning on: by what the other's beginning
 * has found in the pixel, and both in its neighbours (`near`). */
static clshear_status size_patterns(cs_job *job, const finding *other, const finding *near,
                                    cs_u32 *samples, cs_error *error)
{
    const cs_adaptive *adaptive = &job->adaptive;
    const cs_pilot_picture picture = {.variance = other->variance,
                                      .intensity = other->intensity,
                                      .near_variance = near->variance,
                                      .near_intensity = near->intensity,
                                      .certain = adaptive->certain,
                                      .width = job->window[1] - job->window[0],
                                      .height = job->window[3] - job->window[2],
                                      .pattern = adaptive->begin,
                                      .replicates = 1};
    const cs_range range = range_of(job);
    return cs_allocate_samples(&picture, &range, samples, error);
}

/* Puts a beginning back into the pixel, and finishes the pattern where that is all of it. */
static void put_back(cs_job *job, void *user, size_t index, cs_pixel *pixel)
{
    const cs_share *share = user;
    for (size_t c = 0; c < 3; c++) {
        pixel->sum[c] = share->beginning[3 * index + c].sum;
        pixel->carry[c] = share->beginning[3 * index + c].carry;
    }
    pixel->pending = cs_adaptive_begun_with(&job->adaptive, index);
    if (share->samples[index] == pixel->pending) cs_finish_pattern(pixel);
}

enum {
    FINDINGS = 2 * (CS_BEGINNINGS + 1) /* variance and intensity of each beginning and of both */
};

size_t cs_adaptive_begin_bytes(void)
{
    return FINDINGS * sizeof(cs_f32) + cs_allocate_bytes();
}

/* The beginnings, and what they decide. */
static clshear_status begin(cs_job *job, cs_pass *pass, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t count = job->pixel_count;
    cs_f32 *memory = malloc(FINDINGS * count * sizeof *memory);
    finding found[CS_BEGINNINGS], both = {.variance = memory, .intensity = memory + count};
    CS_REQUIRE(memory != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels", count);
    for (cs_u32 k = 0; k < CS_BEGINNINGS; k++) {
        cs_f32 *values = memory + 2 * (k + 1) * count;
        found[k] = (finding){job->adaptive.shares[k].beginning, values, values + count,
                             k > 0 ? &found[k - 1] : NULL};
        CS_TRY(draw_beginning(job, pass, k, &found[k], error));
    }
    for (size_t i = 0; i < count; i++) {
        both.variance[i] = 0.5f * (found[0].variance[i] + found[1].variance[i]);
        both.intensity[i] = 0.5f * (found[0].intensity[i] + found[1].intensity[i]);
    }
    for (cs_u32 k = 0; k < CS_BEGINNINGS; k++)
        CS_TRY(size_patterns(job, &found[1 - k], &both, job->adaptive.shares[k].samples, error));
done:
    free(memory);
    return status;
}

/* Draws the rest of a replicate. */
static clshear_status draw_replicate(cs_job *job, cs_pass *pass, cs_u32 replicate, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_share *share = &job->adaptive.shares[replicate];
    const cs_visit putting = {put_back, share, 1};
    CS_TRY(make_batches(job, share, job->adaptive.begin, error));
    CS_TRY(cs_visit_pixels(job, &putting, error));
    CS_TRY(cs_adaptive_put_aovs(job, replicate, error));
    job->adaptive.begun = replicate + 1;
    CS_TRY(cs_resume_begin(job, replicate, error));
    CS_TRY(cs_pass_replicate(pass, share->batches, share->batch_count, replicate, error));
    CS_TRY(cs_resume_end(job, replicate, error));
    CS_TRY(cs_adaptive_close_aovs(job, replicate, error));
    job->adaptive.closed = replicate + 1;
done:
    return status;
}

/* The samples of all patterns, whose mean is only about the one asked for. */
static double count_samples(const cs_job *job)
{
    double samples = 0.0;
    for (cs_u32 r = 0; r < job->replicates; r++)
        for (size_t i = 0; i < job->pixel_count; i++)
            samples += (double)job->adaptive.shares[r].samples[i];
    return samples;
}

clshear_status cs_adaptive_run(cs_job *job, cs_pass *pass, cs_error *error)
{
    pass->total = (double)job->spp * (double)job->pixel_count;
    clshear_status status = begin(job, pass, error);
    if (status == CLSHEAR_OK) pass->total = count_samples(job);
    for (cs_u32 r = 0; r < job->replicates && status == CLSHEAR_OK; r++)
        status = draw_replicate(job, pass, r, error);
    if (status != CLSHEAR_OK && status != CS_CANCELLED) return status;
    const clshear_status settled = cs_adaptive_settle_aovs(job, error);
    return settled == CLSHEAR_OK ? status : settled;
}

double cs_adaptive_mean(const cs_job *job, const cs_pixel *pixel, size_t index, int colour)
{
    const cs_adaptive *adaptive = &job->adaptive;
    const double finished =
        (double)pixel->pattern_sum[colour] + (double)pixel->pattern_carry[colour];
    const double pending = (double)pixel->sum[colour] + (double)pixel->carry[colour];
    const double begun_with = cs_adaptive_begun_with(adaptive, index);
    /* Beginnings that no pattern contains yet. */
    double sum = 0.0, count = 0.0;
    for (cs_u32 r = adaptive->begun; r < adaptive->drawn; r++) {
        const cs_exact_sum *beginning = &adaptive->shares[r].beginning[3 * index + (size_t)colour];
        sum += ((double)beginning->sum + (double)beginning->carry) / begun_with;
        count++;
    }
    if (adaptive->drawn == CS_BEGINNINGS) {
        sum += finished + (pixel->pending > 0 ? pending / pixel->pending : 0.0);
        count += pixel->patterns + (pixel->pending > 0 ? 1.0 : 0.0);
    } else { /* in a beginning: all samples have the same weight */
        sum = sum * begun_with + pending;
        count = pixel->samples;
    }
    return count > 0.0 ? sum / count : 0.0;
}
