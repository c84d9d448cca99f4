/* clshear: what every public header shares.
 *
 * Included by the others; a program need not include it itself.
 *
 * Conventions of all public functions
 * - A function that can fail returns a clshear_status. Its result goes to the last pointer, which
 *   is left alone on failure.
 * - After a failure, clshear_message() has the reason in one line, for the calling thread.
 * Contexts, scenes and films keep the reason of their own last failure besides.
 * - Objects are opaque. Each is freed by its own _free function, which accepts NULL, in any order:
 *   a scene keeps its context alive.
 * - Arrays and texts passed in are copied.
 * - Structs that cross the interface begin with `struct_size`, which the caller sets to the size of
 *   the struct as compiled: `clshear_film_info info = {.struct_size = sizeof info};`. A newer library leaves alone
 *   what an older program does not know, and takes what it does not have as zero.
 * - Nothing here prints, aborts or exits.
 *
 * Threads
 * - A context may be used by any number of threads at the same time. What they run on its device
 *   takes turns.
 * - A scene may be rendered by any number of threads at the same time, once it is complete. Only
 * one thread at a time may change it, and none may use it meanwhile.
 * - Settings, films, point sets, spectra and other results may be read by any number of threads at
 *   the same time; only one may change them, and none may read them meanwhile.
 * - Different objects are independent of each other. */
#ifndef CLSHEAR_COMMON_H
#define CLSHEAR_COMMON_H

#include <stddef.h>
#include <stdint.h>

#include <clshear/version.h>

#if defined(_WIN32) && defined(CLSHEAR_BUILDING)
#define CLSHEAR_API __declspec(dllexport)
#elif defined(_WIN32)
#define CLSHEAR_API __declspec(dllimport)
#elif defined(__GNUC__)
#define CLSHEAR_API __attribute__((visibility("default")))
#else
#define CLSHEAR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Version
 * --------------------------------------------------------------------------------------------- */

/* Version of the library that runs, as "major.minor.patch" and as a number like CLSHEAR_VERSION.
 * The macros in version.h say what a program was compiled with. */
CLSHEAR_API const char *clshear_version(void);
CLSHEAR_API int clshear_version_number(void);

/* ------------------------------------------------------------------------------------------------
 * Status
 * --------------------------------------------------------------------------------------------- */

/* X(identifier, number, meaning) */
#define CLSHEAR_STATUS_LIST(X)                                         \
    X(OK, 0, "done")                                                   \
    X(BAD_ARGUMENT, 1, "a value is out of its range")                  \
    X(BAD_FILE, 2, "a file cannot be read, written or understood")     \
    X(NO_DEVICE, 3, "there is no OpenCL device, or none of that name") \
    X(DEVICE_FAILED, 4, "the OpenCL driver refused something")         \
    X(OUT_OF_MEMORY, 5, "there is not enough memory, on the host or the device")

typedef enum clshear_status {
#define CLSHEAR_STATUS_ENUMERATOR(identifier, number, meaning) CLSHEAR_##identifier = number,
    CLSHEAR_STATUS_LIST(CLSHEAR_STATUS_ENUMERATOR)
#undef CLSHEAR_STATUS_ENUMERATOR
} clshear_status;

/* The identifier of a status as text, "BAD_FILE"; NULL for a number that is none. */
CLSHEAR_API const char *clshear_status_name(clshear_status status);

/* Why the last call of this thread that failed did so, in one line; "" before any failure. Valid
 * until the thread's next failure. */
CLSHEAR_API const char *clshear_message(void);

/* ------------------------------------------------------------------------------------------------
 * Files
 * --------------------------------------------------------------------------------------------- */

/* Writes `size` bytes to a file, as all written files are: an existing one is replaced only once
 * the new one is complete, links are followed, and devices and pipes are written as they are. "-"
 * is standard output. */
CLSHEAR_API clshear_status clshear_file_write(const char *path, const void *bytes, size_t size);

/* ------------------------------------------------------------------------------------------------
 * Objects
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_context clshear_context;   /* an OpenCL device and its compiled kernels */
typedef struct clshear_settings clshear_settings; /* what a render is asked for */
typedef struct clshear_scene clshear_scene;       /* triangles, materials, lights, hierarchy */
typedef struct clshear_film clshear_film;         /* a rendered image with all its channels */

#ifdef __cplusplus
}
#endif

#endif
