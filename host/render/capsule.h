/* A render's launches, recorded into the file that the setting RECORD names. */
#ifndef CS_RENDER_CAPSULE_H
#define CS_RENDER_CAPSULE_H

#include "device/recorder.h"
#include "render/render_job.h"

/* Records from here on; leaves NULL where the setting is not given. */
clshear_status cs_capsule_begin(const cs_job *job, cs_recorder **recorder, cs_error *error);

/* Writes down the film that the launches have made, and ends the file. The recorder is NULL then.
 */
clshear_status cs_capsule_end(const cs_job *job, cs_recorder **recorder, cs_error *error);

#endif
