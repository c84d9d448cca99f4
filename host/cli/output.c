#include "cli/output.h"

#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/job.h"

static int fail(const char *path)
{
    fprintf(stderr, "clshear: %s: cannot be written: %s\n", path, strerror(errno));
    return CLI_FAILED;
}

/* Whether a path is a device, a pipe or the like, which no new file must replace. */
static int is_special_file(const char *path)
{
    struct stat about;
    return stat(path, &about) == 0 && !S_ISREG(about.st_mode);
}

int cli_check_place(const char *flag, const char *path)
{
    char folder[PATH_MAX] = ".";
    struct stat about;
    if (path == NULL || strcmp(path, "-") == 0) return CLI_DONE;
    const char *slash = strrchr(path, '/');
    const int exists = stat(path, &about) == 0;
    if (exists && S_ISDIR(about.st_mode)) {
        fprintf(stderr, "clshear: --%s %s: is a folder\n", flag, path);
        return CLI_FAILED;
    }
    if (slash != NULL) snprintf(folder, sizeof folder, "%.*s", (int)(slash - path) + 1, path);
    const int special = exists && !S_ISREG(about.st_mode);
    if (access(special ? path : folder, W_OK) == 0) return CLI_DONE;
    fprintf(stderr, "clshear: --%s %s: %s%s cannot be written: %s\n", flag, path,
            special ? "" : "folder ", special ? path : folder, strerror(errno));
    return CLI_FAILED;
}

int cli_check_places(const char *flag, const char *const *paths, int count)
{
    int code = CLI_DONE;
    for (int i = 0; i < count && code == CLI_DONE; i++)
        code = cli_check_place(flag, paths[i]);
    return code;
}

int cli_write_file(const char *path, void (*write)(FILE *stream, const void *user),
                   const void *user)
{
    char target[PATH_MAX], part[PATH_MAX + 32];
    if (strcmp(path, "-") == 0) {
        write(stdout, user);
        return fflush(stdout) == 0 && !ferror(stdout) ? CLI_DONE : fail("standard output");
    }
    const int special = is_special_file(path);
    if (special || realpath(path, target) == NULL) /* links are followed */
        snprintf(target, sizeof target, "%s", path);
    if (special)
        snprintf(part, sizeof part, "%s", path);
    else
        snprintf(part, sizeof part, "%s.part%ld", target, (long)getpid());
    FILE *stream = fopen(part, "wb");
    if (stream == NULL) return fail(path);
    write(stream, user);
    const int broken = ferror(stream);
    if (fclose(stream) == 0 && !broken && (special || rename(part, target) == 0)) return CLI_DONE;
    const int code = fail(path);
    if (!special) unlink(part);
    return code;
}
