/* The parts of reading a PLY file: its head, and the numbers behind it. */
#ifndef CS_IMPORT_PLY_READER_H
#define CS_IMPORT_PLY_READER_H

#include "import/model.h"
#include "import/text.h"

enum {
    CS_PLY_ELEMENTS = 16,
    CS_PLY_PROPERTIES = 256, /* of an element */
    CS_PLY_TEXTURES = 16
};

typedef enum cs_ply_format {
    CS_PLY_ASCII,
    CS_PLY_LITTLE,
    CS_PLY_BIG
} cs_ply_format;

typedef enum cs_ply_type {
    CS_PLY_INT8,
    CS_PLY_UINT8,
    CS_PLY_INT16,
    CS_PLY_UINT16,
    CS_PLY_INT32,
    CS_PLY_UINT32,
    CS_PLY_INT64,
    CS_PLY_UINT64,
    CS_PLY_FLOAT,
    CS_PLY_DOUBLE,
    CS_PLY_NO_TYPE
} cs_ply_type;

/* What a property means. */
typedef enum cs_ply_role {
    CS_PLY_X,
    CS_PLY_Y,
    CS_PLY_Z,
    CS_PLY_NX,
    CS_PLY_NY,
    CS_PLY_NZ,
    CS_PLY_S,
    CS_PLY_T,
    CS_PLY_TX, /* with TZ a tangent, without it the texture coordinates of some programs */
    CS_PLY_TY,
    CS_PLY_TZ,
    CS_PLY_RED,
    CS_PLY_GREEN,
    CS_PLY_BLUE,
    CS_PLY_ALPHA,
    CS_PLY_TEXTURE_NUMBER,
    CS_PLY_SCALARS,                  /* number of roles of one number */
    CS_PLY_INDICES = CS_PLY_SCALARS, /* list */
    CS_PLY_COORDINATES,              /* list */
    CS_PLY_NO_ROLE
} cs_ply_role;

typedef struct cs_ply_property {
    cs_ply_type type;
    cs_ply_type count_type; /* CS_PLY_NO_TYPE: not a list */
    cs_ply_role role;
} cs_ply_property;

typedef struct cs_ply_element {
    char name[32];
    size_t count;
    size_t property_count;
    cs_ply_property properties[CS_PLY_PROPERTIES];
} cs_ply_element;

typedef struct cs_ply_head {
    cs_ply_format format;
    size_t element_count;
    cs_ply_element elements[CS_PLY_ELEMENTS];
    size_t texture_count;
    char textures[CS_PLY_TEXTURES][256]; /* names of image files */
    size_t size;                         /* bytes, to the first number */
} cs_ply_head;

/* Reads the head. `path` is for messages. */
clshear_status cs_ply_read_head(const cs_bytes *bytes, const char *path, cs_ply_head *head,
                                cs_error *error);

/* Whether one of the element's properties means this. No two of them do. */
int cs_ply_has_role(const cs_ply_element *element, cs_ply_role role);

/* Where in the numbers the reader is. */
typedef struct cs_ply_cursor {
    const char *begin; /* of the file */
    const char *at;
    const char *end;
    cs_ply_format format;
    int in_rows;     /* text of which each item has a line of its own */
    const char *row; /* the end of that line; NULL: not in one */
} cs_ply_cursor;

/* Reads the next number; 0 at the end of the file, or where there is no number. */
int cs_ply_next(cs_ply_cursor *cursor, cs_ply_type type, double *value);

/* Finds out whether the numbers are text with a line for each of `items` items, so that a line with
 * too many numbers or too few is seen. */
void cs_ply_find_rows(cs_ply_cursor *cursor, size_t items);

/* Go to the line of the next item, and behind it, where there are such lines; the second returns
 * whether numbers were left in it. */
void cs_ply_begin_row(cs_ply_cursor *cursor);
int cs_ply_end_row(cs_ply_cursor *cursor);

/* Bytes that a number takes in the file, at least. */
size_t cs_ply_least_size(cs_ply_format format, cs_ply_type type);

/* Whether numbers of this type are whole. */
int cs_ply_is_integer(cs_ply_type type);

/* White, in a colour of this type: integers have those of bytes, whatever could be larger in them,
 * but for uint16. */
double cs_ply_most(cs_ply_type type);

#endif
