/* The depths that every pixel sees. */
#include <math.h>
#include <stdlib.h>

#include "accel/embree.h"
#include "base/parallel.h"
#include "lens.h"
#include "pattern/pattern.h"
#include "sampler/sampler.h"
#include "shear.h"

enum {
    WIDTH = 16 /* rays that Embree traces at once */
};

typedef struct prepass {
    const cs_accel *accel;
    const cs_camera *camera;
    const f32 *optics;
    const int *window;
    cs_pattern pattern; /* of the lens rays */
    const u32 *rows;
    u32 lens_rays;
    cs_depth *depth;
} prepass;

static void set_ray(struct RTCRayHit16 *query, int lane, const cs_ray *ray)
{
    query->ray.org_x[lane] = ray->origin[0];
    query->ray.org_y[lane] = ray->origin[1];
    query->ray.org_z[lane] = ray->origin[2];
    query->ray.dir_x[lane] = ray->direction[0];
    query->ray.dir_y[lane] = ray->direction[1];
    query->ray.dir_z[lane] = ray->direction[2];
    query->ray.tnear[lane] = 0.0f;
    query->ray.tfar[lane] = INFINITY;
    query->ray.time[lane] = 0.0f;
    query->ray.mask[lane] = ~0u;
    query->ray.flags[lane] = 0;
    query->hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    query->hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
}

/* Depths along up to WIDTH rays: directions have a forward component of 1. */
static void trace(const cs_accel *accel, const cs_ray *rays, int count, f32 *depth)
{
    struct RTCIntersectContext context;
    struct RTCRayHit16 query;
    int valid[WIDTH] __attribute__((aligned(64)));
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (int lane = 0; lane < WIDTH; lane++) {
        valid[lane] = lane < count ? -1 : 0;
        set_ray(&query, lane, &rays[lane < count ? lane : 0]);
    }
    rtcIntersect16(valid, accel->traced, &context, &query);
    for (int lane = 0; lane < count; lane++)
        depth[lane] =
            query.hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID ? INFINITY : query.ray.tfar[lane];
}

static int by_value(const void *a, const void *b)
{
    const f32 x = *(const f32 *)a, y = *(const f32 *)b;
    return x < y ? -1 : x > y;
}

/* Statistics of `count` depths, which are sorted. */
static void summarise(f32 *all, u32 count, cs_depth *depth)
{
    u32 hits = 0;
    qsort(all, count, sizeof *all, by_value);
    while (hits < count && isfinite(all[hits]))
        hits++;
    depth->misses = (f32)(count - hits) / (f32)count;
    depth->near = all[0];
    depth->median = hits > 0 ? all[(hits - 1) / 2] : INFINITY;
    depth->far = hits > 0 ? all[hits - 1] : INFINITY;
}

static void depths_of_pixel(const prepass *work, u32 x, u32 y, cs_depth *depth)
{
    cs_ray rays[WIDTH];
    f32 all[CS_MOST_LENS_RAYS] = {0};
    const u32 key = cs_pattern_key(0, y << 16 ^ x, 0);
    for (u32 first = 0; first < work->lens_rays; first += WIDTH) {
        u32 count = 0;
        for (; count < WIDTH && first + count < work->lens_rays; count++) {
            f32 t[CS_DIMENSIONS] = {0};
            cs_draw(&work->pattern, work->rows, key, first + count, 2, t);
            const cs_film_lens p =
                cs_unsheared(t[0], t[1], t[2], t[3], &work->camera->optics, work->optics);
            rays[count] = cs_lens_ray(*work->camera, (f32)x + p.x, (f32)y + p.y, p.u, p.v);
        }
        trace(work->accel, rays, (int)count, all + first);
    }
    if (work->lens_rays > 0) {
        summarise(all, work->lens_rays, depth);
    } else {
        depth->near = depth->median = depth->far = depth->centre;
        depth->misses = isfinite(depth->centre) ? 0.0f : 1.0f;
    }
}

/* Pixels [begin, end) of the window: the centres of WIDTH neighbours at once, then their lenses. */
static void depths_of_range(void *user, size_t begin, size_t end)
{
    const prepass *work = user;
    const size_t width = (size_t)(work->window[1] - work->window[0]);
    for (size_t first = begin; first < end; first += WIDTH) {
        const int count = end - first < WIDTH ? (int)(end - first) : WIDTH;
        cs_ray rays[WIDTH];
        f32 centre[WIDTH];
        u32 x[WIDTH], y[WIDTH];
        for (int i = 0; i < count; i++) {
            x[i] = (u32)work->window[0] + (u32)((first + (size_t)i) % width);
            y[i] = (u32)work->window[2] + (u32)((first + (size_t)i) / width);
            rays[i] = cs_lens_ray(*work->camera, (f32)x[i] + 0.5f, (f32)y[i] + 0.5f, 0.0f, 0.0f);
        }
        trace(work->accel, rays, count, centre);
        for (int i = 0; i < count; i++) {
            cs_depth *depth = &work->depth[first + (size_t)i];
            depth->centre = centre[i];
            depths_of_pixel(work, x[i], y[i], depth);
        }
    }
}

clshear_status cs_accel_depth(const cs_accel *accel, const cs_camera *camera, const f32 *optics,
                              const int *window, int lens_rays, cs_depth *depth, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array rows = {0};
    const size_t count = (size_t)(window[1] - window[0]) * (size_t)(window[3] - window[2]);
    prepass work = {.accel = accel,
                    .camera = camera,
                    .optics = optics,
                    .window = window,
                    .lens_rays = (u32)lens_rays,
                    .depth = depth};
    CS_REQUIRE(lens_rays >= 0 && lens_rays <= CS_MOST_LENS_RAYS, CLSHEAR_BAD_ARGUMENT,
               "%d lens rays for the depth of a pixel: must be 0 to %d", lens_rays,
               CS_MOST_LENS_RAYS);
    if (lens_rays > 0) {
        work.pattern = cs_pattern_of(CS_SAMPLER_SZ, 0, (u32)lens_rays);
        CS_TRY(cs_rows_make(&work.pattern, CS_ORDER_SEQUENCE, &rows, error));
        work.rows = rows.items;
    }
    cs_parallel(accel->threads, count, depths_of_range, &work);
done:
    cs_array_free(&rows);
    return status;
}
