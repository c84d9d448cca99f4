/* The scenes of files of a square with one material (material_files.h), without a device. */
#ifndef CS_TESTS_MATERIAL_SCENES_H
#define CS_TESTS_MATERIAL_SCENES_H

#include "import_support.h"
#include "material_files.h"

/* Reads the file of such lines (MTL) or such JSON (glTF). A failure, or a scene that is not sound,
 * fails the test. The caller frees the scene. */
cs_scene material_scene_mtl(const char *lines);
cs_scene material_scene_gltf(const char *material);

#endif
