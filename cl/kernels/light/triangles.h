/* All emissive triangles together, as one area light: one is chosen by power, wherever it is, and a
 * point of its area. The feature EMITTERS takes its place (emitters.h). Device only. */
#ifndef CS_LIGHT_TRIANGLES_H
#define CS_LIGHT_TRIANGLES_H

#include "kernels/light/sample.h"

#if !CS_HAS(EMITTERS)

/* First emitter whose cumulative probability exceeds `target`. */
static inline cs_u32 cs_pick_emitter(CS_GLOBAL const cs_emitter *emitters, cs_u32 count,
                                     cs_f32 target)
{
    cs_u32 low = 0u, high = count - 1u;
    while (low < high) {
        cs_u32 middle = (low + high) / 2u;
        if (emitters[middle].cumulative > target)
            high = middle;
        else
            low = middle + 1u;
    }
    return low;
}

/* Points on emitters, a lane each. */
typedef struct cs_emitter_points {
    cs_float_lanes point[3];
    cs_float_lanes normal[3]; /* unit */
    cs_float_lanes radiance[3];
    cs_float_lanes density; /* per unit of area */
} cs_emitter_points;

#if CS_HAS(MOVING)
/* The emitter at the time of a lane. */
static inline cs_emitter cs_moved_emitter(const cs_scene_buffers *scene, cs_u32 number, int lane)
{
    cs_emitter moved = scene->emitters[number];
    CS_GLOBAL const cs_triangle_step *step = scene->emitter_steps + number;
    cs_float_lanes times;
    cs_f32 square = 0.0f;
    times.all = scene->time;
    for (int i = 0; i < 3; i++) {
        moved.corner[i] += times.lane[lane] * step->corner[i];
        moved.edge1[i] += times.lane[lane] * step->edge1[i];
        moved.edge2[i] += times.lane[lane] * step->edge2[i];
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        cs_f32 normal = moved.edge1[j] * moved.edge2[k] - moved.edge1[k] * moved.edge2[j];
        square += normal * normal;
    }
    moved.area = 0.5f * sqrt(max(square, 1e-36f));
    return moved;
}
#endif

/* Fills in lane `lane` from a point (a, b) of the unit square: the emitter in proportion to its
 * power, then a uniform point by the square-root map (Turk 1990). Stretching the rest of `a` keeps
 * the points stratified. */
static inline void cs_point_on_emitter(const cs_scene_buffers *scene, cs_u32 count, cs_f32 a,
                                       cs_f32 b, int lane, cs_emitter_points *points)
{
    cs_u32 number = cs_pick_emitter(scene->emitters, count, a);
#if CS_HAS(MOVING)
    const cs_emitter moved = cs_moved_emitter(scene, number, lane);
    const cs_emitter *emitter = &moved;
    const cs_f32 *e1 = emitter->edge1;
    const cs_f32 *e2 = emitter->edge2;
#else
    CS_GLOBAL const cs_emitter *emitter = scene->emitters + number;
    CS_GLOBAL const cs_f32 *e1 = emitter->edge1;
    CS_GLOBAL const cs_f32 *e2 = emitter->edge2;
#endif
    cs_f32 below = emitter->cumulative - emitter->probability;
    cs_f32 stretched = clamp((a - below) / emitter->probability, 0.0f, 1.0f);
    cs_f32 root = sqrt(stretched);
    cs_f32 b1 = root * (1.0f - b), b2 = root * b;
    for (int axis = 0; axis < 3; axis++) {
        int next = (axis + 1) % 3, last = (axis + 2) % 3;
        points->point[axis].lane[lane] = emitter->corner[axis] + b1 * e1[axis] + b2 * e2[axis];
        points->normal[axis].lane[lane] =
            (e1[next] * e2[last] - e1[last] * e2[next]) * 0.5f / emitter->area;
        points->radiance[axis].lane[lane] = emitter->radiance[axis];
    }
    points->density.lane[lane] = emitter->probability / emitter->area;
}

/* colour: radiance. parameters: density of a point, per unit of area and luminance. `pair` is a
 * stratified point of the unit square. */
static inline cs_light_sample cs_sample_light_triangles(const cs_scene_buffers *scene,
                                                        CS_GLOBAL const cs_light *light,
                                                        const cs_surface *surface, cs_pair pair)
{
    cs_emitter_points points;
    cs_float_lanes a, b;
    a.all = pair.x;
    b.all = pair.y;
    for (int lane = 0; lane < CS_PACKET; lane++)
        cs_point_on_emitter(scene, light->count, a.lane[lane], b.lane[lane], lane, &points);
    cs_light_sample sample;
    cs_vfloat normal[3];
    for (int axis = 0; axis < 3; axis++) {
        sample.towards[axis] = points.point[axis].all - surface->point[axis];
        sample.colour[axis] = points.radiance[axis].all;
        normal[axis] = points.normal[axis].all;
    }
    cs_vfloat square = cs_max(cs_dot(sample.towards, sample.towards), (cs_vfloat)(1e-30f));
    cs_vfloat turned = fabs(cs_dot(normal, sample.towards));
    cs_vfloat cosines = cs_dot(surface->normal, sample.towards) * turned;
    sample.weight = cosines / (square * square * points.density.all);
    sample.density = light->parameters[0] * cs_luminance(sample.colour) * square * sqrt(square) /
                     cs_max(turned, (cs_vfloat)(1e-20f));
    sample.reach = 0.9999f;
    return sample;
}

#endif

#endif
