/* A point of the pixel and the lens, a time with it, and the blur that a shear stands for. */
#ifndef CLSHEAR_DEVICE_CAMERA_SAMPLE_H
#define CLSHEAR_DEVICE_CAMERA_SAMPLE_H

#include "packet.h"

#include "fp_contract_off.h"

/* A point of the pixel and a point of the lens. */
typedef struct cs_camera_sample {
    cs_vfloat x; /* pixels from the pixel's left edge; wide filters reach below 0 and beyond 1 */
    cs_vfloat y; /* pixels from the pixel's upper edge, likewise */
    cs_vfloat u; /* lens coordinate to the right, 0 in the middle (camera.h) */
    cs_vfloat v; /* lens coordinate down, 0 in the middle */
} cs_camera_sample;

/* Velocity of a surface on the film, pixels while the shutter is open. */
typedef struct cs_velocity {
    cs_f32 x;
    cs_f32 y;
} cs_velocity;

/* A point of pixel and lens, and a time of the shutter, 0 where it opens and 1 where it closes. */
typedef struct cs_moving_sample {
    cs_camera_sample point;
    cs_vfloat time;
} cs_moving_sample;

/* Motion, in pixels while the shutter is open, below which a surface counts as at rest. */
#define CS_LEAST_MOTION 1e-3f

/* Blur, in pixels, below which a surface counts as in focus: the pixel's own width hides it, and
 * the maps divide by it. */
#define CS_LEAST_BLUR 1e-5f

/* The blur that a shear stands for. */
typedef struct cs_blur {
    cs_f32 x;    /* width along x, pixels per lens unit, CS_LEAST_BLUR or more */
    cs_f32 y;    /* width along y, likewise */
    cs_f32 sign; /* 1 or -1, the sign of the shear */
} cs_blur;

/* shear: signed circle of confusion, pixels per unit of v, finite. squeeze: of the cs_optics. */
static inline cs_blur cs_blur_of(cs_f32 shear, cs_f32 squeeze)
{
    cs_blur blur;
    blur.sign = shear < 0.0f ? -1.0f : 1.0f;
    blur.y = blur.sign * shear;
    blur.x = cs_max(blur.y * squeeze, CS_LEAST_BLUR);
    blur.y = cs_max(blur.y, CS_LEAST_BLUR);
    return blur;
}

#include "fp_contract_restore.h"

#endif
