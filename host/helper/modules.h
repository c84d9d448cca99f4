/* What the program loads only when a file needs it. */
#ifndef CS_HELPER_MODULES_H
#define CS_HELPER_MODULES_H

#include "import/import.h"

/* The functions of the modules, which are files beside this program. `path` is the scene file that
 * they read; a process reads one. While they run, memory and processor time have lower limits than
 * our readers have (limits.h). */
const cs_import_modules *cs_modules_for(const char *path);

#endif
