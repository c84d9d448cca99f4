#include "report/output.h"

#include <clshear/clshear.h>
#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "report/failure.h"

static int check_place(const char *flag, const char *path)
{
    char folder[PATH_MAX] = ".";
    struct stat about;
    if (strcmp(path, "-") == 0) return EXIT_DONE;
    const char *slash = strrchr(path, '/');
    const int exists = stat(path, &about) == 0;
    if (!exists && errno == ENAMETOOLONG)
        return complain(EXIT_FAILED, "--%s %s: the name is too long: shorten it", flag, path);
    if (exists && S_ISDIR(about.st_mode))
        return complain(EXIT_FAILED, "--%s %s: is a folder", flag, path);
    if (slash != NULL) snprintf(folder, sizeof folder, "%.*s", (int)(slash - path) + 1, path);
    const int special = exists && !S_ISREG(about.st_mode);
    if (access(special ? path : folder, W_OK) == 0) return EXIT_DONE;
    return complain(EXIT_FAILED, "--%s %s: %s%s cannot be written: %s", flag, path,
                    special ? "" : "folder ", special ? path : folder, strerror(errno));
}

int check_places(const char *flag, const char *const *paths, size_t count)
{
    int code = EXIT_DONE;
    for (size_t i = 0; i < count && code == EXIT_DONE; i++)
        code = check_place(flag, paths[i]);
    return code;
}

/* Whether two paths are of one file, though it may not be there yet. */
static int is_same(const char *a, const char *b)
{
    struct stat of_a, of_b;
    char folder[2][PATH_MAX] = {".", "."};
    const char *paths[2] = {a, b}, *names[2] = {a, b};
    const int has_a = stat(a, &of_a) == 0, has_b = stat(b, &of_b) == 0;
    if (has_a != has_b || (has_a && !S_ISREG(of_a.st_mode))) return 0;
    for (int i = 0; i < 2 && !has_a; i++) {
        const char *slash = strrchr(paths[i], '/');
        if (slash == NULL) continue;
        names[i] = slash + 1;
        snprintf(folder[i], sizeof folder[i], "%.*s", (int)(slash - paths[i]) + 1, paths[i]);
    }
    if (!has_a && (strcmp(names[0], names[1]) != 0 || stat(folder[0], &of_a) != 0 ||
                   stat(folder[1], &of_b) != 0))
        return 0;
    return of_a.st_dev == of_b.st_dev && of_a.st_ino == of_b.st_ino;
}

int check_apart(const char *flag, const char *path, const char *owner, const char *const *others,
                size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (is_same(path, others[i]))
            return complain(EXIT_USAGE, "--%s %s: is the file of %s, too; give it another", flag,
                            path, owner);
    return EXIT_DONE;
}

int write_file(const char *path, void (*write)(FILE *stream, const void *user), const void *user)
{
    char *bytes = NULL;
    size_t size = 0;
    FILE *memory = open_memstream(&bytes, &size);
    if (memory == NULL) return complain(EXIT_FAILED, "%s: out of memory", path);
    write(memory, user);
    const int broken = ferror(memory);
    const int code = fclose(memory) != 0 || broken
                         ? complain(EXIT_FAILED, "%s: out of memory", path)
                         : exit_status_of(clshear_file_write(path, bytes, size));
    free(bytes);
    return code;
}
