/* Triangles and boxes as rays meet them: at rest, or moved to the lanes' times. Device only.
 *
 * With the feature MOVING, corners, edges, boxes and normals change linearly from their places
 * where the shutter opens by the steps of buffers of their own. */
#ifndef CS_KERNELS_SHAPE_H
#define CS_KERNELS_SHAPE_H

#include "clshear/device/packet.h"
#include "kernels/features.h"
#include "kernels/scene_buffers.h"

#if CS_HAS(MOVING)

/* A number of a triangle: one for each lane, as its time says. */
typedef cs_vfloat cs_shape_number;

typedef struct cs_shape {
    cs_vfloat corner[3];
    cs_vfloat edge1[3];
    cs_vfloat edge2[3];
    cs_vfloat normal[3]; /* cross(edge1, edge2), not normalised */
} cs_shape;

static inline cs_vfloat cs_moved(cs_f32 at_rest, cs_f32 step, cs_vfloat time)
{
    return fma(time, (cs_vfloat)(step), (cs_vfloat)(at_rest));
}

/* A triangle at the scene's times. */
static inline cs_shape cs_shape_of(CS_GLOBAL const cs_triangle *triangle,
                                   CS_GLOBAL const cs_triangle_step *step, cs_vfloat time)
{
    cs_shape shape;
    for (int i = 0; i < 3; i++) {
        shape.corner[i] = cs_moved(triangle->corner[i], step->corner[i], time);
        shape.edge1[i] = cs_moved(triangle->edge1[i], step->edge1[i], time);
        shape.edge2[i] = cs_moved(triangle->edge2[i], step->edge2[i], time);
    }
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        shape.normal[i] = shape.edge1[j] * shape.edge2[k] - shape.edge1[k] * shape.edge2[j];
    }
    return shape;
}

typedef const cs_shape *cs_shape_pointer;

#define CS_SHAPE_AT(scene, index) \
    cs_shape_of((scene)->triangles + (index), (scene)->triangle_steps + (index), (scene)->time)

#else

/* A number of a triangle: the same for all lanes. */
typedef cs_f32 cs_shape_number;

typedef cs_triangle cs_shape;
typedef CS_GLOBAL const cs_triangle *cs_shape_pointer;

#define CS_SHAPE_AT(scene, index) (scene)->triangles[index]

#endif

#endif
