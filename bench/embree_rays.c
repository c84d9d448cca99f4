#include "embree_rays.h"

#include <embree3/rtcore.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/parallel.h"

struct embree_scene {
    RTCDevice device;
    RTCScene scene;
    int threads;
};

embree_scene *embree_scene_create(const cs_scene *source, int high_quality, int threads)
{
    char config[32] = "";
    embree_scene *result = calloc(1, sizeof *result);
    if (result == NULL) abort();
    if (threads > 0) snprintf(config, sizeof config, "threads=%d", threads);
    result->threads = threads;
    result->device = rtcNewDevice(config);
    result->scene = rtcNewScene(result->device);
    rtcSetSceneBuildQuality(result->scene,
                            high_quality ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    RTCGeometry geometry = rtcNewGeometry(result->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               source->positions.items, 0, 12, source->positions.count);
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               source->indices.items, 0, 12, source->indices.count);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(result->scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(result->scene);
    return result;
}

void embree_scene_free(embree_scene *scene)
{
    rtcReleaseScene(scene->scene);
    rtcReleaseDevice(scene->device);
    free(scene);
}

typedef struct batch {
    const embree_scene *scene;
    const ray_planes *rays;
    float *distances;
    int *faces;
} batch;

static struct RTCRay ray_at(const ray_planes *rays, size_t i)
{
    const size_t n = rays->count;
    return (struct RTCRay){.org_x = rays->origins[i],
                           .org_y = rays->origins[n + i],
                           .org_z = rays->origins[2 * n + i],
                           .dir_x = rays->directions[i],
                           .dir_y = rays->directions[n + i],
                           .dir_z = rays->directions[2 * n + i],
                           .tfar = rays->reach[i],
                           .mask = ~0u};
}

static void closest_range(void *user, size_t begin, size_t end)
{
    const batch *work = user;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (size_t i = begin; i < end; i++) {
        struct RTCRayHit query = {.ray = ray_at(work->rays, i),
                                  .hit = {.geomID = RTC_INVALID_GEOMETRY_ID}};
        if (query.ray.tfar > 0.0f) rtcIntersect1(work->scene->scene, &context, &query);
        work->distances[i] = query.ray.tfar;
        work->faces[i] =
            query.hit.geomID == RTC_INVALID_GEOMETRY_ID ? CS_NO_HIT : (int)query.hit.primID;
    }
}

static void blocked_range(void *user, size_t begin, size_t end)
{
    const batch *work = user;
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (size_t i = begin; i < end; i++) {
        struct RTCRay query = ray_at(work->rays, i);
        if (query.tfar > 0.0f) rtcOccluded1(work->scene->scene, &context, &query);
        work->distances[i] = query.tfar < 0.0f ? -1.0f : query.tfar;
    }
}

void embree_closest(const embree_scene *scene, const ray_planes *rays, float *distances, int *faces)
{
    batch work = {scene, rays, distances, faces};
    cs_parallel(scene->threads, rays->count, closest_range, &work);
}

void embree_blocked(const embree_scene *scene, const ray_planes *rays, float *distances)
{
    batch work = {scene, rays, distances, NULL};
    cs_parallel(scene->threads, rays->count, blocked_range, &work);
}
