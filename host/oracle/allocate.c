/* How many samples every pixel gets. */
#include <math.h>
#include <stdlib.h>

#include "oracle/choose_rule.h"

/* What is known of a pixel from its 3 x 3 neighbours, itself among them. */
typedef struct surroundings {
    double variance;  /* mean with binomial weights */
    double intensity; /* of the pixel */
    double contrast;  /* largest difference of intensity from it */
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

/* The desire for samples, up to a factor: (V (1/A + W/10B))^0.4. A tenth of the weight is enough
 * for the relative error to fall too. */
static void desires(const cs_pilot_picture *pilot, double *desire)
{
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    /* n samples that saw none of a feature leave an area of some 1/n for it, which in patterns of
     * s would have the variance contrast^2 / (n s) where it is. */
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
            if (pass == 0)
                absolute += v, relative += v * w;
            else
                desire[i] = pow(v * (1.0 / absolute + 0.1 * w / relative), 0.4);
        }
}

/* The power of two nearest to `wanted`, within the limits. */
static cs_u32 rounded(double wanted, cs_u32 least, cs_u32 most)
{
    cs_u32 count = least;
    while (count < most && (double)count * 1.41421356 < wanted)
        count *= 2;
    return count;
}

/* The largest power of two that is not above `count` (at least 1). */
static cs_u32 power_of_two(cs_u32 count)
{
    cs_u32 power = 1;
    while (power <= count / 2)
        power *= 2;
    return power;
}

clshear_status cs_allocate_samples(const cs_pilot_picture *pilot, cs_u32 mean, cs_u32 limit,
                                   cs_u32 *samples, cs_error *error)
{
    const size_t pixels = (size_t)pilot->width * (size_t)pilot->height;
    const cs_u32 least = power_of_two(mean < 4     ? mean
                                      : mean <= 64 ? 4
                                                   : 2 * ((mean - 1) / 16) + 1); /* upwards */
    const cs_u32 most = power_of_two(limit / 16 < mean ? limit : 16 * mean);
    double *desire = malloc(pixels * sizeof *desire);
    if (desire == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels", pixels);
    desires(pilot, desire);
    /* The largest scale at which the total is not above what was asked for, by bisection. */
    double low = -60.0, high = 60.0;
    for (int step = 0; step < 60; step++) {
        const double scale = exp2(0.5 * (low + high));
        double total = 0.0;
        for (size_t i = 0; i < pixels; i++)
            total += rounded(scale * desire[i], least, most);
        if (total > (double)mean * (double)pixels)
            high = 0.5 * (low + high);
        else
            low = 0.5 * (low + high);
    }
    for (size_t i = 0; i < pixels; i++)
        samples[i] = rounded(exp2(low) * desire[i], least, most);
    free(desire);
    return CLSHEAR_OK;
}
