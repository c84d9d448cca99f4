#include "embree_rays.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/parallel.h"

struct embree_scene {
    RTCDevice device;
    RTCScene scene;
    int threads;
};

const char *embree_mode_name(embree_mode mode)
{
    static const char *const names[EMBREE_MODES] = {"1", "8", "16", "stream"};
    return names[mode];
}

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

static struct RTCIntersectContext context_of(embree_mode mode)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = mode == EMBREE_STREAM ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT
                                          : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

/* Fills an Embree packet from the batch. Lanes from `count` on are off. */
#define FILL_PACKET(packet, valid, width, first)                                \
    for (int i = 0; i < (width); i++) {                                         \
        const int from = (first) + i < count ? (first) + i : 0;                 \
        (packet).org_x[i] = batch->origin[0][from];                             \
        (packet).org_y[i] = batch->origin[1][from];                             \
        (packet).org_z[i] = batch->origin[2][from];                             \
        (packet).dir_x[i] = batch->direction[0][from];                          \
        (packet).dir_y[i] = batch->direction[1][from];                          \
        (packet).dir_z[i] = batch->direction[2][from];                          \
        (packet).tnear[i] = 0.0f;                                               \
        (packet).time[i] = 0.0f;                                                \
        (packet).mask[i] = ~0u;                                                 \
        (packet).id[i] = 0u;                                                    \
        (packet).flags[i] = 0u;                                                 \
        (packet).tfar[i] = batch->reach[from];                                  \
        (valid)[i] = (first) + i < count && batch->reach[from] > 0.0f ? -1 : 0; \
    }

#define CLOSEST_PACKETS(width)                                                      \
    for (int first = 0; first < count; first += (width)) {                          \
        struct RTCRayHit##width query;                                              \
        int valid[width] __attribute__((aligned(64)));                              \
        FILL_PACKET(query.ray, valid, width, first)                                 \
        for (int i = 0; i < (width); i++)                                           \
            query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;                          \
        rtcIntersect##width(valid, scene->scene, &context, &query);                 \
        for (int i = 0; i < (width) && first + i < count; i++) {                    \
            batch->reach[first + i] = query.ray.tfar[i];                            \
            batch->normal[0][first + i] = query.hit.Ng_x[i];                        \
            batch->normal[1][first + i] = query.hit.Ng_y[i];                        \
            batch->normal[2][first + i] = query.hit.Ng_z[i];                        \
            batch->face[first + i] = query.hit.geomID[i] == RTC_INVALID_GEOMETRY_ID \
                                         ? CS_NO_HIT                                \
                                         : (int)query.hit.primID[i];                \
        }                                                                           \
    }

#define BLOCKED_PACKETS(width)                                     \
    for (int first = 0; first < count; first += (width)) {         \
        struct RTCRay##width query;                                \
        int valid[width] __attribute__((aligned(64)));             \
        FILL_PACKET(query, valid, width, first)                    \
        rtcOccluded##width(valid, scene->scene, &context, &query); \
        for (int i = 0; i < (width) && first + i < count; i++)     \
            if (valid[i]) batch->reach[first + i] = query.tfar[i]; \
    }

static struct RTCRay single(const embree_batch *batch, int i)
{
    return (struct RTCRay){.org_x = batch->origin[0][i],
                           .org_y = batch->origin[1][i],
                           .org_z = batch->origin[2][i],
                           .dir_x = batch->direction[0][i],
                           .dir_y = batch->direction[1][i],
                           .dir_z = batch->direction[2][i],
                           .tfar = batch->reach[i] > 0.0f ? batch->reach[i] : -1.0f,
                           .mask = ~0u};
}

/* Traces rays one by one, or as a stream. */
static void closest_singles(const embree_scene *scene, embree_mode mode,
                            struct RTCIntersectContext *context, embree_batch *batch, int count)
{
    struct RTCRayHit queries[EMBREE_BATCH];
    for (int i = 0; i < count; i++) {
        queries[i].ray = single(batch, i);
        queries[i].hit.geomID = RTC_INVALID_GEOMETRY_ID;
        queries[i].hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        if (mode == EMBREE_ONE && batch->reach[i] > 0.0f)
            rtcIntersect1(scene->scene, context, &queries[i]);
    }
    if (mode == EMBREE_STREAM)
        rtcIntersect1M(scene->scene, context, queries, (unsigned)count, sizeof *queries);
    for (int i = 0; i < count; i++) {
        const struct RTCHit *hit = &queries[i].hit;
        const int missed = hit->geomID == RTC_INVALID_GEOMETRY_ID;
        batch->reach[i] = queries[i].ray.tfar;
        batch->normal[0][i] = missed ? 0.0f : hit->Ng_x;
        batch->normal[1][i] = missed ? 0.0f : hit->Ng_y;
        batch->normal[2][i] = missed ? 0.0f : hit->Ng_z;
        batch->face[i] = missed ? CS_NO_HIT : (int)hit->primID;
    }
}

static void blocked_singles(const embree_scene *scene, embree_mode mode,
                            struct RTCIntersectContext *context, embree_batch *batch, int count)
{
    struct RTCRay queries[EMBREE_BATCH];
    for (int i = 0; i < count; i++) {
        queries[i] = single(batch, i);
        if (mode == EMBREE_ONE && batch->reach[i] > 0.0f)
            rtcOccluded1(scene->scene, context, &queries[i]);
    }
    if (mode == EMBREE_STREAM)
        rtcOccluded1M(scene->scene, context, queries, (unsigned)count, sizeof *queries);
    for (int i = 0; i < count; i++)
        if (batch->reach[i] > 0.0f) batch->reach[i] = queries[i].tfar;
}

void embree_closest(const embree_scene *scene, embree_mode mode, embree_batch *batch, int count)
{
    struct RTCIntersectContext context = context_of(mode);
    if (mode == EMBREE_EIGHT) {
        CLOSEST_PACKETS(8)
    } else if (mode == EMBREE_SIXTEEN) {
        CLOSEST_PACKETS(16)
    } else {
        closest_singles(scene, mode, &context, batch, count);
    }
}

void embree_blocked(const embree_scene *scene, embree_mode mode, embree_batch *batch, int count)
{
    struct RTCIntersectContext context = context_of(mode);
    if (mode == EMBREE_EIGHT) {
        BLOCKED_PACKETS(8)
    } else if (mode == EMBREE_SIXTEEN) {
        BLOCKED_PACKETS(16)
    } else {
        blocked_singles(scene, mode, &context, batch, count);
    }
}

typedef struct tracing {
    const embree_scene *scene;
    embree_mode mode;
    int any_hit;
    const ray_planes *rays;
    float *distances;
    int *faces;
    size_t spp;
    const float *light;
    float intensity;
} tracing;

static int load(const ray_planes *rays, size_t first, size_t end, embree_batch *batch)
{
    const int count = end - first < EMBREE_BATCH ? (int)(end - first) : EMBREE_BATCH;
    for (size_t axis = 0; axis < 3; axis++)
        for (int i = 0; i < count; i++) {
            batch->origin[axis][i] = rays->origins[axis * rays->count + first + (size_t)i];
            batch->direction[axis][i] = rays->directions[axis * rays->count + first + (size_t)i];
        }
    for (int i = 0; i < count; i++)
        batch->reach[i] = rays->reach[first + (size_t)i];
    return count;
}

static void trace_range(void *user, size_t begin, size_t end)
{
    const tracing *work = user;
    embree_batch batch;
    for (size_t first = begin; first < end; first += EMBREE_BATCH) {
        const int count = load(work->rays, first, end, &batch);
        if (work->any_hit)
            embree_blocked(work->scene, work->mode, &batch, count);
        else
            embree_closest(work->scene, work->mode, &batch, count);
        for (int i = 0; i < count; i++) {
            const float reach = batch.reach[i];
            work->distances[first + (size_t)i] = work->any_hit && reach < 0.0f ? -1.0f : reach;
            if (!work->any_hit) work->faces[first + (size_t)i] = batch.face[i];
        }
    }
}

void embree_trace(const embree_scene *scene, embree_mode mode, int any_hit, const ray_planes *rays,
                  float *distances, int *faces)
{
    tracing work = {scene, mode, any_hit, rays, distances, faces, 0, NULL, 0.0f};
    cs_parallel(scene->threads, rays->count, trace_range, &work);
}

/* Replaces hits by shadow rays. `weight` is the radiance of an unblocked ray. */
static void shade(const float *light, float intensity, embree_batch *batch, int count,
                  float *weight)
{
    for (int i = 0; i < count; i++) {
        const float distance = batch->face[i] >= 0 ? batch->reach[i] : 0.0f;
        float point[3], size = distance, cosine = 0.0f, square = 0.0f, length = 1e-30f, side = 0.0f;
        for (int axis = 0; axis < 3; axis++) {
            point[axis] = batch->origin[axis][i] + distance * batch->direction[axis][i];
            size = fmaxf(size, fabsf(point[axis]));
            side += batch->normal[axis][i] * batch->direction[axis][i];
            length += batch->normal[axis][i] * batch->normal[axis][i];
        }
        const float scale = (side > 0.0f ? -1.0f : 1.0f) / sqrtf(length);
        for (int axis = 0; axis < 3; axis++) {
            const float normal = scale * batch->normal[axis][i];
            const float towards = light[axis] - point[axis];
            batch->origin[axis][i] = point[axis] + 3e-5f * size * normal;
            batch->direction[axis][i] = light[axis] - batch->origin[axis][i];
            cosine += normal * towards;
            square += towards * towards;
        }
        const int lit = batch->face[i] >= 0 && cosine > 0.0f;
        weight[i] =
            lit ? 0.7f * 0.318309886f * intensity * cosine / (square * sqrtf(square)) : 0.0f;
        batch->reach[i] = lit ? 1.0f : -1.0f;
    }
}

static void frame_pixels(void *user, size_t begin, size_t end)
{
    const tracing *work = user;
    embree_batch batch;
    float weight[EMBREE_BATCH];
    for (size_t pixel = begin; pixel < end; pixel++) {
        float sum = 0.0f, square = 0.0f;
        const size_t last = (pixel + 1) * work->spp;
        for (size_t first = pixel * work->spp; first < last; first += EMBREE_BATCH) {
            const int count = load(work->rays, first, last, &batch);
            embree_closest(work->scene, work->mode, &batch, count);
            shade(work->light, work->intensity, &batch, count, weight);
            embree_blocked(work->scene, work->mode, &batch, count);
            for (int i = 0; i < count; i++) {
                const float value = batch.reach[i] > 0.0f ? weight[i] : 0.0f;
                sum += value;
                square += value * value;
            }
        }
        work->distances[2 * pixel] = sum / (float)work->spp;
        work->distances[2 * pixel + 1] = square - sum * sum / (float)work->spp;
    }
}

void embree_frame(const embree_scene *scene, embree_mode mode, const ray_planes *rays, size_t spp,
                  const float *light, float intensity, float *radiance)
{
    tracing work = {scene, mode, 0, rays, radiance, NULL, spp, light, intensity};
    cs_parallel(scene->threads, rays->count / spp, frame_pixels, &work);
}
