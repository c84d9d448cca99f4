#include "render/aov.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/aov.h"
#include "kernels/features.h"

/* A kept plane and its channel. */
typedef struct plane {
    int number; /* CS_PLANE_ */
    char name[24];
    float *pixels;          /* of the film that is made */
    const float *continued; /* of the film that is continued */
} plane;

typedef struct plane_set {
    size_t count;
    int coverage; /* its place among them, or -1 */
    plane planes[CS_PLANES];
} plane_set;

cs_u32 cs_aov_planes(const clshear_settings *settings)
{
#define AOV_BITS(identifier, layer, letters) [CLSHEAR_AOV_##identifier] = CS_PLANE_BITS(identifier),
    static const cs_u32 bits[] = {CS_AOV_LIST(AOV_BITS)};
#undef AOV_BITS
    const cs_setting_value *chosen = &settings->values[CS_INDEX_AOV];
    cs_u32 planes = 0;
    for (size_t i = 0; chosen->is_set && i < chosen->count; i++)
        planes |= bits[(int)chosen->numbers[i]];
    const cs_u32 of_hits = CS_PLANE_BITS(POSITION) | CS_PLANE_BITS(DEPTH);
    return (planes & of_hits) != 0 ? planes | CS_PLANE_BITS(COVERAGE) : planes;
}

size_t cs_aov_count(cs_u32 planes)
{
    size_t count = 0;
    for (; planes != 0; planes >>= 1)
        count += planes & 1u;
    return count;
}

cs_u32 cs_aov_features(const cs_job *job)
{
    return job->planes != 0 ? job->features | CS_FEATURE_AOVS : job->features;
}

static plane_set set_of(const cs_job *job)
{
#define AOV_ROW(identifier, layer, letters) {CS_PLANE_##identifier, layer, letters},
    static const struct {
        int first;
        const char *layer;
        const char *letters;
    } rows[] = {CS_AOV_LIST(AOV_ROW)};
#undef AOV_ROW
    plane_set set = {.coverage = -1};
    for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
        for (int i = 0; rows[r].letters[i] != '\0'; i++) {
            if (!(job->planes >> (rows[r].first + i) & 1u)) continue;
            plane *one = &set.planes[set.count];
            one->number = rows[r].first + i;
            if (one->number == CS_PLANE_COVERAGE) set.coverage = (int)set.count;
            snprintf(one->name, sizeof one->name, "%s.%c", rows[r].layer, rows[r].letters[i]);
            if (job->base != NULL) one->continued = cs_film_channel(job->base, one->name);
            set.count++;
        }
    return set;
}

/* Whether the mean is over samples that see a surface only. */
static int is_of_hits(int number)
{
    return number >= CS_PLANE_POSITION && number <= CS_END_PLANE_DEPTH;
}

/* From the scene's coordinates to those of the file. */
static double shift_of(const cs_job *job, int number)
{
    const int is_position = number >= CS_PLANE_POSITION && number <= CS_END_PLANE_POSITION;
    return is_position ? job->scene->scene.origin[number - CS_PLANE_POSITION] : 0.0;
}

static void resolve_pixel(const cs_job *job, const plane_set *set, const cs_exact_sum *sums,
                          double samples, size_t index)
{
    const double hits = set->coverage >= 0 ? cs_exact_total(sums[set->coverage]) : 0.0;
    for (size_t k = 0; k < set->count; k++) {
        const int number = set->planes[k].number;
        float *value = &set->planes[k].pixels[index];
        const double count = is_of_hits(number) ? hits : samples;
        if (count > 0.0)
            *value = (float)(cs_exact_total(sums[k]) / count + shift_of(job, number));
        else if (number == CS_PLANE_DEPTH)
            *value = INFINITY;
    }
}

static void load_pixel(const cs_job *job, const plane_set *set, double samples, size_t index,
                       cs_exact_sum *sums)
{
    const double hits =
        set->coverage >= 0 ? (double)set->planes[set->coverage].continued[index] * samples : 0.0;
    for (size_t k = 0; k < set->count; k++) {
        const int number = set->planes[k].number;
        const double count = is_of_hits(number) ? hits : samples;
        const double mean = (double)set->planes[k].continued[index] - shift_of(job, number);
        const double total = count > 0.0 ? mean * count : 0.0;
        sums[k].sum = (cs_f32)total;
        sums[k].carry = (cs_f32)(total - (double)sums[k].sum);
    }
}

clshear_status cs_aov_check(const cs_job *job, cs_error *error)
{
    const plane_set set = set_of(job);
    for (size_t k = 0; k < set.count; k++)
        if (set.planes[k].continued == NULL)
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "has no channel %s; give the --aov it was made with",
                           set.planes[k].name);
    return CLSHEAR_OK;
}

clshear_status cs_aov_load(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const plane_set set = set_of(job);
    const double samples = (double)job->pattern.first * job->replicates;
    if (set.count == 0) return CLSHEAR_OK;
    cs_exact_sum *slice = malloc(CS_AOV_PIXEL_SLICE * set.count * sizeof *slice);
    CS_REQUIRE(slice != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t first = 0; first < job->pixel_count; first += CS_AOV_PIXEL_SLICE) {
        const size_t left = job->pixel_count - first,
                     count = left < CS_AOV_PIXEL_SLICE ? left : CS_AOV_PIXEL_SLICE;
        for (size_t i = 0; i < count; i++)
            load_pixel(job, &set, samples, first + i, slice + i * set.count);
        CS_TRY(cs_pixels_write_aovs(&job->pixels, first, count, slice, error));
    }
done:
    free(slice);
    return status;
}

clshear_status cs_aov_resolve(const cs_job *job, const float *samples, clshear_film *film,
                              cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    plane_set set = set_of(job);
    if (set.count == 0) return CLSHEAR_OK;
    cs_exact_sum *slice = malloc(CS_AOV_PIXEL_SLICE * set.count * sizeof *slice);
    CS_REQUIRE(slice != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for the film");
    for (size_t k = 0; k < set.count; k++) {
        set.planes[k].pixels = cs_film_add_channel(film, set.planes[k].name);
        CS_REQUIRE(set.planes[k].pixels != NULL, CLSHEAR_OUT_OF_MEMORY,
                   "out of memory for the film");
    }
    for (size_t first = 0; first < job->pixel_count; first += CS_AOV_PIXEL_SLICE) {
        const size_t left = job->pixel_count - first,
                     count = left < CS_AOV_PIXEL_SLICE ? left : CS_AOV_PIXEL_SLICE;
        CS_TRY(cs_pixels_read_aovs(&job->pixels, first, count, slice, error));
        for (size_t i = 0; i < count; i++)
            resolve_pixel(job, &set, slice + i * set.count, (double)samples[first + i], first + i);
    }
done:
    free(slice);
    return status;
}
