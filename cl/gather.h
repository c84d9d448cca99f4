/* The samples of a few blocks, gathered before they are merged into the pixel. Device only. */
#ifndef CS_GATHER_H
#define CS_GATHER_H

#include "packet.h"
#include "shared.h"
#include "stats.h"

/* Sums of deviations from a shift near the mean: neither the mean nor the variance cancels. */
typedef struct cs_gather {
    f32 shift[3];
    vfloat sum[3];
    vfloat square[3];
    vfloat count;
    vfloat shadow_rays;
} cs_gather;

/* The shift has 16 significant bits, so that its product with a count is exact. */
static inline f32 cs_shift_near(vfloat values, vfloat count)
{
    f32 mean = cs_reduce_add(values) / cs_max(cs_reduce_add(count), 1.0f);
    return as_float(as_uint(mean) & 0xffffff00u);
}

static inline void cs_gather_add(cs_gather *gather, const vfloat *radiance, vfloat shadow_rays,
                                 vint active, int first)
{
    vfloat one = active ? (vfloat)(1.0f) : (vfloat)(0.0f);
    if (first) {
        gather->count = (vfloat)(0.0f);
        gather->shadow_rays = (vfloat)(0.0f);
    }
    for (int c = 0; c < 3; c++) {
        if (first) {
            gather->shift[c] = cs_shift_near(active ? radiance[c] : (vfloat)(0.0f), one);
            gather->sum[c] = (vfloat)(0.0f);
            gather->square[c] = (vfloat)(0.0f);
        }
        vfloat deviation = active ? radiance[c] - gather->shift[c] : (vfloat)(0.0f);
        gather->sum[c] += deviation;
        gather->square[c] = fma(deviation, deviation, gather->square[c]);
    }
    gather->count += one;
    gather->shadow_rays += shadow_rays;
}

static inline void cs_merge_channel(CS_GLOBAL cs_pixel *pixel, int c, f32 count, f32 shift, f32 sum,
                                    f32 square)
{
    cs_exact_sum total = {pixel->sum[c], pixel->carry[c]};
    total = cs_exact_add(cs_exact_add(total, shift * count), sum);
    pixel->sum[c] = total.sum;
    pixel->carry[c] = total.carry;

    cs_moments all = {(f32)pixel->samples, pixel->sample_mean[c], pixel->sample_m2[c]};
    cs_moments these = {count, shift + sum / count, cs_max(square - sum * sum / count, 0.0f)};
    all = cs_moments_merge(all, these);
    pixel->sample_mean[c] = all.mean;
    pixel->sample_m2[c] = all.m2;
}

static inline void cs_merge_gather(CS_GLOBAL cs_pixel *pixel, const cs_gather *gather)
{
    f32 count = cs_reduce_add(gather->count);
    if (count == 0.0f) return;
    for (int c = 0; c < 3; c++)
        cs_merge_channel(pixel, c, count, gather->shift[c], cs_reduce_add(gather->sum[c]),
                         cs_reduce_add(gather->square[c]));
    pixel->samples += (u32)count;
    pixel->pending += (u32)count;
    pixel->shadow_rays += (u32)cs_reduce_add(gather->shadow_rays);
}

/* Turns a complete pattern into one more independent estimate of the pixel. */
static inline void cs_finish_pattern(CS_GLOBAL cs_pixel *pixel)
{
    f32 patterns = (f32)pixel->patterns;
    for (int c = 0; c < 3; c++) {
        f32 mean = (pixel->sum[c] + pixel->carry[c]) / (f32)pixel->pending;
        cs_exact_sum means = {pixel->pattern_sum[c], pixel->pattern_carry[c]};
        f32 before = means.sum / cs_max(patterns, 1.0f);
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
