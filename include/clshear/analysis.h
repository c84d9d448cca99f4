/* clshear: why sheared samples converge faster, in numbers.
 *
 * Part of clshear.h, which has the conventions; included by it. */
#ifndef CLSHEAR_ANALYSIS_H
#define CLSHEAR_ANALYSIS_H

#include "clshear.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Spectra: expected power spectra of point sets. Functions here that have no context fail with a
 * message that clshear_message(NULL) has.
 * --------------------------------------------------------------------------------------------- */

/* The mean over sets of |sum of exp(-2 pi i f.x)|^2 / N at whole frequencies: 1 for random points,
 * N at frequency 0. Freed by clshear_spectrum_free; start from zeros. */
typedef struct clshear_spectrum {
    float *power; /* row by row; that of frequency (column - width / 2, row - height / 2) */
    size_t width;
    size_t height;
    size_t sets;  /* that the mean is of */
    size_t count; /* points in each */
} clshear_spectrum;

/* Measures points of two dimensions on the device, at width x height frequencies, each 2 to 8192.
 */
CLSHEAR_API clshear_status clshear_spectrum_measure(clshear_context *context,
                                                    const clshear_points *points, size_t width,
                                                    size_t height, clshear_spectrum *spectrum);

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
CLSHEAR_API void clshear_spectrum_free(clshear_spectrum *spectrum);

/* Power of the discrete Fourier transform of width x height values, row by row: |f|^2 relative to
 * its mean over all frequencies but 0; as a spectrum of one set. */
CLSHEAR_API clshear_status clshear_spectrum_of_grid(const float *values, size_t width,
                                                    size_t height, clshear_spectrum *spectrum);

/* ------------------------------------------------------------------------------------------------
 * Variance: measured, fitted and predicted, of integrals over the unit square. Functions fail with
 * a message that clshear_message(NULL) has.
 * --------------------------------------------------------------------------------------------- */

/* Shapes about the middle of the square, 1 inside and 0 outside, or with values in between. */
typedef enum clshear_integrand_kind {
    CLSHEAR_INTEGRAND_STEP = 0, /* the half plane on one side of a line, `size` from the middle */
    CLSHEAR_INTEGRAND_BOX = 1,  /* a square of side `size` */
    CLSHEAR_INTEGRAND_DISK = 2, /* of diameter `size` */
    CLSHEAR_INTEGRAND_GAUSSIAN = 3,  /* of deviations size / 4 along the angle, size / 12 across */
    CLSHEAR_INTEGRAND_TENT = 4,      /* falls evenly along the angle to 0 at size / 2 */
    CLSHEAR_INTEGRAND_PLANE_WAVE = 5 /* 1/2 + cos / 2, of wavelength `size` along the angle */
} clshear_integrand_kind;

typedef struct clshear_integrand {
    clshear_integrand_kind kind;
    double angle_deg; /* 0: along x; anticlockwise in a picture with y up */
    double size;
} clshear_integrand;

/* The integrand called "step", "box", "disk", "gaussian", "tent" or "plane-wave", with its usual
 * size, at angle 0. */
CLSHEAR_API clshear_status clshear_integrand_find(const char *name, clshear_integrand *integrand);
CLSHEAR_API double clshear_integrand_at(const clshear_integrand *integrand, double x, double y);

/* Its means over side x side cells, row by row from y = 0, and its mean square, both from 4 x 4
 * values in each cell: what clshear_predict_variance takes. */
CLSHEAR_API clshear_status clshear_integrand_tabulate(const clshear_integrand *integrand,
                                                      size_t side, float *cells,
                                                      double *mean_square);

/* Mean of the integrand over the first two coordinates of every set's points: `sets` values. With
 * `homogenise`, each set is first shifted at random around the torus. NaN for points of one
 * dimension. */
CLSHEAR_API void clshear_points_integrate(const clshear_points *points,
                                          const clshear_integrand *integrand, int homogenise,
                                          uint32_t seed, double *means);

/* A line through log variance over log N. */
typedef struct clshear_fit {
    double slope;
    double slope_low; /* 95 % interval, by bootstrap over the replicates */
    double slope_high;
} clshear_fit;

/* Fits estimates from `replicates` (2 or more) patterns of each of `sizes` (2 or more) rising
 * counts: means[k * replicates + r]. `errors`: for each count the variance of one pattern or, where
 * `reference` is not NULL, its mean squared difference from *reference. Sizes whose error is 0 are
 * left out of the fit; slopes are NaN where fewer than two remain. */
CLSHEAR_API clshear_status clshear_fit_slope(const uint32_t *counts, size_t sizes,
                                             const double *means, size_t replicates,
                                             const double *reference, double *errors,
                                             clshear_fit *fit);

/* The same for errors that are means over parts, such as the tiles of an image: parts[k * count +
 * i]. The bootstrap is over the parts, the same ones for all sizes. */
CLSHEAR_API clshear_status clshear_fit_slope_of_parts(const uint32_t *counts, size_t sizes,
                                                      const double *parts, size_t count,
                                                      double *errors, clshear_fit *fit);

/* A function of four coordinates: writes its values at `count` points of four coordinates each, all
 * in [0, 1]. What it returns but CLSHEAR_OK is returned by those that call it. */
typedef clshear_status (*clshear_function)(void *user, const float *points, size_t count,
                                           float *values);

/* As clshear_points_integrate, of a function of x, y, u and v and points that begin with these. */
CLSHEAR_API clshear_status clshear_points_integrate_4d(const clshear_points *points,
                                                       clshear_function function, void *user,
                                                       int homogenise, uint32_t seed,
                                                       double *means);

enum {
    CLSHEAR_CONES = 8
};

/* Variance that a spectrum of samples lets expect of an integral. */
typedef struct clshear_prediction {
    double variance;             /* the sum of cones and tail */
    double cones[CLSHEAR_CONES]; /* from frequencies whose angle is k to k + 1 eighths of a half
                                    turn from the x axis (Singh & Jarosz 2017, eq. 8) */
    double tail;                 /* what lies beyond the spectrum, at the level of random points */
    double isotropic;            /* as `variance`, with the ring's mean for every frequency
                                    (Pilleboue et al. 2015) */
    double energy;               /* variance of the integrand itself */
} clshear_prediction;

/* Variance of the mean of the integrand at N samples that are shifted at random around the torus:
 * the sum over frequencies f of P_samples(f) P_integrand(f) / N, which is exact. `integrand`:
 * side x side means of the function over cells of the unit square; side is even and at least twice
 * the spectrum's sides, better eight times. mean_square: of the function itself. */
CLSHEAR_API clshear_status clshear_predict_variance(const clshear_spectrum *samples,
                                                    const float *integrand, size_t side,
                                                    double mean_square,
                                                    clshear_prediction *prediction);

/* How far, in each coordinate, the frequencies go that clshear_predict_variance_4d adds up. */
typedef struct clshear_reach {
    uint32_t axis;  /* of one coordinate: 1 to 65536; should be 4 N */
    uint32_t plane; /* of two: 1 to 2047 */
    uint32_t block; /* of three or four: 1 to 15 */
} clshear_reach;

enum {
    CLSHEAR_PARTS = 12
};

/* Where the variance of an integral over four coordinates comes from. Parts: frequencies of x, y, u
 * and v alone; of xy, xu, xv, yu, yv and uv; of three or four (the block); the rest (the tail). */
typedef struct clshear_prediction_4d {
    double variance;                /* the sum of all parts */
    double parts[CLSHEAR_PARTS];    /* of the variance */
    double energies[CLSHEAR_PARTS]; /* of the integrand's own variance */
    double energy;                  /* their sum */
} clshear_prediction_4d;

/* "x", "y", ... "block", "tail". */
CLSHEAR_API const char *clshear_prediction_part(int part);

/* Variance of the mean of a function at N samples that are shifted at random around the torus, from
 * the power of samples that begin with x, y, u and v. No lattice of four dimensions reaches as far
 * as samples are good, so parts go as far as each needs; the tail counts as random points would.
 * The function's energy at each frequency is the cross power of independently shifted grids, so
 * that neither aliases nor chance add to it. */
CLSHEAR_API clshear_status clshear_predict_variance_4d(clshear_context *context,
                                                       const clshear_points *samples,
                                                       clshear_function function, void *user,
                                                       const clshear_reach *reach,
                                                       clshear_prediction_4d *prediction);

/* ------------------------------------------------------------------------------------------------
 * Integrands of pixels
 * --------------------------------------------------------------------------------------------- */

/* Side of the square around the aperture in the unit in which shears count: 1 for squares and
 * images, more for disks and polygons, whose unit is the side of a square as large. */
CLSHEAR_API float clshear_lens_extent(const clshear_camera *camera);

/* The integrand of pixel (x, y) of a width x height image: radiance at `count` points of four
 * coordinates each, film x and y from the pixel's left upper corner (0 to 1 is the pixel), and lens
 * u and v, where 0 to 1 is the square around the aperture, whatever its shape. `rgb`: 3 floats a
 * point. Area lights: one point of one of them, always the same, stands for all their power, as it
 * does for one sample of a render. The camera's lens must be chosen. */
CLSHEAR_API clshear_status clshear_radiance(clshear_scene *scene, const clshear_camera *camera,
                                            int width, int height, int x, int y,
                                            const float *points, size_t count, float *rgb);

/* The same at `count` tuples of four coordinates that a sampler draws: radiance where the options'
 * shear, by `shear_px`, and filter take them. Of the options also width and height count. */
CLSHEAR_API clshear_status clshear_radiance_of_samples(clshear_scene *scene,
                                                       const clshear_camera *camera,
                                                       const clshear_options *options, int x, int y,
                                                       float shear_px, const float *samples,
                                                       size_t count, float *rgb);

/* Writes planes of floats, named R, G, B and whatever else, as clshear_film_write does. Fails with
 * a message that clshear_message(NULL) has. */
CLSHEAR_API clshear_status clshear_image_write(const char *path, int width, int height,
                                               size_t channels, const char *const *names,
                                               const float *const *planes);

#ifdef __cplusplus
}
#endif

#endif
