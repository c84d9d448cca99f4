/* PoCL's cache of compiled kernels, whose faults PoCL does not survive or cannot name. */
#ifndef CS_DEVICE_POCL_CACHE_H
#define CS_DEVICE_POCL_CACHE_H

#include <stddef.h>

#include "device/opencl.h"

/* Fails, naming the folder to delete, if a kernel of this library in the cache is cut short or is
 * none: PoCL would end the process. A cache that cannot be read is fine. */
clshear_status cs_pocl_cache_check(cs_error *error);

/* Whether the cache has no kernel of this library. */
int cs_pocl_cache_is_empty(void);

/* Writes what to do about the cache where a kernel could not be made, as the rest of a sentence;
 * nothing for other drivers. */
void cs_pocl_cache_advice(cl_device_id device, char *text, size_t size);

#endif
