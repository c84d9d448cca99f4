/* Sets of texture coordinates in Collada files as Assimp can read them. */
#ifndef CS_HELPER_COLLADA_SETS_H
#define CS_HELPER_COLLADA_SETS_H

#include "base/status.h"
#include "import/text.h"

/* Numbers the sets of texture coordinates anew in the text: the lowest becomes 0, the next one 1,
 * and so on; and writes these numbers where textures name a set. Assimp 5.2 takes the digits in the
 * name for the number, whatever set the material binds to it, and gives a mesh its sets without
 * gaps. Exporters of 3ds Max count from 1. A file with more sets than Assimp knows stays as it is.
 * Of a name that is bound to several sets, the first binding in the file counts everywhere;
 * `*conflicts` is the number of other ones. Fails only without memory. */
clshear_status cs_collada_number_sets(cs_bytes *bytes, size_t *conflicts, cs_error *error);

#endif
