/* Formats without a reader of our own, by Assimp. */
#ifndef CS_HELPER_OTHER_H
#define CS_HELPER_OTHER_H

#include "import/import.h"

/* In a module of its own, clshear-import-other.so, also the reader of 3MF. Reads the model's file
 * itself, but for Collada and 3MF, of which `bytes` are the content; they may change. */
clshear_status cs_read_other(cs_bytes *bytes, cs_model *model, cs_error *error);

#endif
