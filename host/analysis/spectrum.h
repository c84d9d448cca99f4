/* Power spectra: measurement, Fourier transforms, evaluation and files. */
#ifndef CS_ANALYSIS_SPECTRUM_H
#define CS_ANALYSIS_SPECTRUM_H

#include "context/context.h"
#include "points/points.h"

/* A power spectrum. Initialise to zero. cs_spectrum_free frees the memory and zeroes the struct. */
struct clshear_spectrum {
    float *power; /* row by row; frequency (column - width / 2, row - height / 2) */
    size_t width;
    size_t height;
    size_t sets;  /* number of sets in the mean */
    size_t count; /* points in each set */
};

/* Implement the public functions of these names. Errors go to the calling thread's error. */
clshear_status cs_spectrum_measure(clshear_context *context, const clshear_points *points,
                                   size_t width, size_t height, clshear_spectrum *spectrum);
clshear_status cs_spectrum_of_grid(const float *values, size_t width, size_t height,
                                   clshear_spectrum *spectrum);
clshear_status cs_spectrum_of_slice(const float *values, size_t width, size_t height,
                                    clshear_spectrum *spectrum);
size_t cs_spectrum_radius(const clshear_spectrum *spectrum);
void cs_spectrum_radial(const clshear_spectrum *spectrum, float *mean, float *anisotropy_db);
void cs_spectrum_along(const clshear_spectrum *spectrum, double x, double y, float *power);
clshear_status cs_spectrum_write(const clshear_spectrum *spectrum, int keep_dc, const char *path);
void cs_spectrum_free(clshear_spectrum *spectrum);

/* Implements clshear_image_write. */
clshear_status cs_planes_write(const char *path, int width, int height, size_t channels,
                               const char *const *names, const float *const *planes);

#endif
