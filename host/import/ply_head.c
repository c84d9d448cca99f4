/* The head of a PLY file, and its numbers. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/number.h"
#include "import/ply_reader.h"

static const struct {
    const char *name;
    cs_ply_type type;
} type_names[] = {{"char", CS_PLY_INT8},     {"int8", CS_PLY_INT8},     {"uchar", CS_PLY_UINT8},
                  {"uint8", CS_PLY_UINT8},   {"short", CS_PLY_INT16},   {"int16", CS_PLY_INT16},
                  {"ushort", CS_PLY_UINT16}, {"uint16", CS_PLY_UINT16}, {"int", CS_PLY_INT32},
                  {"int32", CS_PLY_INT32},   {"uint", CS_PLY_UINT32},   {"uint32", CS_PLY_UINT32},
                  {"int64", CS_PLY_INT64},   {"uint64", CS_PLY_UINT64}, {"float", CS_PLY_FLOAT},
                  {"float32", CS_PLY_FLOAT}, {"double", CS_PLY_DOUBLE}, {"float64", CS_PLY_DOUBLE}};

static const struct {
    const char *name;
    cs_ply_role role;
} role_names[] = {
    {"x", CS_PLY_X},
    {"y", CS_PLY_Y},
    {"z", CS_PLY_Z},
    {"nx", CS_PLY_NX},
    {"normal_x", CS_PLY_NX},
    {"normal_y", CS_PLY_NY},
    {"normal_z", CS_PLY_NZ},
    {"ny", CS_PLY_NY},
    {"nz", CS_PLY_NZ},
    {"s", CS_PLY_S},
    {"t", CS_PLY_T},
    {"u", CS_PLY_S},
    {"v", CS_PLY_T},
    {"texture_u", CS_PLY_S},
    {"texture_v", CS_PLY_T},
    {"texture_s", CS_PLY_S},
    {"texture_t", CS_PLY_T},
    {"tx", CS_PLY_TX},
    {"ty", CS_PLY_TY},
    {"tz", CS_PLY_TZ},
    {"s0", CS_PLY_S},
    {"t0", CS_PLY_T},
    {"u0", CS_PLY_S},
    {"v0", CS_PLY_T},
    {"texcoord_u", CS_PLY_S},
    {"texcoord_v", CS_PLY_T},
    {"red", CS_PLY_RED},
    {"green", CS_PLY_GREEN},
    {"blue", CS_PLY_BLUE},
    {"alpha", CS_PLY_ALPHA},
    {"r", CS_PLY_RED},
    {"g", CS_PLY_GREEN},
    {"b", CS_PLY_BLUE},
    {"diffuse_r", CS_PLY_RED},
    {"diffuse_g", CS_PLY_GREEN},
    {"diffuse_b", CS_PLY_BLUE},
    {"diffuse_red", CS_PLY_RED},
    {"diffuse_green", CS_PLY_GREEN},
    {"diffuse_blue", CS_PLY_BLUE},
    {"texnumber", CS_PLY_TEXTURE_NUMBER},
    {"vertex_indices", CS_PLY_INDICES},
    {"vertex_index", CS_PLY_INDICES},
    {"texcoord", CS_PLY_COORDINATES},
};

static cs_ply_type type_called(const char *name)
{
    for (size_t i = 0; name != NULL && i < sizeof type_names / sizeof *type_names; i++)
        if (strcmp(name, type_names[i].name) == 0) return type_names[i].type;
    return CS_PLY_NO_TYPE;
}

static cs_ply_role role_called(const char *name, int is_list)
{
    for (size_t i = 0; i < sizeof role_names / sizeof *role_names; i++) {
        const int for_list = role_names[i].role >= CS_PLY_SCALARS;
        if (for_list == is_list && strcasecmp(name, role_names[i].name) == 0)
            return role_names[i].role;
    }
    return CS_PLY_NO_ROLE;
}

int cs_ply_has_role(const cs_ply_element *element, cs_ply_role role)
{
    for (size_t p = 0; p < element->property_count; p++)
        if (element->properties[p].role == role) return 1;
    return 0;
}

/* Each of these returns what is wrong with a line, or NULL. */

static const char *read_format(cs_ply_head *head, char *at)
{
    static const char *const names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    const char *name = cs_next_word(&at);
    for (int i = 0; i < 3; i++)
        if (name != NULL && strcmp(name, names[i]) == 0) {
            head->format = (cs_ply_format)i;
            return NULL;
        }
    return "the format must be ascii, binary_little_endian or binary_big_endian";
}

static const char *read_element(cs_ply_head *head, char *at)
{
    const char *name = cs_next_word(&at), *count = cs_next_word(&at);
    long long number = 0;
    if (head->element_count == CS_PLY_ELEMENTS) return "there are more than 16 elements";
    if (count == NULL || !cs_parse_whole(&count, &number) || *count != '\0' || number < 0)
        return "an element needs a name and a count of 0 or more";
    cs_ply_element *element = &head->elements[head->element_count++];
    snprintf(element->name, sizeof element->name, "%s", name);
    for (char *letter = element->name; *letter != '\0'; letter++) /* some begin with a capital */
        if (*letter >= 'A' && *letter <= 'Z') *letter = (char)(*letter - 'A' + 'a');
    element->count = (size_t)number;
    return NULL;
}

static const char *read_property(cs_ply_head *head, char *at)
{
    const char *type = cs_next_word(&at);
    cs_ply_property property = {.count_type = CS_PLY_NO_TYPE};
    const int is_list = type != NULL && strcmp(type, "list") == 0;
    if (head->element_count == 0) return "a property comes before any element";
    cs_ply_element *element = &head->elements[head->element_count - 1];
    if (element->property_count == CS_PLY_PROPERTIES)
        return "an element has more than 256 properties";
    if (is_list) {
        property.count_type = type_called(cs_next_word(&at));
        type = cs_next_word(&at);
        if (property.count_type >= CS_PLY_FLOAT) return "a list needs a whole type for its length";
    }
    property.type = type_called(type);
    const char *name = cs_next_word(&at);
    if (property.type == CS_PLY_NO_TYPE || name == NULL)
        return "a property needs a type (char uchar short ushort int uint float double) and a name";
    property.role = role_called(name, is_list);
    if (cs_ply_has_role(element, property.role)) property.role = CS_PLY_NO_ROLE; /* a second set */
    element->properties[element->property_count++] = property;
    return NULL;
}

static const char *read_line(cs_ply_head *head, char *at)
{
    const char *key = cs_next_word(&at);
    if (key == NULL) return NULL;
    if (strcmp(key, "format") == 0) return read_format(head, at);
    if (strcmp(key, "element") == 0) return read_element(head, at);
    if (strcmp(key, "property") == 0) return read_property(head, at);
    if (strcmp(key, "comment") == 0) {
        const char *word = cs_next_word(&at);
        if (word != NULL && strcasecmp(word, "TextureFile") == 0 &&
            head->texture_count < CS_PLY_TEXTURES)
            snprintf(head->textures[head->texture_count++], 256, "%s", cs_rest_of_line(at));
        return NULL;
    }
    return NULL; /* obj_info, and what exporters leave there without "comment" */
}

/* The end of a line: what follows behind its line break. */
static const char *line_end(const char *at, const char *end, const char **next)
{
    while (at != end && *at != '\n' && *at != '\r')
        at++;
    *next = at;
    if (at != end) *next += at[0] == '\r' && at + 1 != end && at[1] == '\n' ? 2 : 1;
    return at;
}

/* Whether a line says nothing of the numbers, however long it is. */
static int is_remark(const char *line)
{
    return strncmp(line, "comment", 7) == 0 || strncmp(line, "obj_info", 8) == 0;
}

/* Where the numbers begin: behind the line end that the first line of the head has, too. Behind a
 * return alone, a line feed is a number's first byte. */
static size_t size_of_head(const cs_bytes *bytes, const char *stop)
{
    const char *first = memchr(bytes->data, '\r', bytes->size);
    const int is_return_alone = first != NULL && first < stop && first[1] != '\n';
    const int is_pair = !is_return_alone && stop[0] == '\r' && stop[1] == '\n';
    return (size_t)(stop - bytes->data) + 1 + (size_t)is_pair;
}

clshear_status cs_ply_read_head(const cs_bytes *bytes, const char *path, cs_ply_head *head,
                                cs_error *error)
{
    const char *at = bytes->data, *end = bytes->data + bytes->size, *next;
    int has_format = 0;
    for (size_t number = 1; at != end; number++, at = next) {
        char line[512];
        const char *stop = line_end(at, end, &next);
        const int is_long = (size_t)(stop - at) >= sizeof line;
        if (is_long && is_remark(at)) continue;
        if (is_long)
            return cs_fail(error, CLSHEAR_BAD_FILE,
                           "%s:%zu: the head has a line of more than 511 bytes", path, number);
        memcpy(line, at, (size_t)(stop - at));
        line[stop - at] = '\0';
        char *text = cs_rest_of_line(line);
        if (number == 1) continue; /* "ply" */
        if (strcmp(text, "end_header") == 0 && next != at) {
            head->size = stop == end ? bytes->size : size_of_head(bytes, stop);
            if (has_format) return CLSHEAR_OK;
            return cs_fail(error, CLSHEAR_BAD_FILE, "%s:%zu: the head names no format", path,
                           number);
        }
        has_format |= strncmp(text, "format", 6) == 0;
        const char *wrong = read_line(head, text);
        if (wrong != NULL)
            return cs_fail(error, CLSHEAR_BAD_FILE, "%s:%zu: %s", path, number, wrong);
    }
    return cs_fail(error, CLSHEAR_BAD_FILE, "%s: the file ends within its head; it was cut", path);
}

static const size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};

size_t cs_ply_least_size(cs_ply_format format, cs_ply_type type)
{
    return format == CS_PLY_ASCII ? 1 : sizes[type]; /* the last digit has nothing behind it */
}

int cs_ply_is_integer(cs_ply_type type)
{
    return type < CS_PLY_FLOAT;
}

double cs_ply_most(cs_ply_type type)
{
    if (!cs_ply_is_integer(type)) return 1.0;
    return type == CS_PLY_UINT16 ? 65535.0 : 255.0;
}

static const char *skip_blanks(const char *at, const char *end)
{
    while (at != end && (unsigned char)*at <= ' ')
        at++;
    return at;
}

void cs_ply_find_rows(cs_ply_cursor *cursor, size_t items)
{
    size_t rows = 0;
    if (cursor->format != CS_PLY_ASCII) return;
    for (const char *at = skip_blanks(cursor->at, cursor->end); at != cursor->end; rows++) {
        line_end(at, cursor->end, &at);
        at = skip_blanks(at, cursor->end);
    }
    cursor->in_rows = rows == items;
}

void cs_ply_begin_row(cs_ply_cursor *cursor)
{
    const char *next;
    if (!cursor->in_rows) return;
    cursor->at = skip_blanks(cursor->at, cursor->end);
    cursor->row = line_end(cursor->at, cursor->end, &next);
}

int cs_ply_end_row(cs_ply_cursor *cursor)
{
    if (!cursor->in_rows) return 0;
    const int is_left = skip_blanks(cursor->at, cursor->row) != cursor->row;
    cursor->at = cursor->row;
    cursor->row = NULL;
    return is_left;
}

static int next_text(cs_ply_cursor *cursor, double *value)
{
    const char *end = cursor->row != NULL ? cursor->row : cursor->end;
    cursor->at = skip_blanks(cursor->at, end);
    const char *after = cs_parse_number(cursor->at, end, value);
    if (after == cursor->at || (after != end && (unsigned char)*after > ' ')) return 0;
    cursor->at = after;
    return 1;
}

int cs_ply_next(cs_ply_cursor *cursor, cs_ply_type type, double *value)
{
    if (cursor->format == CS_PLY_ASCII) return next_text(cursor, value);
    const size_t size = sizes[type];
    uint64_t bits = 0;
    if ((size_t)(cursor->end - cursor->at) < size) return 0;
    for (size_t i = 0; i < size; i++) {
        const size_t place = cursor->format == CS_PLY_BIG ? size - 1 - i : i;
        bits |= (uint64_t)(unsigned char)cursor->at[i] << 8 * place;
    }
    cursor->at += size;
    const uint32_t word = (uint32_t)bits;
    float single;
    memcpy(&single, &word, sizeof single);
    switch (type) {
    case CS_PLY_INT8:
        *value = (double)(int8_t)word;
        break;
    case CS_PLY_INT16:
        *value = (double)(int16_t)word;
        break;
    case CS_PLY_INT32:
        *value = (double)(int32_t)word;
        break;
    case CS_PLY_INT64:
        *value = (double)(int64_t)bits;
        break;
    case CS_PLY_UINT64:
        *value = (double)bits;
        break;
    case CS_PLY_FLOAT:
        *value = (double)single;
        break;
    case CS_PLY_DOUBLE:
        memcpy(value, &bits, sizeof bits);
        break;
    default:
        *value = (double)word;
        break;
    }
    return 1;
}
