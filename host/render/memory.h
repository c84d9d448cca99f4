/* The memory that a render takes, known before it takes it. */
#ifndef CS_RENDER_MEMORY_H
#define CS_RENDER_MEMORY_H

#include "render/render_job.h"

/* What a job with its settings, pattern and window holds at its fullest: an upper bound for what
 * depends on the picture, without the scene and what is the same for all pictures, but with the
 * wide hierarchy of the scene where the job will make it. */
cs_memory cs_memory_of(const cs_job *job);

/* Says before the render when it does not fit: the system ends a program for that without a word,
 * when the memory is written to. */
void cs_memory_check(const cs_job *job);

#endif
