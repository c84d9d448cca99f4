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

void cs_fuzz_three_mf(const uint8_t *data, size_t size)
{
    read_scene(cs_fuzz_file("x.3mf", data, size), size);
}

/* As the material library of a fixed OBJ file. */
void cs_fuzz_mtl(const uint8_t *data, size_t size)
{
    static const char obj[] = "mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\n"
                              "f 1/1 2/1 3/1\n";
    cs_fuzz_file("x.mtl", data, size);
    read_scene(cs_fuzz_file("of_mtl.obj", obj, sizeof obj - 1), size);
}
