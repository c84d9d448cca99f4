/* Closest hit and any hit of rays that have little in common, each by itself. Device only.
 *
 * A ray meets the boxes of up to sixteen children at once (Wald, Benthin & Boulos 2008), and four
 * triangles. The rays of a packet take turns, a step each: what a ray needs next is asked for one
 * turn before, so that it does not wait for memory. */
#ifndef CS_KERNELS_WIDE_WALK_H
#define CS_KERNELS_WIDE_WALK_H

#include "kernels/traverse.h"
#include "kernels/wide_lanes.h"

/* Rays on their way, one in each lane. */
typedef struct cs_wide_rays {
    cs_float_lanes origin[3];
    cs_float_lanes direction[3];
    cs_float_lanes inverse[3]; /* of the direction */
    cs_int_lanes octant;
    cs_float_lanes limit; /* distance of the nearest hit so far, or the ray's reach */
    cs_int_lanes triangle;
    int top[CS_PACKET]; /* entries of the stacks */
    cs_u32 references[CS_PACKET][CS_WIDE_STACK];
    cs_f32 enters[CS_PACKET][CS_WIDE_STACK]; /* distances at which rays enter their boxes */
} cs_wide_rays;

/* Meets the boxes of a node's children. */
static inline void cs_wide_enter(CS_GLOBAL const cs_wide_node *node, cs_wide_rays *rays, int lane,
                                 const int any_hit)
{
    int octant = rays->octant.lane[lane];
    cs_f32 limit = rays->limit.lane[lane];
    cs_vfloat near[3], far[3];
    for (int axis = 0; axis < 3; axis++) {
        int negative = octant >> axis & 1;
        cs_f32 inverse = rays->inverse[axis].lane[lane];
        cs_vfloat scale = (cs_vfloat)(node->step[axis] * inverse);
        cs_vfloat offset = (cs_vfloat)((node->low[axis] - rays->origin[axis].lane[lane]) * inverse);
        near[axis] = fma(cs_bytes_at(node->planes[axis][negative]), scale, offset);
        far[axis] = fma(cs_bytes_at(node->planes[axis][1 - negative]), scale, offset);
    }
    cs_vfloat enter = cs_max(cs_max(near[0], near[1]), cs_max(near[2], (cs_vfloat)(0.0f)));
    cs_vfloat leave = cs_min(cs_min(far[0], far[1]), far[2]);
    /* Ize 2013: what rounding loses relative to the distance */
    cs_vint hit = enter <= leave * 1.0000005f;
    hit = hit & (*(CS_GLOBAL const cs_vint *)node->child != 0);
    enter = hit ? enter : (cs_vfloat)(INFINITY);
    int top = rays->top[lane];
    rays->top[lane] = top + cs_push_lanes(node, any_hit ? 7 - octant : octant, enter, limit,
                                          rays->references[lane] + top, rays->enters[lane] + top);
}

/* Rows of four as columns: the numbers at `a`, `a` + 4, `a` + 8 and `a` + 12 of four vectors. */
#define CS_COLUMNS(row, a, b, c, d)                                                         \
    (float16)(row[0].s##a, row[1].s##a, row[2].s##a, row[3].s##a, row[0].s##b, row[1].s##b, \
              row[2].s##b, row[3].s##b, row[0].s##c, row[1].s##c, row[2].s##c, row[3].s##c, \
              row[0].s##d, row[1].s##d, row[2].s##d, row[3].s##d)

/* Meets four triangles, as cs_hit_triangle. */
static inline void cs_wide_hit(CS_GLOBAL const cs_triangle *triangles, cs_u32 first,
                               cs_wide_rays *rays, int lane, const int any_hit)
{
    float16 row[4];
    for (int i = 0; i < 4; i++)
        row[i] = *(CS_GLOBAL const float16 *)(triangles + first + i);
    float16 x = CS_COLUMNS(row, 0, 4, 8, c);
    float16 y = CS_COLUMNS(row, 1, 5, 9, d);
    float16 z = CS_COLUMNS(row, 2, 6, a, e);
    float4 dx = (float4)(rays->direction[0].lane[lane]);
    float4 dy = (float4)(rays->direction[1].lane[lane]);
    float4 dz = (float4)(rays->direction[2].lane[lane]);
    float4 to_x = x.s0123 - rays->origin[0].lane[lane];
    float4 to_y = y.s0123 - rays->origin[1].lane[lane];
    float4 to_z = z.s0123 - rays->origin[2].lane[lane];
    float4 inverse = 1.0f / fma(x.scdef, dx, fma(y.scdef, dy, z.scdef * dz));
    float4 cross_x = fma(to_y, dz, -to_z * dy);
    float4 cross_y = fma(to_z, dx, -to_x * dz);
    float4 cross_z = fma(to_x, dy, -to_y * dx);
    float4 u = inverse * fma(cross_x, x.s89ab, fma(cross_y, y.s89ab, cross_z * z.s89ab));
    float4 v = -inverse * fma(cross_x, x.s4567, fma(cross_y, y.s4567, cross_z * z.s4567));
    float4 distance = inverse * fma(x.scdef, to_x, fma(y.scdef, to_y, z.scdef * to_z));
    int4 inside = (u >= 0.0f) & (v >= 0.0f) & (u + v <= 1.0f) & (distance > 0.0f) &
                  (distance < rays->limit.lane[lane]);
    if (!any(inside)) return;
    if (any_hit) {
        rays->limit.lane[lane] = -1.0f;
        return;
    }
    distance = inside ? distance : (float4)(INFINITY);
    float2 least = fmin(distance.lo, distance.hi);
    float nearest = fmin(least.x, least.y);
    int number = distance.z == nearest ? 2 : 3;
    number = distance.y == nearest ? 1 : number;
    number = distance.x == nearest ? 0 : number;
    rays->limit.lane[lane] = nearest;
    rays->triangle.lane[lane] = (int)first + number;
}

/* A turn of all rays that are left: takes what is next from each one's stack, then does it. */
static inline int cs_wide_turn(const cs_scene_buffers *scene, cs_wide_rays *rays, int *left,
                               int count, const int any_hit)
{
    cs_u32 next[CS_PACKET];
    int entering[CS_PACKET], hitting[CS_PACKET];
    int enters = 0, hits = 0;
    for (int i = 0; i < count; i++) {
        int lane = left[i], top = rays->top[lane];
        cs_f32 limit = rays->limit.lane[lane];
        while (top > 0 && !(rays->enters[lane][top - 1] < limit))
            top--;
        if (top == 0) continue;
        cs_u32 reference = rays->references[lane][--top];
        rays->top[lane] = top;
        next[lane] = reference & ~(cs_u32)CS_LEAF;
        int leaf = (reference & CS_LEAF) != 0u;
        size_t line = leaf ? (size_t)(scene->triangles + next[lane])
                           : (size_t)(scene->wide_nodes + next[lane]);
        CS_PREFETCH(line);
        CS_PREFETCH(line + 64u);
        CS_PREFETCH(line + 128u);
        CS_PREFETCH(line + 192u);
        entering[enters] = lane;
        hitting[hits] = lane;
        enters += !leaf;
        hits += leaf;
    }
    for (int i = 0; i < enters; i++) {
        int lane = entering[i];
        cs_wide_enter(scene->wide_nodes + next[lane], rays, lane, any_hit);
        left[i] = lane;
    }
    for (int i = 0; i < hits; i++) {
        int lane = hitting[i];
        cs_wide_hit(scene->triangles, next[lane], rays, lane, any_hit);
        left[enters + i] = lane;
    }
    return enters + hits;
}

/* As cs_traverse. */
static inline void cs_traverse_wide(const cs_scene_buffers *scene, const cs_ray *ray,
                                    const int any_hit, cs_hit *hit)
{
    cs_wide_rays rays;
    int left[CS_PACKET], count = 0;
    for (int axis = 0; axis < 3; axis++) {
        cs_vfloat d = ray->direction[axis];
        cs_vfloat safe = fabs(d) < 1e-18f ? (cs_vfloat)(1e-18f) : d;
        rays.origin[axis].all = ray->origin[axis];
        rays.direction[axis].all = d;
        rays.inverse[axis].all = 1.0f / safe;
    }
    rays.octant.all = cs_octants((const cs_vfloat *)&rays.inverse);
    rays.limit.all = hit->distance;
    rays.triangle.all = (cs_vint)(CS_NO_HIT);
    for (int lane = 0; lane < CS_PACKET; lane++) {
        if (!(rays.limit.lane[lane] > 0.0f)) continue;
        rays.references[lane][0] = 0u;
        rays.enters[lane][0] = 0.0f;
        rays.top[lane] = 1;
        left[count++] = lane;
    }
    while (count > 0)
        count = cs_wide_turn(scene, &rays, left, count, any_hit);
    hit->distance = rays.limit.all;
    hit->triangle = rays.triangle.all;
}

#endif
