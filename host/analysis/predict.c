/* Variance predicted from the spectra of the samples and of the integrand. */
#include <fftw3.h>
#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "analysis/fourier.h"
#include "analysis/predict.h"
#include "base/pi.h"
#include "base/status.h"

/* Names of the cones: their first angle in degrees. */
static const char *const part_names[CS_CONES + 1] = {"cone 0",    "cone 22.5",  "cone 45",
                                                     "cone 67.5", "cone 90",    "cone 112.5",
                                                     "cone 135",  "cone 157.5", "tail"};

/* Index of a frequency's cone among `cones` in a half turn. f and -f share one. */
static size_t cone_of(double x, double y, size_t cones)
{
    double angle = atan2(y, x) / CS_PI_DOUBLE; /* in half turns */
    angle -= floor(angle);
    const size_t cone = (size_t)(angle * (double)cones);
    return cone < cones ? cone : 0;
}

/* Energy of the integrand at (x, y), from FFTW's half plane of columns. The attenuation by averages
 * over cells is not corrected: it removes about as much energy from smooth functions as aliases add
 * to functions with jumps. */
static double energy_at(const fftw_complex *transform, size_t side, ptrdiff_t x, ptrdiff_t y)
{
    if (x < 0) {
        x = -x;
        y = -y;
    }
    const size_t row = (size_t)(y < 0 ? y + (ptrdiff_t)side : y);
    const double *value = transform[row * (side / 2 + 1) + (size_t)x];
    const double scale = (double)side * (double)side;
    return (value[0] * value[0] + value[1] * value[1]) / (scale * scale);
}

typedef struct frequency {
    ptrdiff_t x;
    ptrdiff_t y;
    size_t radius; /* index of its ring */
} frequency;

static frequency frequency_of(const clshear_spectrum *samples, size_t index)
{
    frequency f;
    f.x = (ptrdiff_t)(index % samples->width) - (ptrdiff_t)(samples->width / 2);
    f.y = (ptrdiff_t)(index / samples->width) - (ptrdiff_t)(samples->height / 2);
    f.radius = (size_t)lround(hypot((double)f.x, (double)f.y));
    return f;
}

/* Index of a frequency's part of a ring. */
static size_t part_of(const frequency *f, size_t cones)
{
    return f->radius * cones + cone_of((double)f->x, (double)f->y, cones);
}

/* The variance of the frequencies other than 0 with the power of each replaced by its mean over the
 * part of its ring in one of `cones` cones. `means` and `counts` are scratch memory for `entries`
 * entries. */
static double sum_in_cones(const clshear_spectrum *samples, const fftw_complex *transform,
                           size_t side, size_t cones, double *means, double *counts, size_t entries)
{
    double sum = 0.0;
    memset(means, 0, entries * sizeof *means);
    memset(counts, 0, entries * sizeof *counts);
    for (size_t i = 0; i < samples->width * samples->height; i++) {
        const frequency f = frequency_of(samples, i);
        if (f.radius == 0) continue;
        means[part_of(&f, cones)] += (double)samples->power[i];
        counts[part_of(&f, cones)] += 1.0;
    }
    for (size_t i = 0; i < samples->width * samples->height; i++) {
        const frequency f = frequency_of(samples, i);
        if (f.radius == 0) continue;
        const size_t part = part_of(&f, cones);
        sum += energy_at(transform, side, f.x, f.y) * means[part] / counts[part];
    }
    return sum / (double)samples->count;
}

/* Sums over all frequencies of the spectrum except 0. */
static void sum_up(const clshear_spectrum *samples, const fftw_complex *transform, size_t side,
                   clshear_prediction *p)
{
    const double inverse = 1.0 / (double)samples->count;
    double seen = 0.0;
    for (size_t i = 0; i < samples->width * samples->height; i++) {
        const frequency f = frequency_of(samples, i);
        if (f.radius == 0) continue;
        const double energy = energy_at(transform, side, f.x, f.y);
        seen += energy;
        p->variances[cone_of((double)f.x, (double)f.y, CS_CONES)] +=
            inverse * energy * (double)samples->power[i];
    }
    const double tail = inverse * fmax(p->energy - seen, 0.0);
    p->variances[CS_CONES] = tail;
    p->variance = tail;
    for (int cone = 0; cone < CS_CONES; cone++)
        p->variance += p->variances[cone];
}

static size_t longer_side(const clshear_spectrum *samples)
{
    return samples->width > samples->height ? samples->width : samples->height;
}

/* Copies cells in double precision; returns their mean. */
static double take(const float *cells, size_t count, double *values)
{
    double mean = 0.0;
    for (size_t i = 0; i < count; i++) {
        values[i] = (double)cells[i];
        mean += values[i] / (double)count;
    }
    return mean;
}

static void name_parts(clshear_prediction *p)
{
    for (size_t part = 0; part < p->parts; part++) {
        p->names[part] = part_names[part];
        p->energies[part] = NAN;
    }
}

clshear_status cs_predict_variance(const clshear_spectrum *samples, const float *integrand,
                                   size_t side, double mean_square, clshear_prediction *prediction)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    const size_t entries = (longer_side(samples) + 2) << (CS_CONE_LEVELS - 1);
    clshear_prediction p = {.parts = CS_CONES + 1};
    double *values = NULL, *means = NULL;
    fftw_complex *transform = NULL;
    fftw_plan plan = NULL;
    CS_REQUIRE(side % 2 == 0 && side >= 2 * longer_side(samples) && side <= 16384,
               CLSHEAR_BAD_ARGUMENT,
               "an integrand of %zu x %zu cells for a spectrum of %zu x %zu: its side must be even "
               "and at least twice the spectrum's",
               side, side, samples->width, samples->height);
    values = fftw_malloc(side * side * sizeof *values);
    transform = fftw_malloc(side * (side / 2 + 1) * sizeof *transform);
    means = calloc(2 * entries, sizeof *means);
    CS_REQUIRE(values != NULL && transform != NULL && means != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for an integrand of %zu x %zu cells", side, side);
    cs_fourier_start();
    plan = fftw_plan_dft_r2c_2d((int)side, (int)side, values, transform, FFTW_ESTIMATE);
    CS_REQUIRE(plan != NULL, CLSHEAR_OUT_OF_MEMORY, "no transform of %zu x %zu cells", side, side);
    const double mean = take(integrand, side * side, values);
    fftw_execute(plan);
    p.energy = fmax(mean_square - mean * mean, 0.0);
    sum_up(samples, (const fftw_complex *)transform, side, &p);
    for (size_t level = 0; level < CS_CONE_LEVELS; level++)
        p.by_cones[level] = p.variances[CS_CONES] +
                            sum_in_cones(samples, (const fftw_complex *)transform, side,
                                         (size_t)1 << level, means, means + entries, entries);
    name_parts(&p);
    *prediction = p;
done:
    if (plan != NULL) fftw_destroy_plan(plan);
    fftw_free(values);
    fftw_free(transform);
    free(means);
    return status;
}
