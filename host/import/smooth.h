/* Normals for triangles whose file has none. */
#ifndef CS_IMPORT_SMOOTH_H
#define CS_IMPORT_SMOOTH_H

#include "import/model.h"

/* Gives the corners without a normal one: the mean over the triangles of the same smoothing group
 * that share the vertex in the file, weighted by their angle there; group 0 stays flat. With
 * `degrees` of 0 or more: the mean over the triangles around the position whose planes differ by
 * less than that, whatever their group and vertices; positions are the same when they are equal. */
clshear_status cs_model_smooth(cs_model *model, double degrees, cs_error *error);

#endif
