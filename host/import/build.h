/* From a model to a scene. */
#ifndef CS_IMPORT_BUILD_H
#define CS_IMPORT_BUILD_H

#include "import/model.h"

/* Fills an empty scene. Reports what is repaired, left out or not supported to the model's log. The
 * model's pools may grow. `smooth_degrees`: as cs_model_smooth. */
clshear_status cs_model_build(cs_model *model, double smooth_degrees, cs_scene *scene,
                              cs_error *error);

#endif
