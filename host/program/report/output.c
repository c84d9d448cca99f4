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
    if (exists && access(path, W_OK) != 0)
        return complain(EXIT_FAILED, "--%s %s: cannot be written: %s", flag, path, strerror(errno));
    if ((exists && !S_ISREG(about.st_mode)) || access(folder, W_OK) == 0) return EXIT_DONE;
    return complain(EXIT_FAILED, "--%s %s: folder %s cannot be written: %s", flag, path, folder,
                    strerror(errno));
}

/* Where a link leads, though nothing may be there; else the path itself. */
static void follow(const char *path, char target[PATH_MAX])
{
    char name[PATH_MAX];
    const char *slash = strrchr(path, '/');
    const ssize_t length = readlink(path, name, sizeof name - 1);
    const size_t folder =
        slash != NULL && length > 0 && *name != '/' ? (size_t)(slash - path) + 1 : 0;
    name[length > 0 ? length : 0] = '\0';
    if (length <= 0 || folder + (size_t)length >= PATH_MAX) {
        snprintf(target, PATH_MAX, "%s", path);
        return;
    }
    memcpy(target, path, folder);
    memcpy(target + folder, name, (size_t)length + 1);
}

/* Whether two paths are of one file that a rename replaces, though it may not be there yet. */
static int is_same(const char *a, const char *b)
{
    struct stat of_a, of_b;
    char folder[2][PATH_MAX] = {".", "."}, paths[2][PATH_MAX];
    const char *names[2] = {paths[0], paths[1]};
    if (strcmp(a, "-") == 0 || strcmp(b, "-") == 0) return 0;
    const int has_a = stat(a, &of_a) == 0, has_b = stat(b, &of_b) == 0;
    if (has_a != has_b || (has_a && !S_ISREG(of_a.st_mode))) return 0;
    follow(a, paths[0]);
    follow(b, paths[1]);
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

void outputs_add(output_files *files, const char *flag, const char *const *paths, size_t count)
{
    for (size_t i = 0; i < count && files->count < MOST_OUTPUTS; i++) {
        files->flags[files->count] = flag;
        files->paths[files->count++] = paths[i];
    }
}

static int refuse_to_share(const output_files *files, size_t i, const char *dashes,
                           const char *owner)
{
    return complain(EXIT_USAGE, "--%s %s: is the file of %s%s, too; give it another",
                    files->flags[i], files->paths[i], dashes, owner);
}

int outputs_check(const output_files *files)
{
    for (size_t i = 0; i < files->count; i++) {
        const int code = check_place(files->flags[i], files->paths[i]);
        if (code != EXIT_DONE) return code;
    }
    for (size_t i = 0; i < files->count; i++)
        for (size_t k = 0; k < i; k++)
            if (is_same(files->paths[i], files->paths[k]))
                return refuse_to_share(files, i, "--", files->flags[k]);
    return EXIT_DONE;
}

int outputs_spare(const output_files *files, const char *owner, const char *const *paths,
                  size_t count)
{
    for (size_t i = 0; i < files->count; i++)
        for (size_t k = 0; k < count; k++)
            if (is_same(files->paths[i], paths[k])) return refuse_to_share(files, i, "", owner);
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
