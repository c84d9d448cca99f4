#include "report/slice_files.h"

#include <clshear/analysis.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "report/failure.h"
#include "report/output.h"
#include "report/words.h"

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

/* Writes three planes that lie one behind the other, and frees them. */
static int write_planes(const slice_values *slice, float *const *planes, const char *path)
{
    static const char *const names[] = {"R", "G", "B"};
    const float *const constant[] = {planes[0], planes[1], planes[2]};
    const clshear_status status =
        clshear_image_write(path, slice->width, slice->height, 3, names, constant);
    free(planes[0]);
    return exit_status_of(status);
}

/* In pictures the brightest value is white. */
int slice_write_image(const slice_values *slice, const char *path)
{
    const int is_data = has_ending(".exr", path);
    float *memory = malloc(3 * slice->count * sizeof *memory), most = 1e-30f;
    if (memory == NULL) return complain(EXIT_FAILED, "out of memory");
    float *const planes[3] = {memory, memory + slice->count, memory + 2 * slice->count};
    for (size_t i = 0; i < 3 * slice->count; i++)
        most = slice->rgb[i] > most ? slice->rgb[i] : most;
    const float scale = is_data ? 1.0f : 1.0f / most;
    for (size_t i = 0; i < 3 * slice->count; i++)
        planes[i % 3][i / 3] = scale * slice->rgb[i];
    if (!is_data && slice->slope != 0.0)
        draw_line(planes, slice->width, slice->height, -slice->slope, 1.0);
    return write_planes(slice, planes, path);
}

/* Version 1.0 of the format: a magic string, the length of a header in Python's syntax, data. */
static void write_npy(FILE *stream, const void *user)
{
    const slice_values *slice = user;
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

int slice_write_npy(const slice_values *slice, const char *path)
{
    return write_file(path, write_npy, slice);
}

/* Logarithms of the power from 10^-5 (black) to 10^3 (white), with the line on which a surface of
 * the oracle's depth has its energy. */
static int draw_spectrum(const slice_values *slice, const float *power, const char *path)
{
    float *memory = malloc(3 * slice->count * sizeof *memory);
    if (memory == NULL) return complain(EXIT_FAILED, "out of memory");
    float *const planes[3] = {memory, memory + slice->count, memory + 2 * slice->count};
    for (size_t i = 0; i < slice->count; i++) {
        const double level = (log10((double)power[i] + 1e-12) + 5.0) / 8.0;
        const double grey = fmin(fmax(level, 0.0), 1.0);
        for (int c = 0; c < 3; c++)
            planes[c][i] = (float)pow(grey, 2.2);
    }
    if (slice->slope != 0.0)
        draw_line(planes, slice->width, slice->height, 1.0 / slice->width,
                  slice->slope / slice->height);
    return write_planes(slice, planes, path);
}

int slice_write_spectrum(const slice_values *slice, const char *path)
{
    clshear_spectrum *spectrum = NULL;
    float *grey = malloc(slice->count * sizeof *grey);
    if (grey == NULL) return complain(EXIT_FAILED, "out of memory");
    for (size_t i = 0; i < slice->count; i++)
        grey[i] = (slice->rgb[3 * i] + slice->rgb[3 * i + 1] + slice->rgb[3 * i + 2]) / 3.0f;
    const clshear_status status =
        clshear_spectrum_of_slice(grey, (size_t)slice->width, (size_t)slice->height, &spectrum);
    free(grey);
    int code = exit_status_of(status);
    if (code == EXIT_DONE && has_ending(".exr", path))
        code = exit_status_of(clshear_spectrum_write(spectrum, 0, path));
    else if (code == EXIT_DONE)
        code = draw_spectrum(slice, clshear_spectrum_power(spectrum), path);
    clshear_spectrum_free(spectrum);
    return code;
}
