/* Runs a capsule, the launches of a render that clshear --record wrote down, on an OpenCL device,
 * and compares what they make with what they made then. Needs nothing but OpenCL:
 *
 *     cc tools/replay.c -lOpenCL -lm -o replay
 *     ./replay FILE [--device N|NAME] [--options TEXT]
 *
 * The format is described in docs/notes/devices.md. Exit status: 0 equal within rounding, 1
 * different or failed, 2 wrong usage. */
#ifndef _XOPEN_SOURCE
#define _XOPEN_SOURCE 700
#endif
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>

#include <ctype.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum {
    MOST_DEVICES = 64,
    MOST_PROGRAMS = 1024,
    MOST_BUFFERS = 65536,
    MOST_ARGUMENTS = 256,
    ITEM_BYTES = 28 /* of a result: sum[3], carry[3], divisor */
};

/* Devices may round differently, so a ray may meet another surface than it did. A picture is the
 * same if its mean is within this part of itself, and all but this part of its pixels are within
 * that part of the mean. */
static const double mean_tolerance = 1e-4, pixel_tolerance = 1e-3, pixels_beyond = 0.01;

static void die(const char *words, const char *detail)
{
    fprintf(stderr, "replay: %s%s\n", words, detail);
    exit(1);
}

static void need(cl_int code, const char *what)
{
    char number[32];
    if (code == CL_SUCCESS) return;
    snprintf(number, sizeof number, ": OpenCL error %d", (int)code);
    die(what, number);
}

static void *allocate(size_t size)
{
    void *memory = calloc(1, size > 0 ? size : 1);
    if (memory == NULL) die("out of memory", "");
    return memory;
}

static double now_s(void)
{
    struct timespec time;
    clock_gettime(CLOCK_MONOTONIC, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

/* ------------------------------------------------------------------------------------------------
 * The file
 * --------------------------------------------------------------------------------------------- */

/* Bytes that are read one after another; beyond their end is damage. */
typedef struct bytes {
    const unsigned char *at;
    size_t left;
} bytes;

static const void *take(bytes *from, uint64_t size)
{
    const unsigned char *at = from->at;
    if (size > from->left) die("the capsule is damaged", ": a part is longer than the file");
    from->at += size;
    from->left -= (size_t)size;
    return at;
}

static uint32_t take_u32(bytes *from)
{
    uint32_t value;
    memcpy(&value, take(from, sizeof value), sizeof value);
    return value;
}

static uint64_t take_u64(bytes *from)
{
    uint64_t value;
    memcpy(&value, take(from, sizeof value), sizeof value);
    return value;
}

/* A number that has to be below `limit`. */
static uint32_t take_below(bytes *from, uint32_t limit)
{
    const uint32_t value = take_u32(from);
    if (value >= limit) die("the capsule is damaged", ": a number is out of its range");
    return value;
}

static char *take_text(bytes *from, size_t size)
{
    char *text = allocate(size + 1);
    memcpy(text, take(from, size), size);
    return text;
}

static uint64_t sum_of(const unsigned char *data, size_t size, uint64_t sum)
{
    for (size_t i = 0; i < size; i++)
        sum = (sum ^ data[i]) * 0x100000001b3u;
    return sum;
}

static const uint64_t empty_sum = 0xcbf29ce484222325u; /* FNV-1a */

/* The chunks of a file that is whole, and how many samples its launches draw. */
static bytes read_file(const char *path, double *samples)
{
    FILE *file = fopen(path, "rb");
    long size = 0;
    if (file == NULL || fseek(file, 0, SEEK_END) != 0 || (size = ftell(file)) < 0)
        die("cannot read the file ", path);
    unsigned char *data = allocate((size_t)size);
    rewind(file);
    if (fread(data, 1, (size_t)size, file) != (size_t)size) die("cannot read the file ", path);
    fclose(file);
    const size_t last = 8; /* the sum of all bytes before it */
    if (size < 36 || memcmp(data, "CLSHCAP", 7) != 0) die("no capsule: ", path);
    if (data[7] != '1') die("a capsule of another version of clshear: ", path);
    uint64_t sum;
    memcpy(&sum, data + (size_t)size - last, sizeof sum);
    if (sum != sum_of(data, (size_t)size - last, empty_sum))
        die("the capsule is damaged, its checksum is wrong: ", path);
    memcpy(samples, data + (size_t)size - 16, sizeof *samples);
    return (bytes){data + 8, (size_t)size - 8};
}

/* ------------------------------------------------------------------------------------------------
 * The device
 * --------------------------------------------------------------------------------------------- */

typedef struct buffer {
    cl_mem memory;
    size_t size;
} buffer;

typedef struct player {
    cl_device_id device;
    cl_context context;
    cl_command_queue queue;
    const char *options; /* besides those of the capsule */
    cl_program programs[MOST_PROGRAMS];
    uint32_t program_count;
    buffer buffers[MOST_BUFFERS];
    uint32_t buffer_count;
    double compile_s;
    double first_s; /* of the first launch, in which drivers finish compiling */
    double launch_s;
    uint32_t launches;
} player;

static cl_uint all_devices(cl_device_id *devices)
{
    cl_platform_id platforms[16];
    cl_uint platform_count = 0, total = 0;
    if (clGetPlatformIDs(16, platforms, &platform_count) != CL_SUCCESS) return 0;
    for (cl_uint i = 0; i < platform_count && i < 16; i++) {
        cl_uint count = 0;
        if (total == MOST_DEVICES) break;
        if (clGetDeviceIDs(platforms[i], CL_DEVICE_TYPE_ALL, MOST_DEVICES - total, devices + total,
                           &count) == CL_SUCCESS)
            total += count < MOST_DEVICES - total ? count : MOST_DEVICES - total;
    }
    return total;
}

static void describe(cl_device_id device, char *name, char *driver, size_t size)
{
    char words[4][128] = {"", "", "", ""};
    cl_platform_id platform = NULL;
    clGetDeviceInfo(device, CL_DEVICE_PLATFORM, sizeof platform, &platform, NULL);
    clGetDeviceInfo(device, CL_DEVICE_NAME, sizeof words[0] - 1, words[0], NULL);
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof words[1] - 1, words[1], NULL);
    clGetDeviceInfo(device, CL_DRIVER_VERSION, sizeof words[2] - 1, words[2], NULL);
    clGetDeviceInfo(device, CL_DEVICE_VERSION, sizeof words[3] - 1, words[3], NULL);
    snprintf(name, size, "%s (%s)", words[0], words[1]);
    snprintf(driver, size, "%s, %s", words[2], words[3]);
}

static int contains(const char *text, const char *part)
{
    for (; *text != '\0'; text++) {
        size_t i = 0;
        while (part[i] != '\0' &&
               tolower((unsigned char)text[i]) == tolower((unsigned char)part[i]))
            i++;
        if (part[i] == '\0') return 1;
    }
    return 0;
}

static cl_device_id find_device(const char *wanted)
{
    cl_device_id devices[MOST_DEVICES];
    const cl_uint count = all_devices(devices);
    char name[512], driver[512], *end;
    const long number = strtol(wanted, &end, 10);
    if (count == 0) die("no OpenCL device found", "");
    for (cl_uint i = 0; i < count; i++) {
        describe(devices[i], name, driver, sizeof name);
        if (*end == '\0' ? number == (long)i : contains(name, wanted)) return devices[i];
    }
    for (cl_uint i = 0; i < count; i++) {
        describe(devices[i], name, driver, sizeof name);
        fprintf(stderr, "%u: %s\n", i, name);
    }
    die("no such device: ", wanted);
    return NULL;
}

static void open_device(player *player, const char *wanted)
{
    cl_int code;
    char name[512], driver[512];
    player->device = find_device(wanted);
    describe(player->device, name, driver, sizeof name);
    printf("device: %s\ndriver: %s\n", name, driver);
    player->context = clCreateContext(NULL, 1, &player->device, NULL, NULL, &code);
    need(code, "cannot make a context");
    player->queue = clCreateCommandQueue(player->context, player->device, 0, &code);
    need(code, "cannot make a queue");
}

/* ------------------------------------------------------------------------------------------------
 * The chunks
 * --------------------------------------------------------------------------------------------- */

static void build(player *player, bytes chunk)
{
    if (player->program_count == MOST_PROGRAMS) die("the capsule has too many programs", "");
    const double before_s = now_s();
    char *recorded = take_text(&chunk, take_u32(&chunk));
    char *text = take_text(&chunk, chunk.left);
    char *options = allocate(strlen(recorded) + strlen(player->options) + 2);
    const char *source = text;
    cl_int code;
    sprintf(options, "%s %s", recorded, player->options);
    cl_program program = clCreateProgramWithSource(player->context, 1, &source, NULL, &code);
    need(code, "the kernels cannot be loaded");
    code = clBuildProgram(program, 1, &player->device, options, NULL, NULL);
    if (code != CL_SUCCESS) {
        size_t size = 0;
        clGetProgramBuildInfo(program, player->device, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
        char *log = allocate(size + 1);
        clGetProgramBuildInfo(program, player->device, CL_PROGRAM_BUILD_LOG, size, log, NULL);
        fprintf(stderr, "%s\n", log);
        need(code, "the kernels do not compile");
    }
    player->programs[player->program_count++] = program;
    player->compile_s += now_s() - before_s;
    free(recorded);
    free(text);
    free(options);
}

/* Words in runs: each has twice its length, plus 1 where all are the one word that follows. */
static void unpack(bytes *chunk, unsigned char *contents, size_t count)
{
    for (size_t i = 0; i < count;) {
        const uint32_t head = take_u32(chunk);
        const size_t length = head / 2;
        const unsigned char *word = take(chunk, 8 * (uint64_t)(head % 2 != 0 ? 1 : length));
        if (length == 0 || length > count - i)
            die("the capsule is damaged", ": a run of a buffer is too long");
        for (size_t end = i + length; i < end; i++, word += head % 2 != 0 ? 0 : 8)
            memcpy(contents + 8 * i, word, 8);
    }
}

/* Makes or overwrites a buffer. */
static void fill(player *player, bytes chunk)
{
    const uint32_t number = take_below(&chunk, MOST_BUFFERS);
    const uint64_t size = take_u64(&chunk);
    buffer *filled = &player->buffers[number];
    if (number > player->buffer_count || size == 0 || size > SIZE_MAX - 8 ||
        (number < player->buffer_count && size != filled->size))
        die("the capsule is damaged", ": a buffer has a wrong size");
    cl_int code;
    const size_t words = ((size_t)size + 7) / 8;
    unsigned char *contents = allocate(8 * words);
    unpack(&chunk, contents, words);
    if (number == player->buffer_count) {
        filled->memory =
            clCreateBuffer(player->context, CL_MEM_READ_WRITE, (size_t)size, NULL, &code);
        need(code, "no memory for a buffer");
        filled->size = (size_t)size;
        player->buffer_count++;
    }
    need(clEnqueueWriteBuffer(player->queue, filled->memory, CL_TRUE, 0, (size_t)size, contents, 0,
                              NULL, NULL),
         "a buffer cannot be written");
    free(contents);
}

static void set_argument(const player *player, cl_kernel kernel, cl_uint index, bytes *chunk)
{
    const uint32_t size = take_u32(chunk);
    if (size > 0) {
        need(clSetKernelArg(kernel, index, size, take(chunk, size)), "an argument is not accepted");
        return;
    }
    const uint32_t number = take_below(chunk, player->buffer_count + 1);
    cl_mem memory = number > 0 ? player->buffers[number - 1].memory : NULL;
    need(clSetKernelArg(kernel, index, sizeof memory, &memory), "a buffer is not accepted");
}

static void launch(player *player, bytes chunk)
{
    cl_int code;
    cl_event end;
    const uint32_t program = take_below(&chunk, player->program_count);
    const size_t global = (size_t)take_u64(&chunk), local = (size_t)take_u64(&chunk);
    char *name = take_text(&chunk, take_u32(&chunk));
    cl_kernel kernel = clCreateKernel(player->programs[program], name, &code);
    need(code, "a kernel cannot be made");
    const uint32_t count = take_below(&chunk, MOST_ARGUMENTS);
    for (uint32_t i = 0; i < count; i++)
        set_argument(player, kernel, i, &chunk);
    const double before_s = now_s();
    need(clEnqueueNDRangeKernel(player->queue, kernel, 1, NULL, &global, &local, 0, NULL, &end),
         "a kernel cannot be started");
    need(clWaitForEvents(1, &end), "a kernel failed");
    player->launch_s += now_s() - before_s;
    if (player->launches++ == 0) player->first_s = player->launch_s;
    clReleaseEvent(end);
    clReleaseKernel(kernel);
    free(name);
}

/* ------------------------------------------------------------------------------------------------
 * The results
 * --------------------------------------------------------------------------------------------- */

typedef struct results {
    double mean[2][3]; /* sums over the pixels, at first: recorded, replayed */
    uint64_t sum[2];   /* FNV-1a of the bits of all pixels */
    double *differences;
    size_t pixels;
} results;

/* A pixel's colour out of the seven words of a result. */
static void colour_of(const unsigned char *item, float *colour)
{
    float words[6];
    uint32_t divisor;
    memcpy(words, item, sizeof words);
    memcpy(&divisor, item + sizeof words, sizeof divisor);
    for (int c = 0; c < 3; c++)
        colour[c] = divisor > 0 ? (words[c] + words[3 + c]) / (float)divisor : 0.0f;
}

static void compare(player *player, bytes chunk, results *results)
{
    const buffer *made = &player->buffers[take_below(&chunk, player->buffer_count)];
    const uint64_t items = take_u32(&chunk), words = take_u32(&chunk);
    const uint32_t sum = take_u32(&chunk), carry = take_u32(&chunk), divisor = take_u32(&chunk);
    if (items * words * 4 > made->size || sum + 3ull > words || carry + 3ull > words ||
        divisor >= words || chunk.left < items * ITEM_BYTES)
        die("the capsule is damaged", ": a result does not fit its buffer");
    unsigned char *contents = allocate(made->size);
    need(clEnqueueReadBuffer(player->queue, made->memory, CL_TRUE, 0, made->size, contents, 0, NULL,
                             NULL),
         "a result cannot be read");
    double *grown =
        realloc(results->differences, (results->pixels + (size_t)items) * sizeof *grown);
    if (grown == NULL) die("out of memory", "");
    results->differences = grown;
    for (uint64_t i = 0; i < items; i++) {
        const unsigned char *item = contents + i * words * 4;
        unsigned char now[ITEM_BYTES];
        float colours[2][3];
        memcpy(now, item + 4 * (size_t)sum, 12);
        memcpy(now + 12, item + 4 * (size_t)carry, 12);
        memcpy(now + 24, item + 4 * (size_t)divisor, 4);
        colour_of(take(&chunk, ITEM_BYTES), colours[0]);
        colour_of(now, colours[1]);
        double most = 0.0;
        for (int c = 0; c < 3; c++) {
            const double difference = fabs((double)colours[1][c] - (double)colours[0][c]);
            if (!(difference <= most)) most = difference; /* and where it is no number */
            for (int k = 0; k < 2; k++)
                results->mean[k][c] += (double)colours[k][c];
        }
        for (int k = 0; k < 2; k++)
            results->sum[k] =
                sum_of((const unsigned char *)colours[k], sizeof colours[k], results->sum[k]);
        results->differences[results->pixels++] = most;
    }
    free(contents);
}

/* Prints both films' sums and returns whether they are the same picture. */
static int judge(results *results)
{
    double scale = 0.0, largest = 0.0, apart = 0.0;
    size_t beyond = 0;
    if (results->pixels == 0) die("the capsule has no result", "");
    for (int c = 0; c < 3; c++) {
        for (int k = 0; k < 2; k++)
            results->mean[k][c] /= (double)results->pixels;
        scale += results->mean[0][c] / 3.0;
    }
    if (!(scale > 0.0)) scale = 1.0; /* a black picture */
    for (int c = 0; c < 3; c++) {
        const double difference = fabs(results->mean[1][c] - results->mean[0][c]) / scale;
        if (!(difference <= apart)) apart = difference; /* and where it is no number */
    }
    for (size_t i = 0; i < results->pixels; i++) {
        const double difference = results->differences[i] / scale;
        if (!(difference <= largest)) largest = difference;
        if (!(difference <= pixel_tolerance)) beyond++;
    }
    static const char *const names[] = {"recorded", "replayed"};
    for (int k = 0; k < 2; k++)
        printf("%s: mean %.7f %.7f %.7f, checksum %016llx\n", names[k], results->mean[k][0],
               results->mean[k][1], results->mean[k][2], (unsigned long long)results->sum[k]);
    printf("largest difference: %.2e of the mean in a pixel, %.2e in the mean; %zu of %zu pixels "
           "beyond %g\n",
           largest, apart, beyond, results->pixels, pixel_tolerance);
    if (results->sum[0] == results->sum[1]) {
        printf("equal, bit by bit\n");
        return 1;
    }
    const int same =
        apart <= mean_tolerance && (double)beyond <= pixels_beyond * (double)results->pixels;
    printf("%s\n", same ? "equal within rounding" : "DIFFERENT");
    return same;
}

/* Runs the chunks in order. */
static void play(player *player, bytes file, results *results)
{
    for (;;) {
        char name[4];
        memcpy(name, take(&file, 4), 4);
        const uint64_t size = take_u64(&file);
        const bytes chunk = {take(&file, size), (size_t)size};
        if (memcmp(name, "info", 4) == 0)
            printf("capsule: %.*s\n", (int)size, (const char *)chunk.at);
        else if (memcmp(name, "prog", 4) == 0)
            build(player, chunk);
        else if (memcmp(name, "buff", 4) == 0)
            fill(player, chunk);
        else if (memcmp(name, "run ", 4) == 0)
            launch(player, chunk);
        else if (memcmp(name, "want", 4) == 0)
            compare(player, chunk, results);
        else if (memcmp(name, "end ", 4) == 0)
            return;
        else
            die("the capsule is damaged", ": it has a part that is not known");
    }
}

static int usage(void)
{
    fprintf(stderr, "usage: replay FILE [--device N|NAME] [--options TEXT]\n");
    return 2;
}

int main(int count, char **words)
{
    static player player = {.options = ""};
    results results = {.sum = {empty_sum, empty_sum}};
    const char *path = NULL, *device = "0";
    double samples;
    for (int i = 1; i < count; i++) {
        if (strcmp(words[i], "--device") == 0 && i + 1 < count)
            device = words[++i];
        else if (strcmp(words[i], "--options") == 0 && i + 1 < count)
            player.options = words[++i];
        else if (*words[i] != '-' && path == NULL)
            path = words[i];
        else
            return usage();
    }
    if (path == NULL) return usage();
    const bytes file = read_file(path, &samples);
    open_device(&player, device);
    play(&player, file, &results);
    printf("compiling: %.3g s; %u launches: %.3g s, the first %.3g s; %.4g million samples, %.4g "
           "million a second\n",
           player.compile_s, player.launches, player.launch_s, player.first_s, 1e-6 * samples,
           1e-6 * samples / player.launch_s);
    return judge(&results) ? 0 : 1;
}
