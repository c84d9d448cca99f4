/* Embree's device and scene. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "accel/embree.h"
#include "base/parallel.h"
#include "clshear/device/lens.h"

static void note_failure(void *user, enum RTCError code, const char *text)
{
    cs_accel *accel = user;
    accel->failed = 1;
    if (accel->error == NULL) return;
    cs_fail(accel->error,
            code == RTC_ERROR_OUT_OF_MEMORY ? CLSHEAR_OUT_OF_MEMORY : CLSHEAR_DEVICE_FAILED,
            "Embree: %s", text);
}

/* Makes Embree's scene. It reads the caller's arrays in place. */
static clshear_status attach_triangles(cs_accel *accel, cs_error *error)
{
    const cs_scene *scene = accel->scene;
    RTCGeometry geometry = rtcNewGeometry(accel->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               scene->positions.items, 0, 3 * sizeof(float),
                               scene->positions.count);
    if (cs_scene_moves(scene)) {
        rtcSetGeometryTimeStepCount(geometry, 2);
        rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 1, RTC_FORMAT_FLOAT3,
                                   scene->positions_to.items, 0, 3 * sizeof(float),
                                   scene->positions.count);
    }
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
