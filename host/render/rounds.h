/* Renders that may end early. With a progressive sampler all replicates grow together, in rounds:
 * after each the picture is that of a render with so many samples, evenly spread, and the variance
 * between the replicates tells its error. Other samplers draw replicate after replicate. Looks are
 * few, at doublings and where the promised noise is expected. */
#ifndef CS_RENDER_ROUNDS_H
#define CS_RENDER_ROUNDS_H

#include "render/render_job.h"

/* Refuses a job that shows no error, or shows it at its end only. Limits the samples that pilots
 * may spend. Does nothing for a job without rules. */
clshear_status cs_rounds_check(cs_job *job, cs_error *error);

/* Bytes of a pixel on the host: what rounds keep between looks, and what a look takes besides. Both
 * are 0 for jobs without rules. */
size_t cs_rounds_bytes(const cs_job *job);
size_t cs_rounds_look_bytes(const cs_job *job);

/* Draws rounds until a rule ends the job, or all samples are drawn. The job must have a rule. */
clshear_status cs_rounds_run(cs_job *job, cs_pass *pass, cs_error *error);

/* The states of pixels `first` ... , with what all rounds have drawn for them. */
clshear_status cs_rounds_read(const cs_job *job, size_t first, size_t count, cs_pixel *pixels,
                              cs_error *error);

/* Adds to the metadata which rule ended the render, the noise reached, and the samples per pixel
 * with which a promise that is not kept would be. */
clshear_status cs_rounds_describe(const cs_job *job, clshear_film *film);

/* Gives the pass what the last look has seen, for the progress callback. */
void cs_rounds_tell(const cs_job *job, cs_pass *pass);

void cs_rounds_free(cs_job *job);

#endif
