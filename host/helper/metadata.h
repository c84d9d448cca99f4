/* What an Assimp scene says of its file. */
#ifndef CS_HELPER_METADATA_H
#define CS_HELPER_METADATA_H

#include <assimp/scene.h>

/* Returns a text, "" if there is none of this key. */
const char *cs_metadata_text(const struct aiScene *file, const char *key);

/* Returns a number, `missing` if there is none of this key. */
double cs_metadata_number(const struct aiScene *file, const char *key, double missing);

#endif
