/* clshear: OpenCL objects shared with the caller.
 *
 * A header of its own, so that clshear.h does not need the OpenCL headers, CL/cl.h, which programs
 * that include this one have to find and link themselves: clshear's packages do not ask for them.
 * The head of common.h describes the common conventions. */
#ifndef CLSHEAR_OPENCL_H
#define CLSHEAR_OPENCL_H

#ifndef CL_TARGET_OPENCL_VERSION
#define CL_TARGET_OPENCL_VERSION 120
#endif
#include <CL/cl.h>

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Creates a context from the caller's OpenCL context, device and command queue, which it retains.
 * The queue must be in order, and of that context and device. Of the settings (NULL: fallbacks)
 * count CLSHEAR_PACKET, CLSHEAR_THREADS (for Embree) and CLSHEAR_FORCE. */
CLSHEAR_API clshear_status clshear_context_create_from(cl_context cl, cl_device_id device,
                                                       cl_command_queue queue,
                                                       const clshear_settings *settings,
                                                       clshear_context **context);

/* The OpenCL objects of a context, for programs that share its device. Owned by the context. Any of
 * the pointers may be NULL. */
CLSHEAR_API void clshear_context_objects(const clshear_context *context, cl_context *cl,
                                         cl_device_id *device, cl_command_queue *queue);

/* Copies a channel of a film, row by row as floats, into the caller's buffer on the context's
 * device, starting at byte `offset`. Returns when the copy is complete. */
CLSHEAR_API clshear_status clshear_film_copy_to_buffer(clshear_film *film, clshear_context *context,
                                                       const char *channel, cl_mem buffer,
                                                       size_t offset);

#ifdef __cplusplus
}
#endif

#endif
