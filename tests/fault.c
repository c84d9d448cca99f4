/* Loaded before the OpenCL library, makes one of its functions fail: FAULT=function:code:calls,
 * with `code` after that many calls that do what they should. FAULT=clock makes the wall clock
 * jump, FAULT=folders no folder be put on the disk, FAULT=bits turns a bit of all that is read;
 * FAULT=gpu lets PoCL's device "basic" say that it is a GPU, FAULT=emulator all devices that they
 * are emulators, FAULT=small that they allow buffers of 1 MB. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

/* The code with which this call of `function` is to fail; 0: with none. */
static cl_int fault_of(const char *function)
{
    static int left = -1;
    char name[64];
    int code, calls;
    const char *fault = getenv("FAULT");
    if (fault == NULL || sscanf(fault, "%63[^:]:%d:%d", name, &code, &calls) != 3) return 0;
    if (strcmp(name, function) != 0) return 0;
    if (left < 0) left = calls;
    return left > 0 ? (left--, 0) : code;
}

static void *original(const char *function)
{
    return dlsym(RTLD_NEXT, function);
}

cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void *host, cl_int *code)
{
    cl_mem (*call)(cl_context, cl_mem_flags, size_t, void *, cl_int *);
    *(void **)&call = original("clCreateBuffer");
    const cl_int fault = fault_of("clCreateBuffer");
    if (fault == 0) return call(context, flags, size, host, code);
    if (code != NULL) *code = fault;
    return NULL;
}

cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id *devices,
                      const char *options, void(CL_CALLBACK *notify)(cl_program, void *),
                      void *user)
{
    cl_int (*call)(cl_program, cl_uint, const cl_device_id *, const char *,
                   void(CL_CALLBACK *)(cl_program, void *), void *);
    *(void **)&call = original("clBuildProgram");
    const cl_int fault = fault_of("clBuildProgram");
    return fault != 0 ? fault : call(program, count, devices, options, notify, user);
}

cl_int clEnqueueNDRangeKernel(cl_command_queue queue, cl_kernel kernel, cl_uint dimensions,
                              const size_t *offset, const size_t *global, const size_t *local,
                              cl_uint count, const cl_event *wait, cl_event *event)
{
    cl_int (*call)(cl_command_queue, cl_kernel, cl_uint, const size_t *, const size_t *,
                   const size_t *, cl_uint, const cl_event *, cl_event *);
    *(void **)&call = original("clEnqueueNDRangeKernel");
    const cl_int fault = fault_of("clEnqueueNDRangeKernel");
    return fault != 0 ? fault
                      : call(queue, kernel, dimensions, offset, global, local, count, wait, event);
}

cl_int clEnqueueReadBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocks, size_t offset,
                           size_t size, void *target, cl_uint count, const cl_event *wait,
                           cl_event *event)
{
    cl_int (*call)(cl_command_queue, cl_mem, cl_bool, size_t, size_t, void *, cl_uint,
                   const cl_event *, cl_event *);
    *(void **)&call = original("clEnqueueReadBuffer");
    const cl_int fault = fault_of("clEnqueueReadBuffer");
    if (fault != 0) return fault;
    const cl_int code = call(queue, buffer, blocks, offset, size, target, count, wait, event);
    const char *name = getenv("FAULT");
    if (name != NULL && strcmp(name, "bits") == 0 && size >= 4) ((unsigned char *)target)[2] ^= 1;
    return code;
}

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info what, size_t size, void *value,
                       size_t *needed)
{
    cl_int (*call)(cl_device_id, cl_device_info, size_t, void *, size_t *);
    *(void **)&call = original("clGetDeviceInfo");
    const cl_int code = call(device, what, size, value, needed);
    const char *fault = getenv("FAULT");
    if (code != CL_SUCCESS || fault == NULL || value == NULL) return code;
    if (strcmp(fault, "gpu") == 0 && what == CL_DEVICE_TYPE) {
        char name[128] = "";
        call(device, CL_DEVICE_NAME, sizeof name, name, NULL);
        if (strncmp(name, "basic", 5) == 0) *(cl_device_type *)value = CL_DEVICE_TYPE_GPU;
    }
    if (strcmp(fault, "small") == 0 && what == CL_DEVICE_MAX_MEM_ALLOC_SIZE)
        *(cl_ulong *)value = (cl_ulong)1 << 20;
    if (strcmp(fault, "emulator") == 0 && what == CL_DEVICE_NAME)
        snprintf(value, size, "Some Emulator");
    return code;
}

/* A day forth, a day back, with each call. */
int clock_gettime(clockid_t clock, struct timespec *now)
{
    static int calls;
    int (*call)(clockid_t, struct timespec *);
    *(void **)&call = original("clock_gettime");
    const int code = call(clock, now);
    const char *fault = getenv("FAULT");
    if (code == 0 && clock == CLOCK_REALTIME && fault != NULL && strcmp(fault, "clock") == 0)
        now->tv_sec += ++calls % 2 ? 86400 : -86400;
    return code;
}

int fsync(int file)
{
    struct stat about;
    int (*call)(int);
    *(void **)&call = original("fsync");
    const char *fault = getenv("FAULT");
    if (fault == NULL || strcmp(fault, "folders") != 0 || fstat(file, &about) != 0 ||
        !S_ISDIR(about.st_mode))
        return call(file);
    errno = EIO;
    return -1;
}
