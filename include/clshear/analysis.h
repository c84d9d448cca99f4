/* clshear: why sheared samples converge faster, in numbers.
 *
 * Point sets, their spectra, integrands, predicted variance and measured convergence. Common
 * conventions stand at the head of common.h. */
#ifndef CLSHEAR_ANALYSIS_H
#define CLSHEAR_ANALYSIS_H

#include "choices.h"
#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct clshear_points clshear_points;           /* sets of points in the unit cube */
typedef struct clshear_spectrum clshear_spectrum;       /* power over a plane of frequencies */
typedef struct clshear_prediction clshear_prediction;   /* expected variance, by parts */
typedef struct clshear_convergence clshear_convergence; /* measured variance over N */

/* ------------------------------------------------------------------------------------------------
 * Points: what samplers draw, without a device
 * --------------------------------------------------------------------------------------------- */

/* Draws `sets` independent patterns of `count` tuples, or of the next number that the sampler has,
 * in all six coordinates; progressive samplers in the order of their sequence. `sampler` NULL: the
 * default. */
CLSHEAR_API clshear_status clshear_points_draw(const char *sampler, size_t count, size_t sets,
                                               uint32_t seed, clshear_points **points);

/* Copies points from memory: coordinate d of point i of set s is values[(s * count + i) *
 * dimensions + d], in [0, 1). `names` has a letter for each of the 1 to 6 dimensions: x y (film),
 * u v (lens), p q (light). */
CLSHEAR_API clshear_status clshear_points_create(const float *values, size_t sets, size_t count,
                                                 const char *names, clshear_points **points);

/* Reads text, one point a line, coordinates separated by spaces or commas, sets by lines that begin
 * with "#"; or an EXR as clshear_points_write makes it. "-" is standard input. */
CLSHEAR_API clshear_status clshear_points_read(const char *path, clshear_points **points);
CLSHEAR_API void clshear_points_free(clshear_points *points);

/* The coordinates, in the order of clshear_points_create; owned by the points. */
CLSHEAR_API const float *clshear_points_values(const clshear_points *points);
CLSHEAR_API size_t clshear_points_sets(const clshear_points *points);
CLSHEAR_API size_t clshear_points_count(const clshear_points *points); /* in one set */
CLSHEAR_API size_t clshear_points_dimensions(const clshear_points *points);
CLSHEAR_API const char *clshear_points_names(const clshear_points *points);

/* Shears points whose first coordinates are x, y, u, v by `shear_px` pixels per aperture width, for
 * a square aperture. */
CLSHEAR_API clshear_status clshear_points_shear(clshear_points *points, clshear_shear shear,
                                                float shear_px);

/* Keeps the coordinates named in `names`, in that order. */
CLSHEAR_API clshear_status clshear_points_select(clshear_points *points, const char *names);

/* Writes .csv (commas), .exr (a channel for each coordinate, a row for each set), or text for any
 * other name. "-" is text on standard output. */
CLSHEAR_API clshear_status clshear_points_write(const clshear_points *points, const char *path);

/* ------------------------------------------------------------------------------------------------
 * Spectrum: expected power spectra of point sets
 * --------------------------------------------------------------------------------------------- */

/* Measures points of two dimensions on the device, at width x height frequencies, each 2 to 8192:
 * the mean over sets of |sum of exp(-2 pi i f.x)|^2 / N at whole frequencies f, which is 1 for
 * random points and N at frequency 0. */
CLSHEAR_API clshear_status clshear_spectrum_measure(clshear_context *context,
                                                    const clshear_points *points, size_t width,
                                                    size_t height, clshear_spectrum **spectrum);

/* Power of the discrete Fourier transform of width x height values, row by row: |f|^2 relative to
 * its mean over all frequencies but 0; as a spectrum of one set. */
CLSHEAR_API clshear_status clshear_spectrum_of_grid(const float *values, size_t width,
                                                    size_t height, clshear_spectrum **spectrum);

/* The same of a slice of an integrand, whose ends do not meet: of the values less their mean,
 * through Hann's window in both directions. Without the window the jump from edge to edge is all
 * that is seen. */
CLSHEAR_API clshear_status clshear_spectrum_of_slice(const float *values, size_t width,
                                                     size_t height, clshear_spectrum **spectrum);
CLSHEAR_API void clshear_spectrum_free(clshear_spectrum *spectrum);

/* The power row by row: that of frequency (column - width / 2, row - height / 2). Owned by the
 * spectrum. */
CLSHEAR_API const float *clshear_spectrum_power(const clshear_spectrum *spectrum);
CLSHEAR_API size_t clshear_spectrum_width(const clshear_spectrum *spectrum);
CLSHEAR_API size_t clshear_spectrum_height(const clshear_spectrum *spectrum);

/* Largest whole radius that lies in the spectrum in all directions. */
CLSHEAR_API size_t clshear_spectrum_radius(const clshear_spectrum *spectrum);

/* For radii 1 ... R, R as above: the mean over the ring (frequencies whose length rounds to the
 * radius), and its anisotropy in decibels, 10 log10 of the ring's relative variance as it would be
 * for 10 sets: -10 dB where the spectrum is isotropic (Ulichney 1988). Arrays of R; `anisotropy_db`
 * may be NULL. */
CLSHEAR_API void clshear_spectrum_radial(const clshear_spectrum *spectrum, float *mean,
                                         float *anisotropy_db);

/* Power along direction (x, y), not 0, at the distances 1 ... R from frequency 0: each that of the
 * nearest multiple, but not 0, of (x, y) where these are whole numbers within the spectrum, else of
 * the nearest whole frequency. Lines of one frequency's width are seen here and lost in rings. */
CLSHEAR_API void clshear_spectrum_along(const clshear_spectrum *spectrum, double x, double y,
                                        float *power);

/* Writes .exr (channel Power) or a grey .png, .jpg, .tif where random points are at half; frequency
 * 0 is left out (0) unless `keep_dc`. */
CLSHEAR_API clshear_status clshear_spectrum_write(const clshear_spectrum *spectrum, int keep_dc,
                                                  const char *path);

/* ------------------------------------------------------------------------------------------------
 * Integrands of the unit square
 * --------------------------------------------------------------------------------------------- */

/* X(identifier, number, name, usual extent, meaning): shapes about the middle of the square, 1
 * inside and 0 outside, or with values in between. */
#define CLSHEAR_INTEGRAND_LIST(X)                                                                \
    X(STEP, 0, "step", 0.0, "half plane on one side of a line, `extent` from the middle")        \
    X(BOX, 1, "box", 0.53, "square of side `extent`")                                            \
    X(DISK, 2, "disk", 0.6, "disk of diameter `extent`")                                         \
    X(GAUSSIAN, 3, "gaussian", 0.6, "deviations extent / 4 along the angle, extent / 12 across") \
    X(TENT, 4, "tent", 0.8, "falls evenly along the angle to 0 at extent / 2")                   \
    X(PLANE_WAVE, 5, "plane-wave", 0.2, "1/2 + cos / 2, of wavelength `extent`")

typedef enum clshear_integrand_kind {
#define CLSHEAR_INTEGRAND(identifier, number, name, extent, meaning) \
    CLSHEAR_INTEGRAND_##identifier = number,
    CLSHEAR_INTEGRAND_LIST(CLSHEAR_INTEGRAND)
#undef CLSHEAR_INTEGRAND
} clshear_integrand_kind;

typedef struct clshear_integrand {
    size_t struct_size;
    clshear_integrand_kind kind;
    double angle_deg; /* 0: along x; anticlockwise in a picture with y up */
    double extent;    /* size of the shape, parts of the square's side */
} clshear_integrand;

/* The integrand of that name, with its usual extent, at angle 0. `integrand->struct_size` is set by
 * the caller. */
CLSHEAR_API clshear_status clshear_integrand_find(const char *name, clshear_integrand *integrand);
CLSHEAR_API double clshear_integrand_at(const clshear_integrand *integrand, double x, double y);

/* Its means over side x side cells, row by row from y = 0, and its mean square, both from 4 x 4
 * values in each cell: the arguments of clshear_predict_variance. */
CLSHEAR_API clshear_status clshear_integrand_tabulate(const clshear_integrand *integrand,
                                                      size_t side, float *cells,
                                                      double *mean_square);

/* Mean of the integrand over the first two coordinates of every set's points: `sets` values. With
 * `homogenise`, each set is first shifted at random around the torus. NaN for points of one
 * dimension. */
CLSHEAR_API void clshear_points_integrate(const clshear_points *points,
                                          const clshear_integrand *integrand, int homogenise,
                                          uint32_t seed, double *means);

/* A function of four coordinates: writes its values at `count` points of four coordinates each, all
 * in [0, 1]. A status that is not CLSHEAR_OK ends the calling function, which returns it. */
typedef clshear_status (*clshear_function)(void *user, const float *points, size_t count,
                                           float *values);

/* As clshear_points_integrate, of a function of x, y, u and v and points that begin with these. */
CLSHEAR_API clshear_status clshear_points_integrate_4d(const clshear_points *points,
                                                       clshear_function function, void *user,
                                                       int homogenise, uint32_t seed,
                                                       double *means);

/* ------------------------------------------------------------------------------------------------
 * Integrands of pixels
 * --------------------------------------------------------------------------------------------- */

/* Side of the square around the aperture in the unit in which shears count: 1 for squares and
 * images, more for disks and polygons, whose unit is the side of a square as large. */
CLSHEAR_API float clshear_lens_extent(const clshear_settings *settings);

/* The integrand of pixel (x, y): radiance at `count` points of four coordinates each, film x and y
 * from the pixel's left upper corner (0 to 1 is the pixel), and lens u and v, where 0 to 1 is the
 * square around the aperture, whatever its shape. `rgb`: 3 floats a point. Area lights: one point
 * of one of them, always the same, stands for all their power, as it does for one sample of a
 * render.
 */
CLSHEAR_API clshear_status clshear_radiance(clshear_scene *scene, const clshear_settings *settings,
                                            int x, int y, const float *points, size_t count,
                                            float *rgb);

/* The same at `count` tuples of four coordinates that a sampler draws: radiance where the settings'
 * shear, by `shear_px`, and filter take them. */
CLSHEAR_API clshear_status clshear_radiance_of_samples(clshear_scene *scene,
                                                       const clshear_settings *settings, int x,
                                                       int y, float shear_px, const float *samples,
                                                       size_t count, float *rgb);

/* The shear in pixels that the settings' oracle gives pixel (x, y); the pilot counts as centre. */
CLSHEAR_API clshear_status clshear_pixel_shear(clshear_scene *scene,
                                               const clshear_settings *settings, int x, int y,
                                               float *shear_px);

/* Writes planes of floats, named R, G, B and whatever else, as clshear_film_write does. */
CLSHEAR_API clshear_status clshear_image_write(const char *path, int width, int height,
                                               size_t channels, const char *const *names,
                                               const float *const *planes);

/* ------------------------------------------------------------------------------------------------
 * Prediction: variance that a spectrum of samples lets expect of an integral
 * --------------------------------------------------------------------------------------------- */

/* Variance of the mean of the integrand at N samples that are shifted at random around the torus:
 * the sum over frequencies f of P_samples(f) P_integrand(f) / N, which is exact. `integrand`:
 * side x side means of the function over cells of the unit square; side is even and at least twice
 * the spectrum's sides, better eight times. mean_square: of the function itself.
 *
 * The parts are eight cones of frequencies, whose angle is k to k + 1 eighths of a half turn from
 * the x axis (Singh & Jarosz 2017, eq. 8), and "tail", which lies beyond the spectrum and counts as
 * random points would. */
CLSHEAR_API clshear_status clshear_predict_variance(const clshear_spectrum *samples,
                                                    const float *integrand, size_t side,
                                                    double mean_square,
                                                    clshear_prediction **prediction);

/* How far, in each coordinate, the frequencies go that clshear_predict_variance_4d adds up. */
typedef struct clshear_reach {
    size_t struct_size;
    uint32_t axis;  /* of one coordinate: 1 to 65536; should be 4 N */
    uint32_t plane; /* of two: 1 to 2047 */
    uint32_t block; /* of three or four: 1 to 15 */
} clshear_reach;

/* Variance of the mean of a function at N samples that are shifted at random around the torus, from
 * the power of samples that begin with x, y, u and v. No lattice of four dimensions reaches as far
 * as samples are good, so parts go as far as each needs; the tail counts as random points would.
 * The function's energy at each frequency is the cross power of independently shifted grids, so
 * that neither aliases nor chance add to it.
 *
 * The parts are frequencies of x, y, u and v alone, of xy, xu, xv, yu, yv and uv, of three or four
 * ("block"), and the rest ("tail"). */
CLSHEAR_API clshear_status clshear_predict_variance_4d(clshear_context *context,
                                                       const clshear_points *samples,
                                                       clshear_function function, void *user,
                                                       const clshear_reach *reach,
                                                       clshear_prediction **prediction);
CLSHEAR_API void clshear_prediction_free(clshear_prediction *prediction);

/* The predicted variance: the sum of all parts. */
CLSHEAR_API double clshear_prediction_variance(const clshear_prediction *prediction);

/* The same with every frequency's power replaced by its ring's mean (Pilleboue et al. 2015); NaN
 * for four dimensions. */
CLSHEAR_API double clshear_prediction_isotropic(const clshear_prediction *prediction);

/* Variance of the integrand itself. */
CLSHEAR_API double clshear_prediction_energy(const clshear_prediction *prediction);

CLSHEAR_API size_t clshear_prediction_parts(const clshear_prediction *prediction);

/* Name of a part, its share of the predicted variance, and its share of the integrand's energy (NaN
 * where it is not known by parts: two dimensions). `part` is below clshear_prediction_parts. */
CLSHEAR_API const char *clshear_prediction_part_name(const clshear_prediction *prediction,
                                                     size_t part);
CLSHEAR_API double clshear_prediction_part_variance(const clshear_prediction *prediction,
                                                    size_t part);
CLSHEAR_API double clshear_prediction_part_energy(const clshear_prediction *prediction,
                                                  size_t part);

/* ------------------------------------------------------------------------------------------------
 * Convergence: measured variance against the number of samples
 * --------------------------------------------------------------------------------------------- */

/* Variance of `count` (2 or more) values, and that variance's standard error, from their fourth
 * moment. */
CLSHEAR_API clshear_status clshear_variance_of(const double *values, size_t count, double *variance,
                                               double *standard_error);

/* A line through log variance over log N. */
typedef struct clshear_fit {
    size_t struct_size;
    double slope;
    double slope_low; /* 95 % interval, by bootstrap over the replicates or parts */
    double slope_high;
} clshear_fit;

/* Fits estimates from `replicates` (2 or more) patterns of each of `sizes` (2 or more) rising
 * counts: means[k * replicates + r]. `errors`: for each count the variance of one pattern or, where
 * `reference` is not NULL, its mean squared difference from *reference. Sizes whose error is 0 are
 * left out of the fit; slopes are NaN where fewer than two remain. `fit->struct_size` is set by the
 * caller. */
CLSHEAR_API clshear_status clshear_fit_slope(const uint32_t *counts, size_t sizes,
                                             const double *means, size_t replicates,
                                             const double *reference, double *errors,
                                             clshear_fit *fit);

/* The same for errors that are means over parts, such as the tiles of an image: parts[k * count +
 * i]. The bootstrap is over the parts, the same ones for all sizes. */
CLSHEAR_API clshear_status clshear_fit_slope_of_parts(const uint32_t *counts, size_t sizes,
                                                      const double *parts, size_t count,
                                                      double *errors, clshear_fit *fit);

/* Measure how the error falls with the number of samples: `replicates` independent patterns of each
 * of `sizes` (2 or more) rising `counts`, or of the next counts that the sampler has. Errors are
 * variances of one pattern or, where `reference` is not NULL, mean squared differences from it.
 *
 * Of an integrand of the unit square: */
CLSHEAR_API clshear_status clshear_converge_integrand(const clshear_integrand *integrand,
                                                      const char *sampler, uint32_t seed,
                                                      const uint32_t *counts, size_t sizes,
                                                      uint32_t replicates, const double *reference,
                                                      clshear_convergence **result);

/* Of the mean of R, G and B of pixel (x, y), with the settings' sampler, seed and shear; the pilot
 * counts as centre: */
CLSHEAR_API clshear_status clshear_converge_pixel(clshear_scene *scene,
                                                  const clshear_settings *settings, int x, int y,
                                                  const uint32_t *counts, size_t sizes,
                                                  uint32_t replicates, const double *reference,
                                                  clshear_convergence **result);

/* Of a whole image, mean over pixels and colours; the slope's interval is by bootstrap over tiles
 * of 8 x 8 pixels. `reference` (NULL: none) is a render of the same size with many more samples;
 * what its own noise adds is not subtracted. */
CLSHEAR_API clshear_status clshear_converge_image(
    clshear_scene *scene, const clshear_settings *settings, const uint32_t *counts, size_t sizes,
    uint32_t replicates, const clshear_film *reference, clshear_convergence **result);
CLSHEAR_API void clshear_convergence_free(clshear_convergence *result);

CLSHEAR_API size_t clshear_convergence_sizes(const clshear_convergence *result);

/* Samples in a pattern of size number `index`, and its error. `index` is below
 * clshear_convergence_sizes. */
CLSHEAR_API uint32_t clshear_convergence_count(const clshear_convergence *result, size_t index);
CLSHEAR_API double clshear_convergence_error(const clshear_convergence *result, size_t index);

/* Mean of all patterns of the largest size. */
CLSHEAR_API double clshear_convergence_mean(const clshear_convergence *result);

/* The fitted slope. `fit->struct_size` is set by the caller. */
CLSHEAR_API void clshear_convergence_fit(const clshear_convergence *result, clshear_fit *fit);

#ifdef __cplusplus
}
#endif

#endif
