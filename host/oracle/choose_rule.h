/* What a pilot render says: which shear suits a pixel, and how many samples it deserves. Pure
 * statistics; the pilot's samples are traced and thrown away by the floor above. */
#ifndef CS_ORACLE_PILOT_H
#define CS_ORACLE_PILOT_H

#include "base/status.h"
#include "oracle/oracle.h"

/* Evidence on one candidate: variances of small patterns with its shear and, drawn with the same
 * random numbers, with the prior's; both where the pilot looked and the shears differ, else
 * negative. A value for each pixel of the window. */
typedef struct cs_evidence {
    const cs_f32 *variance;
    const cs_f32 *prior;
} cs_evidence;

/* Chooses a rule for every pixel. `evidence` has an entry for each rule; that of `prior` is not
 * looked at. The ratio of variances is taken over the evidence in a window of `radius` pixels
 * around the pixel, drawn towards that of the whole picture where the window holds little, and must
 * be clear before the prior is given up. Fails when out of memory. */
clshear_status cs_pilot_choose(const cs_evidence *evidence, cs_rule prior, int width, int height,
                               int radius, uint8_t *rules, cs_error *error);

/* What a pilot saw of each pixel: `replicates` patterns of `pattern` samples. */
typedef struct cs_pilot_picture {
    const cs_f32 *variance; /* of a pattern's mean */
    const cs_f32 *intensity;
    int width;
    int height;
    cs_u32 pattern;
    cs_u32 replicates;
} cs_pilot_picture;

/* Numbers of samples for a mean of at most `mean` a pixel, powers of two between a 16th (4 where
 * that is less, if the mean is not) and 16 times the mean or `limit`: in proportion to (V (1/A +
 * W/10B))^0.4, which is best where variance falls as N^-1.5. V is the pixel's variance with equal
 * samples, smoothed over 3 x 3 pixels, and a part of its squared contrast with them: what differs
 * there may reach into the pixel where the pilot did not look. W = 1/(I^2 + e^2) weights it for the
 * relative error, with e a hundredth of the mean of the intensity I; A and B are the sums of V and
 * V W: absolute error first, and relative error not forgotten. */
clshear_status cs_allocate_samples(const cs_pilot_picture *pilot, cs_u32 mean, cs_u32 limit,
                                   cs_u32 *samples, cs_error *error);

#endif
