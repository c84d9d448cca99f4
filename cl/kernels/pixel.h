/* The state of a pixel while its samples are drawn. Shared. */
#ifndef CS_KERNELS_PIXEL_H
#define CS_KERNELS_PIXEL_H

#include "clshear/device/dialect.h"

/* What one pixel has gathered. Channels are linear Rec.709 radiance. */
typedef struct cs_pixel {
    cs_f32 sum[3]; /* of the unfinished pattern, with what rounding lost in `carry` */
    cs_f32 carry[3];
    cs_f32 pattern_sum[3]; /* of the means of finished patterns, likewise */
    cs_f32 pattern_carry[3];
    cs_f32 pattern_m2[3];  /* squared deviations of the pattern means */
    cs_f32 sample_mean[3]; /* of all samples */
    cs_f32 sample_m2[3];
    cs_u32 samples; /* of all patterns */
    cs_u32 pending; /* of the unfinished pattern */
    cs_u32 patterns;
    cs_u32 shadow_rays;
} cs_pixel;
CS_SHARED_WORDS(cs_pixel, 25);

#endif
