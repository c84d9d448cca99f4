/* A kernel of your own with clshear's sampler, shear and lens, in an OpenCL context of your own.
 *
 * A checkered wall stands out of focus. Each work-item renders the same pixel once, with 64 samples
 * and a key of its own; the variance of the results is the noise of that pixel. It is printed
 * without and with the shear.
 *
 *     cc -std=c17 own_kernel.c $(pkg-config --cflags --libs clshear) -lOpenCL -lm -o own_kernel
 */
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <clshear/clshear.h>
#include <clshear/device/camera.h>
#include <clshear/device/lens.h>
#include <clshear/device/sampler/pattern.h>
#include <clshear/kernels.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    SAMPLES = 64,
    REPLICATES = 4096,
    IMAGE_SIDE = 100
};

static const float wall_depth = 3.0f; /* the focal plane is at 4 */

/* Compiled behind the text of the device headers. */
static const char kernel_text[] =
    "__kernel void pixel(cs_pattern pattern, __global const uint *sample_table, cs_camera camera,\n"
    "                    __global const float *lens_table, uint mode, float depth,\n"
    "                    __global float *means)\n"
    "{\n"
    "    uint replicate = (uint)get_global_id(0);\n"
    "    uint key = cs_pattern_key(1u, 0u, replicate);\n"
    "    float shear = cs_shear_of_depth(camera, depth);\n"
    "    float sum = 0.0f;\n"
    "    for (uint i = 0; i < pattern.grid.count; i++) {\n"
    "        float t[CS_MAIN_DIMENSIONS];\n"
    "        cs_draw(&pattern, sample_table, key, i, t);\n"
    "        cs_camera_sample p = cs_shear(t[0], t[1], t[2], t[3], mode, &camera.optics,\n"
    "                                      lens_table, shear);\n"
    "        cs_ray ray = cs_lens_ray(camera, 61.0f + p.x, 47.0f + p.y, p.u, p.v);\n"
    "        float x = ray.origin[0] + depth * ray.direction[0];\n"
    "        float y = ray.origin[1] + depth * ray.direction[1];\n"
    "        sum += ((int)floor(4.0f * x) + (int)floor(4.0f * y)) & 1;\n"
    "    }\n"
    "    means[replicate] = sum / pattern.grid.count;\n"
    "}\n";

static void check_cl(cl_int code, const char *what)
{
    if (code == CL_SUCCESS) return;
    fprintf(stderr, "%s: OpenCL error %d\n", what, (int)code);
    exit(2);
}

static void check(clshear_status status)
{
    if (status == CLSHEAR_OK) return;
    fprintf(stderr, "%s\n", clshear_message());
    exit(2);
}

static cl_mem buffer_of(cl_context context, const void *bytes, size_t size)
{
    cl_int code;
    cl_mem buffer = clCreateBuffer(context, CL_MEM_READ_ONLY | CL_MEM_COPY_HOST_PTR, size,
                                   (void *)bytes, &code);
    check_cl(code, "buffer");
    return buffer;
}

static cl_kernel build(cl_context context, cl_device_id device)
{
    cl_int code;
    const char *texts[] = {clshear_device_source(), kernel_text};
    cl_program program = clCreateProgramWithSource(context, 2, texts, NULL, &code);
    check_cl(code, "program");
    check_cl(clBuildProgram(program, 1, &device, "-cl-std=CL1.2", NULL, NULL), "build");
    cl_kernel kernel = clCreateKernel(program, "pixel", &code);
    check_cl(code, "kernel");
    clReleaseProgram(program); /* the kernel keeps it */
    return kernel;
}

static void open_device(cl_device_id *device, cl_context *context, cl_command_queue *queue)
{
    cl_platform_id platform;
    cl_int code;
    check_cl(clGetPlatformIDs(1, &platform, NULL), "platform");
    check_cl(clGetDeviceIDs(platform, CL_DEVICE_TYPE_ALL, 1, device, NULL), "device");
    *context = clCreateContext(NULL, 1, device, NULL, NULL, &code);
    check_cl(code, "context");
    *queue = clCreateCommandQueue(*context, *device, 0, &code);
    check_cl(code, "queue");
}

/* A camera at the origin that looks down -Z, focused behind the wall. */
static clshear_lens *make_lens(void)
{
    static const double eye[3] = {0, 0, 0}, target[3] = {0, 0, -1};
    clshear_settings *settings = NULL;
    clshear_lens *lens = NULL;
    check(clshear_settings_create(&settings));
    check(clshear_settings_set_integer(settings, CLSHEAR_WIDTH, IMAGE_SIDE));
    check(clshear_settings_set_integer(settings, CLSHEAR_HEIGHT, IMAGE_SIDE));
    check(clshear_settings_set_numbers(settings, CLSHEAR_EYE, eye, 3));
    check(clshear_settings_set_numbers(settings, CLSHEAR_TARGET, target, 3));
    check(clshear_settings_set_number(settings, CLSHEAR_FOV, 40.0));
    check(clshear_settings_set_number(settings, CLSHEAR_LENS_RADIUS, 0.2));
    check(clshear_settings_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 4.0));
    check(clshear_settings_set_integer(settings, CLSHEAR_BLADES, 6));
    check(clshear_lens_create(settings, &lens));
    clshear_settings_free(settings);
    return lens;
}

/* Arguments 0 to 3: the samples of a pixel, then a camera with a six-bladed lens. The buffers must
 * live as long as the kernel is run. */
static void set_words(cl_context context, cl_kernel kernel, cl_mem *sample_table,
                      cl_mem *lens_table)
{
    clshear_pattern *pattern = NULL;
    clshear_lens *lens = make_lens();
    cs_pattern constants;
    cs_camera camera;
    size_t words, floats;
    check(clshear_pattern_create("sz", SAMPLES, CLSHEAR_ORDER_COHERENT, &pattern));
    check(clshear_pattern_constants(pattern, &constants, sizeof constants));
    check(clshear_lens_camera(lens, &camera, sizeof camera));
    const uint32_t *sample_words = clshear_pattern_table(pattern, &words);
    const float *lens_floats = clshear_lens_table(lens, &floats);
    *sample_table = buffer_of(context, sample_words, words * sizeof *sample_words);
    *lens_table = buffer_of(context, lens_floats, floats * sizeof *lens_floats);
    check_cl(clSetKernelArg(kernel, 0, sizeof constants, &constants), "argument");
    check_cl(clSetKernelArg(kernel, 1, sizeof(cl_mem), sample_table), "argument");
    check_cl(clSetKernelArg(kernel, 2, sizeof camera, &camera), "argument");
    check_cl(clSetKernelArg(kernel, 3, sizeof(cl_mem), lens_table), "argument");
    clshear_lens_free(lens);
    clshear_pattern_free(pattern);
}

/* Runs the kernel and prints mean and variance of the pixel; returns the variance. */
static double measure(cl_command_queue queue, cl_kernel kernel, cl_mem means, cl_uint mode)
{
    static float mean[REPLICATES];
    const size_t size = REPLICATES;
    double sum = 0.0, square = 0.0;
    check_cl(clSetKernelArg(kernel, 4, sizeof mode, &mode), "argument");
    check_cl(clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &size, NULL, 0, NULL, NULL), "run");
    check_cl(clEnqueueReadBuffer(queue, means, CL_TRUE, 0, sizeof mean, mean, 0, NULL, NULL),
             "read");
    for (int i = 0; i < REPLICATES; i++) {
        sum += mean[i];
        square += (double)mean[i] * (double)mean[i];
    }
    const double average = sum / REPLICATES;
    const double variance = (square - sum * average) / (REPLICATES - 1);
    printf("%-10s mean %.4f, variance %.3e\n", mode == CS_SHEAR_NONE ? "unsheared" : "sheared",
           average, variance);
    return variance;
}

int main(void)
{
    cl_device_id device;
    cl_context context;
    cl_command_queue queue;
    cl_mem sample_table, lens_table;
    cl_int code;
    open_device(&device, &context, &queue);
    cl_kernel kernel = build(context, device);
    cl_mem means =
        clCreateBuffer(context, CL_MEM_WRITE_ONLY, REPLICATES * sizeof(float), NULL, &code);
    check_cl(code, "buffer");
    set_words(context, kernel, &sample_table, &lens_table);
    check_cl(clSetKernelArg(kernel, 5, sizeof wall_depth, &wall_depth), "argument");
    check_cl(clSetKernelArg(kernel, 6, sizeof(cl_mem), &means), "argument");

    const double unsheared = measure(queue, kernel, means, CS_SHEAR_NONE);
    const double sheared = measure(queue, kernel, means, CS_SHEAR_EQUAL_AREA);
    printf("the shear divides the variance by %.1f\n", unsheared / sheared);

    clReleaseMemObject(means);
    clReleaseMemObject(lens_table);
    clReleaseMemObject(sample_table);
    clReleaseKernel(kernel);
    clReleaseCommandQueue(queue);
    clReleaseContext(context);
    return sheared < 0.5 * unsheared ? 0 : 1;
}
