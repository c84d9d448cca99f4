/* Acceleration structures by Embree: the flattened hierarchy for the device, and depths on the
 * host. In host/, only this folder uses Embree. */
#ifndef CS_ACCEL_ACCEL_H
#define CS_ACCEL_ACCEL_H

#include "base/array.h"
#include "base/depth.h"
#include "base/status.h"
#include "clshear/device/camera.h"
#include "clshear/device/camera_sample.h"
#include "kernels/scene.h"
#include "scene/scene.h"

typedef struct cs_accel cs_accel;

/* The hierarchy in the kernels' layout. */
typedef struct cs_flat_bvh {
    cs_array nodes;          /* cs_node; the root is node 0 */
    cs_array triangles;      /* cs_triangle, in leaf order; spatial splits repeat some */
    cs_array node_steps;     /* cs_node_step, as many as nodes; none where nothing moves */
    cs_array triangle_steps; /* cs_triangle_step, as many as triangles; likewise */
    int depth;               /* levels of the tree: entries of the traversal's stack */
} cs_flat_bvh;

void cs_flat_bvh_free(cs_flat_bvh *bvh);

/* Starts Embree with `threads` threads (0: all). The scene's arrays must outlive the result. */
clshear_status cs_accel_create(const cs_scene *scene, int threads, cs_accel **accel,
                               cs_error *error);
void cs_accel_free(cs_accel *accel);

/* Builds the hierarchy by the surface area heuristic (rtcBuildBVH), with spatial splits in small
 * scenes. Of what moves, the tree is that of the middle of the shutter. */
clshear_status cs_accel_build_bvh(const cs_accel *accel, cs_flat_bvh *bvh, cs_error *error);

enum {
    CS_MOST_LENS_RAYS = 256 /* upper bound of lens rays per pixel */
};

/* Lights that rays can meet, as cs_is_shape says; others are skipped. */
typedef struct cs_shapes {
    const cs_light *lights;
    size_t count;
} cs_shapes;

/* Computes the depths of the pixels of a window, row by row, of what is there and of `shapes`,
 * which may be NULL. `optics` is the table of the camera's lens, `window` is x0, x1, y0, y1 in
 * pixels. Each pixel gets a centre ray and `lens_rays` lens rays, 0 to CS_MOST_LENS_RAYS. With 0
 * the statistics repeat the centre and `optics` is not used.
 */
clshear_status cs_accel_depth(const cs_accel *accel, const cs_shapes *shapes,
                              const cs_camera *camera, const cs_f32 *optics, const int *window,
                              int lens_rays, cs_depth *depth, cs_error *error);

/* Cameras of a shutter: where it opens, in the middle, where it closes. */
typedef struct cs_shutter_cameras {
    cs_camera open;
    cs_camera middle;
    cs_camera closed;
} cs_shutter_cameras;

/* Computes the velocities, as cs_oracle_velocity, of what the pixels of a window see through the
 * middle of the lens in the middle of the shutter. */
void cs_accel_velocity(const cs_accel *accel, const cs_shutter_cameras *cameras, const int *window,
                       cs_velocity *velocities);

/* The distance at which a ray meets the first surface, in lengths of `direction`, between `near`
 * and `far`, and the number of the triangle there; infinite, and `triangle` unchanged, if it meets
 * none. time: of the shutter, 0 to 1.
 */
float cs_accel_distance(const cs_accel *accel, const float *origin, const float *direction,
                        float near, float far, float time, uint32_t *triangle);

#endif
