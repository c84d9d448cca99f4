/* Polygons into triangles. */
#ifndef CS_IMPORT_POLYGON_H
#define CS_IMPORT_POLYGON_H

#include "import/model.h"

/* Cuts a polygon of 3 corners or more into `count` - 2 triangles, as places in `corners`: by ears,
 * so that it may be concave, in the plane that fits it best. One that crosses itself is cut
 * somehow, and so is the rest once `budget`, which counts the points looked at, is used up: no file
 * can take for ever. */
void cs_polygon_cut(const double (*positions)[3], const cs_corner *corners, size_t count,
                    double *budget, uint32_t *triangles);

#endif
