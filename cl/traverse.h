/* Closest hit and any hit of a packet of rays over the flattened binary hierarchy. Device only.
 *
 * The packet walks the tree together, one ray octant after another: within an octant the near and
 * far planes of a box and the near child of a node are the same for all lanes and are picked by
 * scalar bits. */
#ifndef CS_TRAVERSE_H
#define CS_TRAVERSE_H

#include "lens.h"
#include "packet.h"
#include "shared.h"

typedef struct cs_hit {
    vfloat distance; /* in units of the ray's direction */
    vint triangle;   /* index into the array of cs_triangle, or CS_NO_HIT */
} cs_hit;

typedef struct cs_walk {
    vfloat inverse[3]; /* of the direction */
    vfloat offset[3];  /* -origin * inverse: slab tests are one multiply-add a plane */
    vint active;       /* lanes of the octant that is walked */
} cs_walk;

/* Distances at which the lanes enter the box of child `side`; lanes that miss it are cleared in
 * `hit`. */
static inline vfloat cs_enter_box(CS_GLOBAL const cs_node *node, int side, const cs_walk *walk,
                                  const int *negative, vfloat limit, vint *hit)
{
    CS_GLOBAL const f32 *x = node->bounds[side][0];
    CS_GLOBAL const f32 *y = node->bounds[side][1];
    CS_GLOBAL const f32 *z = node->bounds[side][2];
    vfloat near_x = fma((vfloat)(x[negative[0]]), walk->inverse[0], walk->offset[0]);
    vfloat near_y = fma((vfloat)(y[negative[1]]), walk->inverse[1], walk->offset[1]);
    vfloat near_z = fma((vfloat)(z[negative[2]]), walk->inverse[2], walk->offset[2]);
    vfloat far_x = fma((vfloat)(x[1 - negative[0]]), walk->inverse[0], walk->offset[0]);
    vfloat far_y = fma((vfloat)(y[1 - negative[1]]), walk->inverse[1], walk->offset[1]);
    vfloat far_z = fma((vfloat)(z[1 - negative[2]]), walk->inverse[2], walk->offset[2]);
    vfloat enter = cs_max(cs_max(near_x, near_y), cs_max(near_z, (vfloat)(0.0f)));
    vfloat leave = cs_min(cs_min(far_x, far_y), cs_min(far_z, limit));
    *hit = enter <= leave;
    return enter;
}

/* Asks for what a node's child refers to, which is wanted once the boxes are tested: 6 to 8 % of
 * the frame with 250 000 triangles and more. */
static inline void cs_prefetch_child(CS_GLOBAL const cs_node *nodes,
                                     CS_GLOBAL const cs_triangle *triangles, u32 child)
{
    u32 first = child & ((1u << CS_LEAF_SHIFT) - 1u);
    CS_PREFETCH(child & CS_LEAF ? (size_t)(triangles + first) : (size_t)(nodes + child));
}

/* Test by scaled barycentrics (Möller & Trumbore 1997 with a stored normal). */
static inline void cs_hit_triangle(CS_GLOBAL const cs_triangle *triangle, i32 index,
                                   const cs_ray *ray, vint active, const int any_hit, cs_hit *hit)
{
    vfloat to_x = triangle->corner[0] - ray->origin[0];
    vfloat to_y = triangle->corner[1] - ray->origin[1];
    vfloat to_z = triangle->corner[2] - ray->origin[2];
    vfloat dx = ray->direction[0], dy = ray->direction[1], dz = ray->direction[2];
    vfloat nx = (vfloat)(triangle->normal[0]);
    vfloat ny = (vfloat)(triangle->normal[1]);
    vfloat nz = (vfloat)(triangle->normal[2]);
    vfloat inverse = 1.0f / fma(nx, dx, fma(ny, dy, nz * dz));
    vfloat cross_x = fma(to_y, dz, -to_z * dy);
    vfloat cross_y = fma(to_z, dx, -to_x * dz);
    vfloat cross_z = fma(to_x, dy, -to_y * dx);
    vfloat u =
        inverse * fma(cross_x, (vfloat)(triangle->edge2[0]),
                      fma(cross_y, (vfloat)(triangle->edge2[1]), cross_z * triangle->edge2[2]));
    vfloat v =
        -inverse * fma(cross_x, (vfloat)(triangle->edge1[0]),
                       fma(cross_y, (vfloat)(triangle->edge1[1]), cross_z * triangle->edge1[2]));
    vfloat distance = inverse * fma(nx, to_x, fma(ny, to_y, nz * to_z));
    vint inside = (u >= 0.0f) & (v >= 0.0f) & (u + v <= 1.0f) & (distance > 0.0f) &
                  (distance < hit->distance) & active;
    if (any_hit) {
        hit->distance = inside ? (vfloat)(-1.0f) : hit->distance;
    } else {
        hit->distance = inside ? distance : hit->distance;
        hit->triangle = inside ? (vint)(index) : hit->triangle;
    }
}

/* Walks the lanes of one octant. Lanes outside it have a negative distance and hit nothing.
 *
 * Works on copies: through the caller's pointers every update of the hit might change the ray, and
 * the compiler would fetch it anew at each step. */
static inline cs_hit cs_walk_octant(CS_GLOBAL const cs_node *nodes,
                                    CS_GLOBAL const cs_triangle *triangles, const cs_ray ray,
                                    const cs_walk walk, int octant, const int any_hit, cs_hit hit)
{
    const int negative[3] = {octant & 1, octant >> 1 & 1, octant >> 2 & 1};
    u32 stack[CS_STACK];
    vfloat stack_enter[CS_STACK];
    int top = 0;
    u32 current = 0u;
    for (;;) {
        int descend = 0;
        if (!(current & CS_LEAF)) {
            CS_GLOBAL const cs_node *node = nodes + current;
            cs_prefetch_child(nodes, triangles, node->child[0]);
            cs_prefetch_child(nodes, triangles, node->child[1]);
            vint hit0, hit1;
            vfloat enter0 = cs_enter_box(node, 0, &walk, negative, hit.distance, &hit0);
            vfloat enter1 = cs_enter_box(node, 1, &walk, negative, hit.distance, &hit1);
            int any0 = cs_any(hit0), any1 = cs_any(hit1);
            descend = any0 | any1;
            current = any0 ? node->child[0] : node->child[1];
            if (any0 & any1) {
                /* Shadow rays go far side first: near their origin is the surface they leave,
                 * dense and rarely in the way. */
                int far_first = (octant >> node->axis & 1) ^ any_hit;
                current = node->child[far_first];
                stack[top] = node->child[1 - far_first];
                vfloat enter = far_first ? enter0 : enter1;
                stack_enter[top] = (far_first ? hit0 : hit1) ? enter : (vfloat)(INFINITY);
                top++;
            }
        } else {
            u32 first = current & ((1u << CS_LEAF_SHIFT) - 1u);
            u32 last = first + (current >> CS_LEAF_SHIFT & 7u);
            for (u32 i = first; i <= last; i++)
                cs_hit_triangle(triangles + i, (i32)i, &ray, walk.active, any_hit, &hit);
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

/* Traces the lanes whose hit->distance is positive, up to that distance. Closest hit: `hit` gets
 * the nearest triangle and its distance. Any hit: the distance of a lane that is blocked becomes
 * negative. `any_hit` must be a literal. */
static inline void cs_traverse(CS_GLOBAL const cs_node *nodes,
                               CS_GLOBAL const cs_triangle *triangles, const cs_ray *ray,
                               const int any_hit, cs_hit *hit)
{
    cs_walk walk;
    vint octants = (vint)(0);
    for (int axis = 0; axis < 3; axis++) {
        vfloat d = ray->direction[axis];
        vfloat safe = fabs(d) < 1e-18f ? (vfloat)(1e-18f) : d;
        walk.inverse[axis] = 1.0f / safe;
        walk.offset[axis] = -ray->origin[axis] * walk.inverse[axis];
        octants += safe < 0.0f ? (vint)(1 << axis) : (vint)(0);
    }
    octants = hit->distance > 0.0f ? octants : (vint)(-1);
    hit->triangle = (vint)(CS_NO_HIT);
    for (int octant = 0; octant < 8; octant++) {
        walk.active = octants == (vint)(octant);
        if (!cs_any(walk.active)) continue;
        vfloat others = hit->distance;
        hit->distance = walk.active ? hit->distance : (vfloat)(-1.0f);
        *hit = cs_walk_octant(nodes, triangles, *ray, walk, octant, any_hit, *hit);
        hit->distance = walk.active ? hit->distance : others;
    }
}

#endif
