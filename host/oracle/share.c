/* How many samples every pixel gets. */
#include <math.h>
#include <stdlib.h>

#include "oracle/pilot.h"

/* Mean of 3 x 3 values around a pixel with binomial weights, at the border of fewer. */
static double smoothed(const f32 *values, int width, int height, int x, int y)
{
    double sum = 0.0, weights = 0.0;
    for (int j = y > 0 ? y - 1 : 0; j <= y + 1 && j < height; j++)
        for (int i = x > 0 ? x - 1 : 0; i <= x + 1 && i < width; i++) {
            const double weight = (i == x ? 2.0 : 1.0) * (j == y ? 2.0 : 1.0);
            sum += weight * (double)values[(size_t)j * (size_t)width + (size_t)i];
            weights += weight;
        }
    return sum / weights;
}

/* The desire for samples, up to a factor: (V (1/A + W/5B))^0.4. A fifth of the weight is enough for
 * the relative error to fall as much as the absolute one. */
static void desires(const f32 *variance, const f32 *intensity, int width, int height,
                    double *desire)
{
    const size_t pixels = (size_t)width * (size_t)height;
    double mean = 0.0, absolute = 0.0, relative = 0.0;
    for (size_t i = 0; i < pixels; i++)
        mean += fabs((double)intensity[i]) / (double)pixels;
    const double least = 1e-4 * mean * mean + 1e-30;
    for (int pass = 0; pass < 2; pass++)
        for (size_t i = 0; i < pixels; i++) {
            const double v = smoothed(variance, width, height, (int)(i % (size_t)width),
                                      (int)(i / (size_t)width));
            const double w = 1.0 / ((double)intensity[i] * (double)intensity[i] + least);
            if (pass == 0)
                absolute += v, relative += v * w;
            else
                desire[i] = pow(v * (1.0 / absolute + 0.2 * w / relative), 0.4);
        }
}

/* The power of two nearest to `wanted`, within the limits. */
static u32 rounded(double wanted, u32 least, u32 most)
{
    u32 count = least;
    while (count < most && (double)count * 1.41421356 < wanted)
        count *= 2;
    return count;
}

/* The least power of two that is not below `count`. */
static u32 power_of_two(u32 count)
{
    u32 power = 1;
    while (power < count)
        power *= 2;
    return power;
}

clshear_status cs_share_samples(const f32 *variance, const f32 *intensity, int width, int height,
                                u32 mean, u32 *samples, cs_error *error)
{
    const size_t pixels = (size_t)width * (size_t)height;
    /* A high floor: small patterns say little about large ones where variance falls as N^-2. */
    const u32 least = power_of_two(mean / 2 > 4 ? mean / 2 : 4), most = power_of_two(16 * mean);
    double *desire = malloc(pixels * sizeof *desire);
    if (desire == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels", pixels);
    desires(variance, intensity, width, height, desire);
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
