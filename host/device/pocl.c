#define _GNU_SOURCE /* pthread_getattr_default_np */
#include "device/pocl.h"

#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "device/pocl_cache.h"

enum {
    PATH_SIZE = 4096,
    MOST_THREADS = 4096,  /* more than processors have cores, fewer than a process may start */
    LEAST_STACK = 1 << 20 /* bytes; the kernels of paths take up to 900 KB of a thread's stack */
};

/* Bytes of stack that new threads have unless they ask for more; 0 where the C library has no call
 * that says so. */
static size_t default_stack(void)
{
    size_t size = 0;
#ifdef __GLIBC__
    pthread_attr_t attributes;
    if (pthread_getattr_default_np(&attributes) != 0) return 0;
    pthread_attr_getstacksize(&attributes, &size);
    pthread_attr_destroy(&attributes);
#endif
    return size;
}

/* PoCL's threads have stacks of the default size, which `ulimit -s` sets. */
static clshear_status check_stack(cs_error *error)
{
    const size_t size = default_stack();
    if (size == 0 || size >= LEAST_STACK) return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_DEVICE_FAILED,
                   "threads have stacks of %zu KB, too small for the kernels on PoCL: allow %d KB "
                   "or more (ulimit -s)",
                   size >> 10, LEAST_STACK >> 10);
}

/* Whether a folder of $PATH has the program. */
static int is_in_path(const char *program)
{
    const char *folder = getenv("PATH");
    char path[PATH_SIZE];
    while (folder != NULL) {
        const int length = (int)strcspn(folder, ":");
        if (snprintf(path, sizeof path, "%.*s/%s", length, folder, program) < PATH_SIZE &&
            access(path, X_OK) == 0)
            return 1;
        folder = folder[length] == ':' ? folder + length + 1 : NULL;
    }
    return 0;
}

/* Fails where Debian's PoCL has to link kernels and cannot find `ld`, for which it ends the
 * process. Kernels in its cache are linked already. Other builds of PoCL may have their linker
 * inside. */
static clshear_status check_linker(cl_device_id device, cs_error *error)
{
    char version[128] = "";
    clGetDeviceInfo(device, CL_DRIVER_VERSION, sizeof version, version, NULL);
    version[sizeof version - 1] = '\0';
    if (strstr(version, "+debian") == NULL || is_in_path("ld") || !cs_pocl_cache_is_empty())
        return CLSHEAR_OK;
    const char *folders = getenv("PATH");
    if (folders == NULL || *folders == '\0')
        return cs_fail(
            error, CLSHEAR_DEVICE_FAILED,
            "PoCL links the kernels with ld, which it looks for in the folders of $PATH, "
            "but $PATH is %s: set it to /usr/bin",
            folders == NULL ? "not set" : "empty");
    return cs_fail(error, CLSHEAR_DEVICE_FAILED,
                   "PoCL links the kernels with ld, which is in no folder of $PATH: add /usr/bin "
                   "to it, or install binutils");
}

/* Fails if PoCL would end the process for the number in the variable `name`. PoCL reads it with
 * strtol, which takes text without a number for 0. PoCL works with `least` to `most`. */
static clshear_status check_number(const char *name, long least, long most, cs_error *error)
{
    const char *text = getenv(name);
    const long value = text == NULL ? least : strtol(text, NULL, 10);
    if (value >= least && value <= most) return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_NO_DEVICE,
                   "$%s is \"%.64s\", for which PoCL would end the process if it is among the "
                   "drivers: unset it, or set it to a number from %ld to %ld",
                   name, text, least, most);
}

clshear_status cs_pocl_check_environment(cs_error *error)
{
    const char *cache = getenv("POCL_CACHE_DIR");
    if (cache != NULL && *cache == '\0')
        return cs_fail(
            error, CLSHEAR_NO_DEVICE,
            "$POCL_CACHE_DIR is empty, for which PoCL would end the process if it is among the "
            "drivers: unset it, or set it to a folder");
    clshear_status status = check_number("POCL_MAX_PTHREAD_COUNT", 0, MOST_THREADS, error);
    return status == CLSHEAR_OK ? check_number("POCL_MAX_WORK_GROUP_SIZE", 1, INT_MAX, error)
                                : status;
}

clshear_status cs_pocl_check(cl_device_id device, cs_error *error)
{
    if (!cs_opencl_is_pocl(device)) return CLSHEAR_OK;
    clshear_status status = check_stack(error);
    if (status == CLSHEAR_OK) status = check_linker(device, error);
    return status == CLSHEAR_OK ? cs_pocl_cache_check(error) : status;
}
