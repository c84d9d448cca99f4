/* A point of the pixel and the lens, and the blur that a shear stands for. */
#ifndef CLSHEAR_DEVICE_CAMERA_SAMPLE_H
#define CLSHEAR_DEVICE_CAMERA_SAMPLE_H

#include "packet.h"

#include "fp_contract_off.h"

/* Pixel coordinates in [0, 1), centred lens coordinates; or the tuple in [0, 1)^4 that they are
 * made from. */
typedef struct cs_camera_sample {
    cs_vfloat x;
    cs_vfloat y;
    cs_vfloat u;
    cs_vfloat v;
} cs_camera_sample;

/* Blurs below this are in focus: the pixel's own width hides them, and the maps divide by them. */
#define CS_LEAST_BLUR 1e-5f

/* Widths of the blur along both axes, pixels per unit of the lens coordinates, above 0. */
typedef struct cs_blur {
    cs_f32 x;
    cs_f32 y;
    cs_f32 sign; /* of the shear */
} cs_blur;

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
