/* The camera of a moving scene. Device only. Without the feature MOTION only the camera at rest. */
#ifndef CS_KERNELS_MOTION_H
#define CS_KERNELS_MOTION_H

#include "clshear/device/lens.h"
#include "clshear/device/motion.h"
#include "clshear/device/sampler/time.h"
#include "kernels/launch.h"
#include "kernels/vector.h"

#if CS_HAS(MOTION)

/* A camera's place and axes at the lanes' times; the members are those of cs_camera. */
typedef struct cs_eye {
    cs_vfloat eye[3];
    cs_vfloat right[3];
    cs_vfloat down[3];
    cs_vfloat forward[3];
} cs_eye;

static inline void cs_unit_cross(const cs_vfloat *a, const cs_vfloat *b, cs_vfloat *product)
{
    for (int i = 0; i < 3; i++) {
        int j = (i + 1) % 3, k = (i + 2) % 3;
        product[i] = a[j] * b[k] - a[k] * b[j];
    }
    cs_vfloat scale = 1.0f / sqrt(cs_max(cs_dot(product, product), (cs_vfloat)(1e-36f)));
    for (int i = 0; i < 3; i++)
        product[i] *= scale;
}

/* The camera at a time of the shutter, 0 to 1. */
static inline cs_eye cs_eye_at(const cs_launch *launch, cs_vfloat time)
{
    const cs_camera_motion *motion = &launch->motion;
    cs_vfloat up[3];
    cs_eye at;
    for (int i = 0; i < 3; i++) {
        at.eye[i] = fma(time, (cs_vfloat)(motion->eye_step[i]), (cs_vfloat)(launch->camera.eye[i]));
        at.forward[i] =
            fma(time, (cs_vfloat)(motion->sight_step[i]), (cs_vfloat)(motion->sight[i]));
        up[i] = fma(time, (cs_vfloat)(motion->up_step[i]), (cs_vfloat)(motion->up[i]));
    }
    cs_vfloat scale = 1.0f / sqrt(cs_max(cs_dot(at.forward, at.forward), (cs_vfloat)(1e-36f)));
    for (int i = 0; i < 3; i++)
        at.forward[i] *= scale;
    cs_unit_cross(at.forward, up, at.right);
    cs_unit_cross(at.forward, at.right, at.down);
    return at;
}

/* As cs_lens_ray. */
static inline cs_ray cs_eye_ray(const cs_launch *launch, const cs_eye *at, cs_vfloat x, cs_vfloat y,
                                cs_vfloat u, cs_vfloat v)
{
    cs_lens_place place = cs_lens_place_of(&launch->camera, x, y, u, v);
    cs_ray ray;
    for (int i = 0; i < 3; i++) {
        ray.origin[i] =
            at->eye[i] + place.lens_right * at->right[i] + place.lens_down * at->down[i];
        ray.direction[i] = at->forward[i] + place.right * at->right[i] + place.down * at->down[i];
    }
    return ray;
}

#else

typedef cs_camera cs_eye;

#endif

#endif
