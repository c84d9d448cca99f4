/* Adaptive allocation: the sample count of every pixel. */
#include <math.h>
#include <stdlib.h>

#include "oracle/choose_rule.h"

/* Statistics of a pixel's 3 x 3 neighbourhood, including the pixel. */
typedef struct surroundings {
    double variance;  /* mean over the neighbourhood with binomial weights */
    double intensity; /* intensity of the pixel itself */
    double contrast;  /* largest difference of intensity from the pixel */
} surroundings;

static surroundings surroundings_of(const cs_pilot_picture *pilot, size_t pixel)
{
    const int width = pilot->width, height = pilot->height;
    const int x = (int)(pixel % (size_t)width), y = (int)(pixel / (size_t)width);
    const double here = (double)pilot->intensity[pixel];
    surroundings found = {.intensity = here};
    double weights = 0.0;
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < height; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; i++) {
            const size_t there = (size_t)j * (size_t)width + (size_t)i;
            const double weight = (i == x ? 2.0 : 1.0) * (j == y ? 2.0 : 1.0);
            found.variance += weight * (double)pilot->variance[there];
            found.contrast = fmax(found.contrast, fabs((double)pilot->intensity[there] - here));
            weights += weight;
        }
    found.variance /= weights;
    return found;
}

/* Computes the importance of each pixel up to a factor: (V (1/A + W/10B))^0.4, as defined in
 * choose_rule.h. A tenth of the relative weight is enough to reduce the relative error too. */
static void compute_importance(const cs_pilot_picture *pilot, double *importance)
{
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    /* A feature missed by n samples has an area of about 1/n. Within it, patterns of s samples have
     * the variance contrast^2 / (n s). */
    const double overlooked = 0.2 / ((double)pilot->pattern * pilot->pattern * pilot->replicates);
    double mean = 0.0, absolute = 0.0, relative = 0.0;
    for (size_t i = 0; i < pixels; i++)
        mean += fabs((double)pilot->intensity[i]) / (double)pixels;
    const double least = 1e-4 * mean * mean + 1e-30;
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < pixels; i++) {
            const surroundings at = surroundings_of(pilot, i);
            const double v = at.variance + overlooked * at.contrast * at.contrast;
            const double w = 1.0 / (at.intensity * at.intensity + least);
            if (pass == 0) {
                absolute += v;
                relative += v * w;
            } else {
                importance[i] = pow(v * (1.0 / absolute + 0.1 * w / relative), 0.4);
            }
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

/* The largest power of two up to `count` (1 or more). */
static cs_u32 power_of_two(cs_u32 count)
{
    cs_u32 power = 1;
    while (power <= count / 2)
        power *= 2;
    return power;
}

/* The smallest allocation for a mean of `mean` samples: mean / 16, rounded up to a power of two,
 * but at least 4 or, for a smaller mean, the largest power of two up to the mean. */
static cs_u32 least_count(cs_u32 mean)
{
    if (mean < 4) return power_of_two(mean);
    if (mean <= 64) return 4;
    return power_of_two(2 * ((mean - 1) / 16) + 1);
}

clshear_status cs_allocate_samples(const cs_pilot_picture *pilot, cs_u32 mean, cs_u32 limit,
                                   cs_u32 *samples, cs_error *error)
{
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    const cs_u32 least = least_count(mean);
    const cs_u32 most = power_of_two(limit / 16 < mean ? limit : 16 * mean);
    double *importance = malloc(pixels * sizeof *importance);
    if (importance == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels", pixels);
    compute_importance(pilot, importance);
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
    for (size_t i = 0; i < pixels; i++)
        samples[i] = rounded(exp2(low) * importance[i], least, most);
    free(importance);
    return CLSHEAR_OK;
}
