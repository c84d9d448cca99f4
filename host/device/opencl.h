/* Finding OpenCL devices, and turning OpenCL's error codes into messages. */
#ifndef CS_DEVICE_OPENCL_H
#define CS_DEVICE_OPENCL_H

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include "device/device.h"

/* Fails with the formatted message and the code's name unless `call` is CL_SUCCESS. */
#define CS_OPENCL(call, ...)                                          \
    do {                                                              \
        cl_int opencl_code = (call);                                  \
        if (opencl_code != CL_SUCCESS) {                              \
            status = cs_opencl_fail(error, opencl_code, __VA_ARGS__); \
            goto done;                                                \
        }                                                             \
    } while (0)

clshear_status cs_opencl_fail(cs_error *error, cl_int code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The device that `wanted` names: its number in cs_device_list, or part of "name (platform)", case
 * ignored; NULL: the one that the environment variable CLSHEAR_DEVICE names in the same way, or
 * else the fastest by its type and size, but no emulator. */
clshear_status cs_opencl_find(const char *wanted, cl_device_id *device, cs_error *error);

int cs_opencl_is_cpu(cl_device_id device);

/* Whether its driver is PoCL. */
int cs_opencl_is_pocl(cl_device_id device);

/* A device made from the caller's objects, which it retains. Fails unless the queue is in order,
 * and of this context and device. */
clshear_status cs_device_adopt(cl_context context, cl_device_id id, cl_command_queue queue,
                               int packet, cs_device **device, cs_error *error);

/* The device's objects; any pointer may be NULL. */
void cs_device_objects(const cs_device *device, cl_context *context, cl_device_id *id,
                       cl_command_queue *queue);

/* "name (platform)" and "driver version", each at most `size` bytes. */
void cs_opencl_describe(cl_device_id device, char *name, char *driver, size_t size);

#endif
