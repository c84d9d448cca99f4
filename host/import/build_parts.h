/* The parts of a scene besides its triangles, made from a model. */
#ifndef CS_IMPORT_BUILD_PARTS_H
#define CS_IMPORT_BUILD_PARTS_H

#include "import/model.h"

/* Materials with their textures; triangles without a material get the model's default, mid-grey. */
clshear_status cs_build_materials(cs_model *model, cs_scene *scene, cs_error *error);

/* Reports the materials whose texture is not seen on `plain` triangles each, for want of texture
 * coordinates. */
void cs_report_plain(const cs_model *model, const size_t *plain);

/* Lights and cameras, relative to the scene's origin. */
clshear_status cs_build_lights(const cs_model *model, cs_scene *scene, cs_error *error);
clshear_status cs_build_cameras(const cs_model *model, cs_scene *scene, cs_error *error);

#endif
