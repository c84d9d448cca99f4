/* Normals for triangles whose file has none. */
#ifndef CS_IMPORT_SMOOTH_H
#define CS_IMPORT_SMOOTH_H

#include "import/model.h"

/* Gives the corners without a normal one: the mean over the triangles around that are of the same
 * smoothing group, weighted by their angle there. With `degrees` of 0 or more, over the triangles
 * whose planes differ by less than that, whatever their group. Group 0 stays flat otherwise.
 * Positions count as the same when they are equal. */
clshear_status cs_model_smooth(cs_model *model, double degrees, cs_error *error);

#endif
