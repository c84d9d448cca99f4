/* The camera and the samples of a moving scene. Device only. Without the feature MOTION only the
 * camera at rest.
 *
 * A sample's time comes beside its tuple. Samplers that stratify film and lens together give it
 * their third coordinate; the place on the fibre then has the fourth and one from beside, which
 * for `sobol` is the fifth of the same net. The others have pairs anyway, and the time is one more.
 */
#ifndef CS_KERNELS_MOTION_H
#define CS_KERNELS_MOTION_H

#include "clshear/device/lens.h"
#include "clshear/device/motion.h"
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

enum {
    CS_KEY_TIME = 0x74696d65 /* of the pair beside the tuple, apart from the keys of a pattern */
};

/* Whether the sampler stratifies film and lens together, not in pairs. */
static inline int cs_is_joint(cs_u32 sampler)
{
    return sampler == (cs_u32)CS_SAMPLER_SOBOL || sampler == (cs_u32)CS_SAMPLER_SZ ||
           sampler == (cs_u32)CS_SAMPLER_HALTON || sampler == (cs_u32)CS_SAMPLER_RANK1;
}

/* The time's number of a tuple, in [0, 1); the tuple's lens pair may change. key: of the pattern.
 * has_light: whether the slot of lights is taken; else the time may use its numbers. */
static inline cs_vfloat cs_draw_time(const cs_pattern *pattern, cs_sample_table table, cs_u32 key,
                                     cs_vuint index, int has_light, cs_camera_sample *tuple)
{
    cs_pair beside;
    if (has_light)
        beside = cs_draw_padding(pattern, table, cs_key(key, CS_KEY_TIME), index, CS_SLOT_LIGHT);
    else
        beside = cs_draw_extra(pattern, table, key, index, CS_SLOT_LIGHT);
    if (!cs_is_joint(pattern->sampler)) return beside.x;
    cs_vfloat time = tuple->u;
    tuple->u = tuple->v;
    tuple->v = beside.x;
    return time;
}

#else

typedef cs_camera cs_eye;

#endif

#endif
