#include "import/import.h"

#include <string.h>

#include "import/build.h"
#include "import/readers.h"
#include "import/transfer.h"
#include "import/wall.h"

static clshear_status refuse(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    (void)bytes;
    return cs_fail(
        error, CLSHEAR_BAD_FILE,
        "%s: only OBJ, glTF, PLY, STL and OFF are read without the program clshear-import, "
        "which is not there",
        model->path);
}

/* What a file is that no reader can read, whatever its name says, and the remedy; or NULL. */
static const char *foreign(const cs_bytes *bytes)
{
    static const struct {
        const char *mark;
        const char *what;
    } kinds[] = {
        {"\x1f\x8b", "is compressed by gzip; unpack it first"},
        {"BZh", "is compressed by bzip2; unpack it first"},
        {"\xfd"
         "7zXZ",
         "is compressed by xz; unpack it first"},
        {"\x28\xb5\x2f\xfd", "is compressed by zstd; unpack it first"},
        {"7z\xbc\xaf", "is a 7z archive; unpack it first"},
        {"Rar!", "is a RAR archive; unpack it first"},
        {"version https://git-lfs",
         "is a pointer of Git LFS, not the file itself; run git lfs pull"},
        {"<!DOCTYPE html", "is a web page; download the file itself"},
        {"<!doctype html", "is a web page; download the file itself"},
        {"<html", "is a web page; download the file itself"},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const size_t length = strlen(kinds[i].mark);
        if (bytes->size >= length && memcmp(bytes->data, kinds[i].mark, length) == 0)
            return kinds[i].what;
    }
    return NULL;
}

/* An archive under the name of a format that is none. */
static int is_hidden_zip(const cs_bytes *bytes, const char *path)
{
    static const char *const names[] = {".obj", ".ply", ".stl", ".gltf", ".glb", ".off", ".zip"};
    if (bytes->size < 4 || memcmp(bytes->data, "PK\3\4", 4) != 0) return 0;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (cs_has_suffix(path, names[i])) return 1;
    return 0;
}

static cs_other_reader reader_for(const cs_bytes *bytes, const char *path, cs_other_reader other)
{
    if (cs_is_gltf(bytes, path)) return cs_read_gltf;
    if (cs_is_ply(bytes, path)) return cs_read_ply;
    if (cs_is_obj(bytes, path)) return cs_read_obj;
    if (cs_is_stl(bytes, path)) return cs_read_stl;
    if (cs_is_off(bytes, path)) return cs_read_off;
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
    const char *flaw =
        is_hidden_zip(&bytes, path) ? "is a ZIP archive; unpack it first" : foreign(&bytes);
    CS_REQUIRE(flaw == NULL, CLSHEAR_BAD_FILE, "%s: %s", path, flaw);
    const cs_other_reader reader = reader_for(&bytes, path, other);
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
