/* Reading a scene in a process of its own, with limits on memory and time. */
#ifndef CS_IMPORT_WALL_H
#define CS_IMPORT_WALL_H

#include "import/import.h"

enum {
    CS_HELPER_PATH = 4096
};

/* The program clshear-import: where $CLSHEAR_IMPORT says, beside the library, or where it is
 * installed. Returns 0 if it is nowhere. */
int cs_find_helper(char *path);

/* Starts the program `helper`, takes over the scene that it sends, and checks it. */
clshear_status cs_import_behind_wall(const char *helper, const char *path,
                                     const cs_import_options *options, cs_scene *scene,
                                     const cs_log *log, cs_error *error);

/* Seconds of processor time, and bytes of memory, that reading a file may take; `by_others`: by
 * code that is not ours. */
double cs_import_seconds(const char *path, int by_others);
double cs_import_bytes(const char *path, int by_others);

#endif
