/* Variance from the two spectra, of the samples and of the integrand. */
#include <fftw3.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "analysis/fourier.h"
#include "base/status.h"

static const double pi = 3.14159265358979323846;

/* Which cone a frequency lies in; f and -f in the same. */
static int cone_of(double x, double y)
{
    double angle = atan2(y, x) / pi; /* half turns */
    angle -= floor(angle);
    const int cone = (int)(angle * CLSHEAR_CONES);
    return cone < CLSHEAR_CONES ? cone : 0;
}

/* Energy of the integrand at (x, y), from the half plane of columns that FFTW returns. That the
 * values are means over cells is not undone: it takes as much from smooth functions as aliases add
 * to those with jumps. */
static double energy_at(const fftw_complex *transform, size_t side, ptrdiff_t x, ptrdiff_t y)
{
    if (x < 0) x = -x, y = -y;
    const size_t row = (size_t)(y < 0 ? y + (ptrdiff_t)side : y);
    const double *value = transform[row * (side / 2 + 1) + (size_t)x];
    const double scale = (double)side * (double)side;
    return (value[0] * value[0] + value[1] * value[1]) / (scale * scale);
}

typedef struct frequency {
    ptrdiff_t x;
    ptrdiff_t y;
    size_t radius; /* of its ring */
} frequency;

static frequency frequency_of(const clshear_spectrum *samples, size_t index)
{
    frequency f;
    f.x = (ptrdiff_t)(index % samples->width) - (ptrdiff_t)(samples->width / 2);
    f.y = (ptrdiff_t)(index / samples->width) - (ptrdiff_t)(samples->height / 2);
    f.radius = (size_t)lround(hypot((double)f.x, (double)f.y));
    return f;
}

/* The mean power of each ring; `counts` is room for as many numbers. */
static void ring_means(const clshear_spectrum *samples, double *means, double *counts, size_t rings)
{
    for (size_t i = 0; i < samples->width * samples->height; i++) {
        const frequency f = frequency_of(samples, i);
        means[f.radius] += (double)samples->power[i];
        counts[f.radius] += 1.0;
    }
    for (size_t i = 0; i < rings; i++)
        if (counts[i] > 0.0) means[i] /= counts[i];
}

/* Sums over all frequencies of the spectrum but 0. */
static void sum_up(const clshear_spectrum *samples, const fftw_complex *transform, size_t side,
                   const double *rings, clshear_prediction *p)
{
    const double inverse = 1.0 / (double)samples->count;
    double seen = 0.0;
    for (size_t i = 0; i < samples->width * samples->height; i++) {
        const frequency f = frequency_of(samples, i);
        if (f.radius == 0) continue;
        const double energy = energy_at(transform, side, f.x, f.y);
        seen += energy;
        p->cones[cone_of((double)f.x, (double)f.y)] += inverse * energy * (double)samples->power[i];
        p->isotropic += inverse * energy * rings[f.radius];
    }
    p->tail = inverse * fmax(p->energy - seen, 0.0);
    p->isotropic += p->tail;
    p->variance = p->tail;
    for (int cone = 0; cone < CLSHEAR_CONES; cone++)
        p->variance += p->cones[cone];
}

static size_t longer_side(const clshear_spectrum *samples)
{
    return samples->width > samples->height ? samples->width : samples->height;
}

clshear_status clshear_predict_variance(const clshear_spectrum *samples, const float *integrand,
                                        size_t side, double mean_square,
                                        clshear_prediction *prediction)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    const size_t rings = longer_side(samples) + 2;
    clshear_prediction p = {0};
    double *values = NULL, *means = NULL, mean = 0.0;
    fftw_complex *transform = NULL;
    fftw_plan plan = NULL;
    CS_REQUIRE(side % 2 == 0 && side >= 2 * longer_side(samples) && side <= 16384,
               CLSHEAR_BAD_ARGUMENT,
               "an integrand of %zu x %zu cells for a spectrum of %zu x %zu: needs an even side of "
               "twice as many at least",
               side, side, samples->width, samples->height);
    values = fftw_malloc(side * side * sizeof *values);
    transform = fftw_malloc(side * (side / 2 + 1) * sizeof *transform);
    means = calloc(2 * rings, sizeof *means);
    CS_REQUIRE(values != NULL && transform != NULL && means != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for an integrand of %zu x %zu cells", side, side);
    cs_fourier_start();
    plan = fftw_plan_dft_r2c_2d((int)side, (int)side, values, transform, FFTW_ESTIMATE);
    CS_REQUIRE(plan != NULL, CLSHEAR_OUT_OF_MEMORY, "no transform of %zu x %zu cells", side, side);
    for (size_t i = 0; i < side * side; i++) {
        values[i] = (double)integrand[i];
        mean += values[i] / (double)(side * side);
    }
    fftw_execute(plan);
    p.energy = fmax(mean_square - mean * mean, 0.0);
    ring_means(samples, means, means + rings, rings);
    sum_up(samples, (const fftw_complex *)transform, side, means, &p);
    *prediction = p;
done:
    if (plan != NULL) fftw_destroy_plan(plan);
    fftw_free(values);
    fftw_free(transform);
    free(means);
    return status;
}

clshear_status clshear_spectrum_of_grid(const float *values, size_t width, size_t height,
                                        clshear_spectrum *spectrum)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    fftw_complex *data = NULL;
    fftw_plan plan = NULL;
    double sum = 0.0;
    clshear_spectrum made = {.width = width, .height = height, .sets = 1, .count = width * height};
    CS_REQUIRE(width >= 2 && height >= 2 && width <= 8192 && height <= 8192, CLSHEAR_BAD_ARGUMENT,
               "a spectrum of %zu x %zu values: each side must be 2 to 8192", width, height);
    data = fftw_malloc(made.count * sizeof *data);
    made.power = malloc(made.count * sizeof *made.power);
    CS_REQUIRE(data != NULL && made.power != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for %zu x %zu values", width, height);
    cs_fourier_start();
    plan = fftw_plan_dft_2d((int)height, (int)width, data, data, FFTW_FORWARD, FFTW_ESTIMATE);
    CS_REQUIRE(plan != NULL, CLSHEAR_OUT_OF_MEMORY, "no transform of %zu x %zu values", width,
               height);
    for (size_t i = 0; i < made.count; i++)
        data[i][0] = (double)values[i], data[i][1] = 0.0;
    fftw_execute(plan);
    for (size_t i = 1; i < made.count; i++)
        sum += data[i][0] * data[i][0] + data[i][1] * data[i][1];
    const double scale = sum > 0.0 ? (double)(made.count - 1) / sum : 0.0;
    for (size_t i = 0; i < made.count; i++) { /* frequency 0 goes to the middle */
        const size_t column = (i % width + width / 2) % width;
        const size_t row = (i / width + height / 2) % height;
        made.power[row * width + column] =
            (float)(scale * (data[i][0] * data[i][0] + data[i][1] * data[i][1]));
    }
    *spectrum = made;
    made.power = NULL;
done:
    if (plan != NULL) fftw_destroy_plan(plan);
    fftw_free(data);
    free(made.power);
    return status;
}
