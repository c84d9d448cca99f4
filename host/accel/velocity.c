/* Velocities on the film, of the points that Embree hits. */
#include <math.h>
#include <string.h>

#include "accel/embree.h"
#include "base/parallel.h"
#include "base/vec.h"
#include "clshear/device/lens.h"
#include "oracle/oracle.h"

/* Depth, in focal distances, at which a pixel that sees no surface sees the sky. */
static const float sky_depth = 1e6f;

typedef struct velocity_work {
    const cs_accel *accel;
    const cs_shutter_cameras *cameras;
    const int *window;
    cs_velocity *velocities;
} velocity_work;

/* Where a point of a triangle in the middle of the shutter is at both ends. */
static void carry(const cs_scene *scene, uint32_t triangle, const float *point, float *from,
                  float *to)
{
    float corner[3][3], e1[3], e2[3], offset[3], normal[3], across1[3], across2[3];
    for (int k = 0; k < 3; k++)
        cs_scene_corner(scene, triangle, k, 0.5f, corner[k]);
    cs_vec_subtract(corner[1], corner[0], e1);
    cs_vec_subtract(corner[2], corner[0], e2);
    cs_vec_subtract(point, corner[0], offset);
    cs_vec_cross(e1, e2, normal);
    cs_vec_cross(e2, normal, across1);
    cs_vec_cross(normal, e1, across2);
    const float square = cs_vec_dot(normal, normal);
    const float b1 = cs_vec_dot(offset, across1) / square;
    const float b2 = cs_vec_dot(offset, across2) / square;
    for (int i = 0; i < 3; i++)
        from[i] = to[i] = 0.0f;
    const float weights[3] = {1.0f - b1 - b2, b1, b2};
    for (int k = 0; k < 3; k++) {
        float open[3], closed[3];
        cs_scene_corner(scene, triangle, k, 0.0f, open);
        cs_scene_corner(scene, triangle, k, 1.0f, closed);
        for (int i = 0; i < 3; i++) {
            from[i] += weights[k] * open[i];
            to[i] += weights[k] * closed[i];
        }
    }
}

static cs_velocity velocity_of(const velocity_work *work, cs_f32 x, cs_f32 y)
{
    const cs_shutter_cameras *cameras = work->cameras;
    const cs_ray ray = cs_lens_ray(cameras->middle, x + 0.5f, y + 0.5f, 0.0f, 0.0f);
    uint32_t triangle = 0;
    float point[3], from[3], to[3];
    float depth =
        cs_accel_distance(work->accel, ray.origin, ray.direction, 0.0f, INFINITY, 0.5f, &triangle);
    const int hits = isfinite(depth);
    if (!hits) depth = sky_depth * cameras->middle.focal_distance;
    for (int i = 0; i < 3; i++)
        point[i] = ray.origin[i] + depth * ray.direction[i];
    memcpy(from, point, sizeof from);
    memcpy(to, point, sizeof to);
    if (hits && cs_scene_moves(work->accel->scene))
        carry(work->accel->scene, triangle, point, from, to);
    return cs_oracle_velocity(&cameras->open, &cameras->closed, from, to);
}

static void velocities_of_range(void *user, size_t begin, size_t end)
{
    const velocity_work *work = user;
    const size_t width = (size_t)(work->window[1] - work->window[0]);
    for (size_t i = begin; i < end; i++) {
        const size_t row = i / width, column = i - row * width;
        work->velocities[i] = velocity_of(work, (cs_f32)work->window[0] + (cs_f32)column,
                                          (cs_f32)work->window[2] + (cs_f32)row);
    }
}

void cs_accel_velocity(const cs_accel *accel, const cs_shutter_cameras *cameras, const int *window,
                       cs_velocity *velocities)
{
    const size_t count = (size_t)(window[1] - window[0]) * (size_t)(window[3] - window[2]);
    velocity_work work = {accel, cameras, window, velocities};
    cs_parallel(accel->threads, count, velocities_of_range, &work);
}
