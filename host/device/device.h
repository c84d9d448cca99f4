/* An OpenCL device with the compiled kernels, its buffers and launches. No other floor sees
 * CL/cl.h.
 */
#ifndef CS_DEVICE_DEVICE_H
#define CS_DEVICE_DEVICE_H

#include <stddef.h>

#include "base/status.h"
#include "device/kernel_list.h"

typedef struct cs_device cs_device;
typedef struct cs_buffer cs_buffer;

/* The text of the public headers, cl/clshear/device, with which every program begins. */
const char *cs_device_source(void);

/* The text of the renderer's kernels, which follows it in their program. */
const char *cs_device_kernels(void);

/* A kernel argument: a buffer (`buffer` not NULL), or `size` bytes by value. */
typedef struct cs_argument {
    const cs_buffer *buffer;
    const void *value;
    size_t size;
} cs_argument;

/* Opens the device that `wanted` names: its number in cs_device_list, or part of its name, case
 * ignored; NULL: that of the environment variable CLSHEAR_DEVICE, or else the fastest. `threads`:
 * compute units of a CPU to use, 0 for all. `packet`: 1, 4, 8 or 16 lanes, 0 for what suits the
 * device. Nothing is compiled yet. All functions of a device may be called by several threads at
 * the same time. */
clshear_status cs_device_open(const char *wanted, int threads, int packet, cs_device **device,
                              cs_error *error);
void cs_device_close(cs_device *device);
clshear_status cs_device_list(void (*report)(void *user, int number, const char *name), void *user,
                              cs_error *error);

/* Where it is told that the driver takes long; the log has to outlive the device. */
void cs_device_set_log(cs_device *device, const cs_log *log);

const char *cs_device_name(const cs_device *device);
const char *cs_device_driver(const cs_device *device);
int cs_device_packet(const cs_device *device);
int cs_device_threads(const cs_device *device); /* its compute units */

/* Bytes that all buffers of the device take at present, and the most that they took at once. */
size_t cs_device_held(const cs_device *device);
size_t cs_device_most_held(const cs_device *device);

/* Bytes of its memory, and whether that is the host's. */
size_t cs_device_memory(const cs_device *device);
int cs_device_shares_memory(const cs_device *device);

/* A buffer of `size` bytes, at least 4, that starts as `initial` or, where that is NULL, as zeros.
 */
clshear_status cs_buffer_create(cs_device *device, size_t size, const void *initial,
                                cs_buffer **buffer, cs_error *error);
clshear_status cs_buffer_read(const cs_buffer *buffer, size_t offset, size_t size, void *target,
                              cs_error *error);
clshear_status cs_buffer_write(cs_buffer *buffer, size_t offset, size_t size, const void *source,
                               cs_error *error);
size_t cs_buffer_size(const cs_buffer *buffer); /* bytes; 0 of NULL */

/* Each retain is undone by a cs_buffer_free. */
cs_buffer *cs_buffer_retain(cs_buffer *buffer);
void cs_buffer_free(cs_buffer *buffer);

/* Compiles a program, if that is not done yet. Running a kernel of it does so too. `features`, bits
 * CS_FEATURE_, choose its variant: each is compiled by itself, when it is first wanted. */
clshear_status cs_device_prepare(cs_device *device, cs_program program, cs_u32 features,
                                 cs_error *error);

/* Runs a kernel on `count` work-items (more are started, to fill the last work-group) and waits.
 * argument_count: the kernel's number of arguments; anything else fails. */
clshear_status cs_device_run(cs_device *device, cs_kernel kernel, cs_u32 features, size_t count,
                             const cs_argument *arguments, size_t argument_count, cs_error *error);

/* The same for CS_KERNEL_<kernel> and an array of arguments, whose length is checked when this is
 * compiled. */
#define CS_RUN_WITH(device, kernel, features, count, arguments, error)    \
    cs_device_run(device, CS_KERNEL_##kernel, features, count, arguments, \
                  CS_LENGTH_CHECKED(arguments, CS_ARGUMENTS_##kernel), error)

/* The same for the variant without features. */
#define CS_RUN(device, kernel, count, arguments, error) \
    CS_RUN_WITH(device, kernel, 0u, count, arguments, error)
#define CS_LENGTH_CHECKED(array, length)                                                    \
    (sizeof(struct {                                                                        \
        _Static_assert(sizeof(array) / sizeof *(array) == (length), "number of arguments"); \
        char each[length];                                                                  \
    }))

#endif
