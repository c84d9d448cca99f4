/* Point sets: drawing, shearing and projection. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"
#include "clshear/device/sampler/sampler.h"
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
                       "points of coordinates \"%s\": must be 1 to 6 letters out of %s", names,
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

static void draw_sets(void *user, size_t begin, size_t end)
{
    const draw_job *job = user;
    const size_t count = job->points->count;
    for (size_t set = begin; set < end; set++) {
        const cs_u32 key = cs_pattern_key(job->seed, (cs_u32)set, 0);
        for (size_t i = 0; i < count; i++)
            cs_draw_all(&job->pattern, job->table, key, (cs_u32)i,
                        job->points->values + (set * count + i) * CS_DIMENSIONS);
    }
}

clshear_status cs_points_draw(const char *name, size_t wanted, size_t sets, uint32_t seed,
                              int fresh, clshear_points *points)
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

clshear_status cs_points_shear(clshear_points *points, clshear_shear shear, float shear_px)
{
    cs_error *error = cs_thread_error();
    const size_t stride = points->dimensions;
    if (stride < CS_MAIN_DIMENSIONS ||
        strncmp(points->names, CS_DIMENSION_NAMES, CS_MAIN_DIMENSIONS) != 0)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "points of %s cannot be sheared: they must begin with %.*s", points->names,
                       CS_MAIN_DIMENSIONS, CS_DIMENSION_NAMES);
    if (!isfinite(shear_px) || (cs_u32)shear > CLSHEAR_SHEAR_EQUAL_AREA)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "shear %d by %g pixels is not possible",
                       (int)shear, (double)shear_px);
    const cs_view square = {.aperture = CLSHEAR_APERTURE_SQUARE};
    cs_optics_tables optics = {0};
    const clshear_status status = cs_optics_make(&square, CLSHEAR_FILTER_BOX, 0.0f, &optics, error);
    if (status != CLSHEAR_OK) return status;
    for (size_t i = 0; i < points->sets * points->count; i++) {
        float *p = points->values + i * stride;
        const cs_camera_sample sheared = cs_shear(p[0], p[1], p[2], p[3], cs_shear_mode(shear),
                                                  &optics.optics, optics.table.items, shear_px);
        const float place[CS_MAIN_DIMENSIONS] = {sheared.x, sheared.y, sheared.u + 0.5f,
                                                 sheared.v + 0.5f};
        for (int d = 0; d < CS_MAIN_DIMENSIONS; d++)
            p[d] = cs_clamp(place[d], 0.0f, 0.99999994f);
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
