/* Buffers on a device. */
#include <stdlib.h>

#include "device/objects.h"

static atomic_uint_least64_t last_number;

/* Adds the bytes of a new buffer to the device's count of bytes held. */
static void count_in(cs_device *device, size_t size)
{
    const size_t held = atomic_fetch_add(&device->held, size) + size;
    size_t most = atomic_load(&device->most);
    while (held > most && !atomic_compare_exchange_weak(&device->most, &most, held))
        continue;
}

clshear_status cs_buffer_create(cs_device *device, size_t size, const void *initial,
                                cs_buffer **result, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cl_int code;
    cl_ulong limit = 0;
    cl_event cleared = NULL;
    cs_buffer *buffer = calloc(1, sizeof *buffer);
    CS_REQUIRE(buffer != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    atomic_init(&buffer->references, 1);
    clGetDeviceInfo(device->id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof limit, &limit, NULL);
    if (size < 4) size = 4; /* kernels never look into an absent table, but OpenCL wants one */
    CS_REQUIRE(size <= limit, CLSHEAR_OUT_OF_MEMORY,
               "%s: a buffer of %zu MB is too large (the device allows %zu MB); make the scene or "
               "the image smaller",
               device->name, size >> 20, (size_t)limit >> 20);
    buffer->device = device;
    buffer->size = size;
    buffer->number = atomic_fetch_add(&last_number, 1) + 1;
    buffer->memory = clCreateBuffer(device->context, CL_MEM_READ_WRITE, size, NULL, &code);
    CS_OPENCL(code, "%s: no memory for a buffer of %zu MB", device->name, size >> 20);
    count_in(device, size);
    if (initial != NULL) {
        CS_TRY(cs_buffer_write(buffer, 0, size, initial, error));
    } else {
        const cl_uint zero = 0;
        CS_OPENCL(clEnqueueFillBuffer(device->queue, buffer->memory, &zero, sizeof zero, 0,
                                      size / 4 * 4, 0, NULL, &cleared),
                  "%s: cannot clear a buffer of %zu MB", device->name, size >> 20);
        /* Some drivers order a fill only by its event. */
        CS_OPENCL(clWaitForEvents(1, &cleared), "%s: cannot clear a buffer", device->name);
    }
    *result = buffer;
    buffer = NULL;
done:
    if (cleared != NULL) clReleaseEvent(cleared);
    cs_buffer_free(buffer);
    return status;
}

clshear_status cs_buffer_read(const cs_buffer *buffer, size_t offset, size_t size, void *target,
                              cs_error *error)
{
    const cl_int code = clEnqueueReadBuffer(buffer->device->queue, buffer->memory, CL_TRUE, offset,
                                            size, target, 0, NULL, NULL);
    if (code == CL_SUCCESS) return CLSHEAR_OK;
    return cs_opencl_fail(error, code, "cannot read %zu bytes from the device", size);
}

clshear_status cs_buffer_write(cs_buffer *buffer, size_t offset, size_t size, const void *source,
                               cs_error *error)
{
    atomic_fetch_add(&buffer->writes, 1u);
    const cl_int code = clEnqueueWriteBuffer(buffer->device->queue, buffer->memory, CL_TRUE, offset,
                                             size, source, 0, NULL, NULL);
    return code == CL_SUCCESS
               ? CLSHEAR_OK
               : cs_opencl_fail(error, code, "cannot write %zu bytes to the device", size);
}

size_t cs_buffer_size(const cs_buffer *buffer)
{
    return buffer != NULL ? buffer->size : 0;
}

cs_buffer *cs_buffer_retain(cs_buffer *buffer)
{
    atomic_fetch_add(&buffer->references, 1);
    return buffer;
}

void cs_buffer_free(cs_buffer *buffer)
{
    if (buffer == NULL || atomic_fetch_sub(&buffer->references, 1) > 1) return;
    if (buffer->memory != NULL) {
        clReleaseMemObject(buffer->memory);
        atomic_fetch_sub(&buffer->device->held, buffer->size);
    }
    free(buffer);
}
