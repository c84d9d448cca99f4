/* clshear: convergence, measured variance against the number of samples. */
#ifndef CLSHEAR_CONVERGENCE_H
#define CLSHEAR_CONVERGENCE_H

#include "integrands.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct clshear_convergence clshear_convergence; /* measured variance over N */

/* Computes the variance of `count` values (2 or more) and its standard error, from their fourth
 * moment. */
CLSHEAR_API clshear_status clshear_variance_of(const double *values, size_t count, double *variance,
                                               double *standard_error);

/* A line fitted to log variance over log N. */
typedef struct clshear_fit {
    size_t struct_size;
    double slope;
    double slope_low; /* 95 % interval, by bootstrap over replicates or parts */
    double slope_high;
} clshear_fit;

/* Fits a slope to the estimates of `replicates` patterns (2 or more) at each of `sizes` rising
 * counts (2 or more): means[k * replicates + r]. `errors` receives the variance of one pattern at
 * each count or, unless `reference` is NULL, its mean squared difference from *reference. The fit
 * leaves out sizes with error 0. Slopes are NaN if fewer than two sizes remain. The caller sets
 * `fit->struct_size`. */
CLSHEAR_API clshear_status clshear_fit_slope(const uint32_t *counts, size_t sizes,
                                             const double *means, size_t replicates,
                                             const double *reference, double *errors,
                                             clshear_fit *fit);

/* Fits a slope to errors that are means over parts, such as the tiles of an image: parts[k * count
 * + i]. The bootstrap resamples the parts, with the same choice for all sizes. */
CLSHEAR_API clshear_status clshear_fit_slope_of_parts(const uint32_t *counts, size_t sizes,
                                                      const double *parts, size_t count,
                                                      double *errors, clshear_fit *fit);

/* Measures the convergence of an integrand of the unit square: the error at `sizes` rising sample
 * counts (2 or more), each from `replicates` independent patterns (2 or more). Counts are rounded
 * up to the next sample count of the sampler. The error is the variance of one pattern or, unless
 * `reference` is NULL, its mean squared difference from *reference. */
CLSHEAR_API clshear_status clshear_converge_integrand(const clshear_integrand *integrand,
                                                      const char *sampler, uint32_t seed,
                                                      const uint32_t *counts, size_t sizes,
                                                      uint32_t replicates, const double *reference,
                                                      clshear_convergence **result);

/* Measures the convergence of the mean of R, G and B of pixel (x, y), with the settings' sampler,
 * seed and shear. The pilot is replaced by the centre. The other arguments are those of
 * clshear_converge_integrand. */
CLSHEAR_API clshear_status clshear_converge_pixel(clshear_scene *scene,
                                                  const clshear_settings *settings, int x, int y,
                                                  const uint32_t *counts, size_t sizes,
                                                  uint32_t replicates, const double *reference,
                                                  clshear_convergence **result);

/* Measures the convergence of a whole image: the mean error over pixels and colours. The slope's
 * interval is by bootstrap over tiles of 8 x 8 pixels. `reference` (NULL: none) is a render of the
 * same size with many more samples; its own noise is not subtracted. The other arguments are those
 * of clshear_converge_integrand. */
CLSHEAR_API clshear_status clshear_converge_image(
    clshear_scene *scene, const clshear_settings *settings, const uint32_t *counts, size_t sizes,
    uint32_t replicates, const clshear_film *reference, clshear_convergence **result);
CLSHEAR_API void clshear_convergence_free(clshear_convergence *result);

CLSHEAR_API size_t clshear_convergence_sizes(const clshear_convergence *result);

/* Samples in a pattern of size number `index`, and the error of one pattern. `index` is below
 * clshear_convergence_sizes. */
CLSHEAR_API uint32_t clshear_convergence_count(const clshear_convergence *result, size_t index);
CLSHEAR_API double clshear_convergence_error(const clshear_convergence *result, size_t index);

/* The error of one pattern in each pixel of an image at size number `index`, the mean over colours,
 * by rows. `window` receives the pixels x0, x1, y0, y1 of the full image that the map covers: x0 <=
 * x < x1, y0 <= y < y1. Owned by the result. NULL for a pixel or an integrand. */
CLSHEAR_API const float *clshear_convergence_map(const clshear_convergence *result, size_t index,
                                                 int window[4]);

/* Mean over all patterns of the largest size. */
CLSHEAR_API double clshear_convergence_mean(const clshear_convergence *result);

/* Copies the fitted slope. The caller sets `fit->struct_size`. */
CLSHEAR_API void clshear_convergence_fit(const clshear_convergence *result, clshear_fit *fit);

/* Copies the slope between size number `index` and the next. A curve in logarithms that is no line
 * shows by slopes that differ beyond their intervals, which the interval of the fitted slope does
 * not contain. `index` + 1 is below clshear_convergence_sizes. */
CLSHEAR_API void clshear_convergence_local_fit(const clshear_convergence *result, size_t index,
                                               clshear_fit *fit);

#ifdef __cplusplus
}
#endif

#endif
