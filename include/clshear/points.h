/* clshear: points, the samples of a sampler, without a device. */
#ifndef CLSHEAR_POINTS_H
#define CLSHEAR_POINTS_H

#include "choices.h"
#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct clshear_points clshear_points; /* sets of points in the unit cube */

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

#ifdef __cplusplus
}
#endif

#endif
