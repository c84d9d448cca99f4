/* Wavefront OBJ. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/number.h"
#include "import/colour.h"
#include "import/obj_reader.h"
#include "import/readers.h"

int cs_has_suffix(const char *path, const char *suffix)
{
    const size_t length = strlen(path), tail = strlen(suffix);
    return length >= tail && strcasecmp(path + length - tail, suffix) == 0;
}

int cs_is_obj(const cs_bytes *bytes, const char *path)
{
    (void)bytes;
    return cs_has_suffix(path, ".obj");
}

static clshear_status complain(const obj_reader *reader, const char *what)
{
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s:%zu: %s", reader->model->path,
                   reader->lines.number, what);
}

/* Numbers of a line; returns how many, at most 8. `*wrong` becomes the first word that is none, or
 * NULL. */
static int read_numbers(char *at, double *numbers, const char **wrong)
{
    static const char blanks[] = " \t\v\f";
    int count = 0;
    *wrong = NULL;
    for (;;) {
        at += strspn(at, blanks);
        if (*at == '\0' || *at == '#' || count == 8) return count;
        const char *end = at + strcspn(at, blanks);
        const char *after = cs_parse_number(at, end, &numbers[count]);
        if (after == at || (after != end && *after != '#')) {
            *wrong = at;
            return count;
        }
        at += after - at;
        count++;
    }
}

/* A line has fewer numbers than it needs: because of a word that is none, if there is one. */
static clshear_status lacks(const obj_reader *reader, const char *what, const char *wrong)
{
    char text[128];
    if (wrong == NULL) return complain(reader, what);
    snprintf(text, sizeof text, "%s; \"%.*s\" is not a number", what,
             (int)strcspn(wrong, " \t\v\f"), wrong);
    return complain(reader, text);
}

/* v x y z, with w or a colour or both behind. */
static clshear_status read_position(obj_reader *reader, char *at)
{
    cs_model *model = reader->model;
    const char *wrong;
    double n[8];
    const int count = read_numbers(at, n, &wrong);
    if (count < 3 || wrong != NULL) return lacks(reader, "a vertex needs three numbers", wrong);
    double *position = cs_model_extend(&model->positions, 1);
    if (position == NULL) return cs_model_full(model, reader->error);
    const double w = (count == 4 || count == 7) && n[3] != 0.0 ? n[3] : 1.0;
    for (int axis = 0; axis < 3; axis++)
        position[axis] = n[axis] / w;
    if (count < 6) return CLSHEAR_OK;
    const double *rgb = n + (count >= 7 ? 4 : 3);
    float colour[3];
    for (int c = 0; c < 3; c++) /* programs write what they show */
        colour[c] = cs_colour_value(rgb[c], 1);
    return cs_model_set_colour(model, model->positions.count - 1, colour, reader->error);
}

/* vt and vn: `needed` numbers of `kept`, what is not finite becomes 0. */
static clshear_status read_attribute(obj_reader *reader, cs_array *pool, int needed, int kept,
                                     char *at)
{
    double n[8] = {0};
    const char *wrong;
    const int count = read_numbers(at, n, &wrong);
    if (count < needed || wrong != NULL)
        return lacks(reader,
                     kept == 3 ? "a normal needs three numbers"
                               : "a texture coordinate needs a number",
                     wrong);
    float *values = cs_model_extend(pool, 1);
    if (values == NULL) return cs_model_full(reader->model, reader->error);
    for (int i = 0; i < kept; i++)
        values[i] = i < count && isfinite(n[i]) ? (float)n[i] : 0.0f;
    return CLSHEAR_OK;
}

/* s off, s 0, s N */
static void read_group(obj_reader *reader, char *at)
{
    const char *word = cs_next_word(&at);
    long long number = 0;
    if (word != NULL && !cs_parse_whole(&word, &number)) number = strcasecmp(word, "on") == 0;
    reader->group = (uint32_t)(number & 0x7fffffff);
}

/* #MRGB of ZBrush: 8 hexadecimal digits for each vertex, a mask and its colour, in their order. */
static clshear_status read_paint(obj_reader *reader, char *at)
{
    cs_model *model = reader->model;
    clshear_status status = CLSHEAR_OK;
    at += strspn(at, " \t");
    while (strspn(at, "0123456789abcdefABCDEF") >= 8 && status == CLSHEAR_OK &&
           reader->painted < model->positions.count) {
        float colour[3];
        for (int c = 0; c < 3; c++) {
            const char digits[3] = {at[2 + 2 * c], at[3 + 2 * c], '\0'};
            colour[c] = cs_colour_value((double)strtoul(digits, NULL, 16) / 255.0, 1);
        }
        status = cs_model_set_colour(model, reader->painted++, colour, reader->error);
        at += 8;
    }
    return status;
}

/* Lines that would bring in more, and are not obeyed. */
static int names_more(const char *key)
{
    static const char *const keys[] = {"call", "csh", "maplib", "usemap"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(key, keys[i]) == 0) return 1;
    return 0;
}

static void leave_out(obj_reader *reader, const char *key)
{
    if (reader->left_out++ == 0)
        cs_warn(reader->model->log, "%s:%zu: \"%s\" is not supported; left out",
                reader->model->path, reader->lines.number, key);
}

/* Lines that OBJ files have besides vertices and faces. */
static int makes_no_surface(const char *key)
{
    static const char *const keys[] = {"mtllib", "usemtl", "o", "g", "s", "vt", "vn", "vp"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcasecmp(key, keys[i]) == 0) return 1;
    return 0;
}

static int is_free_form(const char *key)
{
    static const char *const keys[] = {"curv", "curv2", "surf", "parm", "cstype"};
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (strcmp(key, keys[i]) == 0) return 1;
    return 0;
}

static clshear_status read_line(obj_reader *reader, const char *key, char *at)
{
    cs_model *model = reader->model;
    if (model->positions.count == 0) reader->without_surface += (size_t)makes_no_surface(key);
    if (strcasecmp(key, "v") == 0) return read_position(reader, at);
    if (strcasecmp(key, "vt") == 0) return read_attribute(reader, &model->textures, 1, 2, at);
    if (strcasecmp(key, "vn") == 0) return read_attribute(reader, &model->normals, 3, 3, at);
    if (strcasecmp(key, "f") == 0 || strcmp(key, "fo") == 0) return cs_obj_face(reader, at);
    if (strcasecmp(key, "usemtl") == 0) return cs_obj_use_material(reader, cs_rest_of_line(at));
    if (strcasecmp(key, "mtllib") == 0) return cs_obj_library(reader, cs_rest_of_line(at));
    if (strcmp(key, "s") == 0)
        read_group(reader, at);
    else if (strcmp(key, "l") == 0 || strcmp(key, "p") == 0)
        model->without_area++;
    else if (is_free_form(key))
        reader->free_form++;
    else if (names_more(key))
        leave_out(reader, key);
    else
        return CLSHEAR_OK;
    return CLSHEAR_OK;
}

/* Why there is nothing to render, if there is not. */
static clshear_status check(const obj_reader *reader)
{
    const cs_model *model = reader->model;
    const char *path = model->path;
    if (model->triangles.count > 0) return CLSHEAR_OK;
    if (reader->free_form > 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: holds free-form curves or surfaces only; export triangles", path);
    if (model->without_area > 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: holds points and lines only; export faces", path);
    if (model->positions.count == 0 && reader->without_surface > 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: has no vertices and no faces", path);
    if (model->positions.count == 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: no line in it is one of an OBJ file; is it one?", path);
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: has vertices but no faces", path);
}

clshear_status cs_read_obj(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    obj_reader reader = {.model = model, .error = error, .material = CS_NO_INDEX};
    clshear_status status = cs_bytes_to_utf8(bytes, model->path, error);
    model->up_is_open = 1;
    cs_obj_begin(&reader);
    reader.lines = cs_lines_of(bytes);
    for (char *at = cs_lines_next(&reader.lines); at != NULL && status == CLSHEAR_OK;
         at = status == CLSHEAR_OK ? cs_lines_next(&reader.lines) : NULL) {
        const char *key = cs_next_word(&at);
        if (key == NULL) continue;
        if (strcmp(key, "#MRGB") == 0)
            status = read_paint(&reader, at);
        else if (key[0] != '#')
            status = read_line(&reader, key, at);
    }
    if (status == CLSHEAR_OK) status = cs_obj_waiting_faces(&reader);
    if (status == CLSHEAR_OK) status = cs_obj_materials(&reader);
    if (status == CLSHEAR_OK) status = check(&reader);
    cs_obj_end(&reader);
    return status;
}
