/* Depths in every pixel, traced by Embree. */
#include <math.h>
#include <stdlib.h>

#include "accel/embree.h"
#include "accel/front.h"
#include "base/parallel.h"
#include "clshear/device/lens.h"
#include "clshear/device/sampler/sampler.h"
#include "clshear/device/shear.h"
#include "kernels/light/shape_distance.h"
#include "pattern/pattern.h"

enum {
    WIDTH = 16, /* rays per call of Embree */
    SETS = 64   /* number of sets of lens rays; each pixel uses one at random */
};

typedef struct prepass {
    const cs_accel *accel;
    const cs_shapes *shapes;
    const cs_camera *camera;
    const int *window;
    const cs_camera_sample *sets; /* SETS sets of `lens_rays` samples */
    cs_u32 lens_rays;
    cs_depth *depth;
} prepass;

/* Sets the lane's ray through the pixel with the upper left corner (x, y). The query's other
 * members are constant. */
static void aim(const cs_camera *camera, cs_f32 x, cs_f32 y, const cs_camera_sample *point,
                int lane, struct RTCRayHit16 *query)
{
    const cs_ray ray = cs_lens_ray(*camera, x + point->x, y + point->y, point->u, point->v);
    query->ray.org_x[lane] = ray.origin[0];
    query->ray.org_y[lane] = ray.origin[1];
    query->ray.org_z[lane] = ray.origin[2];
    query->ray.dir_x[lane] = ray.direction[0];
    query->ray.dir_y[lane] = ray.direction[1];
    query->ray.dir_z[lane] = ray.direction[2];
}

/* The distance to the nearest of the shapes along the lane's ray; infinite where it meets none. */
static cs_f32 shape_ahead(const cs_shapes *shapes, const struct RTCRayHit16 *query, int lane)
{
    const cs_ray ray = {{query->ray.org_x[lane], query->ray.org_y[lane], query->ray.org_z[lane]},
                        {query->ray.dir_x[lane], query->ray.dir_y[lane], query->ray.dir_z[lane]}};
    cs_f32 nearest = INFINITY;
    for (size_t i = 0; i < shapes->count; i++)
        if (cs_is_shape(&shapes->lights[i]))
            nearest = fminf(nearest, cs_shape_distance(&shapes->lights[i], &ray));
    return nearest;
}

/* Traces the first `count` rays. Distances are depths, because directions have a forward component
 * of 1. */
static void trace(const cs_accel *accel, const cs_shapes *shapes, struct RTCRayHit16 *query,
                  int count, cs_f32 *depth)
{
    struct RTCIntersectContext context;
    int valid[WIDTH] __attribute__((aligned(64)));
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (int lane = 0; lane < WIDTH; lane++) {
        valid[lane] = lane < count ? -1 : 0;
        query->ray.tfar[lane] = INFINITY;
        query->hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
        query->hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    rtcIntersect16(valid, accel->traced, &context, query);
    for (int lane = 0; lane < count; lane++)
        depth[lane] =
            query->hit.geomID[lane] == RTC_INVALID_GEOMETRY_ID ? INFINITY : query->ray.tfar[lane];
    for (int lane = 0; lane < count && shapes != NULL; lane++)
        depth[lane] = fminf(depth[lane], shape_ahead(shapes, query, lane));
}

/* Insertion sort: there are usually 16 values, many of them equal. */
static void sort(cs_f32 *values, cs_u32 count)
{
    for (cs_u32 i = 1; i < count; i++) {
        const cs_f32 value = values[i];
        cs_u32 place = i;
        for (; place > 0 && values[place - 1] > value; place--)
            values[place] = values[place - 1];
        values[place] = value;
    }
}

/* Sorts `count` depths and computes their statistics. */
static void summarise(cs_f32 *all, cs_u32 count, cs_depth *depth)
{
    cs_u32 hits = 0;
    sort(all, count);
    while (hits < count && isfinite(all[hits]))
        hits++;
    depth->misses = (cs_f32)(count - hits) / (cs_f32)count;
    depth->near = all[0];
    depth->median = hits > 0 ? all[(hits - 1) / 2] : INFINITY;
    depth->far = hits > 0 ? all[hits - 1] : INFINITY;
}

static void depths_of_pixel(const prepass *work, cs_u32 x, cs_u32 y, struct RTCRayHit16 *query,
                            cs_depth *depth)
{
    cs_f32 all[CS_MOST_LENS_RAYS];
    const cs_u32 set = cs_pattern_key(0, y << 16 ^ x, 0) % SETS;
    const cs_camera_sample *points =
        work->lens_rays > 0 ? work->sets + (size_t)set * work->lens_rays : NULL;
    for (cs_u32 first = 0; first < work->lens_rays; first += WIDTH) {
        const cs_u32 left = work->lens_rays - first, count = left < WIDTH ? left : WIDTH;
        for (cs_u32 lane = 0; lane < count; lane++)
            aim(work->camera, (cs_f32)x, (cs_f32)y, &points[first + lane], (int)lane, query);
        trace(work->accel, work->shapes, query, (int)count, all + first);
    }
    if (work->lens_rays > 0) {
        summarise(all, work->lens_rays, depth);
        depth->front_px =
            cs_front_shear(work->camera, (cs_f32)x + 0.5f, (cs_f32)y + 0.5f, all, work->lens_rays);
    } else {
        depth->near = depth->centre;
        depth->median = depth->centre;
        depth->far = depth->centre;
        depth->misses = isfinite(depth->centre) ? 0.0f : 1.0f;
        depth->front_px = INFINITY;
    }
}

/* Computes pixels [begin, end) of the window: first the centres of WIDTH pixels at once, then the
 * lens rays of each. */
static void depths_of_range(void *user, size_t begin, size_t end)
{
    const prepass *work = user;
    const cs_camera_sample middle = {.x = 0.5f, .y = 0.5f};
    const size_t width = (size_t)(work->window[1] - work->window[0]);
    struct RTCRayHit16 query = {0};
    for (int lane = 0; lane < WIDTH; lane++)
        query.ray.mask[lane] = ~0u, query.ray.time[lane] = 0.5f;
    for (size_t first = begin; first < end; first += WIDTH) {
        const int count = end - first < WIDTH ? (int)(end - first) : WIDTH;
        cs_f32 centre[WIDTH];
        cs_u32 x[WIDTH], y[WIDTH];
        for (int i = 0; i < count; i++) {
            x[i] = (cs_u32)work->window[0] + (cs_u32)((first + (size_t)i) % width);
            y[i] = (cs_u32)work->window[2] + (cs_u32)((first + (size_t)i) / width);
            aim(work->camera, (cs_f32)x[i], (cs_f32)y[i], &middle, i, &query);
        }
        trace(work->accel, work->shapes, &query, count, centre);
        for (int i = 0; i < count; i++) {
            cs_depth *depth = &work->depth[first + (size_t)i];
            depth->centre = centre[i];
            depths_of_pixel(work, x[i], y[i], &query, depth);
        }
    }
}

/* Makes SETS sets of camera samples, each a pattern of `lens_rays` tuples. */
static clshear_status make_sets(const cs_camera *camera, const cs_f32 *optics, cs_u32 lens_rays,
                                cs_camera_sample **sets, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array table = {0};
    const cs_pattern pattern = cs_pattern_of(CS_SAMPLER_SZ, 0, lens_rays);
    CS_TRY(cs_sample_table_make(&pattern, CS_ORDER_SEQUENCE, &table, error));
    *sets = malloc(SETS * lens_rays * sizeof **sets);
    CS_REQUIRE(*sets != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (cs_u32 i = 0; i < SETS * lens_rays; i++) {
        cs_f32 t[CS_DIMENSIONS] = {0};
        cs_draw(&pattern, table.items, cs_pattern_key(0, i / lens_rays, 0), i % lens_rays, t);
        (*sets)[i] = cs_unsheared(t[0], t[1], t[2], t[3], &camera->optics, optics);
    }
done:
    cs_array_free(&table);
    return status;
}

clshear_status cs_accel_depth(const cs_accel *accel, const cs_shapes *shapes,
                              const cs_camera *camera, const cs_f32 *optics, const int *window,
                              int lens_rays, cs_depth *depth, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_camera_sample *sets = NULL;
    const size_t count = (size_t)(window[1] - window[0]) * (size_t)(window[3] - window[2]);
    CS_REQUIRE(lens_rays >= 0 && lens_rays <= CS_MOST_LENS_RAYS, CLSHEAR_BAD_ARGUMENT,
               "%d lens rays for the depth of a pixel: must be 0 to %d", lens_rays,
               CS_MOST_LENS_RAYS);
    if (lens_rays > 0) CS_TRY(make_sets(camera, optics, (cs_u32)lens_rays, &sets, error));
    prepass work = {.accel = accel,
                    .shapes = shapes,
                    .camera = camera,
                    .window = window,
                    .sets = sets,
                    .lens_rays = (cs_u32)lens_rays,
                    .depth = depth};
    cs_parallel(accel->threads, count, depths_of_range, &work);
done:
    free(sets);
    return status;
}
