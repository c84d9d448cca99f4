/* Embree's own tracing, ray by ray or many at once, for comparison with the kernels. */
#ifndef CS_BENCH_EMBREE_RAYS_H
#define CS_BENCH_EMBREE_RAYS_H

#include <stddef.h>

#include "scene/scene.h"

/* Rays in the layout of cl/trace.cl: 3 planes of `count` floats for origins and directions. */
typedef struct ray_planes {
    size_t count;
    float *origins;
    float *directions;
    float *reach; /* length of the ray; rays with 0 or less are left out */
} ray_planes;

/* Rays per call of Embree: one (coherent), packets of 8 or 16 (coherent), or a stream of 64 single
 * rays (rtcIntersect1M, incoherent because it is faster). */
typedef enum embree_mode {
    EMBREE_ONE,
    EMBREE_EIGHT,
    EMBREE_SIXTEEN,
    EMBREE_STREAM,
    EMBREE_MODES
} embree_mode;

const char *embree_mode_name(embree_mode mode);

typedef struct embree_scene embree_scene;

/* Builds a scene of medium quality or, with `high_quality`, of high quality (spatial splits). */
embree_scene *embree_scene_create(const cs_scene *scene, int high_quality, int threads);
void embree_scene_free(embree_scene *scene);

enum {
    EMBREE_BATCH = 64 /* most rays of a batch */
};

/* Rays of a batch and their hits. */
typedef struct embree_batch {
    float origin[3][EMBREE_BATCH];
    float direction[3][EMBREE_BATCH];
    /* In: length, 0 or less if left out. Out: distance, or negative if blocked. */
    float reach[EMBREE_BATCH];
    float normal[3][EMBREE_BATCH]; /* normal of the triangle, not normalised */
    int face[EMBREE_BATCH];        /* index of the face, or CS_NO_HIT */
} embree_batch;

/* Finds the nearest hits of the first `count` rays. */
void embree_closest(const embree_scene *scene, embree_mode mode, embree_batch *batch, int count);

/* Sets `reach` to a negative number for blocked rays. */
void embree_blocked(const embree_scene *scene, embree_mode mode, embree_batch *batch, int count);

/* Traces all rays of the planes on the scene's threads. Computes distances (the length without a
 * hit, -1 if blocked) and, unless `any_hit`, faces. */
void embree_trace(const embree_scene *scene, embree_mode mode, int any_hit, const ray_planes *rays,
                  float *distances, int *faces);

/* Renders the frame of cl/render.cl from these rays, `spp` per pixel: albedo 0.7, one point light
 * of the given intensity. `radiance` receives the mean and variance, 2 floats per pixel. */
void embree_frame(const embree_scene *scene, embree_mode mode, const ray_planes *rays, size_t spp,
                  const float *light, float intensity, float *radiance);

#endif
