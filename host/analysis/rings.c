/* Evaluation of spectra: rings, directions, pictures. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "analysis/spectrum.h"
#include "image/image_io.h"

size_t cs_spectrum_radius(const clshear_spectrum *spectrum)
{
    const size_t shorter = spectrum->width < spectrum->height ? spectrum->width : spectrum->height;
    return (shorter - 1) / 2;
}

/* Power at a whole frequency within the spectrum. */
static double power_at(const clshear_spectrum *spectrum, ptrdiff_t x, ptrdiff_t y)
{
    const size_t column = (size_t)(x + (ptrdiff_t)(spectrum->width / 2));
    const size_t row = (size_t)(y + (ptrdiff_t)(spectrum->height / 2));
    return (double)spectrum->power[row * spectrum->width + column];
}

/* Sums the power, squared power and number of frequencies on a ring, over one of each pair f,
 * -f. */
static void sum_ring(const clshear_spectrum *spectrum, ptrdiff_t radius, double *sums)
{
    for (ptrdiff_t y = 0; y <= radius; y++)
        for (ptrdiff_t x = y == 0 ? 1 : -radius; x <= radius; x++) {
            const ptrdiff_t square =
                4 * (x * x + y * y); /* (2 length)^2, for rounding without a square root */
            if (square < (2 * radius - 1) * (2 * radius - 1) ||
                square >= (2 * radius + 1) * (2 * radius + 1))
                continue;
            const double power = power_at(spectrum, x, y);
            sums[0] += power;
            sums[1] += power * power;
            sums[2] += 1.0;
        }
}

void cs_spectrum_radial(const clshear_spectrum *spectrum, float *mean, float *anisotropy_db)
{
    const size_t radii = cs_spectrum_radius(spectrum);
    for (size_t i = 0; i < radii; i++) {
        double sums[3] = {0};
        sum_ring(spectrum, (ptrdiff_t)i + 1, sums);
        const double average = sums[0] / sums[2];
        const double variance = (sums[1] - sums[2] * average * average) / (sums[2] - 1.0);
        mean[i] = (float)average;
        if (anisotropy_db == NULL) continue;
        const double relative = variance / (average * average) * (double)spectrum->sets / 10.0;
        anisotropy_db[i] = (float)(10.0 * log10(relative > 1e-12 ? relative : 1e-12));
    }
}

void cs_spectrum_along(const clshear_spectrum *spectrum, double x, double y, float *power)
{
    const size_t radii = cs_spectrum_radius(spectrum);
    const double length = hypot(x, y);
    const int whole = x == floor(x) && y == floor(y) && length <= (double)radii;
    for (size_t i = 0; i < radii; i++) {
        double scale = (double)(i + 1) / length;
        if (whole) scale = floor(scale + 0.5) > 1.0 ? floor(scale + 0.5) : 1.0;
        if (whole && scale * length >= (double)radii + 1.0) scale -= 1.0;
        power[i] = (float)power_at(spectrum, lround(x * scale), lround(y * scale));
    }
}

/* Inverse of the sRGB curve, which the picture's writer applies. */
static float before_curve(double grey)
{
    return (float)(grey <= 0.04045 ? grey / 12.92 : pow((grey + 0.055) / 1.055, 2.4));
}

clshear_status cs_spectrum_write(const clshear_spectrum *spectrum, int keep_dc, const char *path)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    const size_t frequencies = spectrum->width * spectrum->height;
    const size_t dc = spectrum->height / 2 * spectrum->width + spectrum->width / 2;
    const char *dot = strrchr(path, '.');
    const int is_data = dot != NULL && strcasecmp(dot, ".exr") == 0;
    static const char *const colours[] = {"R", "G", "B"}, *const power[] = {"Power"};
    float *plane = malloc(frequencies * sizeof *plane);
    CS_REQUIRE(plane != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu frequencies",
               frequencies);
    for (size_t i = 0; i < frequencies; i++) {
        const double value = i == dc && !keep_dc ? 0.0 : (double)spectrum->power[i];
        plane[i] = is_data ? (float)value : before_curve(value < 2.0 ? 0.5 * value : 1.0);
    }
    const float *const planes[] = {plane, plane, plane};
    const int width = (int)spectrum->width, height = (int)spectrum->height;
    const cs_picture picture = {.width = width,
                                .height = height,
                                .full_width = width,
                                .full_height = height,
                                .channel_count = is_data ? 1 : 3,
                                .names = is_data ? power : colours,
                                .planes = planes};
    status = cs_image_write(path, &picture, error);
done:
    free(plane);
    return status;
}

clshear_status cs_planes_write(const char *path, int width, int height, size_t channels,
                               const char *const *names, const float *const *planes)
{
    const cs_picture picture = {.width = width,
                                .height = height,
                                .full_width = width,
                                .full_height = height,
                                .channel_count = channels,
                                .names = names,
                                .planes = planes};
    return cs_image_write(path, &picture, cs_thread_error());
}
