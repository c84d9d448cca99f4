/* What ends the process in PoCL, and can be found out before. */
#ifndef CS_DEVICE_POCL_H
#define CS_DEVICE_POCL_H

#include "device/opencl.h"

/* Fails, saying what to do, where PoCL would end the process as it compiles or runs the kernels:
 * its threads' stacks are too small, its linker is not there, or its cache is damaged. Other
 * drivers are fine. */
clshear_status cs_pocl_check(cl_device_id device, cs_error *error);

/* Fails where PoCL would end the process as soon as it looks for its devices: its variables of the
 * environment have values that it does not bear. Call it before any function of OpenCL. It fails
 * without PoCL, too: the loader alone knows where the drivers are, and it asks all of them for
 * their devices to sort them. */
clshear_status cs_pocl_check_environment(cs_error *error);

#endif
