#include "helper/modules.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

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

clshear_status cs_read_by_module(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    cs_other_reader read;
    void *address = find("clshear-import-other.so", "cs_read_other", error);
    if (address == NULL) return CLSHEAR_BAD_FILE;
    memcpy(&read, &address, sizeof read); /* ISO C knows no cast to a function */
    return read(bytes, model, error);
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
