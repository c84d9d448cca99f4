/* What a film says of its view, by the standard attributes of OpenEXR. */
#ifndef CS_RENDER_VIEW_METADATA_H
#define CS_RENDER_VIEW_METADATA_H

#include "render/render_job.h"

/* Adds worldToCamera, worldToNDC and, unless lines of sight are parallel, screenWindowWidth: those
 * of the opening shutter. */
clshear_status cs_view_describe(const cs_job *job, clshear_film *film);

#endif
