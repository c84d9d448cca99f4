/* Slopes of errors over sample counts. */
#include <math.h>
#include <stdlib.h>

#include "analysis/fit.h"
#include "base/status.h"
#include "clshear/device/hash.h"

enum {
    RESAMPLES = 1000
};

/* Variance of `count` values or, unless `reference` is NULL, their mean squared difference from it.
 * `chosen` selects the values by index; NULL: the first `count`. */
static double error_of(const double *values, const uint32_t *chosen, size_t count,
                       const double *reference)
{
    double sum = 0.0, square = 0.0;
    const double origin = reference != NULL ? *reference : values[chosen != NULL ? chosen[0] : 0];
    for (size_t i = 0; i < count; i++) {
        const double value = values[chosen != NULL ? chosen[i] : i] - origin;
        sum += value;
        square += value * value;
    }
    const double n = (double)count;
    return reference != NULL ? square / n : fmax(square - sum * sum / n, 0.0) / (n - 1.0);
}

/* Least squares fit in logarithms. Returns NaN for fewer than two positive errors. */
static double slope_of(const uint32_t *counts, const double *errors, size_t sizes)
{
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
    for (size_t k = 0; k < sizes; k++) {
        if (!(errors[k] > 0.0)) continue;
        const double a = log(counts[k]), b = log(errors[k]);
        n += 1.0;
        x += a;
        y += b;
        xx += a * a;
        xy += a * b;
    }
    const double spread = n * xx - x * x;
    return n >= 2.0 && spread > 0.0 ? (n * xy - x * y) / spread : NAN;
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Slope of one bootstrap sample. `chosen` and `errors` are scratch memory for `replicates` and
 * `sizes` entries. */
static double resampled_slope(const uint32_t *counts, size_t sizes, const double *means,
                              size_t replicates, const double *reference, cs_u32 number,
                              uint32_t *chosen, double *errors)
{
    for (size_t k = 0; k < sizes; k++) {
        const cs_u32 key = cs_key(cs_key(0x626f6f74u, number), (cs_u32)k);
        for (cs_u32 r = 0; r < replicates; r++)
            chosen[r] = (uint32_t)((uint64_t)cs_key(key, r) * replicates >> 32);
        errors[k] = error_of(means + k * replicates, chosen, replicates, reference);
    }
    return slope_of(counts, errors, sizes);
}

/* Stores the slope, and its 95 % interval from `found` resampled slopes. */
static void summarise(double slope, double *slopes, size_t found, clshear_fit *fit)
{
    qsort(slopes, found, sizeof *slopes, by_value);
    fit->slope = slope;
    fit->slope_low = found > 0 ? slopes[found / 40] : NAN;
    fit->slope_high = found > 0 ? slopes[found - 1 - found / 40] : NAN;
}

static clshear_status check_sizes(const uint32_t *counts, size_t sizes, size_t values,
                                  cs_error *error)
{
    if (sizes < 2 || values < 2)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "a slope of %zu sizes and %zu values of each: needs 2 or more of both",
                       sizes, values);
    for (size_t k = 1; k < sizes; k++)
        if (counts[k] <= counts[k - 1])
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "a slope over %u and %u samples: numbers must rise", counts[k - 1],
                           counts[k]);
    return CLSHEAR_OK;
}

clshear_status cs_fit_slope(const uint32_t *counts, size_t sizes, const double *means,
                            size_t replicates, const double *reference, double *errors,
                            clshear_fit *fit)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    double *slopes = calloc(RESAMPLES, sizeof *slopes), *drawn = calloc(sizes + 1, sizeof *drawn);
    uint32_t *chosen = calloc(replicates + 1, sizeof *chosen);
    size_t found = 0;
    CS_TRY(check_sizes(counts, sizes, replicates, error));
    CS_REQUIRE(slopes != NULL && drawn != NULL && chosen != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory");
    for (size_t k = 0; k < sizes; k++)
        errors[k] = error_of(means + k * replicates, NULL, replicates, reference);
    for (cs_u32 s = 0; s < RESAMPLES; s++) {
        const double slope =
            resampled_slope(counts, sizes, means, replicates, reference, s, chosen, drawn);
        if (isfinite(slope)) slopes[found++] = slope;
    }
    summarise(slope_of(counts, errors, sizes), slopes, found, fit);
done:
    free(slopes);
    free(drawn);
    free(chosen);
    return status;
}

clshear_status cs_fit_slope_of_parts(const uint32_t *counts, size_t sizes, const double *parts,
                                     size_t count, double *errors, clshear_fit *fit)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    double *slopes = calloc(RESAMPLES, sizeof *slopes), *sums = calloc(sizes + 1, sizeof *sums);
    size_t found = 0;
    CS_TRY(check_sizes(counts, sizes, count, error));
    CS_REQUIRE(slopes != NULL && sums != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (cs_u32 s = 0; s < RESAMPLES; s++) {
        const cs_u32 key = cs_key(0x70617274u, s);
        for (size_t k = 0; k < sizes; k++)
            sums[k] = 0.0;
        for (cs_u32 i = 0; i < count; i++) {
            const size_t part = (size_t)((uint64_t)cs_key(key, i) * count >> 32);
            for (size_t k = 0; k < sizes; k++)
                sums[k] += parts[k * count + part];
        }
        const double slope = slope_of(counts, sums, sizes);
        if (isfinite(slope)) slopes[found++] = slope;
    }
    for (size_t k = 0; k < sizes; k++) {
        errors[k] = 0.0;
        for (size_t i = 0; i < count; i++)
            errors[k] += parts[k * count + i] / (double)count;
    }
    summarise(slope_of(counts, errors, sizes), slopes, found, fit);
done:
    free(slopes);
    free(sums);
    return status;
}
