/* A target for libFuzzer: the bytes as a file of one format, read in this process. CS_FUZZ_SUFFIX
 * names the format; "mtl" reads them as the material library of a fixed OBJ file. */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "import/import.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void write_file(const char *path, const void *data, size_t size)
{
    FILE *stream = fopen(path, "wb");
    if (stream == NULL) abort();
    if (size > 0) fwrite(data, 1, size, stream);
    fclose(stream);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const char obj[] = "mtllib fuzz.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\n"
                              "f 1/1 2/1 3/1\n";
    static char folder[] = "/tmp/clshear_fuzz_XXXXXX";
    static char path[64], fixed[64];
    const int is_mtl = strcmp(CS_FUZZ_SUFFIX, "mtl") == 0;
    const cs_import_options options = {.smooth_degrees = size % 2 == 0 ? -1.0 : 40.0};
    const cs_log log = {0};
    cs_scene scene;
    cs_error error;
    if (path[0] == '\0') {
        if (mkdtemp(folder) == NULL) abort();
        snprintf(path, sizeof path, "%s/fuzz." CS_FUZZ_SUFFIX, folder);
        snprintf(fixed, sizeof fixed, "%s/fixed.obj", folder);
        write_file(fixed, obj, sizeof obj - 1);
    }
    write_file(path, data, size);
    cs_scene_init(&scene);
    cs_import_here(is_mtl ? fixed : path, &options, NULL, &scene, &log, &error);
    cs_scene_free(&scene);
    return 0;
}
