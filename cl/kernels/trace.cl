/* Rays given by the caller, traced by the renderer's own traversal: for tests and benchmarks. */
#include "kernels/kernel.h"
#include "kernels/lanes.h"
#include "kernels/traverse.h"
#include "kernels/wide_walk.h"

#if CS_WALKS_WIDE
/* Rays walk alone in the wide hierarchy, of which nodes and leaves are given, and instead of faces
 * their triangles' places in the array of cs_triangle are found. */
typedef cs_wide_node cs_traced_node;
typedef cs_wide_leaf cs_traced_triangle;
#define CS_TRACED_NODES wide_nodes
#define CS_TRACED_TRIANGLES wide_leaves
#define CS_TRACED_FACE(index) (index)
#define CS_TRACE cs_traverse_alone
#else
typedef cs_node cs_traced_node;
typedef cs_triangle cs_traced_triangle;
#define CS_TRACED_NODES nodes
#define CS_TRACED_TRIANGLES triangles
#define CS_TRACED_FACE(index) (int)triangles[index].face
#define CS_TRACE cs_traverse
#endif

/* One work-item traces CS_PACKET rays. Global size: rays / CS_PACKET; `rays` is a multiple of it.
 *
 * origins, directions: 3 planes of `rays` floats. distances: in, the ray's reach; out, the distance
 * of the nearest hit (its reach if none), or for any hit -1 where something is in the way. hits:
 * out, the face of the nearest hit or CS_NO_HIT; untouched for any hit. */
CS_KERNEL void cs_trace(const uint rays, const int any_hit, __global const float *origins,
                        __global const float *directions, __global float *distances,
                        __global int *hits, __global const cs_traced_node *nodes,
                        __global const cs_traced_triangle *triangles)
{
    size_t first = get_global_id(0) * CS_PACKET;
    if (first >= rays) return;
    cs_scene_buffers scene; /* the others are not looked at */
    scene.CS_TRACED_NODES = nodes;
    scene.CS_TRACED_TRIANGLES = triangles;
    cs_ray ray;
    for (int axis = 0; axis < 3; axis++) {
        ray.origin[axis] =
            *(__global const cs_loose_float *)(origins + (size_t)axis * rays + first);
        ray.direction[axis] =
            *(__global const cs_loose_float *)(directions + (size_t)axis * rays + first);
    }
    cs_hit hit;
    hit.distance = *(__global const cs_loose_float *)(distances + first);
    if (any_hit) {
        CS_TRACE(&scene, &ray, 1, &hit);
    } else {
        CS_TRACE(&scene, &ray, 0, &hit);
        cs_int_lanes index;
        index.all = hit.triangle;
        for (int lane = 0; lane < CS_PACKET; lane++)
            hits[first + (size_t)lane] =
                index.lane[lane] < 0 ? CS_NO_HIT : CS_TRACED_FACE(index.lane[lane]);
    }
    *(__global cs_loose_float *)(distances + first) = hit.distance;
}
