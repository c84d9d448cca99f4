/* Textures of a scene file. */
#ifndef CS_SCENE_TEXTURE_H
#define CS_SCENE_TEXTURE_H

#include "scene/scene.h"

struct aiScene;

/* Adds the image `name` of the scene file at `path` and sets `texture` to its index: a path
 * relative to the scene file, or "*N" for an image inside it. An image that cannot be read is
 * reported to `log` and leaves CS_NO_TEXTURE. */
clshear_status cs_texture_add(cs_scene *scene, const struct aiScene *file, const char *path,
                              const char *name, cs_i32 *texture, const cs_log *log,
                              cs_error *error);

#endif
