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

/* Statistics of the pilot for each pixel, from `replicates` patterns of `pattern` samples. */
typedef struct cs_pilot_picture {
    const cs_f32 *variance; /* variance of a pattern's mean */
    const cs_f32 *intensity;
    int width;
    int height;
    cs_u32 pattern;
    cs_u32 replicates;
} cs_pilot_picture;

/* Chooses a power of two of samples for each pixel, with a mean of at most `mean`. The counts lie
 * between mean / 16 (at least 4, or `mean` if it is smaller) and 16 * mean or `limit`.
 *
 * Counts are proportional to (V (1/A + W/10B))^0.4, which is optimal if variance falls as N^-1.5. V
 * is the pixel's variance with equal samples, averaged over 3 x 3 pixels, plus a part of its
 * squared contrast with these pixels, because a neighbouring feature may reach into unsampled parts
 * of the pixel. W = 1/(I^2 + e^2) turns V into relative error; I is the intensity and e a hundredth
 * of its mean. A and B are the sums of V and V W. The absolute error thus dominates, and the
 * relative error still counts. */
clshear_status cs_allocate_samples(const cs_pilot_picture *pilot, cs_u32 mean, cs_u32 limit,
                                   cs_u32 *samples, cs_error *error);

#endif
