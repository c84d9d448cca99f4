/* What the program loads only when a file needs it. */
#ifndef CS_HELPER_MODULES_H
#define CS_HELPER_MODULES_H

#include "import/import.h"

/* What the modules beside this program do for the scene file `path`, one file for each process, by
 * libraries of others. They have tighter limits on memory and time there than our readers. */
const cs_import_modules *cs_modules_for(const char *path);

#endif
