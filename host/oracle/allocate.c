/* Adaptive allocation: the sample count of every pixel. */
#include <math.h>
#include <stdlib.h>

#include "oracle/choose_rule.h"

enum {
    FARTHEST = 5 /* pixels: how far blur is followed */
};

/* Statistics of a pixel's neighbourhood, including the pixel. */
typedef struct surroundings {
    double variance;  /* mean over 3 x 3 pixels with binomial weights */
    double intensity; /* likewise */
    double contrast;  /* largest difference of intensity from the pixel, of 3 x 3 */
    double reaching;  /* and of those whose blur may reach into the pixel */
} surroundings;

/* A neighbour at i, j of a pixel at x, y, of this intensity. */
static void meet(const cs_pilot_picture *pilot, int x, int y, int i, int j, surroundings *found)
{
    const size_t there = (size_t)j * (size_t)pilot->width + (size_t)i;
    const size_t here = (size_t)y * (size_t)pilot->width + (size_t)x;
    const int is_other = there != here, distance = (i - x) * (i - x) + (j - y) * (j - y);
    const double radius = 0.5 * fabs((double)pilot->shear_px[there]) + 1.0;
    const double intensity =
        (double)(is_other ? pilot->near_intensity[there] : pilot->intensity[here]);
    const double contrast = fabs(intensity - (double)pilot->intensity[here]);
    if (distance <= radius * radius) found->reaching = fmax(found->reaching, contrast);
    if (distance > 2) return;
    const double weight = (i == x ? 2.0 : 1.0) * (j == y ? 2.0 : 1.0) / 16.0;
    found->variance +=
        weight * (double)(is_other ? pilot->near_variance[there] : pilot->variance[here]);
    found->intensity += weight * intensity;
    found->contrast = fmax(found->contrast, contrast);
}

static surroundings surroundings_of(const cs_pilot_picture *pilot, size_t pixel)
{
    const int width = pilot->width, height = pilot->height;
    const int x = (int)(pixel % (size_t)width), y = (int)(pixel / (size_t)width);
    surroundings found = {0};
    for (int j = y > FARTHEST ? y - FARTHEST : 0; j <= y + FARTHEST && j < height; j++)
        for (int i = x > FARTHEST ? x - FARTHEST : 0; i <= x + FARTHEST && i < width; i++)
            meet(pilot, x, y, i, j, &found);
    return found;
}

/* What importance is measured by, of the whole picture. */
typedef struct measure {
    double overlooked; /* variance of a missed feature, of contrast 1 */
    double dark;       /* square of the intensity below which errors are absolute */
    double absolute;   /* A of choose_rule.h */
    double relative;   /* B */
} measure;

/* V and W of choose_rule.h. */
static void errors_of(const cs_pilot_picture *pilot, const measure *by, size_t pixel, double *v,
                      double *w)
{
    const surroundings at = surroundings_of(pilot, pixel);
    *v = at.variance + by->overlooked * (at.contrast * at.contrast + at.reaching * at.reaching);
    *w = 1.0 / (at.intensity * at.intensity + by->dark);
}

static measure measure_of(const cs_pilot_picture *pilot)
{
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    /* A feature missed by n samples has an area of about 1/n. Within it, patterns of s samples have
     * the variance contrast^2 / (n s). */
    measure by = {.overlooked =
                      0.2 / ((double)pilot->pattern * pilot->pattern * pilot->replicates)};
    double mean = 0.0, v, w;
    for (size_t i = 0; i < pixels; i++)
        mean += fabs((double)pilot->intensity[i]) / (double)pixels;
    by.dark = 1e-4 * mean * mean + 1e-30;
    for (size_t i = 0; i < pixels; i++) {
        errors_of(pilot, &by, i, &v, &w);
        by.absolute += v;
        by.relative += v * w;
    }
    return by;
}

/* The importance of each pixel, up to a factor: (V (1/A + W/2B))^0.4, as defined in choose_rule.h.
 * With half of the relative weight both errors fall. */
static void compute_importance(const cs_pilot_picture *pilot, const measure *by, double *importance)
{
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    double v, w;
    for (size_t i = 0; i < pixels; i++) {
        errors_of(pilot, by, i, &v, &w);
        importance[i] = pow(v * (1.0 / by->absolute + 0.5 * w / by->relative), 0.4);
    }
}

/* The power of two nearest to `wanted`, from `least` to `most`. */
static cs_u32 rounded(double wanted, cs_u32 least, cs_u32 most)
{
    cs_u32 count = least;
    while (count < most && (double)count * 1.41421356 < wanted)
        count *= 2;
    return count;
}

cs_u32 cs_power_of_two(cs_u32 count)
{
    cs_u32 power = 1;
    while (power <= count / 2)
        power *= 2;
    return power;
}

clshear_status cs_allocate_samples(const cs_pilot_picture *pilot, const cs_range *range,
                                   cs_u32 *samples, cs_error *error)
{
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    const cs_u32 least = range->least, mean = range->mean;
    const cs_u32 most = cs_power_of_two(range->most / 16 < mean ? range->most : 16 * mean);
    double *importance = calloc(pixels, sizeof *importance);
    if (importance == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels", pixels);
    /* What the pixels have in common must not depend on what is kept from one of them. */
    cs_pilot_picture alone = *pilot;
    alone.near_variance = pilot->variance;
    alone.near_intensity = pilot->intensity;
    const measure by = measure_of(&alone);
    compute_importance(&alone, &by, importance);
    /* Bisect for the largest scale with a total within the budget. */
    double low = -60.0, high = 60.0;
    for (int step = 0; step < 60; step++) {
        const double scale = exp2(0.5 * (low + high));
        double total = 0.0;
        for (size_t i = 0; i < pixels; i++)
            total += rounded(scale * importance[i], least, most);
        if (total > (double)mean * (double)pixels)
            high = 0.5 * (low + high);
        else
            low = 0.5 * (low + high);
    }
    compute_importance(pilot, &by, importance);
    for (size_t i = 0; i < pixels; i++)
        samples[i] = rounded(exp2(low) * importance[i], least, most);
    free(importance);
    return CLSHEAR_OK;
}
