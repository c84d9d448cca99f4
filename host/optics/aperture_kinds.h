/* The parts of cs_optics_make. */
#ifndef CS_OPTICS_PARTS_H
#define CS_OPTICS_PARTS_H

#include "optics/optics.h"

/* Puts the filter's steps into the first CS_FILTER_STEPS floats of the table. */
clshear_status cs_filter_make(clshear_filter filter, float width_px, cs_optics_tables *tables,
                              cs_error *error);

/* Apertures that are tabulated, as rows of the table in optics.c. */
float cs_polygon_unit(const cs_view *camera);
clshear_status cs_polygon_make(const cs_view *camera, cs_optics_tables *tables, cs_error *error);
clshear_status cs_aperture_image_make(const cs_view *camera, cs_optics_tables *tables,
                                      cs_error *error);

#endif
