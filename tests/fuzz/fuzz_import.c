/* The bytes as a scene file of one format, read in this process. Images and meshes that Draco has
 * compressed are left to their libraries, which are behind the wall: their places have stand-ins.
 */
#include <stdlib.h>
#include <string.h>

#include "helper/three_mf.h"
#include "helper/unpack.h"
#include "image/image_io.h"
#include "import/import.h"
#include "import/transfer.h"
#include "targets.h"

unsigned long crc32(unsigned long sum, const unsigned char *bytes, unsigned size);

/* In the place of zlib's, for libzip: every checksum is 0, as in the corpus, so that what is
 * changed in an archive is read all the same. */
__attribute__((visibility("default"))) unsigned long
crc32(unsigned long sum, const unsigned char *bytes, unsigned size)
{
    (void)sum, (void)bytes, (void)size;
    return 0;
}

clshear_status __wrap_cs_image_read_texels(const char *path, const char *label, const void *memory,
                                           size_t size, const cs_texel_use *use, cs_texels *texels,
                                           cs_error *error);

/* The linker puts this in the place of cs_image_read_texels (--wrap): one texel. */
clshear_status __wrap_cs_image_read_texels(const char *path, const char *label, const void *memory,
                                           size_t size, const cs_texel_use *use, cs_texels *texels,
                                           cs_error *error)
{
    (void)path, (void)memory, (void)size, (void)use;
    texels->halves = calloc(4, sizeof *texels->halves);
    texels->width = texels->height = 1;
    if (texels->halves == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s", label);
    return CLSHEAR_OK;
}

/* In the place of cs_unpack_draco, which asks for any memory: a mesh whose first two bytes say how
 * many vertices and triangles it has, and all of them its indices. */
static clshear_status unpack_draco(const void *bytes, size_t size, cs_packed_mesh *mesh,
                                   cs_error *error)
{
    const uint8_t *numbers = bytes;
    if (size < 2) return cs_fail(error, CLSHEAR_BAD_FILE, "is short");
    mesh->vertex_count = numbers[0];
    mesh->index_count = (size_t)3 * numbers[1];
    mesh->indices = calloc(mesh->index_count + 1, sizeof *mesh->indices);
    for (size_t i = 0; i < mesh->index_count && mesh->indices != NULL; i++)
        mesh->indices[i] = numbers[i % size];
    for (size_t i = 0; i < mesh->attribute_count; i++) {
        const int type = mesh->attributes[i].type;
        const size_t bytes_each = type < 5122 ? 1 : type < 5124 ? 2 : 4;
        mesh->attributes[i].values =
            calloc(mesh->vertex_count + 1, bytes_each * mesh->attributes[i].components);
        if (mesh->attributes[i].values == NULL) return CLSHEAR_OUT_OF_MEMORY;
    }
    return mesh->indices != NULL ? CLSHEAR_OK : CLSHEAR_OUT_OF_MEMORY;
}

static void read_scene(const char *path, size_t size)
{
    const cs_import_options options = {.smooth_degrees = size % 2 == 0 ? -1.0 : 40.0};
    const cs_import_modules modules = {
        .other = cs_read_3mf, .draco = unpack_draco, .meshopt = cs_unpack_meshopt};
    const cs_log log = {0};
    cs_scene scene;
    cs_error error;
    cs_scene_init(&scene);
    if (cs_import_here(path, &options, &modules, &scene, &log, &error) == CLSHEAR_OK &&
        !cs_scene_is_sound(&scene))
        abort();
    cs_scene_free(&scene);
}

#define CS_FORMAT(name)                                         \
    void cs_fuzz_##name(const uint8_t *data, size_t size)       \
    {                                                           \
        read_scene(cs_fuzz_file("x." #name, data, size), size); \
    }
CS_FORMAT(obj)
CS_FORMAT(ply)
CS_FORMAT(stl)
CS_FORMAT(off)
CS_FORMAT(gltf)
CS_FORMAT(glb)

static void put_number(uint8_t **at, size_t value, int count)
{
    for (int i = 0; i < count; i++, value >>= 8)
        *(*at)++ = (uint8_t)value;
}

/* What the head of an entry and the directory have in common, from the version on. */
static void put_head(uint8_t **at, size_t size, size_t name)
{
    put_number(at, 20, 2);
    put_number(at, 0, 12); /* neither packed nor encrypted; time; the checksum as above */
    put_number(at, size, 4);
    put_number(at, size, 4);
    put_number(at, name, 2);
    put_number(at, 0, 2);
}

/* Writes an archive whose only part is this text, as it is, and returns its size. */
static size_t put_archive(const uint8_t *text, size_t size, uint8_t *archive)
{
    static const char name[] = "3D/3dmodel.model";
    const size_t length = sizeof name - 1;
    uint8_t *at = archive;
    at = (uint8_t *)memcpy(at, "PK\3\4", 4) + 4;
    put_head(&at, size, length);
    at = (uint8_t *)memcpy(at, name, length) + length;
    at = (uint8_t *)memcpy(at, text, size) + size;
    const size_t directory = (size_t)(at - archive);
    at = (uint8_t *)memcpy(at, "PK\1\2\24\0", 6) + 6;
    put_head(&at, size, length);
    put_number(&at, 0, 14); /* no comment; the first disk; no attributes; where the entry is */
    at = (uint8_t *)memcpy(at, name, length) + length;
    const size_t end = (size_t)(at - archive);
    at = (uint8_t *)memcpy(at, "PK\5\6\0\0\0\0\1\0\1\0", 12) + 12;
    put_number(&at, end - directory, 4);
    put_number(&at, directory, 4);
    put_number(&at, 0, 2);
    return (size_t)(at - archive);
}

/* An archive, or the text of a part: few changes of an archive leave it one. */
void cs_fuzz_three_mf(const uint8_t *data, size_t size)
{
    uint8_t *archive = malloc(size + 256);
    const int is_archive = size >= 2 && memcmp(data, "PK", 2) == 0;
    if (archive == NULL) return;
    if (is_archive) memcpy(archive, data, size);
    const size_t whole = is_archive ? size : put_archive(data, size, archive);
    read_scene(cs_fuzz_file("x.3mf", archive, whole), size);
    free(archive);
}

/* As the material library of a fixed OBJ file. */
void cs_fuzz_mtl(const uint8_t *data, size_t size)
{
    static const char obj[] = "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\n"
                              "f 1/1 2/1 3/1\n";
    cs_fuzz_file("x.mtl", data, size);
    read_scene(cs_fuzz_file("of_mtl.obj", obj, sizeof obj - 1), size);
}
