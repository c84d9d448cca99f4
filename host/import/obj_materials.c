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
    char key[256] = {0};
    snprintf(key, sizeof key, "%s", name);
    memset(key + strlen(key), 0, sizeof key - strlen(key));
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

/* The number of the used name that means this one: the same, or the same and a comment. */
static uint32_t user_of(const obj_reader *reader, const char *name)
{
    char key[CS_MATERIAL_NAME];
    cs_mtl_key(name, key);
    const uint32_t number = cs_index_map_find(&reader->used, key);
    const char(*names)[CS_MATERIAL_NAME] = reader->used.keys.items;
    for (size_t i = 0; i < reader->used.keys.count && number == UINT32_MAX; i++) {
        memcpy(key, names[i], sizeof key);
        if (cs_cut_comment(key) && strcmp(key, name) == 0) return (uint32_t)i;
    }
    return number;
}

/* For each name that was used, the material called so: the last one, where there are several. */
clshear_status cs_obj_materials(obj_reader *reader)
{
    cs_model *model = reader->model;
    clshear_status status = read_namesake(reader);
    if (status != CLSHEAR_OK) return status;
    const cs_material_description *defined = reader->defined.items;
    const char(*names)[CS_MATERIAL_NAME] = reader->used.keys.items;
    const size_t count = reader->used.keys.count;
    cs_material_description *made = cs_model_extend(&model->materials, count);
    if (made == NULL) return cs_model_full(model, reader->error);
    for (size_t i = 0; i < count; i++)
        cs_material_init(&made[i], "");
    for (size_t i = 0; i < reader->defined.count; i++) {
        const uint32_t number = user_of(reader, defined[i].name);
        if (number != UINT32_MAX) made[number] = defined[i];
    }
    size_t undefined = 0;
    for (size_t i = 0; i < count; i++) {
        cs_material_whiten(&made[i]);
        if (made[i].name[0] != '\0') continue;
        cs_model_plain(model, names[i], &made[i]);
        if (reader->missing == 0 && undefined++ < 8)
            cs_warn(model->log, "%s: material \"%s\" %s", model->path, names[i],
                    model->colours.count > 0 ? "is not defined; it is white"
                                             : "is not defined; it is mid-grey");
    }
    if (undefined > 8)
        cs_warn(model->log, "%s: %zu more materials are not defined", model->path, undefined - 8);
    return CLSHEAR_OK;
}
