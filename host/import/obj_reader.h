/* The state of reading an OBJ file: its lines, its faces, its materials. */
#ifndef CS_IMPORT_OBJ_READER_H
#define CS_IMPORT_OBJ_READER_H

#include "import/index_map.h"
#include "import/model.h"
#include "import/text.h"

typedef struct obj_reader {
    cs_model *model;
    cs_error *error;
    cs_lines lines;
    uint32_t group;           /* of the faces that follow */
    uint32_t material;        /* the same: number of a name in `used`, or CS_NO_INDEX */
    cs_index_map used;        /* names of usemtl, char[CS_MATERIAL_NAME] */
    cs_index_map libraries;   /* the same of mtllib, for those that were read or are missing */
    cs_array defined;         /* cs_material_description, of the libraries */
    cs_array corners;         /* cs_corner, of the current face */
    cs_array waiting;         /* obj_face: those that name what comes later */
    cs_array waiting_corners; /* cs_corner */
    size_t missing;           /* libraries that are not there */
    size_t without_surface;   /* lines of OBJ files that make no surface */
    size_t free_form;         /* lines of curves and surfaces */
    size_t painted;           /* positions that #MRGB has coloured */
    size_t left_out;          /* lines that name more, and are not obeyed */
} obj_reader;

void cs_obj_begin(obj_reader *reader);
void cs_obj_end(obj_reader *reader);

/* Faces. What names vertices that have not come yet waits for the end. */
clshear_status cs_obj_face(obj_reader *reader, char *at);
clshear_status cs_obj_waiting_faces(obj_reader *reader);

/* usemtl and mtllib; at the end the model gets the materials that were used. */
clshear_status cs_obj_use_material(obj_reader *reader, const char *name);
clshear_status cs_obj_library(obj_reader *reader, char *names);
clshear_status cs_obj_materials(obj_reader *reader);

#endif
