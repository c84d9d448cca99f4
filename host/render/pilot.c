/* Pilots: small renders that are thrown away, before the samples that count are drawn. */
#include "render/pilot.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "film/noise.h"
#include "oracle/allocate.h"
#include "oracle/choose_rule.h"
#include "pattern/pattern.h"
#include "render/background.h"
#include "render/pilot_run.h"

enum {
    CHOICE_SAMPLES = 32, /* patterns by which shears are judged */
    CHOICE_REPLICATES = 2,
    GAIN_SAMPLES = 32, /* patterns by which the gain is measured */
    GAIN_REPLICATES = 4,
    PROMISE_SAMPLES = 16, /* of a pixel, by which the gain of sharing out is judged */
    GAIN_PLANES = 3       /* variances without and with the shear, and no shears */
};

/* Fewer samples than this leave a pilot nothing to find out with. */
static const cs_u32 least_spp_for_pilot = 64;

/* The part of the samples of the pixels that differ which the choice of shears may take. */
static const double choice_budget = 0.06;

/* Whether two shears make a difference that a pixel could notice. */
static int differ(cs_f32 a, cs_f32 b)
{
    return fabsf(a - b) > 0.01f * (1.0f + fabsf(a));
}

typedef struct choice {
    cs_f32 *shears[CS_RULE_COUNT];
    cs_f32 *variance[CS_RULE_COUNT];
    cs_u32 *list;
    uint8_t *rules;
} choice;

static const cs_rule prior_rule = CS_RULE_CENTRE;

static int reserve(choice *c, size_t pixels)
{
    int good = (c->list = malloc(pixels * sizeof *c->list)) != NULL;
    good &= (c->rules = malloc(pixels)) != NULL;
    for (int r = 0; r < CS_RULE_COUNT; r++) {
        good &= (c->shears[r] = malloc(pixels * sizeof(cs_f32))) != NULL;
        good &= (c->variance[r] = malloc(pixels * sizeof(cs_f32))) != NULL;
    }
    return good;
}

static void release(choice *c)
{
    free(c->list);
    free(c->rules);
    for (int r = 0; r < CS_RULE_COUNT; r++) {
        free(c->shears[r]);
        free(c->variance[r]);
    }
}

/* Rules tried against the prior. The median is the centre nearly everywhere. */
static int is_candidate(const cs_job *job, int rule)
{
    if (rule == CS_RULE_LENS || rule == CS_RULE_MOTION) return job->moves;
    return rule == CS_RULE_NEAR || rule == CS_RULE_FAR || rule == CS_RULE_NONE;
}

/* Whether the rule is a candidate that pixel `i` could tell from the prior. */
static int differs(const cs_job *job, const choice *c, int rule, size_t i)
{
    if (!is_candidate(job, rule)) return 0;
    if (job->moves && !cs_rule_has_velocity((cs_rule)rule)) {
        const cs_velocity v = job->velocities_px[i];
        if (fabsf(v.x) + fabsf(v.y) > 0.05f) return 1;
    }
    return differ(c->shears[prior_rule][i], c->shears[rule][i]);
}

/* Whether the shear of an exact depth leaves nothing: square apertures with a box. */
static int is_exact(const cs_optics *optics)
{
    return optics->has_closed_form && optics->marginal == CS_MARGINAL_UNIFORM;
}

/* The fraction of pixels that the budget affords, when each is tried with all its candidates. The
 * budget is 6 % of the samples of the pixels that a candidate differs in: the others may be of the
 * background, which costs next to nothing, and 6 % of all would be a third of the time. Where the
 * shear is exact, the right depth gains most: there it is 6 % of all. */
static double affordable_part(const cs_job *job, const choice *c)
{
    const double budget = choice_budget * (double)job->pilot_spp;
    double tries = 0.0, differing = 0.0;
    for (size_t i = 0; i < job->pixel_count; i++) {
        int candidates = 0;
        for (int r = 0; r < CS_RULE_COUNT; r++)
            candidates += differs(job, c, r, i);
        if (candidates == 0) continue;
        tries += candidates + 1;
        differing++;
    }
    const double paying = is_exact(&job->optics.optics) ? (double)job->pixel_count : differing;
    const double cost = tries * CHOICE_SAMPLES * CHOICE_REPLICATES;
    return cost > budget * paying ? budget * paying / cost : 1.0;
}

/* Lists the pixels of the pilot in which `rule` differs from the prior; for the prior itself those
 * that any candidate differs in. */
static size_t list_pixels(const cs_job *job, choice *c, int rule, double part)
{
    size_t count = 0;
    for (size_t i = 0; i < job->pixel_count; i++) {
        const cs_u32 width = (cs_u32)(job->window[1] - job->window[0]);
        const cs_u32 x = (cs_u32)job->window[0] + (cs_u32)i % width,
                     y = (cs_u32)job->window[2] + (cs_u32)i / width;
        const double lot = (double)cs_hash((y << 16 ^ x) + 1u) * 0x1p-32;
        int wanted = 0;
        for (int r = 0; r < CS_RULE_COUNT; r++)
            wanted |= (r == rule || rule == (int)prior_rule) && differs(job, c, r, i);
        if (wanted && lot < part) c->list[count++] = (cs_u32)i;
    }
    return count;
}

static clshear_status try_rules(cs_job *job, choice *c, double part, cs_error *error)
{
    for (int rule = 0; rule < CS_RULE_COUNT; rule++) {
        if (rule != (int)prior_rule && !is_candidate(job, rule)) continue;
        const size_t count = list_pixels(job, c, rule, part);
        const cs_outcome result = {.variance = c->variance[rule]};
        memset(c->rules, rule, job->pixel_count);
        const cs_trial how = {c->shears[rule], c->rules};
        clshear_status status = cs_pilot_run(job, &how, c->list, count, CHOICE_SAMPLES,
                                             CHOICE_REPLICATES, &result, error);
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}

int cs_pilot_chooses_shears(const cs_job *job)
{
    return job->oracle == CLSHEAR_ORACLE_PILOT && !cs_is_set(&job->settings, SHEAR_PX) &&
           job->shear_kind == CLSHEAR_SHEAR_EQUAL_AREA && job->spp >= least_spp_for_pilot &&
           (job->base == NULL || cs_film_channel(job->base, "Shear") == NULL);
}

clshear_status cs_pilot_shears(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const int width = job->window[1] - job->window[0], height = job->window[3] - job->window[2];
    choice c = {0};
    cs_evidence evidence[CS_RULE_COUNT] = {{0}};
    CS_REQUIRE(reserve(&c, job->pixel_count), CLSHEAR_OUT_OF_MEMORY,
               "out of memory for the pilot of %zu pixels", job->pixel_count);
    for (int r = 0; r < CS_RULE_COUNT; r++)
        for (size_t i = 0; i < job->pixel_count; i++)
            c.shears[r][i] = cs_job_shear(job, i, (cs_rule)r);
    const double part = affordable_part(job, &c);
    CS_TRY(try_rules(job, &c, part, error));
    for (int r = 0; r < CS_RULE_COUNT; r++)
        if (is_candidate(job, r))
            evidence[r] = (cs_evidence){c.variance[r], c.variance[prior_rule]};
    /* A window holds about a hundred pixels of the pilot. */
    const int radius = (int)ceil(5.0 / sqrt(part > 1e-4 ? part : 1e-4));
    CS_TRY(cs_pilot_choose(evidence, prior_rule, width, height, radius, c.rules, error));
    for (size_t i = 0; i < job->pixel_count; i++) {
        job->rule[i] = c.rules[i];
        job->shear_px[i] = c.shears[c.rules[i]][i];
    }
done:
    release(&c);
    return status;
}

/* The smallest allocation for a mean of `mean` samples: mean / 16, rounded up to a power of two,
 * but at least 4 or, for a smaller mean, the largest power of two up to the mean. */
static cs_u32 least_count(cs_u32 mean)
{
    if (mean < 4) return cs_power_of_two(mean);
    if (mean <= 64) return 4;
    return cs_power_of_two(2 * ((mean - 1) / 16) + 1);
}

static cs_range range_of(cs_u32 mean, cs_u32 most)
{
    const cs_u32 even = cs_power_of_two(mean), few = least_count(mean);
    return (cs_range){.certain = few,
                      .least = even / 4 > few ? even / 4 : few,
                      .even = even,
                      .mean = mean,
                      .most = most};
}

clshear_status cs_pilot_samples(cs_job *job, cs_u32 *samples, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const int width = job->window[1] - job->window[0], height = job->window[3] - job->window[2];
    cs_outcome result = {.variance = malloc(job->pixel_count * sizeof(cs_f32)),
                         .intensity = malloc(job->pixel_count * sizeof(cs_f32))};
    uint8_t *certain = malloc(job->pixel_count);
    CS_REQUIRE(result.variance != NULL && result.intensity != NULL && certain != NULL,
               CLSHEAR_OUT_OF_MEMORY, "out of memory for the pilot of %zu pixels",
               job->pixel_count);
    CS_TRY(cs_background_find(job, certain, error));
    /* A sixteenth of the samples, but two patterns at least that say something: smaller ones rank
     * pixels worse, and where packets have 16 lanes they cost as much. */
    const cs_u32 sampler = job->pattern.sampler;
    const cs_u32 size = cs_sampler_count(sampler, job->spp < 256 ? 8 : 16);
    const cs_u32 patterns = job->spp / 16 / size;
    const cs_u32 replicates = patterns < 2 ? 2 : patterns > 4 ? 4 : patterns;
    const cs_trial how = {job->shear_px, job->rule};
    CS_TRY(cs_pilot_run(job, &how, NULL, job->pixel_count, size, replicates, &result, error));
    const cs_pilot_picture picture = {.variance = result.variance,
                                      .intensity = result.intensity,
                                      .near_variance = result.variance,
                                      .near_intensity = result.intensity,
                                      .certain = certain,
                                      .width = width,
                                      .height = height,
                                      .pattern = size,
                                      .replicates = replicates};
    cs_u32 limit = CS_MAX_PATTERN; /* a power of two for which the sampler has a pattern */
    while (cs_sampler_count(sampler, limit) == 0)
        limit /= 2;
    const cs_u32 mean = job->pattern.grid.count;
    const cs_range range = range_of(mean, limit);
    CS_TRY(cs_allocate_samples(&picture, &range, samples, error));
done:
    free(result.variance);
    free(result.intensity);
    free(certain);
    return status;
}

/* Lists the pixels of blocks of 3 x 3, one block somewhere in each square of `side` x `side`, that
 * are not certain. */
static size_t list_blocks(const cs_job *job, const uint8_t *certain, cs_u32 side, cs_u32 *list)
{
    const cs_u32 width = (cs_u32)(job->window[1] - job->window[0]);
    const cs_u32 height = (cs_u32)(job->window[3] - job->window[2]);
    size_t count = 0;
    for (cs_u32 top = 0; top < height; top += side)
        for (cs_u32 left = 0; left < width; left += side) {
            const cs_u32 lot = cs_hash((top << 16 ^ left) + 1u);
            const cs_u32 across = width - left < side ? width - left : side;
            const cs_u32 down = height - top < side ? height - top : side;
            const cs_u32 x = left + lot % (across > 3 ? across - 2 : 1);
            const cs_u32 y = top + (lot >> 16) % (down > 3 ? down - 2 : 1);
            for (cs_u32 k = 0; k < 9; k++) {
                const cs_u32 column = x + k % 3, row = y + k / 3;
                if (column >= width || row >= height) continue;
                if (!certain[row * width + column]) list[count++] = row * width + column;
            }
        }
    return count;
}

clshear_status cs_pilot_promise(cs_job *job, const uint8_t *certain, const cs_range *range,
                                double *gain, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t pixels = job->pixel_count;
    const size_t blocks = pixels / 144 < 1024 ? pixels / 144 + 1 : 1024;
    const cs_u32 side = (cs_u32)ceil(sqrt((double)pixels / (double)blocks));
    cs_u32 *list = malloc(pixels * sizeof *list);
    cs_f32 *found = calloc(2 * pixels, sizeof *found);
    CS_REQUIRE(list != NULL && found != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for the pilot of %zu pixels", pixels);
    const cs_u32 size = cs_sampler_count(job->pattern.sampler, PROMISE_SAMPLES);
    const cs_trial how = {job->shear_px, job->rule};
    const cs_outcome result = {.variance = found, .intensity = found + pixels};
    const size_t count = list_blocks(job, certain, side < 12 ? 12 : side, list);
    CS_TRY(cs_pilot_run(job, &how, list, count, size, 1, &result, error));
    const cs_pilot_picture picture = {.variance = found,
                                      .intensity = found + pixels,
                                      .near_variance = found,
                                      .near_intensity = found + pixels,
                                      .certain = certain,
                                      .width = job->window[1] - job->window[0],
                                      .height = job->window[3] - job->window[2],
                                      .pattern = size,
                                      .replicates = 1};
    CS_TRY(cs_allocate_gain(&picture, range, gain, error));
done:
    free(list);
    free(found);
    return status;
}

clshear_status cs_pilot_gain(cs_job *job, cs_f32 *gain, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t pixels = job->pixel_count;
    const int width = job->window[1] - job->window[0], height = job->window[3] - job->window[2];
    cs_f32 *memory = calloc(GAIN_PLANES * pixels, sizeof *memory);
    uint8_t *no_rules = malloc(pixels);
    CS_REQUIRE(memory != NULL && no_rules != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for the gain of %zu pixels", pixels);
    const cs_outcome without = {.variance = memory + pixels},
                     with = {.variance = memory + 2 * pixels};
    memset(no_rules, CS_RULE_NONE, pixels);
    const cs_trial unsheared = {memory, no_rules}, chosen = {job->shear_px, job->rule};
    CS_TRY(cs_pilot_run(job, &unsheared, NULL, pixels, GAIN_SAMPLES, GAIN_REPLICATES, &without,
                        error));
    CS_TRY(cs_pilot_run(job, &chosen, NULL, pixels, GAIN_SAMPLES, GAIN_REPLICATES, &with, error));
    for (size_t i = 0; i < pixels; i++) {
        const int x = (int)(i % (size_t)width), y = (int)(i / (size_t)width);
        const double before = cs_smoothed(without.variance, width, height, x, y);
        const double after = cs_smoothed(with.variance, width, height, x, y);
        gain[i] = after > 0.0 ? (cs_f32)(before / after) : 1.0f;
    }
done:
    free(memory);
    free(no_rules);
    return status;
}

int cs_pilot_chooses_samples(const cs_job *job)
{
    return cs_integer(&job->settings, ADAPTIVE) != 0 && !cs_adaptive_shares(job) &&
           job->spp >= CS_LEAST_SPP_TO_ALLOCATE;
}

/* What run() takes for `part` of the pixels. */
static cs_footprint run_bytes(const cs_job *job, double part)
{
    const double velocity = job->moves ? sizeof(cs_velocity) : 0;
    return (cs_footprint){.host = velocity,
                          .device = part * (double)(cs_pixel_bytes(0) + sizeof(cs_u32)) +
                                    sizeof(cs_f32) + velocity};
}

/* What the choice of shears takes. A pixel is tried with the prior and a candidate at least. */
static cs_footprint choice_bytes(const cs_job *job)
{
    const choice *c = NULL;
    const double cost = 2.0 * CHOICE_SAMPLES * CHOICE_REPLICATES;
    const double part = fmin(choice_budget * job->pilot_spp / cost, 1.0);
    const cs_footprint arrays = {.host =
                                     sizeof *c->list + sizeof *c->rules +
                                     CS_RULE_COUNT * (sizeof **c->shears + sizeof **c->variance)};
    const cs_footprint choosing = {.host = (double)cs_pilot_choose_bytes()};
    return cs_footprint_sum(arrays, cs_footprint_larger(run_bytes(job, part), choosing));
}

cs_footprint cs_pilot_bytes(const cs_job *job)
{
    const cs_footprint run = run_bytes(job, 1.0);
    const cs_footprint gain = {.host = GAIN_PLANES * sizeof(cs_f32) + sizeof(uint8_t)};
    const cs_footprint samples = {.host = 2 * sizeof(cs_f32) + sizeof(uint8_t) + sizeof(cs_u32)};
    const cs_footprint promise = {.host = sizeof(cs_u32) + 2 * sizeof(cs_f32) +
                                          (double)cs_allocate_bytes()};
    cs_footprint most = {0};
    if (cs_adaptive_shares(job)) most = cs_footprint_sum(promise, run_bytes(job, 9.0 / 144.0));
    if (cs_pilot_chooses_shears(job)) most = cs_footprint_larger(most, choice_bytes(job));
    if (cs_integer(&job->settings, GAIN) != 0)
        most = cs_footprint_larger(most, cs_footprint_sum(gain, run));
    if (cs_pilot_chooses_samples(job))
        most = cs_footprint_larger(most, cs_footprint_sum(samples, run));
    return most;
}
