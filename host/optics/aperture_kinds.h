/* The two parts of cs_optics_make. */
#ifndef CS_OPTICS_PARTS_H
#define CS_OPTICS_PARTS_H

#include "optics/optics.h"

/* Puts the filter's steps into the first CS_FILTER_STEPS floats of the table. */
clshear_status cs_filter_make(clshear_filter filter, float width_px, cs_optics_tables *tables,
                              cs_error *error);

/* Append the profiles of a polygon or an image. */
clshear_status cs_polygon_make(int blades, float rotation_deg, cs_optics_tables *tables,
                               cs_error *error);
clshear_status cs_aperture_image_make(const cs_aperture_image *image, cs_optics_tables *tables,
                                      cs_error *error);

#endif
