/* Continuing a render, and keeping the means of its patterns. Everything here does nothing for a
 * job that neither extends one nor is to be extended nor keeps patterns. */
#ifndef CS_RENDER_RESUME_H
#define CS_RENDER_RESUME_H

#include "render/render_job.h"

/* What messages call the picture that a job extends: its path, if it was read from a file. */
const char *cs_resume_name(const cs_job *job);

/* Whether the job continues the picture it is to extend; makes its pattern begin where that one's
 * ends. */
clshear_status cs_resume_check(cs_job *job, cs_error *error);

/* Room for the means of the patterns, which an extension needs one by one. */
clshear_status cs_resume_prepare(cs_job *job, cs_error *error);

/* Channels of the film for them, and bytes of a pixel that are held until then. */
size_t cs_resume_channels(const cs_job *job);
size_t cs_resume_bytes(const cs_job *job);
void cs_resume_free(cs_job *job);

/* Before and after the samples of a replicate are drawn. */
clshear_status cs_resume_begin(cs_job *job, uint32_t replicate, cs_error *error);
clshear_status cs_resume_end(cs_job *job, uint32_t replicate, cs_error *error);

/* Sum of the samples that a pixel has in the extended picture in replicates that have not begun: an
 * interrupted extension must not lose them. 0 for a job that extends nothing. */
double cs_resume_missing(const cs_job *job, size_t index, int colour);

/* Adds to the film what its extension needs, unless the render was interrupted. */
clshear_status cs_resume_describe(const cs_job *job, clshear_film *film);

#endif
