#include "helper/late.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "image/image_io.h"
#include "import/find_file.h"

/* A function of a module beside this program. Modules stay loaded. */
static clshear_status find(const char *module, const char *function, void *target, cs_error *error)
{
    char self[CS_FILE_PATH] = "", folder[CS_FILE_PATH], path[CS_FILE_PATH + 64];
    if (readlink("/proc/self/exe", self, sizeof self - 1) < 0) self[0] = '\0';
    cs_folder_of(self, folder, sizeof folder);
    snprintf(path, sizeof path, "%s%s", folder, module);
    void *library = dlopen(path, RTLD_LAZY | RTLD_LOCAL);
    void *address = library != NULL ? dlsym(library, function) : NULL;
    if (address == NULL)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s cannot be loaded: %.300s", module, dlerror());
    memcpy(target, &address, sizeof address); /* ISO C knows no cast to a function */
    return CLSHEAR_OK;
}

clshear_status cs_read_late(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    cs_other_reader read;
    clshear_status status = find("clshear-import-other.so", "cs_read_other", &read, error);
    return status == CLSHEAR_OK ? read(bytes, model, error) : status;
}

/* In the place of image_io.cpp, which is in the module. */
clshear_status cs_image_read_texels(const char *path, const char *label, const void *memory,
                                    size_t size, float base, float gain, cs_texels *texels,
                                    cs_error *error)
{
    static clshear_status (*read)(const char *, const char *, const void *, size_t, float, float,
                                  cs_texels *, cs_error *);
    clshear_status status = CLSHEAR_OK;
    if (read == NULL)
        status = find("clshear-import-images.so", "cs_image_read_texels", &read, error);
    if (status != CLSHEAR_OK) return status;
    return read(path, label, memory, size, base, gain, texels, error);
}
