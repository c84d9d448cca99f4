/* The items of a PLY file's elements: their numbers, whatever they mean. */
#ifndef CS_IMPORT_PLY_ITEMS_H
#define CS_IMPORT_PLY_ITEMS_H

#include "import/ply_reader.h"

typedef struct cs_ply_reader {
    cs_model *model;
    cs_error *error;
    cs_ply_head head;
    cs_ply_cursor cursor;
    int has_normals, has_coordinates; /* the vertices */
    int is_longer;                    /* some line has more numbers than the head says */
    cs_array corners;                 /* cs_corner, of the current face */
    cs_array texts;                   /* double, of the current list of texture coordinates */
} cs_ply_reader;

/* Values of one item that are single numbers. */
typedef struct cs_ply_scalars {
    double value[CS_PLY_SCALARS];
    int is_there[CS_PLY_SCALARS];
    cs_ply_type type[CS_PLY_SCALARS];
} cs_ply_scalars;

/* Records what is wrong, and in which item of an element. */
clshear_status cs_ply_complain(const cs_ply_reader *reader, const cs_ply_element *element,
                               size_t item, const char *what);

/* Reads one item: its single numbers into `given`, its lists into the reader. */
clshear_status cs_ply_read_item(cs_ply_reader *reader, const cs_ply_element *element, size_t item,
                                cs_ply_scalars *given);

/* The colour of an item, linear; 0 where it has none. */
int cs_ply_colour(const cs_ply_scalars *given, float *colour);

#endif
