/* OFF, the Object File Format of Geomview, as text. */
#include <math.h>
#include <string.h>
#include <strings.h>

#include "base/number.h"
#include "import/colour.h"
#include "import/readers.h"

enum {
    MOST = 16 /* numbers of a vertex, or behind an item */
};

typedef struct off_reader {
    cs_model *model;
    cs_error *error;
    cs_lines lines;
    char *at;                /* in the line; NULL: the next one has to be read */
    int has_st, has_colours; /* the vertices */
    int has_normals, has_w;
    int dimension; /* of the vertices, 3 at least; 0: stands before the counts */
    size_t vertices, faces;
    int is_dense;     /* vertices, or faces, share lines: there is nothing behind them */
    int is_short;     /* fewer lines than vertices and faces: they share lines, or it was cut */
    int has_more;     /* some line has numbers that mean nothing */
    cs_array corners; /* cs_corner, of the current face */
} off_reader;

/* Goes behind OFF and the letters before it, in whatever order; NULL where there is no such mark.
 */
static const char *read_mark(off_reader *reader)
{
    const char *at = reader->at;
    reader->dimension = 3;
    for (;; at++) {
        if (strncasecmp(at, "OFF", 3) == 0) return at + 3;
        if (strncmp(at, "ST", 2) == 0) {
            reader->has_st = 1;
            at++;
        } else if (*at == 'C') {
            reader->has_colours = 1;
        } else if (*at == 'N') {
            reader->has_normals = 1;
        } else if (*at == '4') {
            reader->has_w = 1;
        } else if (*at == 'n') {
            reader->dimension = 0;
        } else {
            break;
        }
    }
    reader->has_st = reader->has_colours = reader->has_normals = reader->has_w = 0;
    reader->dimension = 3;
    return NULL;
}

int cs_is_off(const cs_bytes *bytes, const char *path)
{
    (void)bytes;
    return cs_has_suffix(path, ".off");
}

static clshear_status complain_of_end(const off_reader *reader)
{
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s:%zu: the file ends here; it was cut",
                   reader->model->path, reader->lines.number);
}

/* In a file that is short, a wrong number may as well be one of what is behind an item. */
static clshear_status complain(const off_reader *reader, const char *what)
{
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s:%zu: %s%s", reader->model->path,
                   reader->lines.number, what,
                   reader->is_short ? "; or lines are missing: the file was cut" : "");
}

/* Moves to the next word, over lines and comments; 0 at the end of the file. */
static int find_word(off_reader *reader)
{
    for (;;) {
        if (reader->at == NULL) reader->at = cs_lines_next(&reader->lines);
        if (reader->at == NULL) return 0;
        while (*reader->at != '\0' && (unsigned char)*reader->at <= ' ')
            reader->at++;
        if (*reader->at != '\0' && *reader->at != '#') return 1;
        reader->at = NULL;
    }
}

/* The next number of the line that the reader is in; 0 where there is none. */
static int next_in_line(off_reader *reader, double *value)
{
    if (reader->at == NULL) return 0;
    char *at = reader->at;
    while (*at != '\0' && (unsigned char)*at <= ' ')
        at++;
    const char *end = at + strcspn(at, " \t\v\f");
    const char *after = cs_parse_number(at, end, value);
    if (after == at || ((unsigned char)*after > ' ' && *after != '#')) return 0;
    reader->at = at + (after - at);
    return 1;
}

/* The next number of the file. */
static clshear_status next_number(off_reader *reader, double *value)
{
    if (!find_word(reader)) return complain_of_end(reader);
    if (!next_in_line(reader, value)) return complain(reader, "this is not a number");
    return CLSHEAR_OK;
}

static clshear_status next_count(off_reader *reader, size_t *count)
{
    double value = 0.0;
    const clshear_status status = next_number(reader, &value);
    if (status != CLSHEAR_OK) return status;
    if (!(value >= 0.0 && value <= (double)CS_MODEL_MOST) || value != floor(value))
        return complain(reader, "a count must be a whole number of 0 to 134217727");
    *count = (size_t)value;
    return CLSHEAR_OK;
}

/* Whether the next line with words has only one. */
static int has_word_alone(const off_reader *reader)
{
    const char *at = reader->lines.at, *end = reader->lines.end;
    while (at != end && (unsigned char)*at <= ' ')
        at++;
    while (at != end && (unsigned char)*at > ' ')
        at++;
    while (at != end && (*at == ' ' || *at == '\t'))
        at++;
    return at != end && (*at == '\n' || *at == '\r');
}

/* The mark, which files leave out or write together with the counts; then the counts, of which that
 * of edges is not used and may be missing. It has a line of its own where the others do. */
static clshear_status read_head(off_reader *reader)
{
    clshear_status status = CLSHEAR_OK;
    double edges;
    size_t dimension = 3;
    if (!find_word(reader)) return complain_of_end(reader);
    const char *behind = read_mark(reader);
    if (behind != NULL) reader->at += behind - reader->at;
    const char *word = reader->at + strspn(reader->at, " \t");
    if (behind != NULL && strncasecmp(word, "BINARY", 6) == 0)
        return complain(reader, "binary OFF is not supported; export it as text");
    if (reader->dimension == 0) {
        status = next_count(reader, &dimension);
        reader->dimension = (int)dimension;
    }
    if (status == CLSHEAR_OK && (dimension < 3 || dimension > 4))
        return complain(reader, "vertices must have 3 or 4 coordinates");
    if (status == CLSHEAR_OK) status = next_count(reader, &reader->vertices);
    const size_t line = reader->lines.number;
    if (status == CLSHEAR_OK) status = next_count(reader, &reader->faces);
    if (status == CLSHEAR_OK && !next_in_line(reader, &edges) && reader->lines.number > line &&
        has_word_alone(reader))
        status = next_number(reader, &edges);
    return status;
}

/* Whether what is left has fewer lines than items. */
static int shares_lines(const off_reader *reader, size_t items)
{
    const char *at = reader->lines.at;
    size_t count = reader->at != NULL && reader->at[strspn(reader->at, " \t\v\f")] != '\0';
    int is_new = 1; /* no word or comment has begun in the line */
    for (; at != reader->lines.end && count < items; at++) {
        if (*at == '\n' || *at == '\r') {
            is_new = 1;
        } else if (is_new && (unsigned char)*at > ' ') {
            count += *at != '#';
            is_new = 0;
        }
    }
    return count < items;
}

/* The numbers that are left in the line of an item, of which MOST are kept; returns their count. */
static int read_behind(off_reader *reader, double numbers[MOST])
{
    double beyond;
    int count = 0;
    while (!reader->is_dense && next_in_line(reader, count < MOST ? &numbers[count] : &beyond))
        count++;
    return count;
}

static void take_colour(const double *numbers, float *colour)
{
    for (int c = 0; c < 3; c++)
        colour[c] = cs_colour_value(numbers[c], 1);
}

/* Adds a vertex of these numbers, the texture coordinates last. `places` are those of its position,
 * `marked` all that the mark says. */
static clshear_status add_vertex(off_reader *reader, const double *numbers, int places, int marked,
                                 int count)
{
    cs_model *model = reader->model;
    double *position = cs_model_extend(&model->positions, 1);
    float *normal = cs_model_extend(&model->normals, (size_t)reader->has_normals);
    float *st = cs_model_extend(&model->textures, (size_t)reader->has_st);
    if (position == NULL || normal == NULL || st == NULL)
        return cs_model_full(model, reader->error);
    const double w = reader->has_w && numbers[3] != 0.0 ? numbers[3] : 1.0;
    for (int i = 0; i < 3; i++) {
        position[i] = numbers[i] / w;
        if (reader->has_normals) normal[i] = (float)numbers[places + i];
    }
    for (int i = 0; i < 2 && reader->has_st; i++)
        st[i] = count >= marked + 2 ? (float)numbers[count - 2 + i] : 0.0f;
    const int unmarked = !reader->has_st && (count == marked + 3 || count == marked + 4);
    if (!reader->has_colours && !unmarked) return CLSHEAR_OK; /* OFF with the colours of COFF */
    float colour[3];
    take_colour(numbers + marked - (reader->has_colours ? 3 : 0), colour);
    return cs_model_set_colour(model, model->positions.count - 1, colour, reader->error);
}

/* x y z, w, a normal, a colour, texture coordinates, as far as the mark says. What is behind them
 * in the line may be the colour and the alpha that the mark does not say, or the alpha of a colour.
 */
static clshear_status read_vertex(off_reader *reader)
{
    double numbers[2 * MOST] = {0};
    const int places = reader->has_w ? 4 : reader->dimension;
    const int marked = places + 3 * (reader->has_normals + reader->has_colours);
    const int coordinates = 2 * reader->has_st;
    int count = 0;
    while (count < marked + (reader->is_dense ? coordinates : 0)) {
        const clshear_status status = next_number(reader, &numbers[count++]);
        if (status != CLSHEAR_OK) return status;
    }
    const int behind = read_behind(reader, numbers + count);
    const int colour = behind - (reader->is_dense ? 0 : coordinates);
    const int is_colour = reader->has_colours ? colour == 1 : colour == 3 || colour == 4;
    const int is_known = behind == 0 || colour == 0 || is_colour;
    reader->has_more |= !is_known;
    return add_vertex(reader, numbers, places, marked, count + (is_known ? behind : 0));
}

/* The colour behind a face: three or four numbers. One is the number of a colour in a map that is
 * not in the file. */
static clshear_status colour_face(off_reader *reader)
{
    cs_model *model = reader->model;
    cs_corner *corners = reader->corners.items;
    double numbers[MOST];
    float colour[3];
    const int count = read_behind(reader, numbers);
    reader->has_more |= count == 2 || count > 4;
    if (count < 3 || count > 4) return CLSHEAR_OK;
    take_colour(numbers, colour);
    for (size_t i = 0; i < reader->corners.count; i++) { /* positions of its own */
        const size_t place = model->positions.count;
        double *position = cs_model_extend(&model->positions, 1);
        if (position == NULL) return cs_model_full(model, reader->error);
        memcpy(position, ((double(*)[3])model->positions.items)[corners[i].position],
               3 * sizeof *position);
        corners[i].position = (uint32_t)place;
        const clshear_status status = cs_model_set_colour(model, place, colour, reader->error);
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}

static clshear_status read_face(off_reader *reader)
{
    size_t count = 0;
    double number = 0.0;
    clshear_status status = next_count(reader, &count);
    reader->corners.count = 0;
    for (size_t i = 0; i < count && status == CLSHEAR_OK; i++) {
        status = next_number(reader, &number);
        if (status != CLSHEAR_OK) return status;
        if (!(number >= 0.0 && number < (double)reader->vertices) || number != floor(number))
            return complain(reader, "the face names a vertex that is not there");
        cs_corner *corner = cs_array_extend(&reader->corners, 1);
        if (corner == NULL) return cs_model_full(reader->model, reader->error);
        const uint32_t place = (uint32_t)number;
        *corner = (cs_corner){place, reader->has_normals ? place : CS_NO_INDEX,
                              reader->has_st ? place : CS_NO_INDEX};
    }
    if (status == CLSHEAR_OK) status = colour_face(reader);
    if (status != CLSHEAR_OK) return status;
    return cs_model_add_polygon(reader->model, reader->corners.items, reader->corners.count,
                                CS_NO_INDEX, 0, reader->error);
}

/* All items are read: nothing may be left. */
static clshear_status read_end(off_reader *reader)
{
    const cs_model *model = reader->model;
    const int is_left = find_word(reader);
    if (reader->is_short && (is_left || reader->has_more))
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: has fewer lines than vertices and faces, but more numbers; it was cut, "
                       "or its counts are wrong",
                       model->path);
    if (is_left)
        cs_warn(model->log, "%s:%zu: what is behind the faces that the head counts is left out",
                model->path, reader->lines.number);
    if (reader->has_more)
        cs_warn(model->log, "%s: has lines with more numbers than its kind of OFF has; left out",
                model->path);
    if (model->triangles.count == 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: there are no faces in it",
                       model->path);
    return CLSHEAR_OK;
}

clshear_status cs_read_off(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    off_reader reader = {.model = model, .error = error};
    reader.corners.item_size = sizeof(cs_corner);
    model->up_is_open = 1;
    clshear_status status = cs_bytes_to_utf8(bytes, model->path, error);
    reader.lines = cs_lines_of(bytes);
    if (status == CLSHEAR_OK) status = read_head(&reader);
    reader.is_short = reader.is_dense = shares_lines(&reader, reader.vertices + reader.faces);
    for (size_t i = 0; i < reader.vertices && status == CLSHEAR_OK; i++)
        status = read_vertex(&reader);
    reader.is_dense = shares_lines(&reader, reader.faces);
    reader.is_short |= reader.is_dense;
    for (size_t i = 0; i < reader.faces && status == CLSHEAR_OK; i++)
        status = read_face(&reader);
    if (status == CLSHEAR_OK) status = read_end(&reader);
    cs_array_free(&reader.corners);
    return status;
}
