/* Velocities on the film, of the points that Embree hits. */
#include <math.h>

#include "accel/embree.h"
#include "base/parallel.h"
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

static cs_velocity velocity_of(const velocity_work *work, cs_f32 x, cs_f32 y)
{
    const cs_shutter_cameras *cameras = work->cameras;
    const cs_ray ray = cs_lens_ray(cameras->middle, x + 0.5f, y + 0.5f, 0.0f, 0.0f);
    uint32_t triangle = 0;
    float point[3];
    float depth =
        cs_accel_distance(work->accel, ray.origin, ray.direction, 0.0f, INFINITY, &triangle);
    if (!isfinite(depth)) depth = sky_depth * cameras->middle.focal_distance;
    for (int i = 0; i < 3; i++)
        point[i] = ray.origin[i] + depth * ray.direction[i];
    return cs_oracle_velocity(&cameras->open, &cameras->closed, point, point);
}

static void velocities_of_range(void *user, size_t begin, size_t end)
{
    const velocity_work *work = user;
    const size_t width = (size_t)(work->window[1] - work->window[0]);
    for (size_t i = begin; i < end; i++)
        work->velocities[i] = velocity_of(work, (cs_f32)work->window[0] + (cs_f32)(i % width),
                                          (cs_f32)work->window[2] + (cs_f32)(i / width));
}

void cs_accel_velocity(const cs_accel *accel, const cs_shutter_cameras *cameras, const int *window,
                       cs_velocity *velocities)
{
    const size_t count = (size_t)(window[1] - window[0]) * (size_t)(window[3] - window[2]);
    velocity_work work = {accel, cameras, window, velocities};
    cs_parallel(accel->threads, count, velocities_of_range, &work);
}
