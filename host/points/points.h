/* Point sets: drawn, sheared, projected, read and written. */
#ifndef CS_POINTS_POINTS_H
#define CS_POINTS_POINTS_H

#include "base/status.h"
#include "clshear/analysis.h"

/* Names of up to six coordinates. */
#define CS_POINT_NAMES "xyuvpq"

/* Sets of equally many points of the unit cube. Start from zeros; cs_points_free gives the memory
 * back and leaves zeros. */
struct clshear_points {
    float *values; /* coordinate d of point i of set s: values[(s * count + i) * dimensions + d] */
    size_t sets;
    size_t count;
    size_t dimensions; /* 1 to 6 */
    char names[8];     /* a letter for each dimension */
};

/* Allocates `values` for the sets, count and dimensions that are set. */
clshear_status cs_points_reserve(clshear_points *points, cs_error *error);

/* As clshear_points_create. */
clshear_status cs_points_take(const float *values, size_t sets, size_t count, const char *names,
                              clshear_points *points);

/* As the public functions of these names; fail with the calling thread's message. */
clshear_status cs_points_draw(const char *sampler, size_t count, size_t sets, uint32_t seed,
                              clshear_points *points);
clshear_status cs_points_shear(clshear_points *points, clshear_shear shear, float shear_px);
clshear_status cs_points_select(clshear_points *points, const char *names);
clshear_status cs_points_read(const char *path, clshear_points *points);
clshear_status cs_points_write(const clshear_points *points, const char *path);
void cs_points_free(clshear_points *points);

#endif
