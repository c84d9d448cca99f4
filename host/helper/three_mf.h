/* 3MF, the 3D Manufacturing Format: an archive of XML texts, called parts. */
#ifndef CS_HELPER_THREE_MF_H
#define CS_HELPER_THREE_MF_H

#include "import/index_map.h"
#include "import/model.h"
#include "import/text.h"

int cs_is_3mf(const char *path);

clshear_status cs_read_3mf(cs_bytes *bytes, cs_model *model, cs_error *error);

/* ----- Within the reader ----- */

/* In place of a number that the file does not give, and of one that is not whole, or below 0. */
#define MF_NONE (-1)
#define MF_WRONG (-2)

/* Positions are multiplied as rows, from the left; the last three numbers are the translation. */
typedef struct mf_matrix {
    double value[12];
} mf_matrix;

/* What names something: ids count within a part. */
typedef struct mf_id {
    long long part;
    long long number;
} mf_id;

/* Leads from an id to the index in a list of what has the id: the last one, if several have it. */
typedef struct mf_places {
    cs_index_map ids; /* mf_id */
    cs_array places;  /* size_t, one for each */
} mf_places;

/* Colours that triangles name by their places. */
typedef struct mf_group {
    size_t first, count;
} mf_group;

typedef struct mf_colour {
    float value[4];    /* linear, with opacity */
    uint32_t material; /* number of the model's, or CS_NO_INDEX while nothing has it */
    char name[16];     /* as the file writes it */
} mf_colour;

typedef struct mf_triangle {
    uint32_t vertex[3];
    long long group;     /* or MF_NONE, MF_WRONG */
    long long colour[3]; /* places in the group, or MF_NONE, MF_WRONG */
} mf_triangle;

/* An object, or a copy of one, in its place. */
typedef struct mf_component {
    mf_id object;
    mf_matrix matrix;
} mf_component;

typedef struct mf_object {
    mf_id id;
    long long group, colour; /* of triangles that have none, or MF_NONE, MF_WRONG */
    size_t first_vertex, vertices;
    size_t first_triangle, triangles;
    size_t first_component, components;
} mf_object;

typedef struct mf_reader {
    cs_model *model;
    cs_error *error;
    struct zip *archive;  /* libzip's */
    size_t archive_bytes; /* its size */
    cs_index_map parts;   /* names, char[CS_MATERIAL_NAME]; the first one is the root */
    cs_array objects;     /* mf_object */
    mf_places of_objects;
    cs_array vertices;   /* double[3] */
    cs_array triangles;  /* mf_triangle */
    cs_array components; /* mf_component */
    cs_array items;      /* mf_component: the objects that the file's <build> lists */
    cs_array groups;     /* mf_group */
    mf_places of_groups;
    cs_array colours;     /* mf_colour */
    long long part;       /* that is being read */
    int is_in_object;     /* the last of `objects` is being read */
    size_t visits;        /* components that were placed */
    unsigned left_out;    /* bits: what was told to be left out */
    int has_wrong_colour; /* some triangle names a colour that is not there */
} mf_reader;

/* The name of the part that is being read. */
const char *mf_part_name(const mf_reader *reader);

/* Reads the text of a part into the lists. */
clshear_status mf_read_part(mf_reader *reader, const cs_bytes *text);

/* Places what is to be built into the model. */
clshear_status mf_build(mf_reader *reader);

#endif
