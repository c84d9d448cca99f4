/* clshear: context, an OpenCL device and the kernels compiled for it. */
#ifndef CLSHEAR_CONTEXT_H
#define CLSHEAR_CONTEXT_H

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Opens the device of the settings CLSHEAR_DEVICE, _THREADS and _PACKET (NULL settings: fallbacks).
 * Without the first, the environment variable CLSHEAR_DEVICE is asked, and then the fastest device
 * is taken that is no emulator. The kernels are compiled when a scene or an analysis first needs
 * them. Before its first render a device is tested; with the setting CLSHEAR_FORCE, one that fails
 * is used all the same. */
CLSHEAR_API clshear_status clshear_context_create(const clshear_settings *settings,
                                                  clshear_context **context);
CLSHEAR_API void clshear_context_free(clshear_context *context);

/* Calls `warn` with one line for every repair or guess: missing textures, degenerate triangles. The
 * call comes from the thread that does the work. NULL: no calls. Set it before other threads use
 * the context. */
CLSHEAR_API void clshear_context_set_warning(clshear_context *context,
                                             void (*warn)(void *user, const char *line),
                                             void *user);

/* Calls `alarm`, not the warning callback, with one line where a render goes on although something
 * that was asked for is lost: its checkpoint or its preview cannot be written, or its viewer is not
 * there or no more. NULL: the warning callback gets such lines. */
CLSHEAR_API void clshear_context_set_alarm(clshear_context *context,
                                           void (*alarm)(void *user, const char *line), void *user);

/* The message of the last failed call on this object, from any thread; "" before any failure. Valid
 * until the calling thread next asks for the message of any object. */
CLSHEAR_API const char *clshear_context_message(const clshear_context *context);

/* Name of the device, and name and version of its driver. Owned by the context. */
CLSHEAR_API const char *clshear_device_name(const clshear_context *context);
CLSHEAR_API const char *clshear_driver_name(const clshear_context *context);

/* Calls `report` for each OpenCL device, with its number and "name (platform)". */
CLSHEAR_API clshear_status clshear_list_devices(void (*report)(void *user, int number,
                                                               const char *name),
                                                void *user);

#ifdef __cplusplus
}
#endif

#endif
