/* Pilots: small renders that are thrown away, before the samples that count are drawn. */
#ifndef CS_RENDER_PILOT_H
#define CS_RENDER_PILOT_H

#include "oracle/allocate.h"
#include "render/footprint.h"
#include "render/render_job.h"

/* Whether pilots choose the job's shears, or how many samples its pixels have. Need its settings
 * and its pattern. */
int cs_pilot_chooses_shears(const cs_job *job);
int cs_pilot_chooses_samples(const cs_job *job);

/* Bytes of a pixel that the job's pilots take: an upper bound, since it is not known before which
 * pixels they look at. */
cs_footprint cs_pilot_bytes(const cs_job *job);

/* Fills the job's rules and shears by trying candidates on part of the pixels: at most 7 % of the
 * render's samples. */
clshear_status cs_pilot_shears(cs_job *job, cs_error *error);

/* Shares the replicate's samples out among the pixels: `samples`, one for each, powers of two whose
 * mean is at most that of the job's pattern. Costs a sixteenth of the render's (an eighth of less
 * than 512), of which there must be CS_LEAST_SPP_TO_ALLOCATE a pixel. */
enum {
    CS_LEAST_SPP_TO_ALLOCATE = 128
};
clshear_status cs_pilot_samples(cs_job *job, cs_u32 *samples, cs_error *error);

/* How much less error sharing samples out within `range` promises (cs_allocate_gain), by a look at
 * 9 pixels in 144, at most about 9300 of them, but for those that are `certain`. */
clshear_status cs_pilot_promise(cs_job *job, const uint8_t *certain, const cs_range *range,
                                double *gain, cs_error *error);

/* Variance without shear over variance with the job's shears, of small patterns with the same
 * random numbers, each averaged over 5 x 5 pixels; a value for each pixel. Costs 256 samples a
 * pixel. */
clshear_status cs_pilot_gain(cs_job *job, cs_f32 *gain, cs_error *error);

#endif
