/* Embree's device and scene, and the depth of every pixel. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "accel/embree.h"
#include "base/parallel.h"
#include "lens.h"

static void note_failure(void *user, enum RTCError code, const char *text)
{
    cs_accel *accel = user;
    accel->failed = 1;
    if (accel->error == NULL) return;
    cs_fail(accel->error,
            code == RTC_ERROR_OUT_OF_MEMORY ? CLSHEAR_OUT_OF_MEMORY : CLSHEAR_DEVICE_FAILED,
            "Embree: %s", text);
}

/* The scene as Embree traces it; it reads the caller's arrays in place. */
static clshear_status attach_triangles(cs_accel *accel, cs_error *error)
{
    const cs_scene *scene = accel->scene;
    RTCGeometry geometry = rtcNewGeometry(accel->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               scene->positions.items, 0, 3 * sizeof(float),
                               scene->positions.count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               scene->indices.items, 0, 3 * sizeof(uint32_t), scene->indices.count);
    rtcCommitGeometry(geometry);
    accel->traced = rtcNewScene(accel->device);
    rtcAttachGeometry(accel->traced, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(accel->traced);
    if (accel->failed && error->message[0] == '\0')
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "Embree cannot build its scene");
    return accel->failed ? CLSHEAR_OUT_OF_MEMORY : CLSHEAR_OK;
}

clshear_status cs_accel_create(const cs_scene *scene, int threads, cs_accel **result,
                               cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    char config[64] = "";
    cs_accel *accel = calloc(1, sizeof *accel);
    CS_REQUIRE(accel != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    if (threads > 0) snprintf(config, sizeof config, "threads=%d", threads);
    error->message[0] = '\0';
    accel->scene = scene;
    accel->threads = threads;
    accel->error = error;
    accel->device = rtcNewDevice(config);
    CS_REQUIRE(accel->device != NULL, CLSHEAR_DEVICE_FAILED, "Embree cannot be started");
    rtcSetDeviceErrorFunction(accel->device, note_failure, accel);
    CS_TRY(attach_triangles(accel, error));
    accel->error = NULL;
    *result = accel;
    accel = NULL;
done:
    cs_accel_free(accel);
    return status;
}

void cs_accel_free(cs_accel *accel)
{
    if (accel == NULL) return;
    if (accel->traced != NULL) rtcReleaseScene(accel->traced);
    if (accel->device != NULL) rtcReleaseDevice(accel->device);
    free(accel);
}

typedef struct prepass {
    const cs_accel *accel;
    const cs_camera *camera;
    const int *window;
    float *depth;
} prepass;

static float depth_along(RTCScene traced, const cs_ray *ray)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    struct RTCRayHit query = {
        .ray = {.org_x = ray->origin[0],
                .org_y = ray->origin[1],
                .org_z = ray->origin[2],
                .dir_x = ray->direction[0],
                .dir_y = ray->direction[1],
                .dir_z = ray->direction[2],
                .tfar = INFINITY,
                .mask = ~0u},
        .hit = {.geomID = RTC_INVALID_GEOMETRY_ID},
    };
    rtcIntersect1(traced, &context, &query);
    return query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? INFINITY : query.ray.tfar;
}

static void depth_of_range(void *user, size_t begin, size_t end)
{
    const prepass *work = user;
    const size_t width = (size_t)(work->window[1] - work->window[0]);
    for (size_t i = begin; i < end; i++) {
        const size_t column = (size_t)work->window[0] + i % width;
        const size_t row = (size_t)work->window[2] + i / width;
        float x = (float)column + 0.5f, y = (float)row + 0.5f;
        cs_ray ray = cs_lens_ray(*work->camera, x, y, 0.0f, 0.0f);
        work->depth[i] = depth_along(work->accel->traced, &ray);
    }
}

void cs_accel_depth(const cs_accel *accel, const cs_camera *camera, const int *window, float *depth)
{
    prepass work = {accel, camera, window, depth};
    size_t count = (size_t)(window[1] - window[0]) * (size_t)(window[3] - window[2]);
    cs_parallel(accel->threads, count, depth_of_range, &work);
}
