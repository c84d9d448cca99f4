/* What the program loads only when a file needs it. */
#ifndef CS_HELPER_LATE_H
#define CS_HELPER_LATE_H

#include "import/import.h"

/* cs_read_other of the module clshear-import-other.so, beside this program. */
clshear_status cs_read_late(cs_bytes *bytes, cs_model *model, cs_error *error);

#endif
