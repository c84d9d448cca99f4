/* Point sets: drawing, shearing, projection and files. */
#ifndef CS_POINTS_POINTS_H
#define CS_POINTS_POINTS_H

#include "base/status.h"
#include "clshear/analysis.h"
#include "clshear/device/camera_sample.h"

/* Names of the coordinates: film x y, lens u v, light p q, time t. */
#define CS_POINT_NAMES "xyuvpqt"

/* Sets of equally many points of the unit cube. Initialise to zero. cs_points_free frees the memory
 * and zeroes the struct. */
struct clshear_points {
    float *values; /* coordinate d of point i of set s: values[(s * count + i) * dimensions + d] */
    size_t sets;
    size_t count;
    size_t dimensions; /* coordinates of a point, 1 to 7 */
    char names[8];     /* one letter per coordinate */
};

/* Allocates `values`. `sets`, `count` and `dimensions` must be set. */
clshear_status cs_points_reserve(clshear_points *points, cs_error *error);

/* Implements clshear_points_create. */
clshear_status cs_points_take(const float *values, size_t sets, size_t count, const char *names,
                              clshear_points *points);

/* Implement the public functions of these names; `fresh`, clshear_points_draw_fresh; `moving`,
 * clshear_points_draw_moving. Errors go to the calling thread's error. */
clshear_status cs_points_draw(const char *sampler, size_t count, size_t sets, uint32_t seed,
                              int fresh, int moving, clshear_points *points);
clshear_status cs_points_shear(clshear_points *points, clshear_shear shear, float shear_px);
clshear_status cs_points_shear_moving(clshear_points *points, clshear_shear shear, float shear_px,
                                      cs_velocity velocity_px);
clshear_status cs_points_select(clshear_points *points, const char *names);
clshear_status cs_points_read(const char *path, clshear_points *points);
clshear_status cs_points_write(const clshear_points *points, const char *path);
void cs_points_free(clshear_points *points);

#endif
