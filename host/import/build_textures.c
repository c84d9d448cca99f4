/* Textures of a model's materials. A texture of the device may be made of two images. */
#include <stdlib.h>
#include <string.h>

#include "import/build_parts.h"
#include "scene/texture.h"

enum {
    RED_GREEN_BLUE = 7,
    GREEN = 2,
    BLUE = 4,
    ALPHA = 8,
    ALL = CS_TEXTURE_ALL
};

/* An image's part of a texture. */
typedef struct layer_key {
    int image;
    cs_texel_use use;
    unsigned channels;
} layer_key;

/* A texture that was read, or could not be. */
typedef struct known_texture {
    layer_key layers[CS_TEXTURE_LAYERS];
    cs_i32 texture; /* that repeats, or CS_NO_TEXTURE */
} known_texture;

cs_array cs_known_textures(void)
{
    return (cs_array){.item_size = sizeof(known_texture)};
}

static layer_key key_of(const cs_map *map, unsigned channels)
{
    layer_key key;
    memset(&key, 0, sizeof key);
    key.image = map->image;
    if (map->image == CS_NO_IMAGE) return key;
    key.use = map->use;
    key.channels = channels;
    return key;
}

static int is_alike(const layer_key *a, const layer_key *b)
{
    return a->image == b->image && a->channels == b->channels && a->use.kind == b->use.kind &&
           a->use.base == b->use.base && a->use.gain == b->use.gain &&
           a->use.is_srgb == b->use.is_srgb;
}

/* Reads an image; one that cannot be read is reported and has no texels. */
static clshear_status read_layer(const cs_model *model, const layer_key *key,
                                 cs_texture_layer *layer, cs_error *error)
{
    cs_error reason;
    const cs_image_source *source = (const cs_image_source *)model->images.items + key->image;
    const char *instead = key->use.kind == CS_TEXELS_COLOUR ? "it is mid-grey" : "it is left out";
    *layer = (cs_texture_layer){.channels = key->channels};
    if (key->image == CS_NO_IMAGE) return CLSHEAR_OK;
    if (source->bytes == NULL && *source->path == '\0') {
        cs_warn(model->log, "%s: texture %s is not there; %s", model->path, source->label, instead);
        return CLSHEAR_OK;
    }
    clshear_status status = cs_image_read_texels(source->path, source->label, source->bytes,
                                                 source->size, &key->use, &layer->image, &reason);
    if (status == CLSHEAR_OUT_OF_MEMORY)
        return cs_fail(error, status, "%s: %s", model->path, reason.message);
    if (status != CLSHEAR_OK)
        cs_warn(model->log, "%s: texture %s; %s", model->path, reason.message, instead);
    return CLSHEAR_OK;
}

static clshear_status read_texture(const cs_model *model, cs_scene *scene, known_texture *one,
                                   cs_error *error)
{
    cs_error reason;
    cs_texture_layer layers[CS_TEXTURE_LAYERS] = {{{0, 0, NULL}, 0}, {{0, 0, NULL}, 0}};
    clshear_status status = CLSHEAR_OK;
    for (int i = 0; i < CS_TEXTURE_LAYERS && status == CLSHEAR_OK; i++)
        status = read_layer(model, &one->layers[i], &layers[i], error);
    if (status == CLSHEAR_OK) {
        status = cs_texture_add(scene, layers, CS_TEXTURE_LAYERS, &one->texture, &reason);
        if (status != CLSHEAR_OK) cs_fail(error, status, "%s: %s", model->path, reason.message);
    }
    for (int i = 0; i < CS_TEXTURE_LAYERS; i++)
        free(layers[i].image.halves);
    return status;
}

/* How a map is looked up: cs_texture.lookup. */
static cs_u32 lookup_of(const cs_map *map)
{
    return (cs_u32)map->wrap[0] | (cs_u32)map->wrap[1] << CS_TEXTURE_WRAP_BITS |
           (map->is_nearest ? (cs_u32)CS_TEXTURE_NEAREST : 0u);
}

/* The texture of one map, or of two, looked up as the first that is there. */
static clshear_status find_texture(const cs_model *model, cs_scene *scene, cs_array *known,
                                   const cs_map *maps[CS_TEXTURE_LAYERS],
                                   const layer_key keys[CS_TEXTURE_LAYERS], cs_i32 *texture,
                                   cs_error *error)
{
    const cs_map *first = maps[keys[0].image == CS_NO_IMAGE];
    known_texture *one = known->items;
    clshear_status status = CLSHEAR_OK;
    size_t i = 0;
    *texture = CS_NO_TEXTURE;
    if (keys[0].image == CS_NO_IMAGE && keys[1].image == CS_NO_IMAGE) return CLSHEAR_OK;
    while (i < known->count &&
           !(is_alike(&one[i].layers[0], &keys[0]) && is_alike(&one[i].layers[1], &keys[1])))
        i++;
    if (i == known->count) {
        one = cs_array_extend(known, 1);
        if (one == NULL) return cs_model_full(model, error);
        *one = (known_texture){{keys[0], keys[1]}, CS_NO_TEXTURE};
        status = read_texture(model, scene, one, error);
        one = known->items;
    }
    *texture = one[i].texture;
    if (status != CLSHEAR_OK || *texture == CS_NO_TEXTURE) return status;
    return cs_texture_look_up(scene, lookup_of(first), texture, error);
}

/* Whether two maps are one image, read alike. */
static int is_one_image(const cs_map *a, const cs_map *b)
{
    const layer_key first = key_of(a, ALL), second = key_of(b, ALL);
    return is_alike(&first, &second);
}

clshear_status cs_build_textures(const cs_model *model, cs_scene *scene,
                                 const cs_material_description *material, cs_array *known,
                                 cs_material_textures *textures, cs_error *error)
{
    static const cs_map none = {.image = CS_NO_IMAGE};
    const cs_material_description *m = material;
    const float *shine = m->emissive;
    const int shines = shine[0] > 0.0f || shine[1] > 0.0f || shine[2] > 0.0f;
    const int is_cut = m->alpha_mode != CS_ALPHA_OPAQUE && m->alpha_map.image != CS_NO_IMAGE;
    const int is_packed = is_one_image(&m->roughness_map, &m->metallic_map);
    const struct {
        const cs_map *maps[CS_TEXTURE_LAYERS];
        unsigned channels[CS_TEXTURE_LAYERS];
        cs_i32 *texture;
    } wanted[] = {
        {{&m->base_map, is_cut ? &m->alpha_map : &none},
         {is_cut ? RED_GREEN_BLUE : ALL, ALPHA},
         &textures->base},
        {{&m->roughness_map, is_packed ? &none : &m->metallic_map},
         {is_packed ? ALL : GREEN, BLUE},
         &textures->facets},
        {{&m->normal_map, &none}, {ALL, 0}, &textures->normal},
        {{shines ? &m->emissive_map : &none, &none}, {ALL, 0}, &textures->emission},
    };
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted && status == CLSHEAR_OK; i++) {
        const layer_key keys[] = {key_of(wanted[i].maps[0], wanted[i].channels[0]),
                                  key_of(wanted[i].maps[1], wanted[i].channels[1])};
        const cs_map *maps[] = {wanted[i].maps[0], wanted[i].maps[1]};
        status = find_texture(model, scene, known, maps, keys, wanted[i].texture, error);
    }
    textures->covers = status == CLSHEAR_OK && textures->base != CS_NO_TEXTURE &&
                       cs_texture_covers(scene, textures->base);
    return status;
}
