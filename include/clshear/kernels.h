/* clshear: what a program needs to use the device headers in kernels of its own.
 *
 * The headers in clshear/device/ are functions in OpenCL C that are C and C++ as well. They work on
 * plain words: a cs_pattern with its sample table, a cs_optics with its lens table, a cs_camera.
 * This file makes those words, on the host and without any OpenCL device. docs/guide/own-kernel.md
 * shows how to put them together.
 *
 * Common conventions stand at the head of common.h. Besides:
 * - Functions that write a struct of the device headers take its size, and fail if the headers of
 *   the program and those of the library do not agree on it. */
#ifndef CLSHEAR_KERNELS_H
#define CLSHEAR_KERNELS_H

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The text of all headers in clshear/device/, ended by a zero: OpenCL C 1.2 or later that needs no
 * include path. Pass it to clCreateProgramWithSource as the string before your own. The library
 * owns it. */
CLSHEAR_API const char *clshear_device_source(void);

/* ------------------------------------------------------------------------------------------------
 * Patterns: the samples of a pixel
 * --------------------------------------------------------------------------------------------- */

/* Order of the samples in a pattern. */
typedef enum clshear_sample_order {
    CLSHEAR_ORDER_COHERENT = 0, /* consecutive samples are neighbours on film; best for kernels */
    CLSHEAR_ORDER_SEQUENCE = 1  /* the order of the sampler's sequence */
} clshear_sample_order;

/* The least number of samples, `wanted` or more, that a pattern of the sampler can have. `sampler`
 * is a name that clshear_sampler_describe lists; NULL is the default sampler. `wanted` must be 1 or
 * more. Fails if there is no such number. */
CLSHEAR_API clshear_status clshear_sampler_count(const char *sampler, uint32_t wanted,
                                                 uint32_t *count);

typedef struct clshear_pattern clshear_pattern;

/* A pattern of `wanted` samples, or of the next number that the sampler has. One pattern serves all
 * pixels: a key makes each pixel's samples its own. Making it may take seconds for a sampler whose
 * table is computed by optimisation ("ccvt", "poisson"). */
CLSHEAR_API clshear_status clshear_pattern_create(const char *sampler, uint32_t wanted,
                                                  clshear_sample_order order,
                                                  clshear_pattern **pattern);
CLSHEAR_API void clshear_pattern_free(clshear_pattern *pattern);

/* Writes a cs_pattern (clshear/device/sampler/pattern.h) to `constants`. `size` is sizeof of it. */
CLSHEAR_API clshear_status clshear_pattern_constants(const clshear_pattern *pattern,
                                                     void *constants, size_t size);

/* The sample table, which the pattern owns. `words` receives its length, which is never 0, so that
 * a buffer can be made of it for every sampler. */
CLSHEAR_API const uint32_t *clshear_pattern_table(const clshear_pattern *pattern, size_t *words);

/* ------------------------------------------------------------------------------------------------
 * Lenses: an aperture and a pixel filter
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_lens clshear_lens;

/* The aperture, the pixel filter and, if eye, target and field of view are set, the camera that the
 * settings describe. What is not set has its fallback; an unset up is +Y, an unset lens radius a
 * pinhole, an unset focal distance 1. */
CLSHEAR_API clshear_status clshear_lens_create(const clshear_settings *settings,
                                               clshear_lens **lens);
CLSHEAR_API void clshear_lens_free(clshear_lens *lens);

/* Writes a cs_optics (clshear/device/camera.h) to `optics`. `size` is sizeof of it. */
CLSHEAR_API clshear_status clshear_lens_optics(const clshear_lens *lens, void *optics, size_t size);

/* The lens table that belongs to the cs_optics. The lens owns it. `floats` receives its length,
 * which is never 0. */
CLSHEAR_API const float *clshear_lens_table(const clshear_lens *lens, size_t *floats);

/* Writes a cs_camera (clshear/device/camera.h), with the lens's cs_optics in it, to `camera`.
 * `size` is sizeof of it. Fails if the settings described no camera. */
CLSHEAR_API clshear_status clshear_lens_camera(const clshear_lens *lens, void *camera, size_t size);

#ifdef __cplusplus
}
#endif

#endif
