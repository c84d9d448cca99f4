/* Point sets: drawing, shearing and projection. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "clshear/device/motion.h"
#include "clshear/device/sampler/time.h"
#include "clshear/device/shear.h"
#include "optics/optics.h"
#include "optics/shear_mode.h"
#include "pattern/pattern.h"
#include "points/points.h"

clshear_status cs_points_reserve(clshear_points *points, cs_error *error)
{
    const size_t most = (size_t)1 << 31;
    const size_t dimensions = points->dimensions, count = points->count, sets = points->sets;
    if (count == 0 || sets == 0 || count > most / dimensions || sets > most / (count * dimensions))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%zu sets of %zu points: must be 1 or more, and together less than 2^31 "
                       "coordinates",
                       sets, count);
    points->values = malloc(sets * count * dimensions * sizeof *points->values);
    if (points->values == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu sets of %zu points",
                       sets, count);
    return CLSHEAR_OK;
}

clshear_status cs_points_take(const float *values, size_t sets, size_t count, const char *names,
                              clshear_points *points)
{
    cs_error *error = cs_thread_error();
    const size_t dimensions = strlen(names);
    if (dimensions < 1 || dimensions > sizeof CS_POINT_NAMES - 1 ||
        strspn(names, CS_POINT_NAMES) != dimensions)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "points of coordinates \"%s\": must be 1 to 7 letters out of %s", names,
                       CS_POINT_NAMES);
    points->sets = sets;
    points->count = count;
    points->dimensions = dimensions;
    memcpy(points->names, names, dimensions + 1);
    clshear_status status = cs_points_reserve(points, error);
    if (status == CLSHEAR_OK)
        memcpy(points->values, values, sets * count * dimensions * sizeof *values);
    return status;
}

typedef struct draw_job {
    cs_pattern pattern;
    const cs_u32 *table;
    cs_u32 seed;
    clshear_points *points;
} draw_job;

/* Coordinates of a tuple with a time. */
#define TIMED_NAMES "xyuvt"
enum {
    TIMED = sizeof TIMED_NAMES - 1
};

/* As the kernels draw them where nothing lights with an area. */
static void draw_timed(const draw_job *job, cs_u32 key, cs_u32 index, float *point)
{
    cs_f32 tuple[CS_MAIN_DIMENSIONS] = {0.0f};
    cs_draw(&job->pattern, job->table, key, index, tuple);
    cs_camera_sample place = {tuple[CS_AT_FILM], tuple[CS_END_FILM], tuple[CS_AT_LENS],
                              tuple[CS_END_LENS]};
    point[4] = cs_draw_time(&job->pattern, job->table, key, index, 0, &place);
    point[0] = place.x;
    point[1] = place.y;
    point[2] = place.u;
    point[3] = place.v;
}

static void draw_sets(void *user, size_t begin, size_t end)
{
    const draw_job *job = user;
    const size_t count = job->points->count;
    for (size_t set = begin; set < end; set++) {
        const cs_u32 key = cs_pattern_key(job->seed, (cs_u32)set, 0);
        float *point = job->points->values + set * count * job->points->dimensions;
        for (size_t i = 0; i < count; i++, point += job->points->dimensions)
            if (job->points->dimensions == TIMED)
                draw_timed(job, key, (cs_u32)i, point);
            else
                cs_draw_all(&job->pattern, job->table, key, (cs_u32)i, point);
    }
}

clshear_status cs_points_draw(const char *name, size_t wanted, size_t sets, uint32_t seed,
                              int fresh, int moving, clshear_points *points)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    cs_array table = {0};
    cs_u32 sampler;
    CS_TRY(cs_sampler_find(name, &sampler, error));
    const cs_u32 most = cs_sampler_most(sampler);
    CS_REQUIRE(wanted >= 1 && wanted <= most, CLSHEAR_BAD_ARGUMENT,
               "%zu points of sampler %s: must be 1 to %u", wanted, cs_sampler_name(sampler), most);
    const cs_u32 count = cs_sampler_count(sampler, (cs_u32)wanted);
    clshear_points made = {
        .sets = sets, .count = count, .dimensions = CS_DIMENSIONS, .names = CS_DIMENSION_NAMES};
    if (moving) {
        made.dimensions = TIMED;
        memcpy(made.names, TIMED_NAMES, sizeof TIMED_NAMES);
    }
    draw_job job = {.pattern = cs_pattern_of(sampler, 0, count), .seed = seed, .points = &made};
    if (fresh) cs_pattern_refresh(&job.pattern, seed);
    CS_TRY(cs_sample_table_make(&job.pattern, CS_ORDER_SEQUENCE, &table, error));
    CS_TRY(cs_points_reserve(&made, error));
    job.table = table.items;
    cs_parallel(0, sets, draw_sets, &job);
    *points = made;
done:
    cs_array_free(&table);
    return status;
}

/* Writes a sheared point over the tuple it was made from. */
static void put(const cs_camera_sample *sheared, float *point)
{
    const float place[CS_MAIN_DIMENSIONS] = {sheared->x, sheared->y, sheared->u + 0.5f,
                                             sheared->v + 0.5f};
    for (int d = 0; d < CS_MAIN_DIMENSIONS; d++)
        point[d] = cs_clamp(place[d], 0.0f, 0.99999994f);
}

/* The optics of a square aperture and a box, for points that begin with the coordinates `names`. */
static clshear_status begin_shear(const clshear_points *points, const char *names,
                                  clshear_shear shear, float shear_px, cs_optics_tables *optics)
{
    cs_error *error = cs_thread_error();
    const cs_view square = {.aperture = CLSHEAR_APERTURE_SQUARE};
    if (strncmp(points->names, names, strlen(names)) != 0)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "points of %s cannot be sheared: they must begin with %s", points->names,
                       names);
    if (!isfinite(shear_px) || (cs_u32)shear > CLSHEAR_SHEAR_EQUAL_AREA)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "shear %d by %g pixels is not possible",
                       (int)shear, (double)shear_px);
    return cs_optics_make(&square, CLSHEAR_FILTER_BOX, 0.0f, optics, error);
}

clshear_status cs_points_shear(clshear_points *points, clshear_shear shear, float shear_px)
{
    cs_optics_tables optics = {0};
    const clshear_status status = begin_shear(points, "xyuv", shear, shear_px, &optics);
    if (status != CLSHEAR_OK) return status;
    for (size_t i = 0; i < points->sets * points->count; i++) {
        float *p = points->values + i * points->dimensions;
        const cs_camera_sample sheared = cs_shear(p[0], p[1], p[2], p[3], cs_shear_mode(shear),
                                                  &optics.optics, optics.table.items, shear_px);
        put(&sheared, p);
    }
    cs_optics_free(&optics);
    return CLSHEAR_OK;
}

clshear_status cs_points_shear_moving(clshear_points *points, clshear_shear shear, float shear_px,
                                      cs_velocity velocity_px)
{
    cs_optics_tables optics = {0};
    if (!isfinite(velocity_px.x) || !isfinite(velocity_px.y) || shear == CLSHEAR_SHEAR_TOROIDAL)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,
                       "velocity %g,%g with shear %d: must be finite, and the shear equal-area or "
                       "none",
                       (double)velocity_px.x, (double)velocity_px.y, (int)shear);
    const clshear_status status = begin_shear(points, TIMED_NAMES, shear, shear_px, &optics);
    if (status != CLSHEAR_OK) return status;
    for (size_t i = 0; i < points->sets * points->count; i++) {
        float *p = points->values + i * points->dimensions;
        const cs_camera_sample tuple = {p[0], p[1], p[2], p[3]};
        const cs_moving_sample sheared =
            cs_shear_moving(tuple, p[4], cs_shear_mode(shear), &optics.optics, optics.table.items,
                            shear_px, velocity_px);
        put(&sheared.point, p);
        p[4] = cs_clamp(sheared.time, 0.0f, 0.99999994f);
    }
    cs_optics_free(&optics);
    return CLSHEAR_OK;
}

clshear_status cs_points_select(clshear_points *points, const char *names)
{
    size_t from[sizeof points->names], kept = 0;
    for (; names[kept] != '\0'; kept++) {
        const char *found = strchr(points->names, names[kept]);
        if (found == NULL || kept == points->dimensions ||
            strchr(names, names[kept]) < names + kept)
            return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,
                           "coordinates \"%s\": must be different ones of \"%s\"", names,
                           points->names);
        from[kept] = (size_t)(found - points->names);
    }
    if (kept == 0) return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "no coordinates chosen");
    for (size_t i = 0; i < points->sets * points->count; i++) {
        float point[sizeof points->names];
        memcpy(point, points->values + i * points->dimensions, points->dimensions * sizeof *point);
        for (size_t d = 0; d < kept;
             d++) /* kept <= dimensions, so no unread point is overwritten */
            points->values[i * kept + d] = point[from[d]];
    }
    memset(points->names, 0, sizeof points->names);
    memcpy(points->names, names, kept);
    points->dimensions = kept;
    return CLSHEAR_OK;
}

void cs_points_free(clshear_points *points)
{
    if (points == NULL) return;
    free(points->values);
    *points = (clshear_points){0};
}
