/* Embree's own tracing of rays in planes: what the kernels are compared with. */
#ifndef CS_BENCH_EMBREE_RAYS_H
#define CS_BENCH_EMBREE_RAYS_H

#include <stddef.h>

#include "scene/scene.h"

/* Rays as cl/trace.cl takes them: 3 planes of `count` floats for origins and directions. */
typedef struct ray_planes {
    size_t count;
    float *origins;
    float *directions;
    float *reach;
} ray_planes;

typedef struct embree_scene embree_scene;

/* quality: 0 medium, 1 high (spatial splits). */
embree_scene *embree_scene_create(const cs_scene *scene, int high_quality, int threads);
void embree_scene_free(embree_scene *scene);

/* rtcIntersect1 on every ray: distances (the reach where nothing is hit) and faces (or CS_NO_HIT).
 */
void embree_closest(const embree_scene *scene, const ray_planes *rays, float *distances,
                    int *faces);

/* rtcOccluded1 on every ray: distances become -1 where something is in the way. */
void embree_blocked(const embree_scene *scene, const ray_planes *rays, float *distances);

#endif
