#include "scene/texture.h"

#include <stdlib.h>
#include <string.h>

#include "image/image_io.h"

static clshear_status append(cs_scene *scene, const cs_texels *image, cs_i32 *texture,
                             cs_error *error)
{
    const size_t count = (size_t)image->width * image->height, first = scene->texels.count;
    if (first + count > UINT32_MAX)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY,
                       "textures have more than 2^32 texels; use smaller images");
    void *texels = cs_array_extend(&scene->texels, count);
    cs_texture *added = cs_array_extend(&scene->textures, 1);
    if (texels == NULL || added == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for textures");
    memcpy(texels, image->halves, count * scene->texels.item_size);
    *added = (cs_texture){.first = (uint32_t)first, .width = image->width, .height = image->height};
    *texture = (cs_i32)(scene->textures.count - 1);
    return CLSHEAR_OK;
}

clshear_status cs_texture_add(cs_scene *scene, const char *path, const char *label,
                              const void *memory, size_t size, float base, float gain,
                              cs_i32 *texture, cs_error *error)
{
    cs_texels image = {0};
    *texture = CS_NO_TEXTURE;
    clshear_status status =
        cs_image_read_texels(path, label, memory, size, base, gain, &image, error);
    if (status == CLSHEAR_OK) status = append(scene, &image, texture, error);
    free(image.halves);
    return status;
}

clshear_status cs_texture_wrapped(cs_scene *scene, cs_u32 wrap_s, cs_u32 wrap_t, cs_i32 *texture,
                                  cs_error *error)
{
    const cs_u32 wrap = wrap_s | wrap_t << CS_TEXTURE_WRAP_BITS;
    const cs_texture *textures = scene->textures.items;
    cs_texture wanted = textures[*texture];
    wanted.wrap = wrap;
    for (size_t i = 0; i < scene->textures.count; i++)
        if (memcmp(&textures[i], &wanted, sizeof wanted) == 0) {
            *texture = (cs_i32)i;
            return CLSHEAR_OK;
        }
    cs_texture *added = cs_array_extend(&scene->textures, 1);
    if (added == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for textures");
    *added = wanted;
    *texture = (cs_i32)(scene->textures.count - 1);
    return CLSHEAR_OK;
}
