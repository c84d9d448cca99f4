/* The state of a pixel while its samples are drawn. Shared. */
#ifndef CS_KERNELS_PIXEL_H
#define CS_KERNELS_PIXEL_H

#include "clshear/device/stats.h"

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
    cs_u32 shadow_rays; /* of all pixels of the pools that begin with this one */
} cs_pixel;
CS_SHARED_WORDS(cs_pixel, 25);

/* Turns a complete pattern into one more independent estimate of the pixel. */
static inline void cs_finish_pattern(CS_GLOBAL cs_pixel *pixel)
{
    cs_f32 patterns = (cs_f32)pixel->patterns;
    for (int c = 0; c < 3; c++) {
        cs_f32 mean = (pixel->sum[c] + pixel->carry[c]) / (cs_f32)pixel->pending;
        cs_exact_sum means = {pixel->pattern_sum[c], pixel->pattern_carry[c]};
        cs_f32 before = means.sum / (patterns > 1.0f ? patterns : 1.0f);
        cs_moments moments = {patterns, before, pixel->pattern_m2[c]};
        pixel->pattern_m2[c] = cs_moments_add(moments, mean).m2;
        means = cs_exact_add(means, mean);
        pixel->pattern_sum[c] = means.sum;
        pixel->pattern_carry[c] = means.carry;
        pixel->sum[c] = 0.0f;
        pixel->carry[c] = 0.0f;
    }
    pixel->patterns++;
    pixel->pending = 0u;
}

#endif
