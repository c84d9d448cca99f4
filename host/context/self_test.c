#include "context/self_test.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/cache_folder.h"
#include "base/checksum.h"
#include "base/output_file.h"
#include "clshear/device/hash.h"
#include "clshear/device/shear.h"
#include "kernels/launch.h"
#include "optics/optics.h"
#include "optics/shear_mode.h"
#include "pattern/pattern.h"

enum {
    SAMPLES = 64,
    RAYS = 64,
    TRIANGLES = 2 * CS_MAX_LEAF,
    PATH_SIZE = 4096
};

static const char remedy[] = "update its driver or choose another device; the setting force uses "
                             "it in spite of that";

/* Coordinates are sums and differences of numbers below 2, which devices may round in their way;
 * so may they the quotients in distances. */
static const float point_tolerance = 1e-5f, distance_tolerance = 1e-4f;

/* ------------------------------------------------------------------------------------------------
 * Tuples, equal bit by bit, and their sheared points
 * --------------------------------------------------------------------------------------------- */

static clshear_status draw(clshear_context *context, const cs_launch *launch, const cs_array *table,
                           const cs_array *optics, cs_f32 shear_px, float *points, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_device *device = context->device;
    cs_buffer *rows = NULL, *profiles = NULL, *out = NULL;
    const cs_velocity still = {0.0f, 0.0f};
    const cs_u32 pixel = 0, packet = (cs_u32)cs_device_packet(device);
    const size_t size = SAMPLES * CS_POINT_VALUES * sizeof *points;
    CS_TRY(cs_buffer_create(device, table->count * table->item_size, table->items, &rows, error));
    CS_TRY(cs_buffer_create(device, optics->count * optics->item_size, optics->items, &profiles,
                            error));
    CS_TRY(cs_buffer_create(device, size, NULL, &out, error));
    const cs_argument arguments[] = {{.value = launch, .size = sizeof *launch},
                                     {.value = &pixel, .size = sizeof pixel},
                                     {.value = &shear_px, .size = sizeof shear_px},
                                     {.value = &still, .size = sizeof still},
                                     {.buffer = rows},
                                     {.buffer = profiles},
                                     {.buffer = out}};
    CS_TRY(CS_RUN(device, POINTS, (SAMPLES + packet - 1) / packet, arguments, error));
    CS_TRY(cs_buffer_read(out, 0, size, points, error));
done:
    cs_buffer_free(rows);
    cs_buffer_free(profiles);
    cs_buffer_free(out);
    return status;
}

static clshear_status compare_points(const cs_launch *launch, const cs_array *table,
                                     const cs_array *optics, cs_f32 shear_px, const float *points,
                                     cs_error *error)
{
    const cs_u32 key = cs_pattern_key(launch->seed, 0, launch->replicate);
    for (cs_u32 i = 0; i < SAMPLES; i++) {
        const float *given = points + (size_t)CS_POINT_VALUES * i;
        cs_f32 tuple[CS_DIMENSIONS] = {0};
        cs_draw_all(&launch->pattern, table->items, key, i, tuple);
        for (cs_u32 d = 0; d < CS_DIMENSIONS; d++)
            if (!(given[d] == tuple[d]))
                return cs_fail(error, CLSHEAR_DEVICE_FAILED,
                               "coordinate %u of sample %u of %s is %.9g, not %.9g", d, i,
                               cs_sampler_name(launch->pattern.sampler), (double)given[d],
                               (double)tuple[d]);
        const cs_camera_sample p =
            cs_shear(tuple[0], tuple[1], tuple[2], tuple[3], launch->shear_mode,
                     &launch->camera.optics, optics->items, shear_px);
        const float wanted[CS_MAIN_DIMENSIONS] = {p.x, p.y, p.u, p.v};
        for (cs_u32 d = 0; d < CS_MAIN_DIMENSIONS; d++)
            if (!(fabsf(given[CS_DIMENSIONS + d] - wanted[d]) <= point_tolerance))
                return cs_fail(error, CLSHEAR_DEVICE_FAILED,
                               "sheared coordinate %u of sample %u is %.9g, not %.9g", d, i,
                               (double)given[CS_DIMENSIONS + d], (double)wanted[d]);
    }
    return CLSHEAR_OK;
}

static clshear_status test_sampler(clshear_context *context, const char *name, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_view view = {.aperture = CLSHEAR_APERTURE_DISK, .anamorphic = 1.0f};
    const cs_f32 shear_px = 0.75f;
    cs_optics_tables optics = {0};
    cs_array table = {0};
    cs_u32 sampler;
    float points[SAMPLES * CS_POINT_VALUES];
    CS_TRY(cs_sampler_find(name, &sampler, error));
    cs_launch launch = {.pattern = cs_pattern_of(sampler, 0, SAMPLES),
                        .seed = 1,
                        .replicate = 2,
                        .shear_mode = cs_shear_mode(CLSHEAR_SHEAR_EQUAL_AREA)};
    CS_TRY(cs_optics_make(&view, CLSHEAR_FILTER_BOX, 0.0f, &optics, error));
    CS_TRY(cs_sample_table_make(&launch.pattern, CS_ORDER_COHERENT, &table, error));
    launch.camera.optics = optics.optics;
    CS_TRY(draw(context, &launch, &table, &optics.table, shear_px, points, error));
    CS_TRY(compare_points(&launch, &table, &optics.table, shear_px, points, error));
done:
    cs_optics_free(&optics);
    cs_array_free(&table);
    return status;
}

/* ------------------------------------------------------------------------------------------------
 * A bundle of rays in a heap of triangles
 * --------------------------------------------------------------------------------------------- */

typedef struct bundle {
    cs_node node; /* its children are two leaves */
    cs_triangle triangles[TRIANGLES];
    float origins[3][RAYS];
    float directions[3][RAYS];
    float distances[RAYS]; /* -1: too near to an edge to be sure */
    cs_i32 faces[RAYS];
} bundle;

static float uniform(cs_u32 a, cs_u32 b)
{
    return (cs_f32)(cs_key(a, b) >> 8) * (1.0f / 16777216.0f);
}

/* Triangles in the unit cube, the first half in its lower part. */
static void make_heap(bundle *made)
{
    made->node = (cs_node){.child = {CS_LEAF | (CS_MAX_LEAF - 1) << CS_LEAF_SHIFT,
                                     CS_LEAF | (CS_MAX_LEAF - 1) << CS_LEAF_SHIFT | CS_MAX_LEAF}};
    for (int side = 0; side < 2; side++)
        for (int axis = 0; axis < 3; axis++) {
            made->node.bounds[side][axis][0] = axis == 0 ? 0.5f * (float)side : 0.0f;
            made->node.bounds[side][axis][1] = axis == 0 ? 0.5f * (float)(side + 1) : 1.0f;
        }
    for (cs_u32 i = 0; i < TRIANGLES; i++) {
        cs_triangle *triangle = &made->triangles[i];
        float corners[3][3];
        for (cs_u32 c = 0; c < 3; c++)
            for (cs_u32 axis = 0; axis < 3; axis++) {
                corners[c][axis] = uniform(i, 3 * c + axis);
                if (axis == 0)
                    corners[c][0] = 0.5f * (corners[c][0] + (i < CS_MAX_LEAF ? 0.0f : 1.0f));
            }
        for (int axis = 0; axis < 3; axis++) {
            triangle->corner[axis] = corners[0][axis];
            triangle->edge1[axis] = corners[1][axis] - corners[0][axis];
            triangle->edge2[axis] = corners[2][axis] - corners[0][axis];
        }
        for (int axis = 0; axis < 3; axis++) {
            const int j = (axis + 1) % 3, k = (axis + 2) % 3;
            triangle->normal[axis] =
                triangle->edge1[j] * triangle->edge2[k] - triangle->edge1[k] * triangle->edge2[j];
        }
        triangle->face = i;
    }
}

static double dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Distance of a ray to a triangle's plane, and how far inside the triangle it is, in barycentric
 * coordinates; below 0: outside. */
static double meet(const cs_triangle *triangle, const double *origin, const double *direction,
                   double *inside)
{
    double to[3], e1[3], e2[3], n[3], q[3];
    for (int axis = 0; axis < 3; axis++) {
        to[axis] = (double)triangle->corner[axis] - origin[axis];
        e1[axis] = (double)triangle->edge1[axis];
        e2[axis] = (double)triangle->edge2[axis];
    }
    for (int axis = 0; axis < 3; axis++) {
        const int j = (axis + 1) % 3, k = (axis + 2) % 3;
        n[axis] = e1[j] * e2[k] - e1[k] * e2[j];
        q[axis] = to[j] * direction[k] - to[k] * direction[j];
    }
    const double along = dot(n, direction), u = dot(q, e2) / along, v = -dot(q, e1) / along;
    *inside = fmin(fmin(u, v), 1.0 - u - v);
    return dot(n, to) / along;
}

/* Rays from below the cube to points in it, and what they meet, in double precision. */
static void make_rays(bundle *made)
{
    const double margin = 1e-3;
    for (cs_u32 i = 0; i < RAYS; i++) {
        double origin[3], direction[3], nearest = 10.0;
        int is_sure = 1;
        for (cs_u32 axis = 0; axis < 3; axis++) {
            made->origins[axis][i] = axis == 2 ? -1.0f : uniform(1000 + i, axis);
            made->directions[axis][i] = uniform(1000 + i, 3 + axis) - made->origins[axis][i];
            origin[axis] = (double)made->origins[axis][i];
            direction[axis] = (double)made->directions[axis][i];
        }
        made->faces[i] = CS_NO_HIT;
        for (int k = 0; k < TRIANGLES; k++) {
            double inside;
            const double distance = meet(&made->triangles[k], origin, direction, &inside);
            is_sure &= fabs(inside) > margin;
            if (inside < 0.0 || distance <= 0.0 || distance >= nearest) continue;
            nearest = distance;
            made->faces[i] = k;
        }
        made->distances[i] = is_sure ? (float)nearest : -1.0f;
    }
}

static clshear_status trace(clshear_context *context, const bundle *made, float *distances,
                            cs_i32 *faces, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_device *device = context->device;
    cs_buffer *buffers[6] = {0};
    const cs_u32 rays = RAYS, packet = (cs_u32)cs_device_packet(device);
    const cs_i32 any_hit = 0;
    const void *sources[6] = {made->origins, made->directions, distances,
                              NULL,          &made->node,      made->triangles};
    const size_t sizes[6] = {sizeof made->origins, sizeof made->directions, sizeof made->distances,
                             sizeof made->faces,   sizeof made->node,       sizeof made->triangles};
    cs_argument arguments[CS_ARGUMENTS_TRACE] = {{.value = &rays, .size = sizeof rays},
                                                 {.value = &any_hit, .size = sizeof any_hit}};
    for (int i = 0; i < 6; i++) {
        CS_TRY(cs_buffer_create(device, sizes[i], sources[i], &buffers[i], error));
        arguments[2 + i].buffer = buffers[i];
    }
    CS_TRY(CS_RUN(device, TRACE, RAYS / packet, arguments, error));
    CS_TRY(cs_buffer_read(buffers[2], 0, sizes[2], distances, error));
    CS_TRY(cs_buffer_read(buffers[3], 0, sizes[3], faces, error));
done:
    for (int i = 0; i < 6; i++)
        cs_buffer_free(buffers[i]);
    return status;
}

static clshear_status test_bundle(clshear_context *context, cs_error *error)
{
    bundle made;
    float distances[RAYS];
    cs_i32 faces[RAYS];
    make_heap(&made);
    make_rays(&made);
    for (int i = 0; i < RAYS; i++)
        distances[i] = 10.0f;
    const clshear_status status = trace(context, &made, distances, faces, error);
    if (status != CLSHEAR_OK) return status;
    for (int i = 0; i < RAYS; i++) {
        if (made.distances[i] < 0.0f) continue;
        if (faces[i] != made.faces[i] ||
            !(fabsf(distances[i] - made.distances[i]) <= distance_tolerance * made.distances[i]))
            return cs_fail(error, CLSHEAR_DEVICE_FAILED,
                           "ray %d meets triangle %d at %.9g, not %d at %.9g", i, faces[i],
                           (double)distances[i], made.faces[i], (double)made.distances[i]);
    }
    return CLSHEAR_OK;
}

/* ------------------------------------------------------------------------------------------------
 * What is known of the device
 * --------------------------------------------------------------------------------------------- */

/* The file that says that the device has passed; returns 0 if there is no place for it. */
static int path_of_pass(const clshear_context *context, char *path)
{
    char folder[PATH_SIZE];
    const char *const words[] = {cs_device_name(context->device), cs_device_driver(context->device),
                                 cs_device_source(), cs_device_kernels()};
    uint64_t sum = CS_CHECKSUM_OF_NOTHING ^ (uint64_t)cs_device_packet(context->device);
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        sum = cs_checksum_add(sum, words[i], strlen(words[i]));
    if (!cs_cache_folder("clshear/devices", folder, sizeof folder)) return 0;
    return snprintf(path, PATH_SIZE, "%s/%016llx", folder, (unsigned long long)sum) < PATH_SIZE;
}

/* Without a place to write, the device is tested again next time. */
static void keep_pass(const clshear_context *context, const char *path)
{
    char folder[PATH_SIZE];
    cs_output_file file;
    if (!cs_cache_folder("clshear/devices", folder, sizeof folder)) return;
    if (cs_make_folders(folder) != 0 || cs_output_open(path, &file) != 0) return;
    fprintf(file.stream, "%s, driver %s, packets of %d: passed\n", cs_device_name(context->device),
            cs_device_driver(context->device), cs_device_packet(context->device));
    cs_output_end(&file, 1);
}

clshear_status cs_self_test(clshear_context *context, cs_error *error)
{
    char path[PATH_SIZE];
    cs_error found;
    if (atomic_load(&context->is_tested)) return CLSHEAR_OK;
    const int has_place = path_of_pass(context, path);
    if (has_place && access(path, F_OK) == 0) {
        atomic_store(&context->is_tested, 1);
        return CLSHEAR_OK;
    }
    clshear_status status = test_sampler(context, NULL, &found);
    if (status == CLSHEAR_OK) status = test_sampler(context, "sobol", &found);
    if (status == CLSHEAR_OK) status = test_bundle(context, &found);
    if (status == CLSHEAR_OK && has_place) keep_pass(context, path);
    if (status != CLSHEAR_OK && !context->is_forced)
        return cs_fail(error, status, "%s fails its test: %s; %s", cs_device_name(context->device),
                       found.message, remedy);
    if (status != CLSHEAR_OK)
        cs_warn(&context->log, "%s fails its test: %s", cs_device_name(context->device),
                found.message);
    atomic_store(&context->is_tested, 1);
    return CLSHEAR_OK;
}
