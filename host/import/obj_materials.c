/* Materials of OBJ files. */
#include <stdio.h>
#include <string.h>

#include "import/find_file.h"
#include "import/mtl.h"
#include "import/obj_reader.h"

clshear_status cs_obj_use_material(obj_reader *reader, const char *name)
{
    char key[CS_MATERIAL_NAME] = {0};
    const size_t length = strnlen(name, sizeof key - 1);
    memcpy(key, name, length);
    reader->material = CS_NO_INDEX;
    if (length == 0) return CLSHEAR_OK;
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

static void key_of(const char *name, char *key)
{
    memset(key, 0, CS_MATERIAL_NAME);
    memcpy(key, name, strnlen(name, CS_MATERIAL_NAME - 1));
}

/* For each name that was used, the material called so: the last one, where there are several. */
clshear_status cs_obj_materials(obj_reader *reader)
{
    const cs_material_description *defined = reader->defined.items;
    cs_model *model = reader->model;
    const char(*names)[CS_MATERIAL_NAME] = reader->used.keys.items;
    const size_t count = reader->used.keys.count;
    cs_material_description *made = cs_model_extend(&model->materials, count);
    if (made == NULL) return cs_model_full(model, reader->error);
    for (size_t i = 0; i < count; i++)
        cs_material_init(&made[i], "");
    for (size_t i = 0; i < reader->defined.count; i++) {
        char key[CS_MATERIAL_NAME];
        key_of(defined[i].name, key);
        const uint32_t number = cs_index_map_find(&reader->used, key);
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
