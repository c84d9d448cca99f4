/* The kernels' text, embedded at build time, and its compilation. */
#ifndef CS_DEVICE_PROGRAM_H
#define CS_DEVICE_PROGRAM_H

#include "device/device.h"
#include "device/opencl.h"

enum {
    CS_PROGRAM_OPTIONS = 256 /* most bytes of a program's options */
};

/* The two texts, joined, of a program: the public headers' and its own. */
void cs_program_texts(cs_program which, const char *texts[2]);

/* The options with which programs are compiled for a device. */
void cs_program_options(cl_device_id device, int packet, cs_u32 features,
                        char options[CS_PROGRAM_OPTIONS]);

/* Compiles a program for packets of `packet` lanes, with what `features`, bits CS_FEATURE_, name.
 */
clshear_status cs_program_build(cl_context context, cl_device_id device, cs_program which,
                                int packet, cs_u32 features, cl_program *program, cs_error *error);

#endif
