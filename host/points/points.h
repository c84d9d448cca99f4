/* What the files of this folder share about point sets. */
#ifndef CS_POINTS_POINTS_H
#define CS_POINTS_POINTS_H

#include "base/status.h"

/* Allocates `values` for the sets, count and dimensions that are set. */
clshear_status cs_points_reserve(clshear_points *points, cs_error *error);

/* Names of up to six coordinates. */
#define CS_POINT_NAMES "xyuvpq"

#endif
