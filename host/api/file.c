/* The public function that writes a file. */
#include <errno.h>

#include "api/arguments.h"
#include "base/output_file.h"

static int write_standard_output(const void *bytes, size_t size)
{
    errno = 0;
    if (fwrite(bytes, 1, size, stdout) == size && fflush(stdout) == 0) return 0;
    return errno != 0 ? errno : EIO;
}

/* Returns 0, or errno. */
static int write_file(const char *path, const void *bytes, size_t size)
{
    cs_output_file file;
    const int reason = cs_output_open(path, &file);
    if (reason != 0) return reason;
    errno = 0; /* the stream keeps that a write failed, but not why */
    const int good = fwrite(bytes, 1, size, file.stream) == size;
    const int failure = good ? 0 : errno != 0 ? errno : EIO;
    const int ended = cs_output_end(&file, good);
    return good ? ended : failure;
}

clshear_status clshear_file_write(const char *path, const void *bytes, size_t size)
{
    CS_NEEDS_NAME(path);
    CS_NEEDS(bytes);
    const int is_standard = strcmp(path, "-") == 0;
    const int reason =
        is_standard ? write_standard_output(bytes, size) : write_file(path, bytes, size);
    if (reason == 0) return CLSHEAR_OK;
    return cs_fail(cs_thread_error(), CLSHEAR_BAD_FILE, "%s: cannot be written: %s",
                   is_standard ? "standard output" : path, strerror(reason));
}
