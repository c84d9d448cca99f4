/* Materials of OBJ files. */
#include <stdio.h>
#include <string.h>

#include "import/find_file.h"
#include "import/mtl.h"
#include "import/obj_reader.h"

clshear_status cs_obj_use_material(obj_reader *reader, const char *name)
{
    char key[CS_MATERIAL_NAME];
    cs_mtl_key(name, key);
    reader->material = CS_NO_INDEX;
    if (key[0] == '\0') return CLSHEAR_OK;
    reader->material = cs_index_map_add(&reader->used, key);
    if (reader->material == UINT32_MAX) return cs_model_full(reader->model, reader->error);
    return CLSHEAR_OK;
}

/* Whether a library comes for the first time. */
static int is_new(obj_reader *reader, const char *name)
{
    char key[CS_MATERIAL_NAME];
    cs_mtl_key(name, key);
    const size_t before = reader->libraries.keys.count;
    return cs_index_map_add(&reader->libraries, key) == before;
}

static int find_library(const obj_reader *reader, const char *name, char *found)
{
    char folder[CS_FILE_PATH];
    const char *folders[] = {folder};
    cs_folder_of(reader->model->path, folder, sizeof folder);
    return cs_find_file(name, folders, 1, found);
}

static clshear_status read_library(obj_reader *reader, const char *name)
{
    char found[CS_FILE_PATH];
    if (!is_new(reader, name)) return CLSHEAR_OK;
    if (find_library(reader, name, found)) {
        cs_error reason;
        clshear_status status = cs_mtl_read(found, reader->model, &reader->defined, &reason);
        if (status == CLSHEAR_OUT_OF_MEMORY) return cs_model_full(reader->model, reader->error);
        if (status == CLSHEAR_OK) return status;
        cs_warn(reader->model->log, "%s; its materials are mid-grey", reason.message);
        reader->missing++;
        return CLSHEAR_OK;
    }
    cs_warn(reader->model->log, "%s: material file %s not found; its materials are mid-grey",
            reader->model->path, name);
    reader->missing++;
    return CLSHEAR_OK;
}

/* Reads `mtllib`: one name that contains blanks, if there is such a file; else several names. */
clshear_status cs_obj_library(obj_reader *reader, char *names)
{
    char found[CS_FILE_PATH];
    clshear_status status = CLSHEAR_OK;
    if (*names == '\0') return CLSHEAR_OK;
    if (strpbrk(names, " \t") == NULL || find_library(reader, names, found))
        return read_library(reader, names);
    for (char *name = cs_next_word(&names); name != NULL && *name != '#' && status == CLSHEAR_OK;
         name = cs_next_word(&names))
        status = read_library(reader, name);
    return status;
}

/* Files without mtllib often have their materials beside them, under their own name. */
static clshear_status read_namesake(obj_reader *reader)
{
    char found[CS_FILE_PATH];
    const char *path = reader->model->path, *dot = strrchr(path, '.');
    if (reader->libraries.keys.count > 0 || reader->used.keys.count == 0 || dot == NULL)
        return CLSHEAR_OK;
    snprintf(found, sizeof found, "%.*s.mtl", (int)(dot - path), path);
    const char *slash = strrchr(found, '/');
    const char *name = slash != NULL ? slash + 1 : found;
    char ignored[CS_FILE_PATH];
    return find_library(reader, name, ignored) ? read_library(reader, name) : CLSHEAR_OK;
}

/* ----- Definitions ----- */

/* Materials of the libraries by their names. */
typedef struct definitions {
    const cs_material_description *all;
    cs_index_map names; /* char[CS_MATERIAL_NAME] */
    cs_array last;      /* uint32_t: of each name the last material in `all` that has it */
} definitions;

static void free_definitions(definitions *defined)
{
    cs_index_map_free(&defined->names);
    cs_array_free(&defined->last);
}

/* Returns 0 without memory. */
static int find_definitions(const obj_reader *reader, definitions *defined)
{
    *defined = (definitions){.all = reader->defined.items, .last.item_size = sizeof(uint32_t)};
    cs_index_map_init(&defined->names, CS_MATERIAL_NAME);
    for (size_t i = 0; i < reader->defined.count; i++) {
        char key[CS_MATERIAL_NAME];
        cs_mtl_key(defined->all[i].name, key);
        const uint32_t number = cs_index_map_add(&defined->names, key);
        if (number == UINT32_MAX) return 0;
        if (number == defined->last.count && cs_array_extend(&defined->last, 1) == NULL) return 0;
        ((uint32_t *)defined->last.items)[number] = (uint32_t)i;
    }
    return 1;
}

/* The material that a name means: that of the whole name, or else of what is before a comment in
 * it. NULL where neither is defined. */
static const cs_material_description *definition_of(const definitions *defined, const char *name)
{
    char key[CS_MATERIAL_NAME], text[CS_MATERIAL_NAME];
    cs_mtl_key(name, key);
    uint32_t number = cs_index_map_find(&defined->names, key);
    memcpy(text, key, sizeof text);
    if (number == UINT32_MAX && cs_cut_comment(text)) {
        cs_mtl_key(text, key);
        number = cs_index_map_find(&defined->names, key);
    }
    return number != UINT32_MAX ? &defined->all[((uint32_t *)defined->last.items)[number]] : NULL;
}

static void tell_undefined(const cs_model *model, const char *name)
{
    cs_warn(model->log, "%s: material \"%s\" %s", model->path, name,
            model->colours.count > 0 ? "is not defined; it is white"
                                     : "is not defined; it is mid-grey");
}

/* Makes the materials of the names that were used. */
static void make_used(const obj_reader *reader, const definitions *defined,
                      cs_material_description *made)
{
    enum {
        MOST_LINES = 8
    };
    const cs_model *model = reader->model;
    const char(*names)[CS_MATERIAL_NAME] = reader->used.keys.items;
    size_t undefined = 0;
    for (size_t i = 0; i < reader->used.keys.count; i++) {
        const cs_material_description *definition = definition_of(defined, names[i]);
        if (definition != NULL) {
            made[i] = *definition;
            cs_material_whiten(&made[i]);
            continue;
        }
        cs_model_plain(model, names[i], &made[i]);
        if (reader->missing == 0 && undefined++ < MOST_LINES) tell_undefined(model, names[i]);
    }
    if (undefined > MOST_LINES)
        cs_warn(model->log, "%s: %zu more materials are not defined", model->path,
                undefined - MOST_LINES);
}

/* For each name that was used, the material called so: the last one, where there are several. */
clshear_status cs_obj_materials(obj_reader *reader)
{
    definitions defined = {0};
    cs_model *model = reader->model;
    clshear_status status = read_namesake(reader);
    if (status != CLSHEAR_OK) return status;
    cs_material_description *made = cs_model_extend(&model->materials, reader->used.keys.count);
    if (made != NULL && find_definitions(reader, &defined))
        make_used(reader, &defined, made);
    else
        status = cs_model_full(model, reader->error);
    free_definitions(&defined);
    return status;
}
