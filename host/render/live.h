/* The picture while it is rendered: in a viewer (CLSHEAR_DISPLAY), in a file (CLSHEAR_PREVIEW), and
 * where the caller wants it (clshear_settings_set_preview). Nothing that fails here ends the
 * render; it is told once. */
#ifndef CS_RENDER_LIVE_H
#define CS_RENDER_LIVE_H

#include "render/render_job.h"

/* Whether the settings can be obeyed; connects to the viewer. */
clshear_status cs_live_begin(cs_job *job, cs_error *error);

/* Between two launches: shows what is due. */
clshear_status cs_live_update(cs_job *job, cs_error *error);

/* Shows the picture that the render has made. */
void cs_live_end(cs_job *job, clshear_film *film);

void cs_live_free(cs_job *job);

#endif
