/* Evaluation of a pilot render: the shear rule and the sample count of each pixel. This code is
 * pure statistics; the renderer traces the pilot's samples and discards them. */
#ifndef CS_ORACLE_CHOOSE_RULE_H
#define CS_ORACLE_CHOOSE_RULE_H

#include "base/status.h"
#include "oracle/oracle.h"

/* Evidence on one candidate rule: variances of small patterns with its shear and with the prior's,
 * from the same random numbers. One value per pixel of the window; negative for pixels that the
 * pilot skipped or where the two shears agree. */
typedef struct cs_evidence {
    const cs_f32 *variance;
    const cs_f32 *prior;
} cs_evidence;

/* Chooses a rule for every pixel. `evidence` has an entry for each rule; the entry of `prior` is
 * not read. A candidate is judged by its ratio of variances to the prior, over the evidence within
 * `radius` pixels, shrunk towards the ratio of the whole picture if there is little evidence. It
 * replaces the prior if the ratio is clearly below 1. Fails when out of memory. */
clshear_status cs_pilot_choose(const cs_evidence *evidence, cs_rule prior, int width, int height,
                               int radius, uint8_t *rules, cs_error *error);

/* What is known of each pixel of a window before samples are shared out, from `replicates` patterns
 * of `pattern` samples. */
typedef struct cs_pilot_picture {
    const cs_f32 *variance;  /* of a pattern's mean, averaged over colours */
    const cs_f32 *intensity; /* mean over colours */
    /* The same, as a pixel's neighbours see it. The same arrays, unless a part of a pixel's samples
     * must not decide how many it gets: these lack that part, which neighbours may know. */
    const cs_f32 *near_variance;
    const cs_f32 *near_intensity;
    const cs_f32 *shear_px; /* width of the blur of what is seen there, with a sign */
    int width;
    int height;
    cs_u32 pattern;
    cs_u32 replicates;
} cs_pilot_picture;

/* The largest power of two up to `count` (1 or more). */
cs_u32 cs_power_of_two(cs_u32 count);

/* Samples that a pixel may have. */
typedef struct cs_range {
    cs_u32 least; /* a power of two, at most `mean` */
    cs_u32 mean;  /* over the picture */
    cs_u32 most;  /* that the sampler has; nothing above 16 times the mean is used */
} cs_range;

/* Chooses a power of two of samples for each pixel, within a range. Their mean is at most
 * range->mean, or about that where neighbours see other values: what all pixels have in common is
 * computed from `variance` and `intensity` alone.
 *
 * Counts are proportional to (V (1/A + W/2B))^0.4, which is optimal if variance falls as N^-1.5. V
 * is the pixel's variance with equal samples, averaged over 3 x 3 pixels, plus a part of its
 * squared contrast with these pixels, because a neighbouring feature may reach into unsampled parts
 * of the pixel, and with those, up to 5 pixels away, whose blur may. W = 1/(I^2 + e^2) turns V into
 * relative error; I is the intensity averaged over 3 x 3 pixels and e a hundredth of the picture's.
 * A and B are the sums of V and V W. The absolute error thus dominates, and the relative error
 * still counts. */
clshear_status cs_allocate_samples(const cs_pilot_picture *pilot, const cs_range *range,
                                   cs_u32 *samples, cs_error *error);

#endif
