/* Closest hit and any hit of rays that have little in common, each by itself. Device only.
 *
 * A step tests one ray against the boxes of up to sixteen children (Wald, Benthin & Boulos 2008) or
 * against four triangles. The rays of a packet take turns, a step each. At the end of its step a
 * ray prefetches its next node or leaf, which memory delivers during the steps of the others. */
#ifndef CS_KERNELS_WIDE_WALK_H
#define CS_KERNELS_WIDE_WALK_H

#include "kernels/wide_lanes.h"

#if CS_WALKS_WIDE

/* The three numbers of a lane. */
#define CS_LANE_OF(lanes, i) \
    (float4)((lanes)[0].lane[i], (lanes)[1].lane[i], (lanes)[2].lane[i], 0.0f)

#define CS_WIDE_END 0x80000000u /* the stack's first reference, which is taken last */

/* A ray on its way. */
typedef struct cs_wide_ray {
    float4 origin;
    float4 inverse; /* of the direction */
    float4 direction;
    cs_f32 limit; /* distance of the nearest hit so far, or the ray's reach */
    int near[3]; /* for each axis, offset in bytes of the planes that the ray meets first: 0 for the
                  * low ones, 16 for the high ones */
    int octant;  /* of the direction */
    int next;    /* node or leaf */
    int triangle; /* CS_WIDE_LEAF times its leaf, and its place there; or CS_NO_HIT */
    int top;      /* number of entries on the stack */
    cs_u32 references[CS_WIDE_STACK];
    cs_f32 enters[CS_WIDE_STACK]; /* distances at which the ray enters their boxes */
} cs_wide_ray;

/* Distances at which the ray enters the boxes of CS_PACKET children of a node, from child `first`
 * on; INFINITY where it does not. scale, offset: from bytes to distances. */
static inline cs_vfloat cs_wide_enters(CS_GLOBAL const cs_wide_node *node, int first,
                                       const cs_wide_ray *ray, float4 scale, float4 offset)
{
    CS_GLOBAL const uchar *planes = (CS_GLOBAL const uchar *)node->planes + first;
    cs_vfloat near_x = fma(cs_bytes_at(planes + ray->near[0]), scale.x, offset.x);
    cs_vfloat near_y = fma(cs_bytes_at(planes + 32 + ray->near[1]), scale.y, offset.y);
    cs_vfloat near_z = fma(cs_bytes_at(planes + 64 + ray->near[2]), scale.z, offset.z);
    cs_vfloat far_x = fma(cs_bytes_at(planes + 16 - ray->near[0]), scale.x, offset.x);
    cs_vfloat far_y = fma(cs_bytes_at(planes + 48 - ray->near[1]), scale.y, offset.y);
    cs_vfloat far_z = fma(cs_bytes_at(planes + 80 - ray->near[2]), scale.z, offset.z);
    cs_vfloat enter = cs_max(cs_max(near_x, near_y), cs_max(near_z, (cs_vfloat)(0.0f)));
    cs_vfloat leave = cs_min(cs_min(far_x, far_y), far_z);
    /* Far planes are moved away by the relative error of a slab test in floats (Ize 2013). */
    cs_vint hit = enter <= leave * 1.0000005f;
    hit = hit & (*(CS_GLOBAL const cs_loose_int *)(node->child + first) != 0);
    return hit ? enter : (cs_vfloat)(INFINITY);
}

/* Meets the boxes of a node's children. */
CS_INLINED void cs_wide_enter(CS_GLOBAL const cs_wide_node *nodes, cs_wide_ray *ray,
                              const int any_hit)
{
    CS_GLOBAL const cs_wide_node *node = nodes + ray->next;
    float4 scale = *(CS_GLOBAL const cs_loose_four *)node->step * ray->inverse;
    float4 offset = (*(CS_GLOBAL const cs_loose_four *)node->low - ray->origin) * ray->inverse;
    cs_float_lanes enter[CS_WIDE / CS_PACKET];
    for (int i = 0; i < CS_WIDE / CS_PACKET; i++)
        enter[i].all = cs_wide_enters(node, i * CS_PACKET, ray, scale, offset);
    ray->top += cs_push_children(node, ray->octant, any_hit, enter, ray->limit,
                                 ray->references + ray->top, ray->enters + ray->top);
}

/* A coordinate of four triangles. */
#define CS_FOUR(of) (*(CS_GLOBAL const cs_loose_four *)(of))

/* Distances at which a ray meets a leaf's triangles, as cs_hit_triangle; returns the mask of those
 * that it meets before its limit. */
static inline cs_u32 cs_wide_distances(CS_GLOBAL const cs_wide_leaf *leaf, const cs_wide_ray *ray,
                                       float4 *distance)
{
    const float4 e1[3] = {CS_FOUR(leaf->edge1[0]), CS_FOUR(leaf->edge1[1]),
                          CS_FOUR(leaf->edge1[2])};
    const float4 e2[3] = {CS_FOUR(leaf->edge2[0]), CS_FOUR(leaf->edge2[1]),
                          CS_FOUR(leaf->edge2[2])};
    float4 n[3];
    float4 dx = (float4)(ray->direction.x), dy = (float4)(ray->direction.y);
    float4 dz = (float4)(ray->direction.z);
    float4 to_x = CS_FOUR(leaf->corner[0]) - ray->origin.x;
    float4 to_y = CS_FOUR(leaf->corner[1]) - ray->origin.y;
    float4 to_z = CS_FOUR(leaf->corner[2]) - ray->origin.z;
    n[0] = e1[1] * e2[2] - e1[2] * e2[1];
    n[1] = e1[2] * e2[0] - e1[0] * e2[2];
    n[2] = e1[0] * e2[1] - e1[1] * e2[0];
    float4 inverse = 1.0f / fma(n[0], dx, fma(n[1], dy, n[2] * dz));
    float4 x = fma(to_y, dz, -to_z * dy);
    float4 y = fma(to_z, dx, -to_x * dz);
    float4 z = fma(to_x, dy, -to_y * dx);
    float4 u = inverse * fma(x, e2[0], fma(y, e2[1], z * e2[2]));
    float4 v = -inverse * fma(x, e1[0], fma(y, e1[1], z * e1[2]));
    *distance = inverse * fma(n[0], to_x, fma(n[1], to_y, n[2] * to_z));
    return cs_mask_of_four((u >= 0.0f) & (v >= 0.0f) & (u + v <= 1.0f) & (*distance > 0.0f) &
                           (*distance < ray->limit));
}

/* Meets the triangles of a leaf. */
CS_INLINED void cs_wide_hit(CS_GLOBAL const cs_wide_leaf *leaves, cs_wide_ray *ray,
                            const int any_hit)
{
    union {
        float4 all;
        cs_f32 lane[CS_WIDE_LEAF];
    } distance;
    cs_u32 inside = cs_wide_distances(leaves + ray->next, ray, &distance.all);
    if (inside == 0u) return;
    if (any_hit) {
        ray->limit = -1.0f;
        ray->top = 1;
        return;
    }
    for (; inside != 0u; inside &= inside - 1u) {
        int place = (int)popcount((inside & -inside) - 1u);
        if (!(distance.lane[place] < ray->limit)) continue;
        ray->limit = distance.lane[place];
        ray->triangle = ray->next * CS_WIDE_LEAF + place;
    }
}

/* Lanes whose rays meet a node next, and those whose rays meet a leaf. */
typedef struct cs_wide_turn {
    int nodes[CS_PACKET], leaves[CS_PACKET];
    int node_count, leaf_count;
} cs_wide_turn;

/* Takes the next node or leaf of a ray from its stack and prefetches it. With `any_hit` entries are
 * not compared with the limit: it does not shrink, and all were within it when they were pushed. */
CS_INLINED void cs_wide_pop(const cs_scene_buffers *scene, cs_wide_ray *ray, int lane,
                            const int any_hit, cs_wide_turn *turn)
{
    int top = ray->top - 1;
    while (!any_hit && !(ray->enters[top] < ray->limit))
        top--;
    cs_u32 reference = ray->references[top], kind = reference >> 30;
    ray->top = top;
    reference &= (cs_u32)CS_LEAF - 1u;
    ray->next = (int)reference;
    size_t node = (size_t)(scene->wide_nodes + reference);
    size_t line = (size_t)(scene->wide_leaves + reference);
    line = node ^ ((node ^ line) & -(size_t)(kind & 1u));
    CS_PREFETCH(line);
    CS_PREFETCH(line + 64u);
    CS_PREFETCH(line + 128u);
    CS_PREFETCH(line + 192u - 64u * (kind & 1u)); /* a leaf has three */
    turn->nodes[turn->node_count] = lane;
    turn->leaves[turn->leaf_count] = lane;
    turn->node_count += kind == 0u;
    turn->leaf_count += (int)(kind & 1u);
}

/* Lets all rays take turns until none is left. */
CS_INLINED void cs_wide_take_turns(const cs_scene_buffers *scene, cs_wide_ray *rays,
                                   cs_wide_turn *turns, const int any_hit)
{
    for (int now = 0; turns[now].node_count + turns[now].leaf_count > 0; now = 1 - now) {
        cs_wide_turn *turn = turns + now, *next = turns + 1 - now;
        next->node_count = next->leaf_count = 0;
        for (int i = 0; i < turn->node_count; i++) {
            int lane = turn->nodes[i];
            cs_wide_enter(scene->wide_nodes, rays + lane, any_hit);
            cs_wide_pop(scene, rays + lane, lane, any_hit, next);
        }
        for (int i = 0; i < turn->leaf_count; i++) {
            int lane = turn->leaves[i];
            cs_wide_hit(scene->wide_leaves, rays + lane, any_hit);
            cs_wide_pop(scene, rays + lane, lane, any_hit, next);
        }
    }
}

/* A lane's ray at the root; `origin`, `direction` and `inverse` are of all lanes. */
static inline void cs_wide_begin(cs_wide_ray *ray, const cs_float_lanes *origin,
                                 const cs_float_lanes *direction, const cs_float_lanes *inverse,
                                 int lane, int octant)
{
    ray->origin = CS_LANE_OF(origin, lane);
    ray->direction = CS_LANE_OF(direction, lane);
    ray->inverse = CS_LANE_OF(inverse, lane);
    ray->near[0] = (octant & 1) * CS_WIDE;
    ray->near[1] = (octant >> 1 & 1) * CS_WIDE;
    ray->near[2] = (octant >> 2 & 1) * CS_WIDE;
    ray->octant = octant;
    ray->next = 0;
    ray->triangle = CS_NO_HIT;
    ray->references[0] = CS_WIDE_END;
    ray->enters[0] = -INFINITY;
    ray->top = 1;
}

/* Begins the rays of all lanes that have a reach; returns how many there are, and names them. */
static inline int cs_wide_begin_all(cs_wide_ray *rays, const cs_ray *ray,
                                    const cs_float_lanes *reach, int *lanes)
{
    cs_float_lanes origin[3], direction[3], inverse[3];
    cs_int_lanes octant;
    int count = 0;
    for (int axis = 0; axis < 3; axis++) {
        cs_vfloat d = ray->direction[axis];
        origin[axis].all = ray->origin[axis];
        direction[axis].all = d;
        inverse[axis].all = 1.0f / (fabs(d) < 1e-18f ? (cs_vfloat)(1e-18f) : d);
    }
    octant.all = (inverse[0].all < 0.0f ? (cs_vint)(1) : (cs_vint)(0)) +
                 (inverse[1].all < 0.0f ? (cs_vint)(2) : (cs_vint)(0)) +
                 (inverse[2].all < 0.0f ? (cs_vint)(4) : (cs_vint)(0));
    for (int lane = 0; lane < CS_PACKET; lane++) {
        if (!(reach->lane[lane] > 0.0f)) continue;
        cs_wide_begin(rays + lane, origin, direction, inverse, lane, octant.lane[lane]);
        rays[lane].limit = reach->lane[lane];
        lanes[count++] = lane;
    }
    return count;
}

/* As cs_traverse, each ray by itself. `any_hit` must be a literal. */
CS_INLINED void cs_traverse_alone(const cs_scene_buffers *scene, const cs_ray *ray,
                                  const int any_hit, cs_hit *hit)
{
    cs_wide_ray rays[CS_PACKET];
    cs_wide_turn turns[2];
    cs_float_lanes distance;
    cs_int_lanes triangle;
    int lanes[CS_PACKET];
    distance.all = hit->distance;
    triangle.all = (cs_vint)(CS_NO_HIT);
    int count = cs_wide_begin_all(rays, ray, &distance, lanes);
    for (int i = 0; i < count; i++)
        turns[0].nodes[i] = lanes[i];
    turns[0].node_count = count;
    turns[0].leaf_count = 0;
    cs_wide_take_turns(scene, rays, turns, any_hit);
    for (int i = 0; i < count; i++) {
        int lane = lanes[i], found = rays[lane].triangle;
        distance.lane[lane] = rays[lane].limit;
        if (found != CS_NO_HIT)
            triangle.lane[lane] =
                (int)scene->wide_leaves[found / CS_WIDE_LEAF].first + found % CS_WIDE_LEAF;
    }
    hit->distance = distance.all;
    hit->triangle = triangle.all;
}

/* Both are functions, so that each is compiled once, however often it is called. */
static inline void cs_nearest_alone(const cs_scene_buffers *scene, const cs_ray *ray, cs_hit *hit)
{
    cs_traverse_alone(scene, ray, 0, hit);
}

static inline void cs_blocked_alone(const cs_scene_buffers *scene, const cs_ray *ray, cs_hit *hit)
{
    cs_traverse_alone(scene, ray, 1, hit);
}

/* Largest less smallest value among the lanes in `active`, of which there is one. */
static inline cs_f32 cs_extent(cs_vfloat x, cs_vint active)
{
    cs_vfloat high = active ? x : (cs_vfloat)(-INFINITY);
    cs_vfloat low = active ? -x : (cs_vfloat)(-INFINITY);
    return cs_reduce_max_float(high) + cs_reduce_max_float(low);
}

/* From which extents on rays have little in common, summed over the axes: those of their unit
 * directions, and of their origins as a part of the scene's. */
#define CS_APART 0.6f
#define CS_AWAY 0.1f

/* Whether rays have so little in common that they walk faster alone. */
static inline int cs_is_scattered(const cs_scene_buffers *scene, const cs_ray *ray, cs_vint active)
{
    const cs_vfloat *d = ray->direction;
    cs_vfloat scale = 1.0f / sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    cs_f32 apart = 0.0f, away = 0.0f, size = 0.0f;
    for (int axis = 0; axis < 3; axis++) {
        apart += cs_extent(d[axis] * scale, active);
        away += cs_extent(ray->origin[axis], active);
        size += 255.0f * scene->wide_nodes->step[axis];
    }
    return apart > CS_APART || away > CS_AWAY * size;
}

#endif

/* As cs_traverse, alone or together, whichever is faster. */
CS_INLINED void cs_traverse_either(const cs_scene_buffers *scene, const cs_ray *ray,
                                   const int any_hit, cs_hit *hit)
{
#if CS_WALKS_WIDE
    cs_vint active = hit->distance > 0.0f;
    if (cs_any(active) && cs_is_scattered(scene, ray, active)) {
        if (any_hit)
            cs_blocked_alone(scene, ray, hit);
        else
            cs_nearest_alone(scene, ray, hit);
        return;
    }
#endif
    cs_traverse(scene, ray, any_hit, hit);
}

#endif
