#include "scene/texture.h"

#include <assimp/scene.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/image_io.h"

/* `name` seen from the folder of `path`; backslashes of Windows exporters become slashes. */
static void resolve(const char *path, const char *name, char *resolved, size_t size)
{
    const char *slash = strrchr(path, '/');
    int folder = slash == NULL || name[0] == '/' ? 0 : (int)(slash - path) + 1;
    snprintf(resolved, size, "%.*s%s", folder, path, name);
    for (char *letter = resolved + folder; *letter != '\0'; letter++)
        if (*letter == '\\') *letter = '/';
}

/* The image inside the scene file that `name` means: "*N", or the name of one; NULL if none. */
static const struct aiTexture *embedded_image(const struct aiScene *file, const char *name)
{
    for (unsigned i = 0; i < file->mNumTextures; i++) {
        char number[16];
        snprintf(number, sizeof number, "*%u", i);
        if (strcmp(name, number) == 0 || strcmp(name, file->mTextures[i]->mFilename.data) == 0)
            return file->mTextures[i];
    }
    return NULL;
}

/* Replaces %XX by the bytes they stand for: glTF names files by URI. */
static void decode_percent(char *name)
{
    char *target = name;
    for (const char *source = name; *source != '\0'; source++) {
        char digits[3] = {0};
        char *end = digits;
        long byte = 0;
        if (*source == '%') {
            snprintf(digits, sizeof digits, "%s", source + 1);
            byte = strtol(digits, &end, 16);
        }
        int decoded = end == digits + 2 && byte > 0;
        *target++ = decoded ? (char)byte : *source;
        source += decoded ? 2 : 0;
    }
    *target = '\0';
}

/* The texture that was read under this name before, or CS_NO_TEXTURE. */
static cs_i32 known_texture(const cs_scene *scene, const char *name)
{
    const char(*names)[CS_TEXTURE_NAME] = scene->texture_names.items;
    for (size_t i = 0; i < scene->texture_names.count; i++)
        if (strncmp(names[i], name, CS_TEXTURE_NAME - 1) == 0) return (cs_i32)i;
    return CS_NO_TEXTURE;
}

static clshear_status append(cs_scene *scene, const char *name, const cs_texels *image,
                             cs_i32 *texture, cs_error *error)
{
    size_t count = (size_t)image->width * image->height, first = scene->texels.count;
    if (first + count > UINT32_MAX)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY,
                       "textures have more than 2^32 texels; use smaller images");
    void *texels = cs_array_extend(&scene->texels, count);
    cs_texture *added = cs_array_extend(&scene->textures, 1);
    char *kept_name = cs_array_extend(&scene->texture_names, 1);
    if (texels == NULL || added == NULL || kept_name == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for textures");
    memcpy(texels, image->halves, count * scene->texels.item_size);
    *added = (cs_texture){.first = (uint32_t)first, .width = image->width, .height = image->height};
    snprintf(kept_name, CS_TEXTURE_NAME, "%.*s", CS_TEXTURE_NAME - 1, name);
    *texture = (cs_i32)(scene->textures.count - 1);
    return CLSHEAR_OK;
}

clshear_status cs_texture_add(cs_scene *scene, const struct aiScene *file, const char *path,
                              const char *name, cs_i32 *texture, const cs_log *log, cs_error *error)
{
    char resolved[4096];
    const void *memory = NULL;
    size_t size = 0;
    cs_texels image = {0};
    cs_error reason;
    *texture = CS_NO_TEXTURE;
    resolve(path, name, resolved, sizeof resolved);
    const struct aiTexture *embedded = embedded_image(file, name);
    if (embedded != NULL && embedded->mHeight == 0) {
        memory = embedded->pcData;
        size = embedded->mWidth;
        snprintf(resolved, sizeof resolved, "%s.%s", name, embedded->achFormatHint);
    }
    *texture = known_texture(scene, resolved);
    if (*texture != CS_NO_TEXTURE) return CLSHEAR_OK;
    clshear_status status = cs_image_read_texels(resolved, memory, size, &image, &reason);
    if (status != CLSHEAR_OK && strchr(resolved, '%') != NULL) {
        decode_percent(resolved);
        *texture = known_texture(scene, resolved);
        if (*texture != CS_NO_TEXTURE) return CLSHEAR_OK;
        status = cs_image_read_texels(resolved, memory, size, &image, &reason);
    }
    if (status != CLSHEAR_OK) {
        cs_warn(log, "%s: texture %s; it is mid-grey", path, reason.message);
        return CLSHEAR_OK;
    }
    status = append(scene, resolved, &image, texture, error);
    free(image.halves);
    return status;
}
