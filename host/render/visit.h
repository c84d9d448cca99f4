/* Visits of the host to what the pixels of a job have gathered on the device. */
#ifndef CS_RENDER_VISIT_H
#define CS_RENDER_VISIT_H

#include "base/status.h"
#include "kernels/pixel.h"

struct cs_job;

/* What is done in a visit. `apply` gets `user` and the pixel's number in the window, row by row. */
typedef struct cs_visit {
    void (*apply)(struct cs_job *job, void *user, size_t index, cs_pixel *pixel);
    void *user;
    int changes; /* whether pixels are written back */
} cs_visit;

/* Visits every pixel of the job in order, some thousands in memory at a time. Fails when out of
 * memory or where the device cannot be read or written. */
clshear_status cs_visit_pixels(struct cs_job *job, const cs_visit *visit, cs_error *error);

#endif
