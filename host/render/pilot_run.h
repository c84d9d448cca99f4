/* A small render of some pixels that is thrown away. */
#ifndef CS_RENDER_PILOT_RUN_H
#define CS_RENDER_PILOT_RUN_H

#include "render/render_job.h"

/* Where a pilot's results go, for each pixel of the window: negative where it did not look. */
typedef struct cs_outcome {
    cs_f32 *variance; /* of a pattern's mean, averaged over colours */
    cs_f32 *intensity;
} cs_outcome;

/* How the pixels of a pilot are sheared. */
typedef struct cs_trial {
    const cs_f32 *shears;
    const uint8_t *rules; /* which say whether the velocity counts */
} cs_trial;

/* Renders `replicates` patterns of `samples` for the listed pixels (NULL: all), with random numbers
 * of their own. With one replicate the variance is that of independent samples. */
clshear_status cs_pilot_run(cs_job *job, const cs_trial *how, const cs_u32 *list, size_t count,
                            cs_u32 samples, cs_u32 replicates, const cs_outcome *result,
                            cs_error *error);

#endif
