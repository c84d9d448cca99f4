/* Apertures and pixel filters in the kernels' form: constants and a table. */
#ifndef CS_OPTICS_OPTICS_H
#define CS_OPTICS_OPTICS_H

#include "base/array.h"
#include "base/status.h"
#include "clshear/device/camera.h"
#include "optics/view.h"

typedef struct cs_optics_tables {
    cs_optics optics;
    cs_array
        table; /* cs_f32: the filter's steps, then the marginals (cl/clshear/device/marginal.h) */
} cs_optics_tables;

/* Makes the tables of a filter of `width_px` (0: its usual width) and of the camera's aperture.
 * Initialise `tables` to zero; free it with cs_optics_free. */
clshear_status cs_optics_make(const cs_view *camera, clshear_filter filter, float width_px,
                              cs_optics_tables *tables, cs_error *error);
void cs_optics_free(cs_optics_tables *tables);

/* One unit of the lens coordinates, as a multiple of the lens radius. */
float cs_optics_unit(const cs_view *camera);

/* Side of the square around the aperture, in units of the lens coordinates: 1 for squares and
 * images, above 1 for disks and polygons. */
float cs_lens_extent(const cs_view *view);

#endif
