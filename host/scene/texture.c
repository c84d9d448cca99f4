#include "scene/texture.h"

#include <string.h>

enum {
    HALF_ONE = 0x3c00
};

/* Texel (x, y) of a picture of another size: the nearest one. */
static const uint16_t *texel_at(const cs_texels *image, const cs_texture *size, size_t x, size_t y)
{
    const size_t across = x * image->width / size->width, down = y * image->height / size->height;
    return image->halves + 4 * (down * image->width + across);
}

static void fill(const cs_texture *texture, const cs_texture_layer *layers, size_t count,
                 uint16_t *texels)
{
    const size_t size = 4 * (size_t)texture->width * texture->height;
    if (layers[0].channels == CS_TEXTURE_ALL && layers[0].image.halves != NULL) {
        memcpy(texels, layers[0].image.halves, size * sizeof *texels);
        return;
    }
    for (size_t i = 0; i < size; i++)
        texels[i] = HALF_ONE;
    for (size_t i = 0; i < count; i++)
        for (size_t y = 0; y < texture->height && layers[i].image.halves != NULL; y++)
            for (size_t x = 0; x < texture->width; x++) {
                const uint16_t *from = texel_at(&layers[i].image, texture, x, y);
                uint16_t *to = texels + 4 * (y * texture->width + x);
                for (int c = 0; c < 4; c++)
                    if (layers[i].channels >> c & 1u) to[c] = from[c];
            }
}

clshear_status cs_texture_add(cs_scene *scene, const cs_texture_layer *layers, size_t count,
                              cs_i32 *texture, cs_error *error)
{
    cs_texture made = {.first = (uint32_t)scene->texels.count};
    *texture = CS_NO_TEXTURE;
    for (size_t i = 0; i < count; i++)
        if (layers[i].image.halves != NULL) {
            made.width = layers[i].image.width > made.width ? layers[i].image.width : made.width;
            made.height =
                layers[i].image.height > made.height ? layers[i].image.height : made.height;
        }
    const size_t size = (size_t)made.width * made.height;
    if (size == 0) return CLSHEAR_OK;
    if (scene->texels.count + size > UINT32_MAX)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY,
                       "textures have more than 2^32 texels; use smaller images");
    uint16_t *texels = cs_array_extend(&scene->texels, size);
    cs_texture *added = cs_array_extend(&scene->textures, 1);
    if (texels == NULL || added == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for textures");
    fill(&made, layers, count, texels);
    *added = made;
    *texture = (cs_i32)(scene->textures.count - 1);
    return CLSHEAR_OK;
}

int cs_texture_covers(const cs_scene *scene, cs_i32 texture)
{
    const cs_texture *one = (const cs_texture *)scene->textures.items + texture;
    const uint16_t(*texels)[4] = scene->texels.items;
    for (size_t i = 0; i < (size_t)one->width * one->height; i++)
        if (texels[one->first + i][3] != HALF_ONE) return 0;
    return 1;
}

clshear_status cs_texture_look_up(cs_scene *scene, cs_u32 lookup, cs_i32 *texture, cs_error *error)
{
    const cs_texture *textures = scene->textures.items;
    cs_texture wanted = textures[*texture];
    wanted.lookup = lookup;
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
