/* How a picture's samples are shared out between its pixels. This code is pure statistics; the
 * renderer draws what it is told. */
#ifndef CS_ORACLE_ALLOCATE_H
#define CS_ORACLE_ALLOCATE_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"
#include "clshear/device/dialect.h"

/* What is known of each pixel of a window before samples are shared out, row by row. */
typedef struct cs_pilot_picture {
    const cs_f32 *variance;  /* about that of the mean of a pattern, averaged over colours; */
                             /* negative: nothing is known, which only cs_allocate_gain allows */
    const cs_f32 *intensity; /* mean over colours */
    /* The same, as a pixel's neighbours see it. The same arrays, unless a part of a pixel's samples
     * must not decide how many it gets: these lack that part, which neighbours may know. */
    const cs_f32 *near_variance;
    const cs_f32 *near_intensity;
    const uint8_t *certain; /* 1: the pixel has the same radiance all over, see certain.h */
    int width;
    int height;
    cs_u32 pattern;    /* samples that `variance` is of */
    cs_u32 replicates; /* patterns that `intensity` is the mean of */
} cs_pilot_picture;

/* Samples that a pixel may have: what follows, and powers of two between. */
typedef struct cs_range {
    cs_u32 certain; /* of a certain pixel */
    cs_u32 least;   /* of a bright one */
    cs_u32 even;    /* that all have if nothing is gained by less: the mean, or a count below it */
    cs_u32 mean;    /* over the picture */
    cs_u32 most;    /* that the sampler has; nothing above 16 times the mean is used */
} cs_range;

/* The largest power of two up to `count` (1 or more). */
cs_u32 cs_power_of_two(cs_u32 count);

/* Chooses the samples of each pixel within a range. Their mean is at most range->mean, or about
 * that where neighbours see other values: what all pixels have in common is computed from
 * `variance` and `intensity` alone. Fails when out of memory.
 *
 * Certain pixels get the fewest, and what they leave goes to the others. Of these none gets less
 * than `even`, so that none is worse than with equal samples, whatever the pilot has overlooked;
 * but where less than `even` in bright pixels promises a gain of 3 % at least, in the root of the
 * product of absolute and relative error, and neither of them to rise, these may get `least`. Dark
 * ones may not: half the picture's mean intensity or less can hide a rare bright sample that
 * decides the relative error.
 *
 * Counts are proportional to (V (1/A + k W/B))^0.4, which is optimal if variance falls as N^-1.5. k
 * is 1, or 0.3 or 0.1 where bright pixels may get less with it and may not with 1. V is the pixel's
 * variance with equal samples, averaged over 3 x 3 pixels, plus a part of its
 * squared contrast with these pixels, because a neighbouring feature may reach into unsampled parts
 * of the pixel. W = 1/(I^2 + e^2) turns V into relative error; I is the intensity averaged over
 * 3 x 3 pixels and e a hundredth of the picture's. A and B are the sums of V and V W. */
clshear_status cs_allocate_samples(const cs_pilot_picture *pilot, const cs_range *range,
                                   cs_u32 *samples, cs_error *error);

/* How much less error that promises than as many samples for each pixel: a ratio of variances, the
 * root of the product of absolute and relative ones; 1 where there is no variance. Fails when out
 * of memory. */
clshear_status cs_allocate_gain(const cs_pilot_picture *pilot, const cs_range *range, double *gain,
                                cs_error *error);

/* Bytes that it takes for each pixel while it runs. */
size_t cs_allocate_bytes(void);

#endif
