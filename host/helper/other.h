/* Formats without a reader of our own, by Assimp. */
#ifndef CS_HELPER_OTHER_H
#define CS_HELPER_OTHER_H

#include "import/import.h"

clshear_status cs_read_other(cs_bytes *bytes, cs_model *model, cs_error *error);

#endif
