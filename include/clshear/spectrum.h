/* clshear: expected power spectra of point sets. */
#ifndef CLSHEAR_SPECTRUM_H
#define CLSHEAR_SPECTRUM_H

#include "points.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct clshear_spectrum clshear_spectrum; /* power over a plane of frequencies */

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

#ifdef __cplusplus
}
#endif

#endif
