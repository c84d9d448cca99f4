/* Lights of an Assimp scene. */
#ifndef CS_HELPER_LIGHT_H
#define CS_HELPER_LIGHT_H

#include <assimp/scene.h>

#include "import/model.h"

/* Reads a light; its name, even if the result is 0: the kind is not supported. */
int cs_light_read(const struct aiScene *file, const struct aiLight *source, cs_model_light *light);

#endif
