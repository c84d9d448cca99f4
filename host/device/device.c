#include "device/device.h"

#include <stdlib.h>
#include <string.h>

#include "base/resident.h"
#include "device/objects.h"
#include "device/pocl_cache.h"
#include "device/program.h"
#include "device/recorder.h"
#include "device/slow_driver.h"

/* Bytes of addresses that PoCL and LLVM do with, libraries included: measured below 1.5 GB. */
static const size_t safe_addresses = (size_t)2 << 30;

#define KERNEL_ROW(identifier, name, program, arguments) \
    {#name, CS_PROGRAM_##program, CS_ARGUMENTS_##identifier},
static const struct {
    const char *name;
    cs_program program;
    cl_uint arguments;
} kernel_list[CS_KERNEL_COUNT] = {CS_KERNEL_LIST(KERNEL_ROW)};

/* Restricts a CPU device to some of its compute units, by a sub-device. */
static clshear_status limit_threads(cs_device *device, int threads, cs_error *error)
{
    cl_uint units = 1;
    clGetDeviceInfo(device->id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    device->threads = (int)units;
    if (threads <= 0 || (cl_uint)threads >= units || !cs_opencl_is_cpu(device->id))
        return CLSHEAR_OK;
    const cl_device_partition_property by_count[] = {CL_DEVICE_PARTITION_BY_COUNTS, threads,
                                                     CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    cl_device_id part;
    if (clCreateSubDevices(device->id, by_count, 1, &part, NULL) != CL_SUCCESS)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "device %s cannot be limited to %d threads; leave the number out",
                       device->name, threads);
    device->id = part;
    device->is_partition = 1;
    device->threads = threads;
    return CLSHEAR_OK;
}

static clshear_status create_kernel(cs_device *device, cs_variant *variant, cs_kernel kernel,
                                    cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const char *name = kernel_list[kernel].name;
    cl_int code;
    cl_uint arguments = 0;
    char advice[1280] = "";
    size_t most = device->local_size;
    cl_kernel made = clCreateKernel(variant->programs[kernel_list[kernel].program], name, &code);
    variant->kernels[kernel] = made;
    if (code != CL_SUCCESS) cs_pocl_cache_advice(device->id, advice, sizeof advice);
    CS_OPENCL(code, "kernel %s cannot be created%s", name, advice);
    CS_OPENCL(clGetKernelInfo(made, CL_KERNEL_NUM_ARGS, sizeof arguments, &arguments, NULL),
              "kernel %s: no number of arguments", name);
    CS_REQUIRE(arguments == kernel_list[kernel].arguments, CLSHEAR_DEVICE_FAILED,
               "kernel %s has %u arguments, not %u", name, arguments,
               kernel_list[kernel].arguments);
    clGetKernelWorkGroupInfo(made, device->id, CL_KERNEL_WORK_GROUP_SIZE, sizeof most, &most, NULL);
    variant->local_sizes[kernel] = most < device->local_size ? most : device->local_size;
done:
    return status;
}

static clshear_status create_kernels(cs_device *device, cs_variant *variant, cs_program program,
                                     cs_error *error)
{
    for (int i = 0; i < CS_KERNEL_COUNT; i++) {
        if (kernel_list[i].program != program) continue;
        clshear_status status = create_kernel(device, variant, (cs_kernel)i, error);
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}

/* Packets of 8 even on narrower units: they share the walk. 16 where a register holds them:
 * measured 1.3 to 1.5 times faster than 8 there (docs/performance.md). */
static int cpu_packet(cl_device_id id)
{
    cl_uint native = 8;
    clGetDeviceInfo(id, CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT, sizeof native, &native, NULL);
    return native >= 16 ? 16 : 8;
}

/* Work-groups fit every CPU stack (private memory of a group lies on it). */
static void choose_widths(cs_device *device, int packet)
{
    const int cpu = cs_opencl_is_cpu(device->id);
    device->local_size = cpu ? 8 : CS_GPU_WORK_GROUP;
    device->packet = packet != 0 ? packet : cpu ? cpu_packet(device->id) : 1;
}

clshear_status cs_device_open(const char *wanted, int threads, int packet, cs_device **result,
                              cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cl_int code;
    cs_device *device = calloc(1, sizeof *device);
    CS_REQUIRE(device != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    pthread_mutex_init(&device->lock, NULL);
    CS_TRY(cs_opencl_find(wanted, &device->id, error));
    cs_opencl_describe(device->id, device->name, device->driver, sizeof device->name);
    CS_TRY(limit_threads(device, threads, error));
    choose_widths(device, packet);
    device->context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &code);
    CS_OPENCL(code, "cannot make a context on %s", device->name);
    device->queue = clCreateCommandQueue(device->context, device->id, 0, &code);
    CS_OPENCL(code, "cannot make a queue on %s", device->name);
    *result = device;
    device = NULL;
done:
    cs_device_close(device);
    return status;
}

/* Fails unless the queue is one of the context and the device, and in order: launches follow each
 * other without events. */
static clshear_status check_queue(cl_context context, cl_device_id id, cl_command_queue queue,
                                  cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cl_context its_context = NULL;
    cl_device_id its_device = NULL;
    cl_command_queue_properties properties = 0;
    CS_OPENCL(
        clGetCommandQueueInfo(queue, CL_QUEUE_CONTEXT, sizeof its_context, &its_context, NULL),
        "the queue cannot be used");
    CS_OPENCL(clGetCommandQueueInfo(queue, CL_QUEUE_DEVICE, sizeof its_device, &its_device, NULL),
              "the queue has no device");
    CS_OPENCL(
        clGetCommandQueueInfo(queue, CL_QUEUE_PROPERTIES, sizeof properties, &properties, NULL),
        "the queue has no properties");
    CS_REQUIRE(its_context == context && its_device == id, CLSHEAR_BAD_ARGUMENT,
               "the queue is of another context or device");
    CS_REQUIRE((properties & CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE) == 0, CLSHEAR_BAD_ARGUMENT,
               "the queue is out of order; it must be in order");
done:
    return status;
}

clshear_status cs_device_adopt(cl_context context, cl_device_id id, cl_command_queue queue,
                               int packet, cs_device **result, cs_error *error)
{
    clshear_status status = check_queue(context, id, queue, error);
    cl_uint units = 1;
    if (status != CLSHEAR_OK) return status;
    cs_device *device = calloc(1, sizeof *device);
    if (device == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    pthread_mutex_init(&device->lock, NULL);
    device->id = id;
    CS_OPENCL(clRetainContext(context), "the context cannot be retained");
    device->context = context;
    CS_OPENCL(clRetainCommandQueue(queue), "the queue cannot be retained");
    device->queue = queue;
    cs_opencl_describe(id, device->name, device->driver, sizeof device->name);
    clGetDeviceInfo(id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    device->threads = (int)units;
    choose_widths(device, packet);
    *result = device;
    device = NULL;
done:
    cs_device_close(device);
    return status;
}

void cs_device_objects(const cs_device *device, cl_context *context, cl_device_id *id,
                       cl_command_queue *queue)
{
    if (context != NULL) *context = device->context;
    if (id != NULL) *id = device->id;
    if (queue != NULL) *queue = device->queue;
}

/* With the device locked. */
static clshear_status prepare(cs_device *device, cs_program program, cs_u32 features,
                              cs_error *error)
{
    cs_variant *variant = &device->variants[features];
    cl_program *made = &variant->programs[program];
    if (*made != NULL) return CLSHEAR_OK;
    clshear_status status = cs_program_build(device->context, device->id, program, device->packet,
                                             features, made, error);
    if (status == CLSHEAR_OK) status = create_kernels(device, variant, program, error);
    if (status != CLSHEAR_OK && *made != NULL) { /* so that it is tried again */
        clReleaseProgram(*made);
        *made = NULL;
    }
    return status;
}

/* What a caller of this file has asked for. */
typedef struct wish {
    cs_device *device;
    cs_kernel kernel;
    cs_program program;
    cs_u32 features;
    size_t count;
    const cs_argument *arguments;
    size_t argument_count;
    cs_error *error;
} wish;

static clshear_status prepare_wish(void *user)
{
    const wish *wanted = user;
    cs_device *device = wanted->device;
    pthread_mutex_lock(&device->lock);
    const clshear_status status = prepare(device, wanted->program, wanted->features, wanted->error);
    pthread_mutex_unlock(&device->lock);
    return status;
}

/* Says, once, that memory is limited to less than drivers may take as they compile: they end the
 * process then. */
static void warn_of_limit(cs_device *device)
{
    const size_t limit = cs_address_limit();
    if (limit == 0 || limit >= safe_addresses || device->log == NULL) return;
    if (atomic_exchange(&device->is_warned, 1)) return;
    cs_warn(device->log,
            "memory is limited to %zu MB (ulimit -v); drivers that want more end the program",
            limit >> 20);
}

clshear_status cs_device_prepare(cs_device *device, cs_program program, cs_u32 features,
                                 cs_error *error)
{
    warn_of_limit(device);
    wish wanted = {.device = device, .program = program, .features = features, .error = error};
    return cs_run_patiently(prepare_wish, &wanted, device->name, device->log);
}

void cs_device_set_log(cs_device *device, const cs_log *log)
{
    device->log = log;
}

void cs_device_close(cs_device *device)
{
    if (device == NULL) return;
    for (int f = 0; f < CS_FEATURE_SETS; f++) {
        const cs_variant *variant = &device->variants[f];
        for (int i = 0; i < CS_KERNEL_COUNT; i++)
            if (variant->kernels[i] != NULL) clReleaseKernel(variant->kernels[i]);
        for (int i = 0; i < CS_PROGRAM_COUNT; i++)
            if (variant->programs[i] != NULL) clReleaseProgram(variant->programs[i]);
    }
    if (device->queue != NULL) clReleaseCommandQueue(device->queue);
    if (device->context != NULL) clReleaseContext(device->context);
    if (device->is_partition) clReleaseDevice(device->id);
    pthread_mutex_destroy(&device->lock);
    free(device);
}

const char *cs_device_name(const cs_device *device)
{
    return device->name;
}

const char *cs_device_driver(const cs_device *device)
{
    return device->driver;
}

int cs_device_packet(const cs_device *device)
{
    return device->packet;
}

int cs_device_threads(const cs_device *device)
{
    return device->threads;
}

size_t cs_device_held(const cs_device *device)
{
    return atomic_load(&device->held);
}

size_t cs_device_most_held(const cs_device *device)
{
    return atomic_load(&device->most);
}

size_t cs_device_memory(const cs_device *device)
{
    cl_ulong bytes = 0;
    clGetDeviceInfo(device->id, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof bytes, &bytes, NULL);
    return (size_t)bytes;
}

int cs_device_shares_memory(const cs_device *device)
{
    cl_bool is_shared = CL_FALSE;
    clGetDeviceInfo(device->id, CL_DEVICE_HOST_UNIFIED_MEMORY, sizeof is_shared, &is_shared, NULL);
    return is_shared == CL_TRUE;
}

/* Sets the kernel's arguments and starts it, with the device locked: the arguments are the
 * kernel's, whichever thread set them. */
static clshear_status start(const wish *wanted, cl_event *done_at)
{
    clshear_status status = CLSHEAR_OK;
    cs_device *device = wanted->device;
    cs_error *error = wanted->error;
    const cs_kernel kernel = wanted->kernel;
    const char *name = kernel_list[kernel].name;
    CS_REQUIRE(wanted->argument_count == kernel_list[kernel].arguments, CLSHEAR_DEVICE_FAILED,
               "kernel %s: %zu arguments", name, wanted->argument_count);
    CS_TRY(prepare(device, wanted->program, wanted->features, error));
    const cs_variant *variant = &device->variants[wanted->features];
    size_t local = variant->local_sizes[kernel];
    size_t global = (wanted->count + local - 1) / local * local;
    if (device->recorder != NULL) {
        const cs_recorded_launch launch = {.kernel = name,
                                           .program = wanted->program,
                                           .features = wanted->features,
                                           .global = global,
                                           .local = local,
                                           .arguments = wanted->arguments,
                                           .argument_count = wanted->argument_count};
        CS_TRY(cs_recorder_launch(device->recorder, &launch, error));
    }
    for (cl_uint i = 0; i < wanted->argument_count; i++) {
        const cs_argument *argument = &wanted->arguments[i];
        const int is_value = argument->buffer == NULL && argument->value != NULL;
        const void *value =
            argument->buffer != NULL ? (const void *)&argument->buffer->memory : argument->value;
        CS_OPENCL(clSetKernelArg(variant->kernels[kernel], i,
                                 is_value ? argument->size : sizeof(cl_mem), value),
                  "kernel %s: argument %u is not accepted", name, i);
    }
    CS_OPENCL(clEnqueueNDRangeKernel(device->queue, variant->kernels[kernel], 1, NULL, &global,
                                     &local, 0, NULL, done_at),
              "kernel %s cannot be started", name);
done:
    return status;
}

static clshear_status run_wish(void *user)
{
    const wish *wanted = user;
    cs_device *device = wanted->device;
    cs_error *error = wanted->error;
    cl_event done_at = NULL;
    pthread_mutex_lock(&device->lock);
    clshear_status status = start(wanted, &done_at);
    pthread_mutex_unlock(&device->lock);
    if (status != CLSHEAR_OK) return status;
    clFlush(device->queue);
    CS_OPENCL(clWaitForEvents(1, &done_at), "kernel %s failed", kernel_list[wanted->kernel].name);
    atomic_store(&device->variants[wanted->features].has_run[wanted->kernel], 1);
done:
    clReleaseEvent(done_at);
    return status;
}

clshear_status cs_device_run(cs_device *device, cs_kernel kernel, cs_u32 features, size_t count,
                             const cs_argument *arguments, size_t argument_count, cs_error *error)
{
    wish wanted = {device,         kernel, kernel_list[kernel].program, features, count, arguments,
                   argument_count, error};
    if (atomic_load(&device->variants[features].has_run[kernel])) return run_wish(&wanted);
    return cs_run_patiently(run_wish, &wanted, device->name, device->log);
}
