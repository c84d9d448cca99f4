/* Closest hit and any hit of a packet of rays over the flattened binary hierarchy. Device only.
 *
 * The packet walks the tree together, one ray octant after another: within an octant the near and
 * far planes of a box and the near child of a node are the same for all lanes and are picked by
 * scalar bits. */
#ifndef CS_KERNELS_TRAVERSE_H
#define CS_KERNELS_TRAVERSE_H

#include "clshear/device/lens.h"
#include "clshear/device/packet.h"
#include "kernels/shape.h"

/* Whether rays may walk the wide hierarchy. */
#define CS_WALKS_WIDE (CS_HAS(WIDE) && CS_PACKET >= CS_WIDE_LEAST_PACKET)

typedef struct cs_hit {
    cs_vfloat distance; /* in units of the ray's direction */
    cs_vint triangle;   /* index into the array of cs_triangle, or CS_NO_HIT */
} cs_hit;

typedef struct cs_walk {
    cs_vfloat inverse[3]; /* of the direction */
    cs_vfloat offset[3];  /* -origin * inverse: slab tests are one multiply-add a plane */
    cs_vint active;       /* lanes of the octant that is walked */
#if CS_HAS(MOVING)
    CS_GLOBAL const cs_node_step *node_steps;
    CS_GLOBAL const cs_triangle_step *triangle_steps;
    cs_vfloat time;
#endif
} cs_walk;

/* A plane of a box. */
#if CS_HAS(MOVING)
#define CS_PLANE_OF(axis, end) cs_moved(axis[end], axis##_step[end], time)
#else
#define CS_PLANE_OF(axis, end) ((cs_vfloat)(axis[end]))
#endif

/* Distances at which the lanes enter the box of child `side`; lanes that miss it are cleared in
 * `hit`. */
static inline cs_vfloat cs_enter_box(CS_GLOBAL const cs_node *nodes, cs_u32 index, int side,
                                     const cs_walk *walk, const int *negative, cs_vfloat limit,
                                     cs_vint *hit)
{
    CS_GLOBAL const cs_node *node = nodes + index;
    CS_GLOBAL const cs_f32 *x = node->bounds[side][0];
    CS_GLOBAL const cs_f32 *y = node->bounds[side][1];
    CS_GLOBAL const cs_f32 *z = node->bounds[side][2];
#if CS_HAS(MOVING)
    CS_GLOBAL const cs_node_step *step = walk->node_steps + index;
    CS_GLOBAL const cs_f32 *x_step = step->bounds[side][0];
    CS_GLOBAL const cs_f32 *y_step = step->bounds[side][1];
    CS_GLOBAL const cs_f32 *z_step = step->bounds[side][2];
    cs_vfloat time = walk->time;
#endif
    cs_vfloat near_x = fma(CS_PLANE_OF(x, negative[0]), walk->inverse[0], walk->offset[0]);
    cs_vfloat near_y = fma(CS_PLANE_OF(y, negative[1]), walk->inverse[1], walk->offset[1]);
    cs_vfloat near_z = fma(CS_PLANE_OF(z, negative[2]), walk->inverse[2], walk->offset[2]);
    cs_vfloat far_x = fma(CS_PLANE_OF(x, 1 - negative[0]), walk->inverse[0], walk->offset[0]);
    cs_vfloat far_y = fma(CS_PLANE_OF(y, 1 - negative[1]), walk->inverse[1], walk->offset[1]);
    cs_vfloat far_z = fma(CS_PLANE_OF(z, 1 - negative[2]), walk->inverse[2], walk->offset[2]);
    cs_vfloat enter = cs_max(cs_max(near_x, near_y), cs_max(near_z, (cs_vfloat)(0.0f)));
    cs_vfloat leave = cs_min(cs_min(far_x, far_y), cs_min(far_z, limit));
    *hit = enter <= leave;
    return enter;
}

/* Asks for what a node's child refers to, which is wanted once the boxes are tested: 6 to 8 % of
 * the frame with 250 000 triangles and more. */
static inline void cs_prefetch_child(CS_GLOBAL const cs_node *nodes,
                                     CS_GLOBAL const cs_triangle *triangles, cs_u32 child)
{
    cs_u32 first = child & ((1u << CS_LEAF_SHIFT) - 1u);
    CS_PREFETCH(child & CS_LEAF ? (size_t)(triangles + first) : (size_t)(nodes + child));
}

/* Test by scaled barycentrics (Möller & Trumbore 1997 with a stored normal). */
static inline void cs_hit_triangle(cs_shape_pointer triangle, cs_i32 index, const cs_ray *ray,
                                   cs_vint active, const int any_hit, cs_hit *hit)
{
    cs_vfloat to_x = triangle->corner[0] - ray->origin[0];
    cs_vfloat to_y = triangle->corner[1] - ray->origin[1];
    cs_vfloat to_z = triangle->corner[2] - ray->origin[2];
    cs_vfloat dx = ray->direction[0], dy = ray->direction[1], dz = ray->direction[2];
    cs_vfloat nx = (cs_vfloat)(triangle->normal[0]);
    cs_vfloat ny = (cs_vfloat)(triangle->normal[1]);
    cs_vfloat nz = (cs_vfloat)(triangle->normal[2]);
    cs_vfloat inverse = 1.0f / fma(nx, dx, fma(ny, dy, nz * dz));
    cs_vfloat cross_x = fma(to_y, dz, -to_z * dy);
    cs_vfloat cross_y = fma(to_z, dx, -to_x * dz);
    cs_vfloat cross_z = fma(to_x, dy, -to_y * dx);
    cs_vfloat u =
        inverse * fma(cross_x, (cs_vfloat)(triangle->edge2[0]),
                      fma(cross_y, (cs_vfloat)(triangle->edge2[1]), cross_z * triangle->edge2[2]));
    cs_vfloat v =
        -inverse * fma(cross_x, (cs_vfloat)(triangle->edge1[0]),
                       fma(cross_y, (cs_vfloat)(triangle->edge1[1]), cross_z * triangle->edge1[2]));
    cs_vfloat distance = inverse * fma(nx, to_x, fma(ny, to_y, nz * to_z));
    cs_vint inside = (u >= 0.0f) & (v >= 0.0f) & (u + v <= 1.0f) & (distance > 0.0f) &
                     (distance < hit->distance) & active;
    if (any_hit) {
        hit->distance = inside ? (cs_vfloat)(-1.0f) : hit->distance;
    } else {
        hit->distance = inside ? distance : hit->distance;
        hit->triangle = inside ? (cs_vint)(index) : hit->triangle;
    }
}

/* Walks the lanes of one octant. Lanes outside it have a negative distance and hit nothing.
 *
 * Works on copies: through the caller's pointers every update of the hit might change the ray, and
 * the compiler would fetch it anew at each step. */
CS_INLINED cs_hit cs_walk_octant(CS_GLOBAL const cs_node *nodes,
                                 CS_GLOBAL const cs_triangle *triangles, const cs_ray ray,
                                 const cs_walk walk, int octant, const int any_hit, cs_hit hit)
{
    const int negative[3] = {octant & 1, octant >> 1 & 1, octant >> 2 & 1};
    cs_u32 stack[CS_STACK];
    cs_vfloat stack_enter[CS_STACK];
    int top = 0;
    cs_u32 current = 0u;
    for (;;) {
        int descend = 0;
        if (!(current & CS_LEAF)) {
            CS_GLOBAL const cs_node *node = nodes + current;
            cs_prefetch_child(nodes, triangles, node->child[0]);
            cs_prefetch_child(nodes, triangles, node->child[1]);
            cs_vint hit0, hit1;
            cs_vfloat enter0 =
                cs_enter_box(nodes, current, 0, &walk, negative, hit.distance, &hit0);
            cs_vfloat enter1 =
                cs_enter_box(nodes, current, 1, &walk, negative, hit.distance, &hit1);
            int any0 = cs_any(hit0), any1 = cs_any(hit1);
            descend = any0 | any1;
            current = any0 ? node->child[0] : node->child[1];
            if (any0 & any1) {
                /* Shadow rays go far side first: near their origin is the surface they leave,
                 * dense and rarely in the way. */
                int far_first = (octant >> node->axis & 1) ^ any_hit;
                current = node->child[far_first];
                stack[top] = node->child[1 - far_first];
                cs_vfloat enter = far_first ? enter0 : enter1;
                stack_enter[top] = (far_first ? hit0 : hit1) ? enter : (cs_vfloat)(INFINITY);
                top++;
            }
        } else {
            cs_u32 first = current & ((1u << CS_LEAF_SHIFT) - 1u);
            cs_u32 last = first + (current >> CS_LEAF_SHIFT & 7u);
            for (cs_u32 i = first; i <= last; i++) {
#if CS_HAS(MOVING)
                const cs_shape moved =
                    cs_shape_of(triangles + i, walk.triangle_steps + i, walk.time);
                cs_hit_triangle(&moved, (cs_i32)i, &ray, walk.active, any_hit, &hit);
#else
                cs_hit_triangle(triangles + i, (cs_i32)i, &ray, walk.active, any_hit, &hit);
#endif
            }
            if (any_hit && !cs_any(hit.distance >= 0.0f)) return hit;
        }
        while (!descend) {
            if (top == 0) return hit;
            top--;
            current = stack[top];
            descend = cs_any(stack_enter[top] < hit.distance);
        }
    }
}

/* The octants of directions: a bit for each axis, set where the direction is negative along it. */
static inline cs_vint cs_octants(const cs_vfloat *direction)
{
    cs_vint octants = (cs_vint)(0);
    for (int axis = 0; axis < 3; axis++)
        octants += direction[axis] < 0.0f ? (cs_vint)(1 << axis) : (cs_vint)(0);
    return octants;
}

/* Traces the lanes whose hit->distance is positive, up to that distance. Closest hit: `hit` gets
 * the nearest triangle and its distance. Any hit: the distance of a lane that is blocked becomes
 * negative. `any_hit` must be a literal: each of the two is compiled for itself. */
CS_INLINED void cs_traverse(const cs_scene_buffers *scene, const cs_ray *ray, const int any_hit,
                            cs_hit *hit)
{
    cs_walk walk;
    cs_vint octants = (cs_vint)(0);
#if CS_HAS(MOVING)
    walk.node_steps = scene->node_steps;
    walk.triangle_steps = scene->triangle_steps;
    walk.time = scene->time;
#endif
    for (int axis = 0; axis < 3; axis++) {
        cs_vfloat d = ray->direction[axis];
        cs_vfloat safe = fabs(d) < 1e-18f ? (cs_vfloat)(1e-18f) : d;
        walk.inverse[axis] = 1.0f / safe;
        walk.offset[axis] = -ray->origin[axis] * walk.inverse[axis];
        octants += safe < 0.0f ? (cs_vint)(1 << axis) : (cs_vint)(0);
    }
    octants = hit->distance > 0.0f ? octants : (cs_vint)(-1);
    hit->triangle = (cs_vint)(CS_NO_HIT);
#if CS_PACKET == 1
    /* A loop over octants would let the lanes of a GPU's warp walk one after another. */
    walk.active = octants >= 0;
    if (walk.active)
        *hit = cs_walk_octant(scene->nodes, scene->triangles, *ray, walk, octants, any_hit, *hit);
#else
    for (int octant = 0; octant < 8; octant++) {
        walk.active = octants == (cs_vint)(octant);
        if (!cs_any(walk.active)) continue;
        cs_vfloat others = hit->distance;
        hit->distance = walk.active ? hit->distance : (cs_vfloat)(-1.0f);
        *hit = cs_walk_octant(scene->nodes, scene->triangles, *ray, walk, octant, any_hit, *hit);
        hit->distance = walk.active ? hit->distance : others;
    }
#endif
}

#endif
