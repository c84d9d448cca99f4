/* The parts of a scene besides its triangles, made from a model. */
#ifndef CS_IMPORT_BUILD_PARTS_H
#define CS_IMPORT_BUILD_PARTS_H

#include "import/model.h"

/* Materials with their textures; triangles without a material get the model's default, mid-grey. */
clshear_status cs_build_materials(cs_model *model, cs_scene *scene, cs_error *error);

/* Textures that were read: an array for cs_build_textures. */
cs_array cs_known_textures(void);

/* The textures of a material, read unless they are known. What cannot be read is reported. */
clshear_status cs_build_textures(const cs_model *model, cs_scene *scene,
                                 const cs_material_description *material, cs_array *known,
                                 cs_material_textures *textures, cs_error *error);

/* Reports the materials whose texture is not seen on `plain` triangles each, for want of texture
 * coordinates. */
void cs_report_plain(const cs_model *model, const size_t *plain);

/* Lights and cameras, relative to the scene's origin. */
clshear_status cs_build_lights(const cs_model *model, const double bounds[2][3], cs_scene *scene,
                               cs_error *error);
clshear_status cs_build_cameras(const cs_model *model, cs_scene *scene, cs_error *error);

#endif
