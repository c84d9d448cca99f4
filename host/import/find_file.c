#include "import/find_file.h"

#include <ctype.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>

void cs_folder_of(const char *path, char *folder, size_t size)
{
    const char *slash = strrchr(path, '/');
    snprintf(folder, size, "%.*s", slash != NULL ? (int)(slash - path) + 1 : 0, path);
}

enum {
    A_FILE, /* or a pipe or device. What cannot be read is found out by who opens it */
    A_FOLDER
};

static int is_there(const char *path, int wanted)
{
    struct stat about;
    return stat(path, &about) == 0 && S_ISDIR(about.st_mode) == (wanted == A_FOLDER);
}

/* Joins without overflow; 0 where the path is too long. */
static int join(const char *folder, const char *name, char *path)
{
    const int length = snprintf(path, CS_FILE_PATH, "%s%s", folder, name);
    return length >= 0 && length < CS_FILE_PATH;
}

/* The entry of `folder` that is called like `name` but for the case of letters. */
static int entry_in_any_case(const char *folder, const char *name, size_t length, char *entry)
{
    int found = 0;
    DIR *listing = opendir(*folder != '\0' ? folder : ".");
    if (listing == NULL) return 0;
    for (struct dirent *one = readdir(listing); one != NULL && !found; one = readdir(listing))
        if (strlen(one->d_name) == length && strncasecmp(one->d_name, name, length) == 0) {
            memcpy(entry, one->d_name, length + 1);
            found = 1;
        }
    closedir(listing);
    return found;
}

/* Follows `name` part by part from `folder`. */
static int find_in_any_case(const char *folder, const char *name, int kind, char *path)
{
    if (!join(folder, "", path)) return 0;
    while (*name != '\0') {
        const size_t length = strcspn(name, "/"), used = strlen(path);
        char *entry = path + used;
        if (length > 255 || used + length + 2 > CS_FILE_PATH) return 0;
        if (length > 0 && name[0] == '.' && strspn(name, ".") == length) {
            memcpy(entry, name, length + 1);
            entry[length] = '\0';
        } else if (length > 0 && !entry_in_any_case(path, name, length, entry)) {
            return 0;
        }
        name += length;
        if (*name == '/') {
            entry[strlen(entry) + 1] = '\0';
            entry[strlen(entry)] = '/';
            name++;
        }
    }
    return is_there(path, kind);
}

/* Whether a name begins at the root of a machine, its author's as a rule: with a slash, with the
 * letter of a drive (C:/), or with a scheme (file:///). Only its last part is looked for then. The
 * name has slashes, no backslashes. */
static int is_elsewhere(const char *name)
{
    const int has_drive = isalpha((unsigned char)name[0]) && name[1] == ':' && name[2] == '/';
    return name[0] == '/' || has_drive || strstr(name, "://") != NULL;
}

static int find_as_written(const char *name, const char *const *folders, size_t count, int kind,
                           char *found)
{
    char slashed[CS_FILE_PATH], first[CS_FILE_PATH];
    const char *wanted = slashed;
    snprintf(slashed, sizeof slashed, "%s", name);
    for (char *letter = slashed; *letter != '\0'; letter++)
        if (*letter == '\\') *letter = '/';
    snprintf(first, sizeof first, "%.*s", CS_FILE_PATH - 1, slashed);
    const char *last_part = strrchr(slashed, '/');
    if (slashed[0] == '/' && is_there(slashed, kind)) {
        memcpy(found, slashed, sizeof slashed);
        return 1;
    }
    if (is_elsewhere(slashed) && last_part != NULL) wanted = last_part + 1;
    for (size_t i = 0; i < count && *wanted != '\0'; i++)
        if (join(folders[i], wanted, found) && is_there(found, kind)) return 1;
    for (size_t i = 0; i < count && *wanted != '\0'; i++) /* names with backslashes in them */
        if (join(folders[i], name, found) && is_there(found, kind)) return 1;
    for (size_t i = 0; i < count && *wanted != '\0'; i++)
        if (find_in_any_case(folders[i], wanted, kind, found)) return 1;
    for (size_t i = 0; i < count && last_part != NULL; i++) /* without the author's folders */
        if (kind == A_FILE && find_in_any_case(folders[i], last_part + 1, kind, found)) return 1;
    memcpy(found, first, sizeof first);
    return 0;
}

/* The value of a hexadecimal digit, or -1. */
static int digit_of(char letter)
{
    if (letter >= '0' && letter <= '9') return letter - '0';
    if (letter >= 'a' && letter <= 'f') return letter - 'a' + 10;
    return letter >= 'A' && letter <= 'F' ? letter - 'A' + 10 : -1;
}

size_t cs_decode_percent(char *name)
{
    char *target = name;
    for (const char *source = name; *source != '\0'; source++) {
        const int high = *source == '%' ? digit_of(source[1]) : -1;
        const int low = high >= 0 ? digit_of(source[2]) : -1;
        *target++ = low >= 0 ? (char)(16 * high + low) : *source;
        source += low >= 0 ? 2 : 0;
    }
    *target = '\0';
    return (size_t)(target - name);
}

static int find_kind(const char *name, const char *const *folders, size_t count, int kind,
                     char *found)
{
    char decoded[CS_FILE_PATH], ignored[CS_FILE_PATH];
    if (find_as_written(name, folders, count, kind, found)) return 1;
    if (strchr(name, '%') == NULL || strlen(name) >= sizeof decoded) return 0;
    snprintf(decoded, sizeof decoded, "%s", name);
    const size_t length = cs_decode_percent(decoded);
    if (strlen(decoded) != length) return 0; /* no name holds a 0 */
    if (!find_as_written(decoded, folders, count, kind, ignored)) return 0;
    memcpy(found, ignored, sizeof ignored);
    return 1;
}

int cs_find_file(const char *name, const char *const *folders, size_t count, char *found)
{
    char tried[CS_FILE_PATH];
    if (find_kind(name, folders, count, A_FILE, found)) return 1;
    memcpy(tried, found, sizeof tried);
    if (find_kind(name, folders, count, A_FOLDER, found)) return 1;
    memcpy(found, tried, sizeof tried);
    return 0;
}
