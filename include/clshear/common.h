/* clshear: what all public headers share: export of symbols, status codes, version.
 *
 * Included by clshear.h, analysis.h and kernels.h. */
#ifndef CLSHEAR_COMMON_H
#define CLSHEAR_COMMON_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define CLSHEAR_API __attribute__((visibility("default")))
#else
#define CLSHEAR_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ------------------------------------------------------------------------------------------------
 * Status
 * --------------------------------------------------------------------------------------------- */

typedef enum clshear_status {
    CLSHEAR_OK = 0,
    CLSHEAR_BAD_ARGUMENT,  /* a value is out of its range; the message names it */
    CLSHEAR_BAD_FILE,      /* a file cannot be read, written or understood */
    CLSHEAR_NO_DEVICE,     /* no OpenCL device, or none of that name */
    CLSHEAR_DEVICE_FAILED, /* the OpenCL driver refused something */
    CLSHEAR_OUT_OF_MEMORY,
    CLSHEAR_CANCELLED /* the progress callback asked to stop; what was done is kept */
} clshear_status;

#ifdef __cplusplus
}
#endif

#endif
