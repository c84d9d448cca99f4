#include "helper/modules.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "helper/limits.h"
#include "image/image_io.h"
#include "import/find_file.h"

/* A function of a module beside this program, or NULL and a message. Modules stay loaded. */
static void *find(const char *module, const char *function, cs_error *error)
{
    char self[CS_FILE_PATH] = "", folder[CS_FILE_PATH], path[CS_FILE_PATH + 64];
    if (readlink("/proc/self/exe", self, sizeof self - 1) < 0) self[0] = '\0';
    cs_folder_of(self, folder, sizeof folder);
    snprintf(path, sizeof path, "%s%s", folder, module);
    void *library = dlopen(path, RTLD_LAZY | RTLD_LOCAL);
    void *address = library != NULL ? dlsym(library, function) : NULL;
    if (address == NULL)
        cs_fail(error, CLSHEAR_BAD_FILE, "%s cannot be loaded: %.300s", module, dlerror());
    return address;
}

/* The scene file that is read. */
static const char *limiting_path;

/* ISO C knows no cast from the address of data to that of a function, so all of these copy it. */
static clshear_status read_other(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    cs_other_reader read;
    void *address = find("clshear-import-other.so", "cs_read_other", error);
    if (address == NULL) return CLSHEAR_BAD_FILE;
    memcpy(&read, &address, sizeof read);
    const cs_limits limits = cs_limits_lower(limiting_path);
    const clshear_status status = read(bytes, model, error);
    cs_limits_restore(&limits);
    return status;
}

static clshear_status unpack_draco(const void *bytes, size_t size, cs_packed_mesh *mesh,
                                   cs_error *error)
{
    cs_draco_reader read;
    void *address = find("clshear-import-unpack.so", "cs_unpack_draco", error);
    if (address == NULL) return CLSHEAR_BAD_FILE;
    memcpy(&read, &address, sizeof read);
    const cs_limits limits = cs_limits_lower(limiting_path);
    const clshear_status status = read(bytes, size, mesh, error);
    cs_limits_restore(&limits);
    return status;
}

static clshear_status unpack_meshopt(const void *bytes, size_t size, const cs_packed_view *view,
                                     unsigned char **unpacked, cs_error *error)
{
    cs_meshopt_reader read;
    void *address = find("clshear-import-unpack.so", "cs_unpack_meshopt", error);
    if (address == NULL) return CLSHEAR_BAD_FILE;
    memcpy(&read, &address, sizeof read);
    const cs_limits limits = cs_limits_lower(limiting_path);
    const clshear_status status = read(bytes, size, view, unpacked, error);
    cs_limits_restore(&limits);
    return status;
}

const cs_import_modules *cs_modules_for(const char *path)
{
    static const cs_import_modules modules = {read_other, unpack_draco, unpack_meshopt};
    limiting_path = path;
    return &modules;
}

/* In the place of texels.cpp, which is in the module. */
clshear_status cs_image_read_texels(const char *path, const char *label, const void *memory,
                                    size_t size, const cs_texel_use *use, cs_texels *texels,
                                    cs_error *error)
{
    clshear_status (*read)(const char *, const char *, const void *, size_t, const cs_texel_use *,
                           cs_texels *, cs_error *);
    void *address = find("clshear-import-images.so", "cs_image_read_texels", error);
    if (address == NULL) return CLSHEAR_BAD_FILE;
    memcpy(&read, &address, sizeof read);
    return read(path, label, memory, size, use, texels, error);
}
