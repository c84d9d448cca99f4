/* Which pixels of a render show the background alone. */
#ifndef CS_RENDER_BACKGROUND_H
#define CS_RENDER_BACKGROUND_H

#include "render/render_job.h"

/* Marks by 1 in `certain`, else 0, the pixels of the job's window, row by row, that have the same
 * radiance all over pixel, lens and shutter: the background is constant, and no surface that the
 * prepass has met reaches them, by its blur, its motion or the pixel filter. What the prepass has
 * overlooked costs noise, not bias. The job must have its depths and velocities. */
clshear_status cs_background_find(const cs_job *job, uint8_t *certain, cs_error *error);

#endif
