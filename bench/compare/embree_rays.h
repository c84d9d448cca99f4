/* Embree's own tracing, ray by ray or many at once: what the kernels are compared with. */
#ifndef CS_BENCH_EMBREE_RAYS_H
#define CS_BENCH_EMBREE_RAYS_H

#include <stddef.h>

#include "scene/scene.h"

/* Rays as cl/trace.cl takes them: 3 planes of `count` floats for origins and directions. */
typedef struct ray_planes {
    size_t count;
    float *origins;
    float *directions;
    float *reach; /* above 0, or the ray is left out */
} ray_planes;

/* How many rays a call of Embree traces: one (coherent), packets of 8 or 16 (coherent), or a stream
 * of 64 single ones (rtcIntersect1M, incoherent as its fastest). */
typedef enum embree_mode {
    EMBREE_ONE,
    EMBREE_EIGHT,
    EMBREE_SIXTEEN,
    EMBREE_STREAM,
    EMBREE_MODES
} embree_mode;

const char *embree_mode_name(embree_mode mode);

typedef struct embree_scene embree_scene;

/* quality: 0 medium, 1 high (spatial splits). */
embree_scene *embree_scene_create(const cs_scene *scene, int high_quality, int threads);
void embree_scene_free(embree_scene *scene);

enum {
    EMBREE_BATCH = 64 /* rays that a batch has room for */
};

/* Rays of a batch, and what they hit. */
typedef struct embree_batch {
    float origin[3][EMBREE_BATCH];
    float direction[3][EMBREE_BATCH];
    float reach[EMBREE_BATCH];     /* in: not above 0, or left out; out: distance, or below 0 */
    float normal[3][EMBREE_BATCH]; /* of the triangle, of any length */
    int face[EMBREE_BATCH];        /* CS_NO_HIT for none */
} embree_batch;

/* Nearest hits of the first `count` rays. */
void embree_closest(const embree_scene *scene, embree_mode mode, embree_batch *batch, int count);

/* Reaches become below 0 where something is in the way. */
void embree_blocked(const embree_scene *scene, embree_mode mode, embree_batch *batch, int count);

/* All rays of the planes on the scene's threads: distances (the reach where nothing is hit, -1
 * where something blocks) and, but for `any_hit`, faces. */
void embree_trace(const embree_scene *scene, embree_mode mode, int any_hit, const ray_planes *rays,
                  float *distances, int *faces);

/* The frame that cl/render.cl renders of these rays, `spp` of each pixel: albedo 0.7, one point
 * light of the given intensity, mean and variance of what arrives. radiance: 2 floats a pixel. */
void embree_frame(const embree_scene *scene, embree_mode mode, const ray_planes *rays, size_t spp,
                  const float *light, float intensity, float *radiance);

#endif
