/* Going on with a render: more samples of the same patterns, without redoing those it has. */
#include "render/resume.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "oracle/oracle.h"
#include "pattern/pattern.h"
#include "render/aov.h"
#include "render/recipe.h"
#include "render/visit.h"

static int is_extendable(const cs_job *job)
{
    return cs_integer(&job->settings, EXTENDABLE) != 0;
}

static void plane_name(char *name, size_t size, uint32_t replicate, int colour)
{
    snprintf(name, size, "Pattern%u.%c", replicate, "RGB"[colour]);
}

/* The planes that a continued render reads, the means of the patterns last: the name of number
 * `index` from 0, or NULL past the last one. */
static const char *needed_plane(uint32_t replicates, size_t index, char *name, size_t size)
{
    static const char *const needed[] = {
        "R",     "G",     "B", "SampleVariance.R", "SampleVariance.G", "SampleVariance.B",
        "Shear", "Oracle"};
    const size_t others = sizeof needed / sizeof *needed;
    if (index < others) return needed[index];
    if (index - others >= 3 * (size_t)replicates) return NULL;
    plane_name(name, size, (uint32_t)(index - others) / 3, (int)(index - others) % 3);
    return name;
}

/* Whether a film has all these planes, and counts of samples to go with them. */
static int holds_state(const clshear_film *base, uint32_t replicates, int *samples)
{
    char text[32];
    const char *name;
    int good = cs_film_int(base, "samplesPerPixel", samples) && *samples >= (int)replicates;
    for (size_t i = 0; (name = needed_plane(replicates, i, text, sizeof text)) != NULL; i++)
        good &= cs_film_channel(base, name) != NULL;
    return good;
}

/* Status of a film that no render can go on from. */
static clshear_status status_of_unfit(const clshear_film *base)
{
    return base->path != NULL ? CLSHEAR_BAD_FILE : CLSHEAR_BAD_ARGUMENT;
}

/* Fails unless all pixels of a plane have numbers that a render writes. */
static clshear_status check_plane(const clshear_film *base, const char *name, cs_error *error)
{
    const size_t width = (size_t)base->info.width, pixels = width * (size_t)base->info.height;
    const float *plane = cs_film_channel(base, name);
    const int is_rule = strcmp(name, "Oracle") == 0;
    for (size_t i = 0; i < pixels; i++) {
        const float value = plane[i];
        const int is_known = value >= 0.0f && value < CS_RULE_COUNT && value == floorf(value);
        if (is_rule ? !is_known : !isfinite(value))
            return cs_fail(error, status_of_unfit(base),
                           "is damaged: pixel %d,%d has %g in channel %s",
                           base->info.window[0] + (int)(i % width),
                           base->info.window[2] + (int)(i / width), (double)value, name);
    }
    return CLSHEAR_OK;
}

static clshear_status check_planes(const clshear_film *base, uint32_t replicates, cs_error *error)
{
    char text[32];
    const char *name;
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; (name = needed_plane(replicates, i, text, sizeof text)) != NULL; i++)
        CS_TRY(check_plane(base, name, error));
done:
    return status;
}

const char *cs_resume_name(const cs_job *job)
{
    return job->base->path != NULL ? job->base->path : "the image to extend";
}

/* Whether patterns can be extended: those of this job, or by them. */
static clshear_status check_patterns(const cs_job *job, cs_error *error)
{
    const char *is_wrong = job->base != NULL ? "cannot extend it" : "cannot be extended";
    if (cs_integer(&job->settings, ADAPTIVE) != 0)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "an adaptive render %s; leave out --adaptive",
                       is_wrong);
    if (!cs_sampler_is_progressive(job->pattern.sampler))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "sampler %s %s: its points depend on their number; progressive ones can",
                       cs_sampler_name(job->pattern.sampler), is_wrong);
    return CLSHEAR_OK;
}

/* Whether the picture to extend is one of this job's, with all that is needed of it, and fewer
 * samples; the job then draws the rest of its pattern. */
static clshear_status check_base(cs_job *job, cs_error *error)
{
    const clshear_film *base = job->base;
    char mine[CS_RECIPE_SIZE], name[32];
    int samples = 0;
    cs_recipe_of(job, mine, sizeof mine);
    const char *theirs = cs_film_text(base, "clshear.recipe");
    if (theirs == NULL ||
        (strcmp(mine, theirs) == 0 && !holds_state(base, job->replicates, &samples)))
        return cs_fail(error, status_of_unfit(base),
                       "lacks the means of its patterns; it must be a complete EXR rendered with "
                       "--extendable");
    if (strcmp(mine, theirs) != 0) {
        cs_recipe_difference(theirs, mine, name, sizeof name);
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "was made with another %s; give all flags as before, but for --spp", name);
    }
    if (memcmp(base->info.window, job->window, sizeof job->window) != 0)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "shows other pixels; give the same --crop");
    clshear_status status = check_planes(base, job->replicates, error);
    if (status == CLSHEAR_OK) status = cs_aov_check(job, error);
    if (status != CLSHEAR_OK) return status;
    const uint32_t had = (uint32_t)samples / job->replicates;
    if (job->pattern.grid.count <= had)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "has %d samples per pixel already; ask for more", samples);
    job->pattern = cs_pattern_of(job->pattern.sampler, had, job->pattern.grid.count - had);
    return CLSHEAR_OK;
}

clshear_status cs_resume_check(cs_job *job, cs_error *error)
{
    cs_error reason;
    if (job->base == NULL) return is_extendable(job) ? check_patterns(job, error) : CLSHEAR_OK;
    clshear_status status = check_patterns(job, &reason);
    if (status == CLSHEAR_OK) status = check_base(job, &reason);
    if (status == CLSHEAR_OK) return CLSHEAR_OK;
    return cs_fail(error, status, "%s: %s", cs_resume_name(job), reason.message);
}

/* Puts the picture's samples of a replicate into the pixel; before the first, its moments too. */
static void load(cs_job *job, void *user, size_t index, cs_pixel *pixel)
{
    const uint32_t replicate = *(const uint32_t *)user;
    static const char *const mean[3] = {"R", "G", "B"};
    static const char *const variance[3] = {"SampleVariance.R", "SampleVariance.G",
                                            "SampleVariance.B"};
    const clshear_film *base = job->base;
    const uint32_t had = job->pattern.first, all = had * job->replicates;
    for (int c = 0; c < 3; c++) {
        char name[32];
        plane_name(name, sizeof name, replicate, c);
        const double sum = (double)cs_film_channel(base, name)[index] * had;
        pixel->sum[c] = (cs_f32)sum;
        pixel->carry[c] = (cs_f32)(sum - (double)pixel->sum[c]);
        if (replicate > 0) continue;
        pixel->sample_mean[c] = cs_film_channel(base, mean[c])[index];
        pixel->sample_m2[c] =
            all > 1 ? cs_film_channel(base, variance[c])[index] * (cs_f32)(all - 1) : 0.0f;
    }
    pixel->pending = had;
    if (replicate == 0) pixel->samples = all;
}

/* The mean of the replicate that was finished last: what the sum of means has grown by. */
static void keep(cs_job *job, void *user, size_t index, cs_pixel *pixel)
{
    const uint32_t replicate = *(const uint32_t *)user;
    for (size_t c = 0; c < 3; c++) {
        double *before = &job->pattern_sums[3 * index + c];
        const double now = (double)pixel->pattern_sum[c] + (double)pixel->pattern_carry[c];
        job->pattern_means[(3 * replicate + c) * job->pixel_count + index] = (float)(now - *before);
        *before = now;
    }
}

static int keeps_patterns(const cs_job *job)
{
    return is_extendable(job) || job->base != NULL || cs_integer(&job->settings, KEEP_PATTERNS);
}

size_t cs_resume_channels(const cs_job *job)
{
    return keeps_patterns(job) ? 3 * (size_t)job->replicates : 0;
}

size_t cs_resume_bytes(const cs_job *job)
{
    return keeps_patterns(job) ? cs_resume_channels(job) * sizeof *job->pattern_means +
                                     3 * sizeof *job->pattern_sums
                               : 0;
}

clshear_status cs_resume_prepare(cs_job *job, cs_error *error)
{
    const uint32_t most = 16;
    const size_t planes = cs_resume_channels(job);
    const int extends = is_extendable(job) || job->base != NULL;
    if (planes == 0) return CLSHEAR_OK;
    if (extends && job->replicates > most)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%u replicates: a render that can be extended has at most %u",
                       job->replicates, most);
    job->pattern_means = malloc(planes * job->pixel_count * sizeof *job->pattern_means);
    job->pattern_sums = calloc(3 * job->pixel_count, sizeof *job->pattern_sums);
    if (job->pattern_means == NULL || job->pattern_sums == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
                       job->pixel_count);
    return CLSHEAR_OK;
}

clshear_status cs_resume_begin(cs_job *job, uint32_t replicate, cs_error *error)
{
    const cs_visit loading = {load, &replicate, 1};
    job->replicates_begun = replicate + 1;
    if (job->base == NULL) return CLSHEAR_OK;
    const clshear_status status = replicate == 0 ? cs_aov_load(job, error) : CLSHEAR_OK;
    return status == CLSHEAR_OK ? cs_visit_pixels(job, &loading, error) : status;
}

clshear_status cs_resume_end(cs_job *job, uint32_t replicate, cs_error *error)
{
    const cs_visit keeping = {keep, &replicate, 0};
    if (job->pattern_means == NULL) return CLSHEAR_OK;
    clshear_status status = cs_visit_pixels(job, &keeping, error);
    if (status == CLSHEAR_OK) job->patterns_kept++;
    return status;
}

double cs_resume_missing(const cs_job *job, size_t index, int colour)
{
    double sum = 0.0;
    if (job->base == NULL) return 0.0;
    for (uint32_t r = job->replicates_begun; r < job->replicates; r++) {
        char name[32];
        plane_name(name, sizeof name, r, colour);
        sum += (double)cs_film_channel(job->base, name)[index] * job->pattern.first;
    }
    return sum;
}

clshear_status cs_resume_describe(const cs_job *job, clshear_film *film)
{
    char text[CS_RECIPE_SIZE];
    if (job->patterns_kept < job->replicates) return CLSHEAR_OK; /* interrupted */
    for (uint32_t plane = 0; plane < 3 * job->replicates; plane++) {
        char name[32];
        plane_name(name, sizeof name, plane / 3, (int)(plane % 3));
        float *pixels = cs_film_add_channel(film, name);
        if (pixels == NULL)
            return cs_fail(cs_thread_error(), CLSHEAR_OUT_OF_MEMORY, "out of memory for the film");
        memcpy(pixels, job->pattern_means + (size_t)plane * job->pixel_count,
               job->pixel_count * sizeof *pixels);
    }
    if (!is_extendable(job) && job->base == NULL) return CLSHEAR_OK;
    cs_recipe_of(job, text, sizeof text);
    return cs_film_annotate(film, "clshear.recipe", text);
}

void cs_resume_free(cs_job *job)
{
    free(job->pattern_means);
    free(job->pattern_sums);
}
