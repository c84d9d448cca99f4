/* AOVs of a render: from the settings to planes on the device, and from these to channels. */
#ifndef CS_RENDER_AOV_H
#define CS_RENDER_AOV_H

#include "render/render_job.h"

/* The planes that the settings ask for: a set of CS_PLANE_ numbers. Position and depth are means
 * over the samples that see a surface, and bring the coverage with them. */
cs_u32 cs_aov_planes(const clshear_settings *settings);
size_t cs_aov_count(cs_u32 planes);

/* CS_FEATURE_ bits of the variant that draws the picture. */
cs_u32 cs_aov_features(const cs_job *job);

/* Refuses a film to continue that lacks the job's AOVs. */
clshear_status cs_aov_check(const cs_job *job, cs_error *error);

/* Puts the sums of the film that is continued on the device. */
clshear_status cs_aov_load(cs_job *job, cs_error *error);

/* Adds the channels to the film. samples: of each pixel. */
clshear_status cs_aov_resolve(const cs_job *job, const float *samples, clshear_film *film,
                              cs_error *error);

#endif
