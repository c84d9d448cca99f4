/* Slices as pictures and data. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/output.h"
#include "cli/slice.h"

static int fail(const char *message)
{
    fprintf(stderr, "clshear: %s\n", message);
    return CLI_FAILED;
}

static int is_data(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot != NULL && strcmp(dot, ".exr") == 0;
}

/* Draws the line through the middle along which the second coordinate, downwards, changes by `down`
 * where the first changes by `across`, one value wide, into three planes. */
static void draw_line(float *const *planes, int width, int height, double across, double down)
{
    static const float colour[3] = {1.0f, 0.0f, 0.6f};
    const double dx = across * width, dy = down * height;
    const double steps = fmax(fabs(dx), fabs(dy));
    if (!(steps > 0.0)) return;
    for (int i = -2 * (width + height); i <= 2 * (width + height); i++) {
        const int x = (int)floor(0.5 * width + 0.5 * i * dx / steps);
        const int y = (int)floor(0.5 * height + 0.5 * i * dy / steps);
        if (x < 0 || y < 0 || x >= width || y >= height) continue;
        for (int c = 0; c < 3; c++)
            planes[c][y * width + x] = colour[c];
    }
}

/* R, G, B; in pictures scaled so that the brightest value is white, with the fibre's direction. */
static int write_slice(const cli_slice_job *job, const cli_slice *slice, const char *path)
{
    static const char *const names[] = {"R", "G", "B"};
    float *memory = malloc(3 * slice->count * sizeof *memory), most = 1e-30f;
    if (memory == NULL) return fail("out of memory");
    float *const planes[3] = {memory, memory + slice->count, memory + 2 * slice->count};
    for (size_t i = 0; i < 3 * slice->count; i++)
        most = slice->rgb[i] > most ? slice->rgb[i] : most;
    const float scale = is_data(path) ? 1.0f : 1.0f / most;
    for (size_t i = 0; i < 3 * slice->count; i++)
        planes[i % 3][i / 3] = scale * slice->rgb[i];
    if (!is_data(path) && !job->no_line && slice->slope != 0.0)
        draw_line(planes, slice->width, slice->height, -slice->slope, 1.0);
    const clshear_status status = clshear_image_write(path, slice->width, slice->height, 3, names,
                                                      (const float *const *)planes);
    free(memory);
    return status == CLSHEAR_OK ? CLI_DONE : fail(clshear_message(NULL));
}

/* Version 1.0 of the format: a magic string, the length of a header in Python's syntax, data. */
static void write_npy(FILE *stream, const void *user)
{
    const cli_slice *slice = user;
    const int r = slice->width;
    char header[118];
    int length = snprintf(
        header, sizeof header,
        "{'descr': '<f4', 'fortran_order': False, 'shape': (%d, %d, %d, %d, 3), }", r, r, r, r);
    memset(header + length, ' ', sizeof header - (size_t)length);
    header[sizeof header - 1] = '\n';
    fwrite("\x93NUMPY\x01\x00", 1, 8, stream);
    fputc((int)sizeof header, stream);
    fputc(0, stream);
    fwrite(header, 1, sizeof header, stream);
    fwrite(slice->rgb, sizeof *slice->rgb, 3 * slice->count, stream);
}

/* Logarithms of the power from 10^-5 (black) to 10^3 (white), with the line on which a surface of
 * the oracle's depth has its energy; as data the power itself. */
static int draw_spectrum(const cli_slice_job *job, const cli_slice *slice,
                         const clshear_spectrum *spectrum, const char *path)
{
    static const char *const names[] = {"R", "G", "B"};
    if (is_data(path))
        return clshear_spectrum_write(spectrum, 0, path) == CLSHEAR_OK
                   ? CLI_DONE
                   : fail(clshear_message(NULL));
    float *memory = malloc(3 * slice->count * sizeof *memory);
    if (memory == NULL) return fail("out of memory");
    float *const planes[3] = {memory, memory + slice->count, memory + 2 * slice->count};
    for (size_t i = 0; i < slice->count; i++) {
        const double level = (log10((double)spectrum->power[i] + 1e-12) + 5.0) / 8.0;
        const double grey = level < 0.0 ? 0.0 : level > 1.0 ? 1.0 : level;
        for (int c = 0; c < 3; c++)
            planes[c][i] = (float)pow(grey, 2.2);
    }
    if (!job->no_line && slice->slope != 0.0)
        draw_line(planes, slice->width, slice->height, 1.0 / slice->width,
                  slice->slope / slice->height);
    const clshear_status status = clshear_image_write(path, slice->width, slice->height, 3, names,
                                                      (const float *const *)planes);
    free(memory);
    return status == CLSHEAR_OK ? CLI_DONE : fail(clshear_message(NULL));
}

/* Hann's window over `count` values: without it the jump from one edge to the other is all that is
 * seen. */
static double window(int index, int count)
{
    return 0.5 - 0.5 * cos(2.0 * 3.14159265358979323846 * (index + 0.5) / count);
}

static int write_spectrum(const cli_slice_job *job, const cli_slice *slice)
{
    clshear_spectrum spectrum = {0};
    float *grey = malloc(slice->count * sizeof *grey);
    double mean = 0.0;
    int code = CLI_FAILED;
    if (grey == NULL) return fail("out of memory");
    for (size_t i = 0; i < slice->count; i++) {
        grey[i] = (slice->rgb[3 * i] + slice->rgb[3 * i + 1] + slice->rgb[3 * i + 2]) / 3.0f;
        mean += (double)grey[i] / (double)slice->count;
    }
    for (size_t i = 0; i < slice->count; i++) {
        const int x = (int)(i % (size_t)slice->width), y = (int)(i / (size_t)slice->width);
        grey[i] =
            (float)(((double)grey[i] - mean) * window(x, slice->width) * window(y, slice->height));
    }
    if (clshear_spectrum_of_grid(grey, (size_t)slice->width, (size_t)slice->height, &spectrum) ==
        CLSHEAR_OK)
        code = draw_spectrum(job, slice, &spectrum, job->spectrum);
    else
        fail(clshear_message(NULL));
    clshear_spectrum_free(&spectrum);
    free(grey);
    return code;
}

int cli_slice_write(const cli_slice_job *job, const cli_slice *slice)
{
    int code = CLI_DONE;
    for (int i = 0; i < job->output_count && code == CLI_DONE; i++)
        code = strcmp(job->projection, "4d") == 0
                   ? cli_write_file(job->outputs[i], write_npy, slice)
                   : write_slice(job, slice, job->outputs[i]);
    if (code == CLI_DONE && job->spectrum != NULL) code = write_spectrum(job, slice);
    return code;
}
