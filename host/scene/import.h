/* Scene files, through Assimp. */
#ifndef CS_SCENE_IMPORT_H
#define CS_SCENE_IMPORT_H

#include "scene/scene.h"

/* Reads `path` into an initialised, empty scene. What is missing but not needed is reported to
 * `log`. */
clshear_status cs_scene_import(const char *path, cs_scene *scene, const cs_log *log,
                               cs_error *error);

#endif
