/* clshear: analysis of samples: why sheared samples converge faster.
 *
 * Point sets, their spectra, integrands, predicted variance and measured convergence. The head of
 * common.h describes the common conventions. */
#ifndef CLSHEAR_ANALYSIS_H
#define CLSHEAR_ANALYSIS_H

#include "choices.h"
#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct clshear_points clshear_points;           /* sets of points in the unit cube */
typedef struct clshear_spectrum clshear_spectrum;       /* power over a plane of frequencies */
typedef struct clshear_prediction clshear_prediction;   /* predicted variance, by parts */
typedef struct clshear_convergence clshear_convergence; /* measured variance over N */

/* ------------------------------------------------------------------------------------------------
 * Points: the samples of a sampler, without a device
 * --------------------------------------------------------------------------------------------- */

/* Draws `sets` independent patterns of `count` tuples with all six coordinates. `count` is rounded
 * up to the next sample count of the sampler. `sampler` is a name; NULL: the default. Progressive
 * samplers draw in the order of their sequence. */
CLSHEAR_API clshear_status clshear_points_draw(const char *sampler, size_t count, size_t sets,
                                               uint32_t seed, clshear_points **points);

/* The same, but the planar sets of "poisson" and "ccvt" are made anew from the seed instead of
 * being the kept ones that all seeds share. For expectations over sets; it may take minutes. */
CLSHEAR_API clshear_status clshear_points_draw_fresh(const char *sampler, size_t count, size_t sets,
                                                     uint32_t seed, clshear_points **points);

/* Draws tuples of five coordinates: x, y, u, v and the time t, as a render draws them where
 * something moves and no light has an area. With `fresh`, as clshear_points_draw_fresh. */
CLSHEAR_API clshear_status clshear_points_draw_moving(const char *sampler, size_t count,
                                                      size_t sets, uint32_t seed, int fresh,
                                                      clshear_points **points);

/* Copies points from memory. Coordinate d of point i of set s is values[(s * count + i) *
 * dimensions + d], in [0, 1). `names` has one letter for each of the 1 to 7 dimensions: x y (film),
 * u v (lens), p q (light), t (time). */
CLSHEAR_API clshear_status clshear_points_create(const float *values, size_t sets, size_t count,
                                                 const char *names, clshear_points **points);

/* Reads a text file with one point per line, or an EXR in the format of clshear_points_write.
 * Spaces or commas separate coordinates, and lines that begin with "#" separate sets. "-" is
 * standard input. */
CLSHEAR_API clshear_status clshear_points_read(const char *path, clshear_points **points);
CLSHEAR_API void clshear_points_free(clshear_points *points);

/* The coordinates, in the order of clshear_points_create. Owned by the points. */
CLSHEAR_API const float *clshear_points_values(const clshear_points *points);
CLSHEAR_API size_t clshear_points_sets(const clshear_points *points);
CLSHEAR_API size_t clshear_points_count(const clshear_points *points); /* points in one set */
CLSHEAR_API size_t clshear_points_dimensions(const clshear_points *points);
CLSHEAR_API const char *clshear_points_names(const clshear_points *points);

/* Shears points by `shear_px` pixels per aperture width, for a square aperture. The coordinates
 * must begin with x, y, u, v. */
CLSHEAR_API clshear_status clshear_points_shear(clshear_points *points, clshear_shear shear,
                                                float shear_px);

/* Shears points by `shear_px` pixels per aperture width and by a velocity on the film, in pixels
 * while the shutter is open, for a square aperture. The coordinates must begin with x, y, u, v, t,
 * and the shear must not be toroidal. */
CLSHEAR_API clshear_status clshear_points_shear_moving(clshear_points *points, clshear_shear shear,
                                                       float shear_px, const float velocity_px[2]);

/* Keeps the coordinates in `names`, in that order, and drops the others. */
CLSHEAR_API clshear_status clshear_points_select(clshear_points *points, const char *names);

/* Writes .csv (commas), .exr (one channel per coordinate, one row per set), or text for other
 * extensions. "-" is text on standard output. */
CLSHEAR_API clshear_status clshear_points_write(const clshear_points *points, const char *path);

/* ------------------------------------------------------------------------------------------------
 * Spectrum: expected power spectra of point sets
 * --------------------------------------------------------------------------------------------- */

/* Measures the power spectrum of two-dimensional points on the device, at width x height
 * frequencies, each 2 to 8192. The power is the mean over sets of |sum of exp(-2 pi i f.x)|^2 / N
 * at whole frequencies f: 1 for random points, and N at frequency 0. */
CLSHEAR_API clshear_status clshear_spectrum_measure(clshear_context *context,
                                                    const clshear_points *points, size_t width,
                                                    size_t height, clshear_spectrum **spectrum);

/* Computes the power of the discrete Fourier transform of width x height values, row by row, as a
 * spectrum of one set. The power is |f|^2, relative to its mean over all frequencies except 0. */
CLSHEAR_API clshear_status clshear_spectrum_of_grid(const float *values, size_t width,
                                                    size_t height, clshear_spectrum **spectrum);

/* Computes the spectrum of a slice of an integrand: of the values minus their mean, through Hann's
 * window in both directions. Without the window, the jump between opposite edges would dominate the
 * spectrum. */
CLSHEAR_API clshear_status clshear_spectrum_of_slice(const float *values, size_t width,
                                                     size_t height, clshear_spectrum **spectrum);
CLSHEAR_API void clshear_spectrum_free(clshear_spectrum *spectrum);

/* The power, row by row. The value at (column, row) is that of frequency (column - width / 2, row -
 * height / 2). Owned by the spectrum. */
CLSHEAR_API const float *clshear_spectrum_power(const clshear_spectrum *spectrum);
CLSHEAR_API size_t clshear_spectrum_width(const clshear_spectrum *spectrum);
CLSHEAR_API size_t clshear_spectrum_height(const clshear_spectrum *spectrum);

/* The largest whole radius R of a disk of frequencies within the spectrum. */
CLSHEAR_API size_t clshear_spectrum_radius(const clshear_spectrum *spectrum);

/* Computes the mean and the anisotropy over rings of radius 1 ... R, as arrays of length R
 * (clshear_spectrum_radius). A ring has all frequencies with a length that rounds to its radius.
 * The anisotropy in decibels is 10 log10 of the ring's relative variance, scaled to 10 sets: -10 dB
 * if the spectrum is isotropic (Ulichney 1988). `anisotropy_db` may be NULL. */
CLSHEAR_API void clshear_spectrum_radial(const clshear_spectrum *spectrum, float *mean,
                                         float *anisotropy_db);

/* Reads the power along direction (x, y) at the distances 1 ... R from frequency 0. (x, y) must not
 * be 0. If x and y are whole numbers within the spectrum, each value is read at the nearest nonzero
 * multiple of (x, y), otherwise at the nearest whole frequency. Lines of one frequency's width are
 * visible here but not in ring means. */
CLSHEAR_API void clshear_spectrum_along(const clshear_spectrum *spectrum, double x, double y,
                                        float *power);

/* Writes .exr (channel Power) or a grey .png, .jpg or .tif, in which the power of random points is
 * half grey. Frequency 0 is written as 0 unless `keep_dc`. */
CLSHEAR_API clshear_status clshear_spectrum_write(const clshear_spectrum *spectrum, int keep_dc,
                                                  const char *path);

/* ------------------------------------------------------------------------------------------------
 * Integrands of the unit square
 * --------------------------------------------------------------------------------------------- */

/* X(identifier, number, name, usual extent, meaning): shapes around the middle of the square.
 * Values are 1 inside and 0 outside, or between these. */
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
    double angle_deg; /* 0: along x; anticlockwise if y points up */
    double extent;    /* size of the shape, relative to the square's side */
} clshear_integrand;

/* Finds an integrand by name and fills in its usual extent and angle 0. The caller sets
 * `integrand->struct_size`. */
CLSHEAR_API clshear_status clshear_integrand_find(const char *name, clshear_integrand *integrand);
CLSHEAR_API double clshear_integrand_at(const clshear_integrand *integrand, double x, double y);

/* Computes the integrand's means over side x side cells, row by row from y = 0, and its mean
 * square, both from 4 x 4 values per cell. Both are arguments of clshear_predict_variance. */
CLSHEAR_API clshear_status clshear_integrand_tabulate(const clshear_integrand *integrand,
                                                      size_t side, float *cells,
                                                      double *mean_square);

/* Computes the mean of the integrand over the first two coordinates of each set's points: `sets`
 * values. With `homogenise`, each set is first shifted at random around the torus. The means are
 * NaN for one-dimensional points. */
CLSHEAR_API void clshear_points_integrate(const clshear_points *points,
                                          const clshear_integrand *integrand, int homogenise,
                                          uint32_t seed, double *means);

/* A function of four coordinates, or of five where the points' begin with x, y, u, v, t. Writes its
 * values at `count` points of so many coordinates each, all in [0, 1]. The calling function returns
 * a status other than CLSHEAR_OK to its caller at once. */
typedef clshear_status (*clshear_function)(void *user, const float *points, size_t count,
                                           float *values);

/* Computes the mean of a function of x, y, u and v, or of these and t, over each set's points,
 * whose coordinates must begin with these. `homogenise` is that of clshear_points_integrate. */
CLSHEAR_API clshear_status clshear_points_integrate_4d(const clshear_points *points,
                                                       clshear_function function, void *user,
                                                       int homogenise, uint32_t seed,
                                                       double *means);

/* ------------------------------------------------------------------------------------------------
 * Integrands of pixels
 * --------------------------------------------------------------------------------------------- */

/* Side of the square around the aperture, in the unit of the shear: 1 for squares and images, above
 * 1 for disks and polygons, whose unit is the side of a square of equal area. */
CLSHEAR_API float clshear_lens_extent(const clshear_settings *settings);

/* Computes the integrand of pixel (x, y): the radiance at `count` points of four coordinates each.
 * The film coordinates x and y start at the pixel's upper left corner, and the pixel is 0 to 1. The
 * lens coordinates u and v cover the square around the aperture with 0 to 1, whatever its shape.
 * `rgb` receives 3 floats per point. A fixed point on one area light represents the power of all
 * area lights, as for one sample of a render. Where something moves, it is the middle of the
 * shutter. */
CLSHEAR_API clshear_status clshear_radiance(clshear_scene *scene, const clshear_settings *settings,
                                            int x, int y, const float *points, size_t count,
                                            float *rgb);

/* Computes the radiance at `count` samples of four coordinates each, as a sampler draws them, after
 * the settings' shear by `shear_px` and their filter. */
CLSHEAR_API clshear_status clshear_radiance_of_samples(clshear_scene *scene,
                                                       const clshear_settings *settings, int x,
                                                       int y, float shear_px, const float *samples,
                                                       size_t count, float *rgb);

/* The same at points of five coordinates, of which the last is the time: 0 where the shutter opens
 * and 1 where it closes; with ramps, the part of the exposure that has come in before. It makes no
 * difference where nothing moves. */
CLSHEAR_API clshear_status clshear_moving_radiance(clshear_scene *scene,
                                                   const clshear_settings *settings, int x, int y,
                                                   const float *points, size_t count, float *rgb);

/* The same at samples of five coordinates, after the shear of pixel, lens and time by `shear_px`
 * and a velocity on the film, in pixels while the shutter is open. With ramps the shear follows the
 * velocity in the middle of the exposure, as that of a render does. */
CLSHEAR_API clshear_status clshear_moving_radiance_of_samples(
    clshear_scene *scene, const clshear_settings *settings, int x, int y, float shear_px,
    const float velocity_px[2], const float *samples, size_t count, float *rgb);

/* Finds whether anything moves while the shutter is open, and the velocity on the film of what the
 * centre of pixel (x, y) sees in the middle of it, in pixels while it is open. */
CLSHEAR_API clshear_status clshear_pixel_motion(clshear_scene *scene,
                                                const clshear_settings *settings, int x, int y,
                                                int *moves, float velocity_px[2]);

/* Computes the shear of pixel (x, y) by the settings' oracle, in pixels. The pilot is replaced by
 * the centre. */
CLSHEAR_API clshear_status clshear_pixel_shear(clshear_scene *scene,
                                               const clshear_settings *settings, int x, int y,
                                               float *shear_px);

/* Writes named planes of floats as clshear_film_write does. Pictures need R, G and B. */
CLSHEAR_API clshear_status clshear_image_write(const char *path, int width, int height,
                                               size_t channels, const char *const *names,
                                               const float *const *planes);

/* ------------------------------------------------------------------------------------------------
 * Prediction: the variance of an integral from the spectrum of its samples
 * --------------------------------------------------------------------------------------------- */

/* Predicts the variance of the mean of the integrand at N samples that are shifted at random around
 * the torus. It is exactly the sum over frequencies f of P_samples(f) P_integrand(f) / N.
 * `integrand` has side x side means of the function over cells of the unit square. `side` is even
 * and at least twice, better eight times, the longer side of the spectrum. `mean_square` is the
 * mean square of the function itself.
 *
 * The parts are eight cones of frequencies and the tail. Cone k covers the angles from k to k + 1
 * eighths of a half turn from the x axis (Singh & Jarosz 2017, eq. 8). The tail lies beyond the
 * spectrum and has the power of random points. */
CLSHEAR_API clshear_status clshear_predict_variance(const clshear_spectrum *samples,
                                                    const float *integrand, size_t side,
                                                    double mean_square,
                                                    clshear_prediction **prediction);

/* Highest frequencies, in each coordinate, of the sums in clshear_predict_variance_4d, and effort.
 */
typedef struct clshear_reach {
    size_t struct_size;
    uint32_t axis;  /* for parts of one coordinate: 1 to 65536; should be 4 N */
    uint32_t plane; /* for parts of two coordinates: 1 to 2047 */
    uint32_t block; /* for the block of three or more: 1 to 15; with the time 1 to 5 */
    size_t points;  /* samples of the function for a part, in each of eight grids: a grid has one in
                       every cell at least; 0: 2^19. Few make the energies noisy, not biased. */
} clshear_reach;

/* Predicts the variance of the mean of a function at N samples that are shifted at random around
 * the torus. The samples' coordinates must begin with x, y, u, v; if the time t is the fifth, it is
 * one more coordinate of the function. A full lattice of frequencies would be too small, so each
 * part covers its own range. The tail has the power of random points. The function's energy at a
 * frequency is the cross power of independently shifted grids, and so free of aliases and noise on
 * average.
 *
 * The parts are the frequencies of x, y, u and v alone, of xy, xu, xv, yu, yv and uv, of three or
 * more coordinates ("block"), and the rest ("tail"); with the time also those of t, xt, yt, ut and
 * vt. */
CLSHEAR_API clshear_status clshear_predict_variance_4d(clshear_context *context,
                                                       const clshear_points *samples,
                                                       clshear_function function, void *user,
                                                       const clshear_reach *reach,
                                                       clshear_prediction **prediction);
CLSHEAR_API void clshear_prediction_free(clshear_prediction *prediction);

/* The predicted variance, the sum of all parts. */
CLSHEAR_API double clshear_prediction_variance(const clshear_prediction *prediction);

/* The predicted variance with the power of each frequency replaced by its ring's mean (Pilleboue et
 * al. 2015). NaN in four dimensions. */
CLSHEAR_API double clshear_prediction_isotropic(const clshear_prediction *prediction);

/* The predicted variance with the power of each frequency replaced by the mean over its ring within
 * one of 2^`level` cones of directions, for levels 0 to 8: from the isotropic formula to, in the
 * limit of many cones, the anisotropic one (Singh & Jarosz 2017). Above 8 the prediction itself;
 * NaN in four dimensions. */
CLSHEAR_API double clshear_prediction_in_cones(const clshear_prediction *prediction, size_t level);

/* Variance of the integrand itself. */
CLSHEAR_API double clshear_prediction_energy(const clshear_prediction *prediction);

CLSHEAR_API size_t clshear_prediction_parts(const clshear_prediction *prediction);

/* Name of a part, its share of the predicted variance, and its share of the integrand's energy (NaN
 * in two dimensions). `part` is below clshear_prediction_parts. */
CLSHEAR_API const char *clshear_prediction_part_name(const clshear_prediction *prediction,
                                                     size_t part);
CLSHEAR_API double clshear_prediction_part_variance(const clshear_prediction *prediction,
                                                    size_t part);
CLSHEAR_API double clshear_prediction_part_energy(const clshear_prediction *prediction,
                                                  size_t part);

/* ------------------------------------------------------------------------------------------------
 * Convergence: measured variance against the number of samples
 * --------------------------------------------------------------------------------------------- */

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
