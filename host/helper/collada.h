/* Collada files as Assimp can read them. */
#ifndef CS_HELPER_COLLADA_H
#define CS_HELPER_COLLADA_H

#include "base/status.h"
#include "import/text.h"

/* Whether the name is that of a Collada file. */
int cs_is_collada(const char *path);

/* Makes the text UTF-8, and takes away the blanks behind tags and before them: Assimp 5.2 reads
 * neither UTF-16 nor colours that begin with a blank or a line end, as several exporters write
 * them, and takes a line end for a part of an image's name. */
clshear_status cs_collada_tidy(cs_bytes *bytes, const char *path, cs_error *error);

#endif
