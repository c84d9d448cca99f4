/* The samples of a few blocks, gathered before they are merged into the pixel. Device only. */
#ifndef CS_KERNELS_ACCUMULATOR_H
#define CS_KERNELS_ACCUMULATOR_H

#include "clshear/device/packet.h"
#include "clshear/device/stats.h"
#include "kernels/pixel.h"

/* Sums of deviations from a shift near the mean: neither the mean nor the variance cancels. */
typedef struct cs_accumulator {
    cs_f32 shift[3];
    cs_vfloat sum[3];
    cs_vfloat square[3];
    cs_vfloat count;
    cs_vfloat shadow_rays;
} cs_accumulator;

/* The shift has 16 significant bits, so that its product with a count is exact. */
static inline cs_f32 cs_shift_near(cs_vfloat values, cs_vfloat count)
{
    cs_f32 mean = cs_reduce_add(values) / cs_max(cs_reduce_add(count), 1.0f);
    return as_float(as_uint(mean) & 0xffffff00u);
}

static inline void cs_accumulator_add(cs_accumulator *accumulator, const cs_vfloat *radiance,
                                      cs_vfloat shadow_rays, cs_vint active, int first)
{
    cs_vfloat one = active ? (cs_vfloat)(1.0f) : (cs_vfloat)(0.0f);
    if (first) {
        accumulator->count = (cs_vfloat)(0.0f);
        accumulator->shadow_rays = (cs_vfloat)(0.0f);
    }
    for (int c = 0; c < 3; c++) {
        if (first) {
            accumulator->shift[c] = cs_shift_near(active ? radiance[c] : (cs_vfloat)(0.0f), one);
            accumulator->sum[c] = (cs_vfloat)(0.0f);
            accumulator->square[c] = (cs_vfloat)(0.0f);
        }
        cs_vfloat deviation = active ? radiance[c] - accumulator->shift[c] : (cs_vfloat)(0.0f);
        accumulator->sum[c] += deviation;
        accumulator->square[c] = fma(deviation, deviation, accumulator->square[c]);
    }
    accumulator->count += one;
    accumulator->shadow_rays += shadow_rays;
}

static inline void cs_merge_channel(CS_GLOBAL cs_pixel *pixel, int c, cs_f32 count, cs_f32 shift,
                                    cs_f32 sum, cs_f32 square)
{
    cs_exact_sum total = {pixel->sum[c], pixel->carry[c]};
    total = cs_exact_add(cs_exact_add(total, shift * count), sum);
    pixel->sum[c] = total.sum;
    pixel->carry[c] = total.carry;

    cs_moments all = {(cs_f32)pixel->samples, pixel->sample_mean[c], pixel->sample_m2[c]};
    cs_moments these = {count, shift + sum / count, cs_max(square - sum * sum / count, 0.0f)};
    all = cs_moments_merge(all, these);
    pixel->sample_mean[c] = all.mean;
    pixel->sample_m2[c] = all.m2;
}

static inline void cs_accumulator_merge(CS_GLOBAL cs_pixel *pixel,
                                        const cs_accumulator *accumulator)
{
    cs_f32 count = cs_reduce_add(accumulator->count);
    if (count == 0.0f) return;
    for (int c = 0; c < 3; c++)
        cs_merge_channel(pixel, c, count, accumulator->shift[c], cs_reduce_add(accumulator->sum[c]),
                         cs_reduce_add(accumulator->square[c]));
    pixel->samples += (cs_u32)count;
    pixel->pending += (cs_u32)count;
    pixel->shadow_rays += (cs_u32)cs_reduce_add(accumulator->shadow_rays);
}

#endif
