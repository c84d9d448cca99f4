/* The filter and the tabulated apertures that cs_optics_make puts together. */
#ifndef CS_OPTICS_APERTURE_KINDS_H
#define CS_OPTICS_APERTURE_KINDS_H

#include "optics/optics.h"

/* Writes the filter's density on CS_FILTER_STEPS steps to the start of the table, and its
 * constants. */
clshear_status cs_filter_make(clshear_filter filter, float width_px, cs_optics_tables *tables,
                              cs_error *error);

/* Size and marginals of the tabulated apertures; entries of `apertures` in optics.c. */
float cs_polygon_unit(const cs_view *camera);
clshear_status cs_polygon_make(const cs_view *camera, cs_optics_tables *tables, cs_error *error);
clshear_status cs_aperture_image_make(const cs_view *camera, cs_optics_tables *tables,
                                      cs_error *error);

#endif
