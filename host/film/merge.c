#include "film/merge.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "film/recipe_difference.h"
#include "film/shards.h"

/* A film with what it says of its shards. */
typedef struct part {
    const clshear_film *film;
    cs_shards shards;
    int patterns;    /* in each pixel */
    char label[256]; /* for messages */
} part;

/* How a channel is merged: by its name up to the first point. */
typedef enum merge_kind {
    KEPT,         /* the same in all shards: what the prepass and the pilots find */
    MEAN,         /* of the samples */
    MEAN_OF_HITS, /* of the samples that see a surface */
    TOTAL,
    VARIANCE, /* of the mean, between patterns */
    SAMPLE_VARIANCE
} merge_kind;

static merge_kind kind_of(const char *name)
{
    static const struct {
        const char *layer;
        merge_kind kind;
    } layers[] = {{"Z", KEPT},
                  {"Shear", KEPT},
                  {"CoC", KEPT},
                  {"Oracle", KEPT},
                  {"Gain", KEPT},
                  {"Velocity", KEPT},
                  {"Samples", TOTAL},
                  {"P", MEAN_OF_HITS},
                  {"Depth", MEAN_OF_HITS},
                  {"Variance", VARIANCE},
                  {"SampleVariance", SAMPLE_VARIANCE}};
    const size_t length = strcspn(name, ".");
    for (size_t i = 0; i < sizeof layers / sizeof *layers; i++)
        if (strlen(layers[i].layer) == length && strncmp(layers[i].layer, name, length) == 0)
            return layers[i].kind;
    return MEAN;
}

/* Whether all pixels have a number of samples that a render can have. */
static int counts_samples(const clshear_film *film)
{
    const float *samples = cs_film_channel(film, "Samples"), most = 2e9f;
    const size_t pixels = (size_t)film->info.width * (size_t)film->info.height;
    size_t good = 0;
    for (size_t i = 0; samples != NULL && i < pixels; i++)
        good += samples[i] >= 0.0f && samples[i] <= most;
    return good == pixels;
}

static clshear_status read_part(const clshear_film *film, size_t number, part *made,
                                cs_error *error)
{
    static const char *const needed[] = {
        "R", "G", "B", "Samples", "SampleVariance.R", "SampleVariance.G", "SampleVariance.B"};
    const char *text = cs_film_text(film, "clshear.shard");
    int interrupted = 0;
    made->film = film;
    if (film->path != NULL)
        snprintf(made->label, sizeof made->label, "%.250s", film->path);
    else
        snprintf(made->label, sizeof made->label, "film %zu", number + 1);
    cs_film_int(film, "clshear.interrupted", &interrupted);
    int whole = text != NULL && cs_film_text(film, "clshear.recipe") != NULL &&
                cs_film_int(film, "clshear.patterns", &made->patterns) && made->patterns > 0 &&
                made->patterns < 1 << 30 && !interrupted;
    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++)
        whole &= cs_film_channel(film, needed[i]) != NULL;
    whole &= counts_samples(film);
    if (made->patterns > 1) whole &= cs_film_channel(film, "Variance.G") != NULL;
    if (!whole)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%s: is no complete EXR of a shard; they are rendered with --shard K/N",
                       made->label);
    const clshear_status status = cs_shards_read(text, &made->shards, error);
    if (status == CLSHEAR_OK) return CLSHEAR_OK;
    return cs_fail(error, status, "%s: says that it is of shard \"%.40s\"", made->label, text);
}

/* What two films of one render must share, but for the recipe; the name of what they do not. */
static const char *difference(const part *a, const part *b)
{
    static const char *const numbers[] = {"clshear.spp", "clshear.adaptive"};
    int x = 0, y = 0;
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        if (!cs_film_int(a->film, numbers[i], &x) || !cs_film_int(b->film, numbers[i], &y) ||
            x != y)
            return numbers[i] + strlen("clshear.");
    if (a->shards.count != b->shards.count) return "number of shards";
    if (memcmp(a->film->info.window, b->film->info.window, sizeof a->film->info.window) != 0)
        return "crop";
    for (size_t c = 0; c < a->film->channels.count; c++) {
        const char *channel = cs_film_channel_name(a->film, c);
        if (kind_of(channel) != VARIANCE && cs_film_channel(b->film, channel) == NULL)
            return "set of channels";
    }
    return NULL;
}

static clshear_status check_pair(const part *a, const part *b, cs_error *error)
{
    char name[64];
    const char *other = name;
    if (!cs_recipe_difference(cs_film_text(a->film, "clshear.recipe"),
                              cs_film_text(b->film, "clshear.recipe"), name, sizeof name))
        other = difference(a, b);
    if (other == NULL) return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s and %s: are of different renders: another %s",
                   a->label, b->label, other);
}

static int by_first_shard(const void *a, const void *b)
{
    return ((const part *)a)->shards.first - ((const part *)b)->shards.first;
}

/* Planes of a part that the merge of a channel needs. */
typedef struct source {
    const float *value; /* NULL: no variance, of one pattern */
    const float *mean;  /* of a variance */
    const float *samples;
    const float *coverage; /* NULL: there is none */
    double patterns;
} source;

static source source_of(const part *from, const char *channel)
{
    const char colour[2] = {channel[strlen(channel) - 1], '\0'};
    return (source){.value = cs_film_channel(from->film, channel),
                    .mean = cs_film_channel(from->film, colour),
                    .samples = cs_film_channel(from->film, "Samples"),
                    .coverage = cs_film_channel(from->film, "Coverage.A"),
                    .patterns = from->patterns};
}

/* The variance of all values from those of the parts, or of their mean: Chan, Golub and LeVeque
 * 1979, equation 2.1. */
static float merge_variance(const source *sources, size_t count, merge_kind kind, size_t pixel)
{
    double values = 0.0, mean = 0.0, m2 = 0.0;
    for (size_t p = 0; p < count; p++) {
        const source *from = &sources[p];
        const double more = kind == VARIANCE ? from->patterns : (double)from->samples[pixel];
        if (!(more > 0.0)) continue;
        const double variance = from->value != NULL ? (double)from->value[pixel] : 0.0;
        const double delta = (double)from->mean[pixel] - mean, both = values + more;
        m2 += variance * (kind == VARIANCE ? more * (more - 1.0) : more - 1.0);
        m2 += delta * delta * values * more / both;
        mean += delta * more / both;
        values = both;
    }
    if (!(values > 1.0)) return 0.0f;
    const double variance = m2 / (values - 1.0);
    return (float)(kind == VARIANCE ? variance / values : variance);
}

/* The mean, weighted by samples; or the sum of these. */
static float merge_mean(const source *sources, size_t count, merge_kind kind, size_t pixel)
{
    double sum = 0.0, weights = 0.0;
    for (size_t p = 0; p < count; p++) {
        const source *from = &sources[p];
        double weight = (double)from->samples[pixel];
        if (kind == MEAN_OF_HITS && from->coverage != NULL) weight *= (double)from->coverage[pixel];
        if (!(weight > 0.0)) continue; /* depths without a hit are infinite */
        sum += weight * (kind == TOTAL ? 1.0 : (double)from->value[pixel]);
        weights += weight;
    }
    if (kind == TOTAL) return (float)sum;
    return weights > 0.0 ? (float)(sum / weights) : sources[0].value[pixel];
}

static clshear_status merge_channel(const part *parts, size_t count, const char *channel,
                                    clshear_film *merged, cs_error *error)
{
    const merge_kind kind = kind_of(channel);
    const size_t pixels = (size_t)merged->info.width * (size_t)merged->info.height;
    source *sources = malloc(count * sizeof *sources);
    float *plane = sources != NULL ? cs_film_add_channel(merged, channel) : NULL;
    if (plane == NULL) {
        free(sources);
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for the film");
    }
    for (size_t p = 0; p < count; p++)
        sources[p] = source_of(&parts[p], channel);
    for (size_t i = 0; i < pixels; i++)
        plane[i] = kind == KEPT ? sources[0].value[i]
                   : kind == VARIANCE || kind == SAMPLE_VARIANCE
                       ? merge_variance(sources, count, kind, i)
                       : merge_mean(sources, count, kind, i);
    free(sources);
    return CLSHEAR_OK;
}

/* All channels in their usual order: one shard of a pattern lacks the variances, which come after
 * the colours. */
static clshear_status merge_channels(const part *parts, size_t count, int patterns,
                                     clshear_film *merged, cs_error *error)
{
    static const char *const variances[] = {"Variance.R", "Variance.G", "Variance.B"};
    clshear_status status = CLSHEAR_OK;
    for (size_t c = 0; c < parts[0].film->channels.count; c++) {
        const char *channel = cs_film_channel_name(parts[0].film, c);
        if (strcmp(channel, "SampleVariance.R") == 0)
            for (size_t v = 0; v < 3 && patterns > 1; v++)
                CS_TRY(merge_channel(parts, count, variances[v], merged, error));
        if (kind_of(channel) != VARIANCE)
            CS_TRY(merge_channel(parts, count, channel, merged, error));
    }
done:
    return status;
}

/* What the parts say of themselves, and how much was drawn. */
static clshear_status describe(const part *parts, size_t count, const cs_shards *shards,
                               int patterns, clshear_film *merged, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t size = 8 * (size_t)shards->count + 32;
    const size_t pixels = (size_t)merged->info.width * (size_t)merged->info.height;
    const float *samples = cs_film_channel(merged, "Samples");
    double total = 0.0, seconds = 0.0;
    char *text = malloc(size);
    CS_REQUIRE(text != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for metadata");
    for (size_t i = 0; i < pixels; i++)
        total += (double)samples[i];
    for (size_t p = 0; p < count; p++)
        seconds += cs_film_float(parts[p].film, "renderTimeSeconds");
    CS_TRY(cs_film_copy_attributes(parts[0].film, merged));
    cs_shards_print(shards, 1, text, size);
    CS_TRY(cs_film_annotate(merged, "clshear.shard", text));
    CS_TRY(cs_film_set_int(merged, "clshear.patterns", patterns));
    const double mean = total / (double)pixels + 0.5;
    CS_TRY(
        cs_film_set_int(merged, "samplesPerPixel", mean < INT32_MAX ? (int32_t)mean : INT32_MAX));
    CS_TRY(cs_film_set_float(merged, "renderTimeSeconds", (float)seconds));
    merged->info.samples = (uint64_t)total;
    merged->info.render_s = seconds;
    merged->info.complete = shards->held == shards->count;
done:
    free(text);
    return status;
}

/* Checks all parts against the first, and adds their shards to its own. */
static clshear_status join(part *parts, size_t count, cs_shards *shards, int *patterns,
                           cs_error *error)
{
    clshear_status status =
        cs_shards_read(cs_film_text(parts[0].film, "clshear.shard"), shards, error);
    *patterns = parts[0].patterns;
    for (size_t p = 1; status == CLSHEAR_OK && p < count; p++) {
        CS_TRY(check_pair(&parts[0], &parts[p], error));
        const int both = cs_shards_add(shards, &parts[p].shards);
        CS_REQUIRE(both == 0, CLSHEAR_BAD_ARGUMENT, "%s: shard %d is in another of the films, too",
                   parts[p].label, both);
        CS_REQUIRE(parts[p].patterns < INT32_MAX - *patterns, CLSHEAR_BAD_ARGUMENT,
                   "%s: has %d patterns, too many to add", parts[p].label, parts[p].patterns);
        *patterns += parts[p].patterns;
    }
done:
    return status;
}

clshear_status cs_film_merge(const clshear_film *const *films, size_t count, clshear_film **result,
                             cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    clshear_film *merged = NULL;
    cs_shards shards = {0};
    int patterns = 0;
    part *parts = calloc(count, sizeof *parts);
    CS_REQUIRE(parts != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu films", count);
    for (size_t p = 0; p < count; p++)
        CS_TRY(read_part(films[p], p, &parts[p], error));
    qsort(parts, count, sizeof *parts, by_first_shard); /* so that the order given does not count */
    CS_TRY(join(parts, count, &shards, &patterns, error));
    const clshear_film *first = parts[0].film;
    CS_TRY(cs_film_create(first->info.window, first->info.full_width, first->info.full_height,
                          error, &merged));
    CS_TRY(merge_channels(parts, count, patterns, merged, error));
    CS_TRY(describe(parts, count, &shards, patterns, merged, error));
    *result = merged;
    merged = NULL;
done:
    for (size_t p = 0; parts != NULL && p < count; p++)
        cs_shards_free(&parts[p].shards);
    free(parts);
    cs_shards_free(&shards);
    cs_film_free(merged);
    return status;
}
