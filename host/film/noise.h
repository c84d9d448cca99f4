/* How noisy a picture is, by its own variance. */
#ifndef CS_FILM_NOISE_H
#define CS_FILM_NOISE_H

#include "base/status.h"
#include "image/tone.h"

/* Mean radiance and the variance of that mean, a plane for each colour, row by row. */
typedef struct cs_estimate {
    const float *mean[3];
    const float *variance[3];
    int width;
    int height;
} cs_estimate;

/* The relative standard error of the picture: the root of the mean variance over the mean radiance,
 * both over all pixels and colours. 0 where nothing varies; infinite where a black picture does, or
 * where floats cannot hold a variance. */
double cs_noise_of_picture(const cs_estimate *estimate);

/* The 95th percentile over pixels of the standard error as a screen shows it, `noise`: 1 is the
 * step from black to white. A colour's error is half of what the tone and the sRGB curve make of
 * the step from one standard error below the mean to one above; a pixel's is the root of the mean
 * square over its colours. Variances are averaged over 5 x 5 pixels before: from two patterns, that
 * of a single pixel is off by more than its size; one that floats cannot hold counts as infinite.
 * Fails when out of memory. */
clshear_status cs_noise_of_pixels(const cs_estimate *estimate, const cs_tone *tone, double *noise,
                                  cs_error *error);

/* Bytes that it takes for each pixel while it runs. */
size_t cs_noise_bytes(void);

/* Mean of a plane over 5 x 5 pixels around one, at the border over fewer. */
double cs_smoothed(const float *plane, int width, int height, int x, int y);

#endif
