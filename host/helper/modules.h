/* What the program loads only when a file needs it. */
#ifndef CS_HELPER_MODULES_H
#define CS_HELPER_MODULES_H

#include "import/import.h"

/* cs_read_other of the module clshear-import-other.so, beside this program. */
clshear_status cs_read_by_module(cs_bytes *bytes, cs_model *model, cs_error *error);

#endif
