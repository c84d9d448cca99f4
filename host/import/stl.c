/* STL, as text and as bytes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/number.h"
#include "import/colour.h"
#include "import/index_map.h"
#include "import/readers.h"

enum {
    HEAD = 84,  /* bytes before the first facet */
    FACET = 50, /* bytes of a facet */
    NO_COLOUR = 1 << 16
};

/* A corner: those that are equal become one. */
typedef struct stl_key {
    double position[3];
    uint64_t colour; /* 15 bits, or NO_COLOUR */
} stl_key;

typedef struct stl_reader {
    cs_model *model;
    cs_error *error;
    cs_index_map corners; /* of stl_key */
} stl_reader;

static uint32_t word_at(const char *at)
{
    const unsigned char *byte = (const unsigned char *)at;
    return (uint32_t)byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 |
           (uint32_t)byte[3] << 24;
}

static int begins_with_solid(const cs_bytes *bytes)
{
    const char *at = bytes->data, *end = at + bytes->size;
    while (at != end && (unsigned char)*at <= ' ' && *at != '\0')
        at++;
    return end - at >= 5 && strncasecmp(at, "solid", 5) == 0;
}

/* Whether the size is just that of the facets that the head counts. */
static int has_binary_size(const cs_bytes *bytes)
{
    return bytes->size >= HEAD &&
           bytes->size == HEAD + (size_t)FACET * word_at(bytes->data + HEAD - 4);
}

/* Whether a word is in the text, in small letters or capitals. */
static int has_word(const char *at, const char *end, const char *word)
{
    const size_t length = strlen(word);
    for (; (size_t)(end - at) >= length; at++)
        if (strncasecmp(at, word, length) == 0) return 1;
    return 0;
}

enum {
    LOOKED_AT = 512 /* bytes that tell text from bytes */
};

/* Whether there is no zero, as the count of a binary file has. Zeros at the end fill blocks. */
static int has_letters(const cs_bytes *bytes)
{
    size_t size = bytes->size;
    if (has_binary_size(bytes)) return 0;
    while (size > 0 && bytes->data[size - 1] == '\0')
        size--;
    return size > 0 && memchr(bytes->data, '\0', size < LOOKED_AT ? size : LOOKED_AT) == NULL;
}

/* Whether it begins with "solid", or has a facet soon, and goes on as text. */
static int is_text(const cs_bytes *bytes)
{
    const size_t size = bytes->size < LOOKED_AT ? bytes->size : LOOKED_AT;
    return has_letters(bytes) &&
           (begins_with_solid(bytes) || has_word(bytes->data, bytes->data + size, "facet"));
}

int cs_is_stl(const cs_bytes *bytes, const char *path)
{
    return cs_has_suffix(path, ".stl") || (begins_with_solid(bytes) && is_text(bytes));
}

/* The model's position for a corner. */
static clshear_status add_corner(stl_reader *reader, const double *position, uint32_t colour,
                                 cs_corner *corner)
{
    cs_model *model = reader->model;
    stl_key key = {.colour = colour};
    for (int i = 0; i < 3; i++)
        key.position[i] = position[i] + 0.0; /* -0 is 0 */
    const uint32_t number = cs_index_map_add(&reader->corners, &key);
    if (number == UINT32_MAX) return cs_model_full(model, reader->error);
    *corner = (cs_corner){number, CS_NO_INDEX, CS_NO_INDEX};
    if (number < model->positions.count) return CLSHEAR_OK;
    double *added = cs_model_extend(&model->positions, 1);
    if (added == NULL) return cs_model_full(model, reader->error);
    memcpy(added, key.position, sizeof key.position);
    if (colour == NO_COLOUR) return CLSHEAR_OK;
    float rgb[3];
    for (int c = 0; c < 3; c++)
        rgb[c] = cs_colour_value((double)(colour >> 5 * c & 31) / 31.0, 1);
    return cs_model_set_colour(model, number, rgb, reader->error);
}

/* ----- Text ----- */

static clshear_status complain(const stl_reader *reader, size_t line, const char *what)
{
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s:%zu: %s", reader->model->path, line, what);
}

static char *next_token(char **at, size_t *line)
{
    while (**at != '\0' && (unsigned char)**at <= ' ') {
        *line += **at == '\n';
        (*at)++;
    }
    char *token = *at;
    while ((unsigned char)**at > ' ')
        (*at)++;
    return token;
}

static int is_word(const char *token, const char *end, const char *word)
{
    return (size_t)(end - token) == strlen(word) && strncasecmp(token, word, strlen(word)) == 0;
}

static clshear_status read_vertex(stl_reader *reader, char **at, size_t *line, cs_corner *corner)
{
    double position[3];
    for (int i = 0; i < 3; i++) {
        const char *token = next_token(at, line);
        if (token == *at) return complain(reader, *line, "the file ends in a vertex; it was cut");
        if (cs_parse_number(token, *at, &position[i]) != *at)
            return complain(reader, *line, "a vertex needs three numbers");
    }
    return add_corner(reader, position, NO_COLOUR, corner);
}

/* Goes past the name of a solid, which may hold any word, to the end of its line; not where facets
 * are on that line. */
static void pass_name(char **at)
{
    const size_t length = strcspn(*at, "\r\n");
    if (!has_word(*at, *at + length, "normal")) *at += length;
}

/* The facet that is being read. */
typedef struct open_facet {
    int is_open;
    size_t count; /* corners */
    cs_corner corners[3];
} open_facet;

static clshear_status close_facet(stl_reader *reader, open_facet *facet, size_t line)
{
    if (!facet->is_open) return CLSHEAR_OK;
    if (facet->count != 3) return complain(reader, line, "a facet has fewer than three vertices");
    facet->is_open = 0;
    return cs_model_add_polygon(reader->model, facet->corners, 3, CS_NO_INDEX, 0, reader->error);
}

/* Reads on from a word. A facet begins with "facet" or "loop", and ends with "endloop", "endfacet",
 * or what cannot be inside it: files lack any of these. */
static clshear_status read_word(stl_reader *reader, const char *word, const char *end, char **at,
                                size_t *line, open_facet *facet)
{
    clshear_status status = CLSHEAR_OK;
    if (is_word(word, end, "endloop") || is_word(word, end, "endfacet"))
        return close_facet(reader, facet, *line);
    if (is_word(word, end, "endsolid") || is_word(word, end, "solid")) {
        status = close_facet(reader, facet, *line);
        pass_name(at);
    } else if (is_word(word, end, "facet") || (is_word(word, end, "loop") && !facet->is_open)) {
        status = close_facet(reader, facet, *line);
        *facet = (open_facet){.is_open = 1};
    } else if (facet->is_open && is_word(word, end, "vertex")) {
        if (facet->count == 3)
            return complain(reader, *line, "a facet has more than three vertices");
        status = read_vertex(reader, at, line, &facet->corners[facet->count++]);
    }
    return status;
}

static clshear_status read_text(stl_reader *reader, cs_bytes *bytes)
{
    char *at = bytes->data;
    size_t line = 1;
    open_facet facet = {0};
    clshear_status status = CLSHEAR_OK;
    while (status == CLSHEAR_OK) {
        char words[16];
        const char *word = next_token(&at, &line), *end = at;
        if (word == end) break;
        if (is_word(word, end, "end")) { /* some write "end facet" */
            const char *second = next_token(&at, &line);
            snprintf(words, sizeof words, "end%.*s", (int)(at - second < 9 ? at - second : 9),
                     second);
            word = words;
            end = words + strlen(words);
        }
        status = read_word(reader, word, end, &at, &line, &facet);
    }
    if (status == CLSHEAR_OK && facet.is_open)
        return complain(reader, line, "the file ends in a facet; it was cut");
    return status;
}

/* ----- Bytes ----- */

/* Colours of facets: Magics writes "COLOR=" into the head and clears bit 15 of facets with a colour
 * of their own, red first; VisCAM sets bit 15, blue first. Others leave anything there, so that
 * VisCAM's counts only where all facets have it. */
typedef enum stl_colours {
    NONE,
    MAGICS,
    VISCAM
} stl_colours;

static stl_colours colours_of(const cs_bytes *bytes, size_t facets)
{
    for (size_t i = 0; i + 6 + 4 <= 80; i++)
        if (memcmp(bytes->data + i, "COLOR=", 6) == 0) return MAGICS;
    for (size_t i = 0; i < facets; i++)
        if ((bytes->data[HEAD + i * FACET + 49] & 0x80) == 0) return NONE;
    return facets > 0 ? VISCAM : NONE;
}

/* 15 bits, red lowest. */
static uint32_t colour_at(const cs_bytes *bytes, stl_colours kind, const char *facet)
{
    const uint32_t bits = (uint32_t)(unsigned char)facet[48] | (uint32_t)(unsigned char)facet[49]
                                                                   << 8;
    if (kind == NONE) return NO_COLOUR;
    if (kind == VISCAM) return (bits & 31) << 10 | (bits & 31 << 5) | (bits >> 10 & 31);
    if ((bits & 0x8000) == 0 && bits != 0) return bits; /* 0 is what others leave there */
    const char *head = bytes->data;
    while (memcmp(head, "COLOR=", 6) != 0)
        head++;
    uint32_t colour = 0;
    for (int c = 0; c < 3; c++)
        colour |= (uint32_t)((unsigned char)head[6 + c] >> 3) << 5 * c;
    return colour;
}

/* How many facets are read: those that the head counts, if they are there. */
static clshear_status count_facets(const stl_reader *reader, const cs_bytes *bytes, size_t *facets)
{
    const char *path = reader->model->path;
    if (bytes->size < HEAD)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: is shorter than the head of an STL file; it was cut", path);
    const size_t given = word_at(bytes->data + HEAD - 4), room = (bytes->size - HEAD) / FACET;
    *facets = given;
    if ((given == 0 || given == UINT32_MAX) && room > 0) { /* written before it was known */
        cs_warn(reader->model->log, "%s: does not say how many triangles it has; %zu fit", path,
                room);
        *facets = room;
    } else if (given > room) {
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: says that it has %zu triangles, but ends after %zu; it was cut", path,
                       given, room);
    } else if (given < room) {
        cs_warn(reader->model->log,
                "%s: says that it has %zu triangles; bytes for %zu more behind them are left out",
                path, given, room - given);
    }
    return CLSHEAR_OK;
}

static clshear_status read_facet(stl_reader *reader, const char *facet, uint32_t colour,
                                 uint32_t material)
{
    cs_corner corners[3];
    for (size_t k = 0; k < 3; k++) {
        double position[3];
        for (size_t axis = 0; axis < 3; axis++) {
            const uint32_t word = word_at(facet + 12 + 12 * k + 4 * axis);
            float value;
            memcpy(&value, &word, sizeof value);
            position[axis] = (double)value;
        }
        const clshear_status status = add_corner(reader, position, colour, &corners[k]);
        if (status != CLSHEAR_OK) return status;
    }
    return cs_model_add_polygon(reader->model, corners, 3, material, 0, reader->error);
}

static clshear_status read_binary(stl_reader *reader, const cs_bytes *bytes)
{
    size_t facets = 0;
    clshear_status status = count_facets(reader, bytes, &facets);
    if (status != CLSHEAR_OK) return status;
    const stl_colours kind = colours_of(bytes, facets);
    for (size_t i = 0; i < facets && status == CLSHEAR_OK; i++) {
        const char *facet = bytes->data + HEAD + i * FACET;
        status = read_facet(reader, facet, colour_at(bytes, kind, facet),
                            kind == NONE ? CS_NO_INDEX : 0);
    }
    if (status != CLSHEAR_OK || kind == NONE) return status;
    cs_material_description *material = cs_model_extend(&reader->model->materials, 1);
    if (material == NULL) return cs_model_full(reader->model, reader->error);
    cs_material_init(material, "colours of facets");
    for (int c = 0; c < 3; c++)
        material->base_colour[c] = 1.0f;
    return CLSHEAR_OK;
}

clshear_status cs_read_stl(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    stl_reader reader = {.model = model, .error = error};
    cs_index_map_init(&reader.corners, sizeof(stl_key));
    clshear_status status = CLSHEAR_OK;
    model->z_up = 1;
    if (bytes->size > 0 && (unsigned char)bytes->data[0] >= 0xef && !has_binary_size(bytes))
        status = cs_bytes_to_utf8(bytes, model->path, error);
    if (status == CLSHEAR_OK && has_letters(bytes) && !is_text(bytes))
        status = cs_fail(error, CLSHEAR_BAD_FILE, "%s: is text without facets; is it an STL file?",
                         model->path);
    if (status == CLSHEAR_OK)
        status = is_text(bytes) ? read_text(&reader, bytes) : read_binary(&reader, bytes);
    if (status == CLSHEAR_OK && model->triangles.count == 0)
        status = cs_fail(error, CLSHEAR_BAD_FILE, "%s: there are no triangles in it", model->path);
    cs_index_map_free(&reader.corners);
    return status;
}
