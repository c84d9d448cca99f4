/* glTF files with one node: a hilly sheet, its data in five parts beside the file. */
#ifndef CS_TESTS_GLTF_SHEET_H
#define CS_TESTS_GLTF_SHEET_H

#include "import_support.h"

enum {
    SHEET_SIDE = 9,
    SHEET_VERTICES = SHEET_SIDE * SHEET_SIDE,
    SHEET_TRIANGLES = 2 * (SHEET_SIDE - 1) * (SHEET_SIDE - 1),
    SHEET_BYTES = 1 << 16
};

extern float sheet_positions[SHEET_VERTICES][3], sheet_normals[SHEET_VERTICES][3];
extern float sheet_textures[SHEET_VERTICES][2];
extern uint8_t sheet_colours[SHEET_VERTICES][4]; /* parts of 255 */
extern uint16_t sheet_indices[SHEET_TRIANGLES][3];

/* Fills these. Call it first. */
void sheet_make(void);

/* The five, in this order: bytes of an item, how many there are, and where. */
extern const size_t sheet_strides[5], sheet_counts[5];
extern const void *const sheet_items[5];

/* The bytes beside a file, and where its five parts are: four attributes and the indices. */
typedef struct sheet_parts {
    unsigned char bytes[SHEET_BYTES];
    size_t used;
    size_t begin[5];
    size_t size[5];
} sheet_parts;

/* Adds bytes, which are those of a part. */
void sheet_append(sheet_parts *to, int part, const void *bytes, size_t size);

/* What files of one node differ in: parts of their JSON, NULL if not given. */
typedef struct sheet_contents {
    const char *views;        /* buffer views; those of the five parts are the first */
    int is_bare;              /* whether accessors have none of them */
    const char *normals;      /* type of their accessor; NULL: floats */
    const char *accessors;    /* more than those of the five parts */
    const char *of_node;      /* more members */
    const char *of_primitive; /* more members */
    const char *required;     /* an extension */
} sheet_contents;

/* Writes a file and returns its path. */
const char *sheet_write(const char *name, const sheet_parts *data, const sheet_contents *what);

/* The same without compression. of_primitive: more members of the primitive; required: an
 * extension, or NULL. */
const char *sheet_write_plain(const char *name, const char *of_primitive, const char *required);

/* Reads a file behind the wall, as the program does. Warnings fail the test. The caller frees the
 * scene. */
cs_scene sheet_load(const char *path);

/* Expects a refusal that contains `words`. */
void sheet_refused(const char *path, const char *words);

#endif
