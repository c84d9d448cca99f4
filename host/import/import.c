#include "import/import.h"

#include <string.h>
#include <strings.h>

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

/* The first bytes of a file, and what is said of those that begin so. */
typedef struct file_mark {
    const char *bytes;
    const char *what;
} file_mark;

/* What Git has in the place of files that it keeps elsewhere. */
static const file_mark pointers[] = {
    {"version https://git-lfs", "is a pointer of Git LFS, not the file itself; run git lfs pull"},
    {NULL, NULL}};

/* What some formats that Assimp reads are packed by: Blender's by gzip. */
static const file_mark packings[] = {{"\x1f\x8b", "is compressed by gzip; unpack it first"},
                                     {"BZh", "is compressed by bzip2; unpack it first"},
                                     {"\xfd"
                                      "7zXZ",
                                      "is compressed by xz; unpack it first"},
                                     {"\x28\xb5\x2f\xfd", "is compressed by zstd; unpack it first"},
                                     {"7z\xbc\xaf", "is a 7z archive; unpack it first"},
                                     {"Rar!", "is a RAR archive; unpack it first"},
                                     {NULL, NULL}};

/* Some formats are archives, and say themselves what is wrong with them. */
static const file_mark archives[] = {{"PK\3\4", "is a ZIP archive; unpack it first"}, {NULL, NULL}};

/* What is said of a file by its mark, one of a list; NULL where it has none. */
static const char *find_mark(const cs_bytes *bytes, const file_mark *list)
{
    for (; list->bytes != NULL; list++) {
        const size_t length = strlen(list->bytes);
        if (bytes->size >= length && memcmp(bytes->data, list->bytes, length) == 0)
            return list->what;
    }
    return NULL;
}

/* Web pages may begin with a mark of the order of bytes, or blank lines. */
static int is_web_page(const cs_bytes *bytes)
{
    const char *at = bytes->data;
    if (strncmp(at, "\xef\xbb\xbf", 3) == 0) at += 3;
    at += strspn(at, " \t\r\n");
    return strncasecmp(at, "<!doctype html", 14) == 0 || strncasecmp(at, "<html", 5) == 0;
}

/* Whether a name is that of a format whose files are never packed, or says that this one is. */
static int is_plain_or_packed(const char *path)
{
    static const char *const names[] = {".obj", ".ply", ".stl", ".gltf", ".glb", ".off", ".zip",
                                        ".gz",  ".bz2", ".xz",  ".zst",  ".7z",  ".rar"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (cs_has_suffix(path, names[i])) return 1;
    return 0;
}

/* Why no reader need try a file; NULL where one has to. */
static const char *flaw_of(const cs_bytes *bytes, const char *path)
{
    const char *flaw = find_mark(bytes, pointers);
    if (is_web_page(bytes)) flaw = "is a web page; download the file itself";
    if (flaw != NULL || !is_plain_or_packed(path)) return flaw;
    flaw = find_mark(bytes, packings);
    return flaw != NULL ? flaw : find_mark(bytes, archives);
}

static cs_other_reader reader_for(const cs_bytes *bytes, const char *path,
                                  const cs_import_modules *modules)
{
    if (cs_is_gltf(bytes, path)) return cs_read_gltf;
    if (cs_is_ply(bytes, path)) return cs_read_ply;
    if (cs_is_obj(bytes, path)) return cs_read_obj;
    if (cs_is_stl(bytes, path)) return cs_read_stl;
    if (cs_is_off(bytes, path)) return cs_read_off;
    return modules != NULL && modules->other != NULL ? modules->other : refuse;
}

clshear_status cs_import_here(const char *path, const cs_import_options *options,
                              const cs_import_modules *modules, cs_scene *scene, const cs_log *log,
                              cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_bytes bytes = {0};
    cs_model model;
    cs_model_init(&model, path, log);
    model.modules = modules;
    model.is_played = options->is_played;
    model.time_s = options->time_s;
    CS_TRY(cs_bytes_read(path, &bytes, error));
    CS_REQUIRE(bytes.size > 0, CLSHEAR_BAD_FILE, "%s: is empty", path);
    const char *flaw = flaw_of(&bytes, path), *packing = find_mark(&bytes, packings);
    CS_REQUIRE(flaw == NULL, CLSHEAR_BAD_FILE, "%s: %s", path, flaw);
    status = reader_for(&bytes, path, modules)(&bytes, &model, error);
    CS_REQUIRE(status != CLSHEAR_BAD_FILE || packing == NULL, status, "%s: %s", path, packing);
    CS_TRY(status);
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
