#include "film/noise.h"

#include <math.h>
#include <stdlib.h>

static size_t pixels_of(const cs_estimate *estimate)
{
    return (size_t)estimate->width * (size_t)estimate->height;
}

double cs_noise_of_picture(const cs_estimate *estimate)
{
    const size_t pixels = pixels_of(estimate);
    double variance = 0.0, mean = 0.0;
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < pixels; i++) {
            variance += (double)estimate->variance[c][i];
            mean += (double)estimate->mean[c][i];
        }
    variance /= 3.0 * (double)pixels;
    mean /= 3.0 * (double)pixels;
    if (variance == 0.0) return 0.0;
    return isfinite(variance) && mean > 0.0 ? sqrt(variance) / mean : INFINITY;
}

double cs_smoothed(const float *plane, int width, int height, int x, int y)
{
    double sum = 0.0;
    int count = 0;
    for (int j = y > 2 ? y - 2 : 0; j <= y + 2 && j < height; j++)
        for (int i = x > 2 ? x - 2 : 0; i <= x + 2 && i < width; i++) {
            sum += (double)plane[(size_t)j * (size_t)width + (size_t)i];
            count++;
        }
    return sum / count;
}

/* The curve of IEC 61966-2-1, within what a screen shows. */
static double shown(float linear)
{
    if (!(linear > 0.0f)) return 0.0;
    if (linear >= 1.0f) return 1.0;
    return linear <= 0.0031308f ? 12.92 * (double)linear
                                : 1.055 * pow((double)linear, 1.0 / 2.4) - 0.055;
}

/* The error of a pixel on a screen. scale: as of cs_tone_apply. */
static float error_at(const cs_estimate *estimate, const cs_tone *tone, float scale, int x, int y)
{
    const size_t pixel = (size_t)y * (size_t)estimate->width + (size_t)x;
    float ends[6]; /* one standard error below the mean, and above */
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
        const float deviation = (float)sqrt(
            cs_smoothed(estimate->variance[c], estimate->width, estimate->height, x, y));
        if (!isfinite(deviation) || !isfinite(estimate->mean[c][pixel])) return INFINITY;
        ends[c] = estimate->mean[c][pixel] - deviation;
        ends[3 + c] = estimate->mean[c][pixel] + deviation;
    }
    cs_tone_apply(tone, scale, ends, 2);
    for (int c = 0; c < 3; c++) {
        const double half = 0.5 * (shown(ends[3 + c]) - shown(ends[c]));
        sum += half * half;
    }
    return (float)sqrt(sum / 3.0);
}

static int by_size(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

size_t cs_noise_bytes(void)
{
    return sizeof(float);
}

clshear_status cs_noise_of_pixels(const cs_estimate *estimate, const cs_tone *tone, double *noise,
                                  cs_error *error)
{
    const size_t pixels = pixels_of(estimate);
    float *memory = malloc(pixels * sizeof *memory);
    if (memory == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels", pixels);
    const float scale = cs_tone_scale(tone, estimate->mean, pixels);
    for (size_t i = 0; i < pixels; i++)
        memory[i] = error_at(estimate, tone, scale, (int)(i % (size_t)estimate->width),
                             (int)(i / (size_t)estimate->width));
    qsort(memory, pixels, sizeof *memory, by_size);
    *noise = (double)memory[(size_t)(0.95 * (double)(pixels - 1))];
    free(memory);
    return CLSHEAR_OK;
}
