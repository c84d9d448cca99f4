/* Material libraries of OBJ files. */
#ifndef CS_IMPORT_MTL_H
#define CS_IMPORT_MTL_H

#include "import/model.h"

/* Reads the library at `path`, appending its materials to `materials` (cs_material_description).
 * Textures are looked for beside it and beside the model's file. A line that cannot be understood
 * is reported and left out. */
clshear_status cs_mtl_read(const char *path, cs_model *model, cs_array *materials, cs_error *error);

/* What tells a material apart: its name, or, where that is longer than CS_MATERIAL_NAME - 1
 * letters, its beginning and a checksum of the whole. All of `key` is written. */
void cs_mtl_key(const char *name, char key[CS_MATERIAL_NAME]);

#endif
