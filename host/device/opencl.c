#include "device/opencl.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/resident.h"
#include "device/device.h"
#include "device/pocl.h"

enum {
    MAX_DEVICES = 64,
    MAX_PLATFORMS = 16,
    FEW_FILES = 64
};

static const char *code_name(cl_int code)
{
    switch (code) {
    case CL_DEVICE_NOT_AVAILABLE:
        return "device not available";
    case CL_MEM_OBJECT_ALLOCATION_FAILURE:
        return "no device memory";
    case CL_OUT_OF_RESOURCES:
        return "out of resources";
    case CL_OUT_OF_HOST_MEMORY:
        return "out of host memory";
    case CL_BUILD_PROGRAM_FAILURE:
        return "build failed";
    case CL_INVALID_KERNEL_ARGS:
        return "invalid kernel arguments";
    case CL_INVALID_WORK_GROUP_SIZE:
        return "invalid work-group size";
    case CL_INVALID_BUFFER_SIZE:
        return "invalid buffer size";
    default:
        return "see the OpenCL headers";
    }
}

clshear_status cs_opencl_fail(cs_error *error, cl_int code, const char *format, ...)
{
    cs_error what;
    va_list arguments;
    va_start(arguments, format);
    cs_fail_with(&what, CLSHEAR_DEVICE_FAILED, format, arguments);
    va_end(arguments);
    int memory = code == CL_MEM_OBJECT_ALLOCATION_FAILURE || code == CL_OUT_OF_HOST_MEMORY;
    return cs_fail(error, memory ? CLSHEAR_OUT_OF_MEMORY : CLSHEAR_DEVICE_FAILED,
                   "%.512s (OpenCL error %d: %s)", what.message, code, code_name(code));
}

void cs_opencl_describe(cl_device_id device, char *name, char *driver, size_t size)
{
    char device_name[128] = "unknown", platform_name[128] = "unknown", version[128] = "";
    cl_platform_id platform = NULL;
    clGetDeviceInfo(device, CL_DEVICE_NAME, sizeof device_name, device_name, NULL);
    clGetDeviceInfo(device, CL_DRIVER_VERSION, sizeof version, version, NULL);
    clGetDeviceInfo(device, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL);
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof platform_name, platform_name, NULL);
    snprintf(name, size, "%s (%s)", device_name, platform_name);
    if (driver != NULL) snprintf(driver, size, "%s %s", platform_name, version);
}

/* The variable that says where the loader looks for drivers, if one is set. */
static const char *variable_of_drivers(void)
{
    static const char *const names[] = {"OCL_ICD_VENDORS", "OPENCL_VENDOR_PATH"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        const char *value = getenv(names[i]);
        if (value != NULL && *value != '\0') return names[i];
    }
    return NULL;
}

static clshear_status no_drivers(cs_error *error)
{
    const char *name = variable_of_drivers();
    return cs_fail(error, CLSHEAR_NO_DEVICE,
                   "no OpenCL device found; install a driver, for CPUs pocl-opencl-icd%s%s%s",
                   name == NULL ? "" : ", or unset $", name == NULL ? "" : name,
                   name == NULL ? "" : ", which says where drivers are");
}

/* PoCL has no device where it has no cache, or where its variable names others. */
static clshear_status no_devices_of_drivers(cs_error *error)
{
    const char *wanted = getenv("POCL_DEVICES");
    return cs_fail(
        error, CLSHEAR_NO_DEVICE,
        "the OpenCL drivers here offer no device; %s%.64s%sPoCL needs a cache folder that "
        "it can write: $POCL_CACHE_DIR, else one in $XDG_CACHE_HOME or ~/.cache",
        wanted == NULL ? "" : "$POCL_DEVICES is \"", wanted == NULL ? "" : wanted,
        wanted == NULL ? "" : "\": unset it, or name PoCL's devices there (pthread); ");
}

static clshear_status no_devices(cl_uint platforms, cs_error *error)
{
    const size_t files = cs_open_file_limit();
    if (files != 0 && files < FEW_FILES)
        return cs_fail(error, CLSHEAR_NO_DEVICE,
                       "no OpenCL device found; the process may have %zu files open (ulimit -n), "
                       "which may be too few to load a driver: allow %d",
                       files, FEW_FILES);
    if (cs_address_limit() != 0)
        return cs_fail(error, CLSHEAR_NO_DEVICE,
                       "no OpenCL device found; memory is limited to %zu MB (ulimit -v), which may "
                       "be too little to load a driver",
                       cs_address_limit() >> 20);
    return platforms == 0 ? no_drivers(error) : no_devices_of_drivers(error);
}

/* Finds the devices of all drivers; fails when there are none. */
static clshear_status all_devices(cl_device_id *devices, cl_uint *found, cs_error *error)
{
    cl_platform_id platforms[MAX_PLATFORMS];
    cl_uint platform_count = 0, total = 0;
    clshear_status status = cs_pocl_check_environment(error);
    if (status != CLSHEAR_OK) return status;
    if (clGetPlatformIDs(MAX_PLATFORMS, platforms, &platform_count) != CL_SUCCESS)
        platform_count = 0;
    if (platform_count > MAX_PLATFORMS) platform_count = MAX_PLATFORMS;
    for (cl_uint i = 0; i < platform_count; i++) {
        cl_uint count = 0;
        if (clGetDeviceIDs(platforms[i], CL_DEVICE_TYPE_ALL, MAX_DEVICES - total, devices + total,
                           &count) != CL_SUCCESS)
            continue;
        total += count < MAX_DEVICES - total ? count : MAX_DEVICES - total;
        if (total == MAX_DEVICES) break;
    }
    *found = total;
    return total > 0 ? CLSHEAR_OK : no_devices(platform_count, error);
}

static int contains_ignoring_case(const char *text, const char *part)
{
    size_t length = strlen(part);
    for (; *text != '\0'; text++) {
        size_t i = 0;
        while (i < length && tolower((unsigned char)text[i]) == tolower((unsigned char)part[i]))
            i++;
        if (i == length) return 1;
    }
    return length == 0;
}

/* Whether a device only plays one: its results are right, its speed is none. */
static int is_emulator(const char *name)
{
    return contains_ignoring_case(name, "oclgrind") || contains_ignoring_case(name, "emulat") ||
           contains_ignoring_case(name, "simulat");
}

int cs_opencl_is_cpu(cl_device_id device)
{
    cl_device_type type = CL_DEVICE_TYPE_CPU;
    clGetDeviceInfo(device, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    return (type & CL_DEVICE_TYPE_CPU) != 0;
}

int cs_opencl_is_pocl(cl_device_id device)
{
    cl_platform_id platform = NULL;
    char name[64] = "";
    clGetDeviceInfo(device, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL);
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof name, name, NULL);
    name[sizeof name - 1] = '\0';
    return strcmp(name, "Portable Computing Language") == 0;
}

/* How fast a device promises to be; below 0 for emulators. Any GPU with memory of its own is before
 * any without, these are before all CPUs, and CPUs before what only replaces a missing GPU. Clover,
 * Mesa's old driver, does not compile the kernels. CPU drivers see the same processor: of equal
 * ones the first is taken. */
static double merit_of(cl_device_id device)
{
    char name[256];
    cl_uint units = 1, clock_mhz = 1;
    cl_bool shares_memory = CL_FALSE;
    cl_device_type type = CL_DEVICE_TYPE_CPU;
    cs_opencl_describe(device, name, NULL, sizeof name);
    if (is_emulator(name)) return -1.0;
    if (contains_ignoring_case(name, "llvmpipe") || contains_ignoring_case(name, "clover"))
        return 0.0;
    clGetDeviceInfo(device, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    if (cs_opencl_is_cpu(device)) return 1e3 + (double)units;
    clGetDeviceInfo(device, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    if ((type & CL_DEVICE_TYPE_GPU) == 0) return 1.0;
    clGetDeviceInfo(device, CL_DEVICE_MAX_CLOCK_FREQUENCY, sizeof clock_mhz, &clock_mhz, NULL);
    clGetDeviceInfo(device, CL_DEVICE_HOST_UNIFIED_MEMORY, sizeof shares_memory, &shares_memory,
                    NULL);
    return (shares_memory ? 1e6 : 1e12) + (double)units * (double)clock_mhz;
}

/* The fastest of the devices that are no emulators. */
static clshear_status find_best(const cl_device_id *devices, cl_uint count, cl_device_id *device,
                                cs_error *error)
{
    double most = -1.0;
    char name[256];
    for (cl_uint i = 0; i < count; i++) {
        const double merit = merit_of(devices[i]);
        if (merit > most) *device = devices[i];
        if (merit > most) most = merit;
    }
    if (most >= 0.0) return CLSHEAR_OK;
    cs_opencl_describe(devices[0], name, NULL, sizeof name);
    return cs_fail(error, CLSHEAR_NO_DEVICE,
                   "no OpenCL device but an emulator, %s; name it if it is wanted: device 0", name);
}

clshear_status cs_opencl_find(const char *wanted, cl_device_id *device, cs_error *error)
{
    cl_device_id devices[MAX_DEVICES];
    cl_uint count;
    clshear_status status = all_devices(devices, &count, error);
    if (status != CLSHEAR_OK) return status;
    if (wanted == NULL) wanted = getenv("CLSHEAR_DEVICE");
    if (wanted == NULL || *wanted == '\0') return find_best(devices, count, device, error);
    char *end;
    const long number = strtol(wanted, &end, 10);
    const int is_number = *end == '\0';
    char names[512] = "";
    for (cl_uint i = 0; i < count; i++) {
        char name[256];
        cs_opencl_describe(devices[i], name, NULL, sizeof name);
        const size_t used = strlen(names);
        snprintf(names + used, sizeof names - used, "%s%u %s", i == 0 ? "" : ", ", i, name);
        if (is_number ? number == (long)i : contains_ignoring_case(name, wanted)) {
            *device = devices[i];
            return CLSHEAR_OK;
        }
    }
    return cs_fail(error, CLSHEAR_NO_DEVICE, "no OpenCL device is called \"%s\"; there are: %s",
                   wanted, names);
}

clshear_status cs_device_list(void (*report)(void *user, int number, const char *name), void *user,
                              cs_error *error)
{
    cl_device_id devices[MAX_DEVICES];
    cl_uint count;
    clshear_status status = all_devices(devices, &count, error);
    if (status != CLSHEAR_OK) return status;
    for (cl_uint i = 0; i < count; i++) {
        char name[256];
        cs_opencl_describe(devices[i], name, NULL, sizeof name);
        report(user, (int)i, name);
    }
    return CLSHEAR_OK;
}
