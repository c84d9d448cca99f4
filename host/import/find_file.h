/* Files that a scene file names: where they are on this machine. */
#ifndef CS_IMPORT_FIND_FILE_H
#define CS_IMPORT_FIND_FILE_H

#include <stddef.h>

enum {
    CS_FILE_PATH = 4096
};

/* The folder of `path` with its closing slash; "" for a bare name. */
void cs_folder_of(const char *path, char *folder, size_t size);

/* Finds the file that a scene calls `name`, in one of `count` folders: as it is written, with
 * slashes for backslashes, by its last part alone where the rest is a path of another machine, in
 * whatever case, and at last with the %XX of a URI decoded. Returns 1 and its path in `found`
 * (CS_FILE_PATH bytes). Where only a folder is called so it is found, so that who opens it can say
 * so. Else returns 0, with the path that was tried first. */
int cs_find_file(const char *name, const char *const *folders, size_t count, char *found);

/* Replaces %XX by the bytes they stand for: URIs name files so. Returns the number of bytes, of
 * which some may be 0. */
size_t cs_decode_percent(char *name);

#endif
