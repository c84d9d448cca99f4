#include "import/import.h"

#include <string.h>

#include "import/build.h"
#include "import/readers.h"
#include "import/transfer.h"
#include "import/wall.h"

static clshear_status refuse(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    (void)bytes;
    return cs_fail(error, CLSHEAR_BAD_FILE,
                   "%s: only OBJ, glTF, PLY and STL are read without the program clshear-import, "
                   "which is not there",
                   model->path);
}

/* What is often found in the place of a scene, by its first bytes; NULL: something else. */
static const char *found_instead(const cs_bytes *bytes)
{
    static const struct {
        const char *begin;
        const char *meaning;
    } table[] = {
        {"version https://git-lfs", "is a pointer of Git LFS; \"git lfs pull\" fetches the scene"},
        {"\x1f\x8b", "is compressed by gzip; unpack it"},
        {"<!DOCTYPE html", "is a web page; download the scene itself"},
        {"<!doctype html", "is a web page; download the scene itself"},
        {"<html", "is a web page; download the scene itself"},
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        const size_t length = strlen(table[i].begin);
        if (bytes->size >= length && memcmp(bytes->data, table[i].begin, length) == 0)
            return table[i].meaning;
    }
    return NULL;
}

static cs_other_reader reader_for(const cs_bytes *bytes, const char *path, cs_other_reader other)
{
    if (cs_is_gltf(bytes, path)) return cs_read_gltf;
    if (cs_is_ply(bytes, path)) return cs_read_ply;
    if (cs_is_obj(bytes, path)) return cs_read_obj;
    if (cs_is_stl(bytes, path)) return cs_read_stl;
    return other != NULL ? other : refuse;
}

clshear_status cs_import_here(const char *path, const cs_import_options *options,
                              cs_other_reader other, cs_scene *scene, const cs_log *log,
                              cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_bytes bytes = {0};
    cs_model model;
    cs_model_init(&model, path, log);
    model.is_played = options->is_played;
    model.time_s = options->time_s;
    CS_TRY(cs_bytes_read(path, &bytes, error));
    CS_REQUIRE(bytes.size > 0, CLSHEAR_BAD_FILE, "%s: is empty", path);
    const cs_other_reader reader = reader_for(&bytes, path, other);
    const char *instead = reader != other ? found_instead(&bytes) : NULL;
    CS_REQUIRE(instead == NULL, CLSHEAR_BAD_FILE, "%s: %s", path, instead);
    CS_TRY(reader(&bytes, &model, error));
    scene->z_up = model.z_up;
    scene->up_is_open = model.up_is_open;
    cs_bytes_free(&bytes);
    CS_TRY(cs_model_build(&model, options->smooth_degrees, scene, error));
    CS_TRY(cs_scene_finish(scene, path, error));
done:
    cs_bytes_free(&bytes);
    cs_model_free(&model);
    return status;
}

/* Gives back what growing arrays have too much. */
static void trim(cs_scene *scene)
{
    cs_array *arrays[CS_SCENE_ARRAYS];
    cs_scene_arrays(scene, arrays);
    for (int i = 0; i < CS_SCENE_ARRAYS; i++)
        cs_array_trim(arrays[i]);
}

clshear_status cs_scene_import(const char *path, const cs_import_options *options, cs_scene *scene,
                               const cs_log *log, cs_error *error)
{
    char helper[CS_HELPER_PATH];
    const clshear_status status =
        cs_find_helper(helper) ? cs_import_behind_wall(helper, path, options, scene, log, error)
                               : cs_import_here(path, options, NULL, scene, log, error);
    if (status == CLSHEAR_OK) trim(scene);
    return status;
}
