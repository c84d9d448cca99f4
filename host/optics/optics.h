/* Apertures and pixel filters as the kernels want them: constants and a table. */
#ifndef CS_OPTICS_OPTICS_H
#define CS_OPTICS_OPTICS_H

#include "base/array.h"
#include "base/status.h"
#include "clshear/device/camera.h"
#include "optics/view.h"

typedef struct cs_optics_tables {
    cs_optics optics;
    cs_array table; /* cs_f32: filter, then profiles (cl/clshear/device/marginal.h) */
} cs_optics_tables;

/* Filter of `width_px` (0: its usual width) and the camera's aperture. Start from zeros. */
clshear_status cs_optics_make(const cs_view *camera, clshear_filter filter, float width_px,
                              cs_optics_tables *tables, cs_error *error);
void cs_optics_free(cs_optics_tables *tables);

/* One unit of the lens coordinates as a multiple of the lens radius. */
float cs_optics_unit(const cs_view *camera);

/* Side of the square around the aperture in units of the lens coordinates: 1 for squares and
 * images, more for disks and polygons. */
float cs_lens_extent(const cs_view *view);

#endif
