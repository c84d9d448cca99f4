/* clshear: common definitions of all public headers, which include this file.
 *
 * Conventions
 * - A function that can fail returns a clshear_status. It writes its result through the last
 *   pointer, and leaves the target unchanged on failure.
 * - After a failure, clshear_message() returns a one-line reason, for each thread separately.
 *   Contexts, scenes and films also store the reason of their own last failure.
 * - Objects are opaque. Each type has a _free function, which accepts NULL. Objects can be freed in
 *   any order: a scene keeps its context alive.
 * - A function that returns no status takes a NULL object or target too: it returns NULL or 0
 *   (clshear_film_mean_variance: NaN) and does nothing else. The same for an index past the last.
 * - Functions copy the arrays and texts in their arguments.
 * - Public structs begin with `struct_size`. Who makes the struct sets it to its size:
 *   `clshear_film_info info = {.struct_size = sizeof info};`. The library writes no
 *   member beyond this size, reads missing members as zero and ignores unknown ones, so that
 *   programs work with newer and older libraries.
 * - No function prints, aborts or exits.
 *
 * Threads
 * - Any number of threads may use a context at the same time. Their work on its device takes turns.
 * - Any number of threads may render a complete scene at the same time. A thread that changes the
 *   scene must be the only one that uses it.
 * - Any number of threads may read settings, films, point sets, spectra and other results at the
 *   same time. A thread that changes one must be the only one that uses it.
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

/* Version of the loaded library, as "major.minor.patch" and as a number like CLSHEAR_VERSION. The
 * macros in version.h are the version at compile time. */
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

/* The identifier of a status as text, such as "BAD_FILE"; NULL for an unknown number. */
CLSHEAR_API const char *clshear_status_name(clshear_status status);

/* The message of this thread's last failed call, in one line; "" before any failure. Valid until
 * the thread's next failure. */
CLSHEAR_API const char *clshear_message(void);

/* ------------------------------------------------------------------------------------------------
 * Files
 * --------------------------------------------------------------------------------------------- */

/* Writes `size` bytes to a file in the way of all output files: an existing file is replaced only
 * when the new one is complete, links are followed, and devices and pipes are written in place. "-"
 * is standard output. */
CLSHEAR_API clshear_status clshear_file_write(const char *path, const void *bytes, size_t size);

/* ------------------------------------------------------------------------------------------------
 * Objects
 * --------------------------------------------------------------------------------------------- */

typedef struct clshear_context clshear_context;   /* an OpenCL device and its compiled kernels */
typedef struct clshear_settings clshear_settings; /* options of a render */
typedef struct clshear_scene clshear_scene;       /* triangles, materials, lights, hierarchy */
typedef struct clshear_film clshear_film;         /* a rendered image with all its channels */

#ifdef __cplusplus
}
#endif

#endif
