/* clshear: data for the device headers, for programs with kernels of their own.
 *
 * The headers in clshear/device/ are functions in OpenCL C that also compile as C and C++. They
 * work on plain structs and arrays: a cs_pattern with its sample table, a cs_optics with its lens
 * table, a cs_camera. This file makes these on the host, without an OpenCL device.
 * docs/guide/own-kernel.md shows their use.
 *
 * The head of common.h describes the common conventions. Functions that write a struct of the
 * device headers also take its size, and fail if the program's headers and the library are of
 * different versions. */
#ifndef CLSHEAR_KERNELS_H
#define CLSHEAR_KERNELS_H

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The text of all headers in clshear/device/, zero-terminated: OpenCL C 1.2 or later without
 * includes. Pass it to clCreateProgramWithSource as the string before your own. Owned by the
 * library. */
CLSHEAR_API const char *clshear_device_source(void);

/* ------------------------------------------------------------------------------------------------
 * Patterns: the samples of a pixel
 * --------------------------------------------------------------------------------------------- */

/* Order of the samples in a pattern. */
typedef enum clshear_sample_order {
    CLSHEAR_ORDER_COHERENT = 0, /* consecutive samples are neighbours on film; best for kernels */
    CLSHEAR_ORDER_SEQUENCE = 1  /* the order of the sampler's sequence */
} clshear_sample_order;

/* Finds the smallest sample count of a sampler that is `wanted` or more. `sampler` is a name from
 * clshear_sampler_describe; NULL is the default. `wanted` must be 1 or more. Fails if there is no
 * such count. */
CLSHEAR_API clshear_status clshear_sampler_count(const char *sampler, uint32_t wanted,
                                                 uint32_t *count);

typedef struct clshear_pattern clshear_pattern;

/* Creates a pattern of `wanted` samples, rounded up to the next sample count of the sampler. One
 * pattern serves all pixels, and a key selects the samples of each. "poisson" and
 * "ccvt" make their point sets when first used, which may take a minute, and keep them in the
 * user's folder of caches (docs/notes/samplers.md). */
CLSHEAR_API clshear_status clshear_pattern_create(const char *sampler, uint32_t wanted,
                                                  clshear_sample_order order,
                                                  clshear_pattern **pattern);
CLSHEAR_API void clshear_pattern_free(clshear_pattern *pattern);

/* Writes a cs_pattern (clshear/device/sampler/pattern.h) to `constants`. `size` is its size. */
CLSHEAR_API clshear_status clshear_pattern_constants(const clshear_pattern *pattern,
                                                     void *constants, size_t size);

/* The sample table. Owned by the pattern. `words` receives its length, which is never 0, so that a
 * buffer can be made for every sampler. */
CLSHEAR_API const uint32_t *clshear_pattern_table(const clshear_pattern *pattern, size_t *words);

/* ------------------------------------------------------------------------------------------------
 * Lenses: an aperture and a pixel filter
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_lens clshear_lens;

/* Creates the aperture, the pixel filter and, if eye, target and field of view are set, the camera
 * of the settings. Settings that are not set have their fallbacks; an unset up is +Y, an unset lens
 * radius 0 (a pinhole), and an unset focal distance 1. Fails for CLSHEAR_F_STOP, _BLUR,
 * _FOCUS_PIXEL and _FOCUS_POINT, which need a scene: clshear_camera_complete turns them into
 * numbers. */
CLSHEAR_API clshear_status clshear_lens_create(const clshear_settings *settings,
                                               clshear_lens **lens);
CLSHEAR_API void clshear_lens_free(clshear_lens *lens);

/* Writes a cs_optics (clshear/device/camera.h) to `optics`. `size` is its size. */
CLSHEAR_API clshear_status clshear_lens_optics(const clshear_lens *lens, void *optics, size_t size);

/* The lens table of the cs_optics. Owned by the lens. `floats` receives its length, which is never
 * 0. */
CLSHEAR_API const float *clshear_lens_table(const clshear_lens *lens, size_t *floats);

/* Writes a cs_camera (clshear/device/camera.h) to `camera`, including the lens's cs_optics. `size`
 * is its size. Fails if the settings have no camera. */
CLSHEAR_API clshear_status clshear_lens_camera(const clshear_lens *lens, void *camera, size_t size);

#ifdef __cplusplus
}
#endif

#endif
