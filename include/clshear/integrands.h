/* clshear: integrands, of the unit square and of pixels. */
#ifndef CLSHEAR_INTEGRANDS_H
#define CLSHEAR_INTEGRANDS_H

#include "points.h"

#ifdef __cplusplus
extern "C" {
#endif

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

/* Computes the shear of pixel (x, y) by the settings' oracle, in pixels; by the centre if
 * none is set, or the pilot. */
CLSHEAR_API clshear_status clshear_pixel_shear(clshear_scene *scene,
                                               const clshear_settings *settings, int x, int y,
                                               float *shear_px);

/* Writes named planes of floats as clshear_film_write does. Pictures need R, G and B. */
CLSHEAR_API clshear_status clshear_image_write(const char *path, int width, int height,
                                               size_t channels, const char *const *names,
                                               const float *const *planes);

#ifdef __cplusplus
}
#endif

#endif
