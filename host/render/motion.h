/* Motion of a render: cameras of its shutter, velocities of its pixels. */
#ifndef CS_RENDER_MOTION_H
#define CS_RENDER_MOTION_H

#include "render/render_job.h"

/* The shutter of the settings. */
cs_shutter cs_motion_shutter(const cs_job *job);

/* The velocity for a shear, whose time is a part of the exposure and even, from one in pixels while
 * the shutter is open: as in the middle of a trapezoid. */
cs_velocity cs_motion_exposed(const cs_job *job, cs_velocity velocity);

/* Makes the cameras of the shutter from `view`, the camera where it opens. The job's camera must be
 * complete. Sets job->moves. */
clshear_status cs_motion_begin(cs_job *job, const cs_view *view, cs_error *error);

/* Finds the velocities of all pixels, if anything moves. */
clshear_status cs_motion_find(cs_job *job, cs_error *error);

/* The velocities by which pixels are sheared, as a buffer for the kernels: 0 where the rule has
 * none. rules: one for each pixel. *buffer stays NULL where nothing moves. */
clshear_status cs_motion_upload(const cs_job *job, const uint8_t *rules, cs_buffer **buffer,
                                cs_error *error);

/* Adds the channels Velocity.X and Velocity.Y to the film of what moves. */
clshear_status cs_motion_resolve(const cs_job *job, clshear_film *film, cs_error *error);

#endif
