/* The kernels' text, embedded at build time, and its compilation. */
#ifndef CS_DEVICE_PROGRAM_H
#define CS_DEVICE_PROGRAM_H

#include "device/device.h"
#include "device/opencl.h"

/* Compiles a program for packets of `packet` lanes, with what `features`, bits CS_FEATURE_, name.
 */
clshear_status cs_program_build(cl_context context, cl_device_id device, cs_program which,
                                int packet, cs_u32 features, cl_program *program, cs_error *error);

#endif
