/* Point sets as files: text, CSV and EXR. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/array.h"
#include "base/number.h"
#include "base/output_file.h"
#include "image/image_io.h"
#include "points/points.h"

static int has_extension(const char *path, const char *extension)
{
    const size_t length = strlen(path), size = strlen(extension);
    return length > size && strcasecmp(path + length - size, extension) == 0;
}

/* ----- Text ----- */

typedef struct text_reader {
    const char *path;
    cs_error *error;
    cs_array values; /* float coordinates of all points */
    size_t line, dimensions, sets;
    size_t in_set; /* points read of the current set */
    size_t count;  /* points in each complete set */
} text_reader;

static clshear_status complain(const text_reader *reader, const char *what)
{
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s:%zu: %s", reader->path, reader->line, what);
}

static clshear_status end_set(text_reader *reader)
{
    if (reader->in_set == 0) return CLSHEAR_OK; /* a "#" before any point, or a repeated one */
    if (reader->sets > 0 && reader->in_set != reader->count)
        return complain(reader, "this set and the first one have different numbers of points");
    reader->count = reader->in_set;
    reader->in_set = 0;
    reader->sets++;
    return CLSHEAR_OK;
}

static clshear_status read_point(text_reader *reader, const char *text)
{
    float point[sizeof CS_POINT_NAMES];
    size_t dimensions = 0;
    for (text += strspn(text, " \t\r\n"); *text != '\0'; text += strspn(text, " \t\r\n,;")) {
        double wide;
        const char *end = cs_parse_number(text, text + strcspn(text, " \t\r\n,;"), &wide);
        const float value = (float)wide;
        if (end == text) return complain(reader, "a coordinate is not a number");
        if (dimensions == sizeof CS_POINT_NAMES - 1)
            return complain(reader, "more than seven coordinates");
        if (!(value >= 0.0f && value <= 1.0f))
            return complain(reader, "a coordinate is not between 0 and 1");
        point[dimensions++] = value;
        text = end;
    }
    if (dimensions == 0) return CLSHEAR_OK;
    if (reader->dimensions == 0) reader->dimensions = dimensions;
    if (dimensions != reader->dimensions)
        return complain(reader,
                        "this line and the first one have different numbers of coordinates");
    float *added = cs_array_extend(&reader->values, dimensions);
    if (added == NULL) return cs_fail(reader->error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    memcpy(added, point, dimensions * sizeof *point);
    reader->in_set++;
    return CLSHEAR_OK;
}

/* Reads what is left of a line of which `line` holds the beginning. */
static void skip_rest(const char *line, FILE *stream)
{
    int byte = strchr(line, '\n') != NULL ? '\n' : 0;
    while (byte != '\n' && byte != EOF)
        byte = getc(stream);
}

/* Whether `line`, which fgets wrote over line ends, is text up to the end of the line or the file,
 * or a comment that is longer than `size`. A line with a byte 0 is neither. */
static int is_text(const char *line, size_t size, FILE *stream)
{
    const size_t length = strlen(line);
    if (strchr(line, '\n') != NULL) return 1;
    if (feof(stream) && length + 1 < size) return line[length + 1] == '\n';
    return line[0] == '#' && length == size - 1;
}

/* fgets, over line ends: what it has read ends where these begin. */
static int read_line(char *line, int size, FILE *stream)
{
    memset(line, '\n', (size_t)size);
    return fgets(line, size, stream) != NULL;
}

/* Streams without an end of the line, such as /dev/zero, do not fill the memory. */
static clshear_status read_lines(text_reader *reader, FILE *stream)
{
    clshear_status status = CLSHEAR_OK;
    char line[4096];
    while (status == CLSHEAR_OK && read_line(line, sizeof line, stream)) {
        reader->line++;
        if (!is_text(line, sizeof line, stream)) {
            status = complain(reader, "this is no line of text, or has more than 4095 bytes");
        } else if (line[0] == '#') {
            skip_rest(line, stream);
            status = end_set(reader);
        } else {
            status = read_point(reader, line);
        }
    }
    if (status != CLSHEAR_OK) return status;
    if (ferror(stream))
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: cannot be read: %s", reader->path,
                       strerror(errno));
    status = end_set(reader);
    if (status == CLSHEAR_OK && reader->sets == 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: there are no points", reader->path);
    return status;
}

static clshear_status read_text(const char *path, clshear_points *points, cs_error *error)
{
    const int standard = strcmp(path, "-") == 0;
    text_reader reader = {.path = standard ? "standard input" : path, .error = error};
    FILE *stream = standard ? stdin : fopen(path, "r");
    if (stream == NULL)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be opened: %s", path, strerror(errno));
    reader.values.item_size = sizeof(float);
    clshear_status status = read_lines(&reader, stream);
    if (!standard) fclose(stream);
    if (status != CLSHEAR_OK) {
        cs_array_free(&reader.values);
        return status;
    }
    *points = (clshear_points){.values = reader.values.items,
                               .sets = reader.sets,
                               .count = reader.count,
                               .dimensions = reader.dimensions};
    memcpy(points->names, CS_POINT_NAMES, reader.dimensions);
    return CLSHEAR_OK;
}

static int print_points(const clshear_points *points, const char *separator, FILE *stream)
{
    const float *value = points->values;
    char text[32];
    for (size_t set = 0; set < points->sets && !ferror(stream); set++) {
        if (set > 0) fputs("#\n", stream);
        for (size_t i = 0; i < points->count; i++)
            for (size_t d = 0; d < points->dimensions; d++)
                fprintf(stream, "%s%s", cs_format_number(text, sizeof text, (double)*value++, 9),
                        d + 1 < points->dimensions ? separator : "\n");
    }
    return fflush(stream) == 0 && !ferror(stream);
}

static clshear_status write_text(const clshear_points *points, const char *path, cs_error *error)
{
    const char *separator = has_extension(path, ".csv") ? "," : " ";
    cs_output_file file;
    if (strcmp(path, "-") == 0) {
        if (print_points(points, separator, stdout)) return CLSHEAR_OK;
        return cs_fail(error, CLSHEAR_BAD_FILE, "standard output cannot be written: %s",
                       strerror(errno));
    }
    int reason = cs_output_open(path, &file);
    if (reason == 0) {
        const int printed = print_points(points, separator, file.stream);
        const int while_printing = printed ? 0 : errno;
        reason = cs_output_end(&file, printed);
        if (!printed) reason = while_printing;
    }
    if (reason == 0) return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be written: %s", path, strerror(reason));
}

/* ----- EXR ----- */

static clshear_status read_exr(const char *path, clshear_points *points, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_loaded_picture loaded = {0};
    const float *planes[sizeof CS_POINT_NAMES];
    CS_TRY(cs_image_read(path, &loaded, error));
    const cs_picture *picture = &loaded.picture;
    *points = (clshear_points){.sets = (size_t)picture->height, .count = (size_t)picture->width};
    for (const char *name = CS_POINT_NAMES; *name != '\0'; name++)
        for (size_t c = 0; c < picture->channel_count; c++)
            if (picture->names[c][0] == *name && picture->names[c][1] == '\0') {
                points->names[points->dimensions] = *name;
                planes[points->dimensions++] = picture->planes[c];
            }
    CS_REQUIRE(points->dimensions > 0, CLSHEAR_BAD_FILE,
               "%s: has no channels x, y, u, v, p or q; it holds no points", path);
    CS_TRY(cs_points_reserve(points, error));
    for (size_t i = 0; i < points->sets * points->count; i++)
        for (size_t d = 0; d < points->dimensions; d++) {
            const float value = planes[d][i];
            CS_REQUIRE(value >= 0.0f && value <= 1.0f, CLSHEAR_BAD_FILE,
                       "%s: coordinate %c of point %zu is not between 0 and 1", path,
                       points->names[d], i);
            points->values[i * points->dimensions + d] = value;
        }
done:
    cs_image_free(&loaded);
    if (status != CLSHEAR_OK) cs_points_free(points);
    return status;
}

static clshear_status write_exr(const clshear_points *points, const char *path, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t pixels = points->sets * points->count;
    const float *planes[sizeof CS_POINT_NAMES];
    const char *names[sizeof CS_POINT_NAMES];
    char letters[sizeof CS_POINT_NAMES][2] = {{0}};
    float *plane = malloc(pixels * points->dimensions * sizeof *plane);
    CS_REQUIRE(plane != NULL, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    for (size_t d = 0; d < points->dimensions; d++) {
        letters[d][0] = points->names[d];
        names[d] = letters[d];
        planes[d] = plane + d * pixels;
        for (size_t i = 0; i < pixels; i++)
            plane[d * pixels + i] = points->values[i * points->dimensions + d];
    }
    const int width = (int)points->count, height = (int)points->sets;
    const cs_picture picture = {.width = width,
                                .height = height,
                                .full_width = width,
                                .full_height = height,
                                .channel_count = points->dimensions,
                                .names = names,
                                .planes = planes};
    CS_TRY(cs_image_write(path, &picture, error));
done:
    free(plane);
    return status;
}

clshear_status cs_points_read(const char *path, clshear_points *points)
{
    cs_error *error = cs_thread_error();
    return has_extension(path, ".exr") ? read_exr(path, points, error)
                                       : read_text(path, points, error);
}

clshear_status cs_points_write(const clshear_points *points, const char *path)
{
    cs_error *error = cs_thread_error();
    return has_extension(path, ".exr") ? write_exr(points, path, error)
                                       : write_text(points, path, error);
}
