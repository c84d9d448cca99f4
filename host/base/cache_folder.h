/* The user's folder for files that can be made again. */
#ifndef CS_BASE_CACHE_FOLDER_H
#define CS_BASE_CACHE_FOLDER_H

#include <stddef.h>

/* Writes the path of the folder `name` among the user's caches, as the XDG Base Directory
 * Specification places them: in $XDG_CACHE_HOME if that is an absolute path, else in
 * $HOME/.cache. Returns 0 if there is no such place or it does not fit into `size` bytes, else 1.
 */
int cs_cache_folder(const char *name, char *path, size_t size);

/* Makes a folder and those above it that are missing. Returns 0, or errno. */
int cs_make_folders(const char *path);

#endif
