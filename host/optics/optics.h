/* Apertures and pixel filters as the kernels want them: constants and a table. */
#ifndef CS_OPTICS_OPTICS_H
#define CS_OPTICS_OPTICS_H

#include "base/array.h"
#include "base/status.h"
#include "clshear/clshear.h"
#include "clshear/device/camera.h"

typedef struct cs_optics_tables {
    cs_optics optics;
    cs_array table; /* cs_f32: filter, then profiles (cl/clshear/device/marginal.h) */
} cs_optics_tables;

/* Filter of `width_px` (0: its usual width) and the camera's aperture. Start from zeros. */
clshear_status cs_optics_make(const clshear_camera *camera, clshear_filter filter, float width_px,
                              cs_optics_tables *tables, cs_error *error);
void cs_optics_free(cs_optics_tables *tables);

/* One unit of the lens coordinates as a multiple of the lens radius. */
float cs_optics_unit(const clshear_camera *camera);

/* "disk", "polygon", ... and "box", "tent", ...; NULL for others. */
const char *cs_aperture_name(clshear_aperture aperture);
const char *cs_filter_name(clshear_filter filter);

#endif
