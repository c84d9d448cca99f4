/* Settings files: one setting per line. */
#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "settings/settings.h"

enum {
    MOST_BYTES = 1 << 20
};

/* Reads a whole text file, which the caller frees, and appends a 0. Pictures and streams without an
 * end are no settings. */
static clshear_status read_text(const char *path, char **text, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    FILE *stream = fopen(path, "rb");
    *text = stream == NULL ? NULL : malloc(MOST_BYTES + 1);
    CS_REQUIRE(stream != NULL, CLSHEAR_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
    CS_REQUIRE(*text != NULL, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    const size_t size = fread(*text, 1, MOST_BYTES, stream);
    (*text)[size] = '\0';
    CS_REQUIRE(!ferror(stream), CLSHEAR_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
    CS_REQUIRE(memchr(*text, '\0', size) == NULL && size < MOST_BYTES, CLSHEAR_BAD_FILE,
               "%s: is no settings file: it must be text, less than 1 MB, with a flag on each line",
               path);
done:
    if (stream != NULL) fclose(stream);
    return status;
}

/* A line split in place into name and value. The name is empty if the line has no setting. */
typedef struct words {
    char *name;
    char *value; /* NULL if the line has no value */
} words;

static words cut_line(char *line)
{
    char *comment = strchr(line, '#');
    if (comment != NULL) *comment = '\0';
    line += strspn(line, " \t-");
    size_t end = strlen(line);
    while (end > 0 && isspace((unsigned char)line[end - 1]))
        line[--end] = '\0';
    const size_t length = strcspn(line, " \t=");
    words found = {line, line + length};
    found.value += strspn(found.value, " \t=");
    if (*found.value == '\0') found.value = NULL;
    line[length] = '\0';
    return found;
}

/* Whether the value names a file that is read. */
static int names_input(const cs_setting *entry, const char *value)
{
    return entry->setting == CLSHEAR_ENVIRONMENT || entry->setting == CLSHEAR_TO ||
           (entry->setting == CLSHEAR_APERTURE && strpbrk(value, "./") != NULL);
}

/* The path of `name` in the folder of the settings file `path`, so that the file means the same
 * from wherever it is read; owned by the caller. NULL where no such file is there, and where that
 * folder is the current one. */
static char *find_beside(const char *path, const char *name)
{
    const char *slash = strrchr(path, '/');
    const size_t folder = slash == NULL ? 0 : (size_t)(slash + 1 - path), length = strlen(name);
    char *beside = folder == 0 || *name == '/' ? NULL : malloc(folder + length + 1);
    if (beside == NULL) return NULL;
    memcpy(beside, path, folder);
    memcpy(beside + folder, name, length + 1);
    if (access(beside, F_OK) == 0) return beside;
    free(beside);
    return NULL;
}

/* Applies a line with a setting of the file `path`. The message starts with `place`, file and
 * line. */
static clshear_status apply(clshear_settings *settings, size_t index, const char *path,
                            const char *place, const words *line, cs_error *error)
{
    const cs_setting *entry = &cs_setting_table[index];
    const int takes_value = entry->kind != CLSHEAR_SWITCH;
    if (takes_value && line->value == NULL)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s%s needs a value: %s", place, line->name,
                       entry->argument);
    const char *value = line->value != NULL ? line->value : "1";
    char *beside = names_input(entry, value) ? find_beside(path, value) : NULL;
    cs_error reason;
    const clshear_status status =
        cs_settings_set_text(settings, index, beside != NULL ? beside : value, &reason);
    free(beside);
    if (status == CLSHEAR_OK) return status;
    return cs_fail(error, status, "%s%s", place, reason.message);
}

clshear_status cs_settings_read(clshear_settings *settings, const char *path,
                                int (*other)(void *user, const char *file, int line,
                                             const char *name, const char *value),
                                void *user, cs_error *error)
{
    char *text = NULL, place[600];
    int number = 1;
    clshear_status status = read_text(path, &text, error);
    if (status != CLSHEAR_OK || text == NULL) goto done;
    /* Editors put a byte order mark before UTF-8. */
    const size_t mark = strncmp(text, "\xef\xbb\xbf", 3) == 0 ? 3 : 0;
    for (char *line = text + mark; line != NULL; number++) {
        char *next = strchr(line, '\n');
        if (next != NULL) *next++ = '\0';
        const words found = cut_line(line);
        line = next;
        if (*found.name == '\0') continue;
        const size_t index = cs_setting_named(found.name, strlen(found.name));
        snprintf(place, sizeof place, "%.500s:%d: ", path, number);
        if (index < CS_SETTING_COUNT) {
            CS_TRY(apply(settings, index, path, place, &found, error));
            continue;
        }
        CS_REQUIRE(other != NULL && other(user, path, number, found.name, found.value) == 0,
                   CLSHEAR_BAD_ARGUMENT, "%sunknown setting %s", place, found.name);
    }
done:
    free(text);
    return status;
}
