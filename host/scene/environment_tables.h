/* The tables that an environment's directions are drawn by. */
#ifndef CS_SCENE_ENVIRONMENT_TABLES_H
#define CS_SCENE_ENVIRONMENT_TABLES_H

#include "base/array.h"
#include "base/status.h"

/* Adds the tables that cs_lat_long_of says to `image`, which holds width x height texels. Cells:
 * `across` in a row, and `down` rows; all have as many texels. */
clshear_status cs_environment_tabulate(size_t width, size_t height, size_t across, size_t down,
                                       cs_array *image, cs_error *error);

#endif
