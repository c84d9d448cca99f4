#include "base/cache_folder.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

int cs_cache_folder(const char *name, char *path, size_t size)
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    int length = -1;
    if (cache != NULL && *cache == '/')
        length = snprintf(path, size, "%s/%s", cache, name);
    else if (home != NULL && *home == '/')
        length = snprintf(path, size, "%s/.cache/%s", home, name);
    return length > 0 && (size_t)length < size;
}

int cs_make_folders(const char *path)
{
    char *upper = strdup(path);
    int reason = upper == NULL ? ENOMEM : 0;
    for (char *slash = upper; reason == 0 && slash != NULL;) {
        slash = strchr(slash + 1, '/');
        if (slash != NULL) *slash = '\0';
        if (mkdir(upper, 0777) != 0 && errno != EEXIST) reason = errno;
        if (slash != NULL) *slash = '/';
    }
    free(upper);
    return reason;
}
