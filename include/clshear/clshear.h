/* clshear: depth of field with sheared samples.
 *
 * The rendering half of the library, in the order of use: settings.h, context.h, scene.h, camera.h,
 * the renders of this file, film.h. analysis.h has the analysis of samples, kernels.h and device/
 * the kernels for other programs, and opencl.h the sharing of OpenCL objects. The head of common.h
 * describes the conventions and the rules for threads.
 *
 * World space is right-handed, in any unit. Raster coordinates start at the top left corner of the
 * image. Radiance is linear Rec.709. */
#ifndef CLSHEAR_H
#define CLSHEAR_H

#include "camera.h"
#include "common.h"
#include "context.h"
#include "film.h"
#include "scene.h"
#include "settings.h"

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Samplers
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_sampler_info {
    size_t struct_size;
    const char *name;
    const char *about; /* one line */
    int progressive;   /* 1: a pattern's first samples are independent of its length */
    int is_default;
} clshear_sampler_info;

/* Describes sampler number `index`, from 0. Returns 0 past the last one. The caller sets
 * `info->struct_size`. */
CLSHEAR_API int clshear_sampler_describe(size_t index, clshear_sampler_info *info);

/* ------------------------------------------------------------------------------------------------
 * Render
 * --------------------------------------------------------------------------------------------- */

/* Renders the scene. Renders with equal arguments are equal bit for bit, whatever the number of
 * threads. A render that the progress callback stops succeeds: the film has the samples so far, its
 * channel Samples their number, and its info complete == 0. NULL settings: fallbacks. */
CLSHEAR_API clshear_status clshear_render(clshear_scene *scene, const clshear_settings *settings,
                                          clshear_film **film);

/* Continues a render up to the settings' samples per pixel, without repeating the samples of
 * `base`. The base must have been made with CLSHEAR_EXTENDABLE and the same settings except
 * CLSHEAR_SPP. The sampler must be progressive. */
CLSHEAR_API clshear_status clshear_render_extend(clshear_scene *scene,
                                                 const clshear_settings *settings,
                                                 const clshear_film *base, clshear_film **film);

#ifdef __cplusplus
}
#endif

#endif
