#include "cli/output.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

#include "cli/job.h"

static int fail(const char *path)
{
    fprintf(stderr, "clshear: %s: cannot be written: %s\n", path, strerror(errno));
    return CLI_FAILED;
}

int cli_write_file(const char *path, void (*write)(FILE *stream, const void *user),
                   const void *user)
{
    char part[4096];
    if (strcmp(path, "-") == 0) {
        write(stdout, user);
        return fflush(stdout) == 0 && !ferror(stdout) ? CLI_DONE : fail("standard output");
    }
    snprintf(part, sizeof part, "%s.part%ld", path, (long)getpid());
    FILE *stream = fopen(part, "wb");
    if (stream == NULL) return fail(path);
    write(stream, user);
    const int broken = ferror(stream);
    if (fclose(stream) == 0 && !broken && rename(part, path) == 0) return CLI_DONE;
    const int code = fail(path);
    unlink(part);
    return code;
}
