/* Materials, textures and images of glTF. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import/find_file.h"
#include "import/gltf_reader.h"

/* ----- Images ----- */

static clshear_status add_file(gltf_reader *reader, const char *uri, int *image)
{
    char found[CS_FILE_PATH];
    const char *folders[] = {reader->folder};
    const int there = cs_find_file(uri, folders, 1, found);
    return cs_model_add_image(reader->model, there ? found : "", there ? found : uri, NULL, 0,
                              image, reader->error);
}

/* An image of the file as one of the model. */
static clshear_status add_image(gltf_reader *reader, long long index, int *image)
{
    const json_t *json = gltf_at(reader, "images", index);
    if (json == NULL) return CLSHEAR_BAD_FILE;
    const char *uri = gltf_text(json, "uri", NULL);
    char label[80], *owned = NULL;
    const unsigned char *data = NULL;
    size_t size = 0, stride = 0;
    clshear_status status;
    if (uri != NULL && !gltf_is_data(uri)) return add_file(reader, uri, image);
    snprintf(label, sizeof label, "embedded image %lld", index);
    if (uri != NULL) {
        status = gltf_uri(reader, "images", index, uri, &owned, &size);
        data = (const unsigned char *)owned;
    } else {
        status = gltf_view(reader, gltf_index(json, "bufferView"), &data, &size, &stride);
    }
    if (status == CLSHEAR_OK)
        status = cs_model_add_image(reader->model, "", label, data, size, image, reader->error);
    free(owned);
    return status;
}

/* ----- Textures ----- */

static cs_wrap wrap_of(const json_t *sampler, const char *key)
{
    const long long code = gltf_index(sampler, key);
    return code == 33071 ? CS_WRAP_CLAMP : code == 33648 ? CS_WRAP_MIRROR : CS_WRAP_REPEAT;
}

/* From the vertex's coordinates, whose t grows downwards, to those of the image, whose t grows
 * upwards; with the KHR_texture_transform of `info`: scale, then rotation, then offset. */
static void set_transform(const json_t *info, cs_map *map)
{
    const json_t *given = gltf_extension(info, "KHR_texture_transform");
    double offset[2] = {0, 0}, scale[2] = {1, 1};
    gltf_numbers(given, "offset", offset, 2);
    gltf_numbers(given, "scale", scale, 2);
    const double angle = gltf_number(given, "rotation", 0.0);
    const double c = cos(angle), s = sin(angle);
    const long long set = gltf_index(given, "texCoord");
    if (set >= 0 && set < 64) map->set = (int)set;
    map->across[0] = c * scale[0];
    map->across[1] = s * scale[1];
    map->across[2] = offset[0];
    map->up[0] = s * scale[0];
    map->up[1] = -c * scale[1];
    map->up[2] = 1.0 - offset[1];
}

/* Where a texture's image is: EXT_texture_webp's goes before the plain one. */
static long long source_of(const json_t *texture)
{
    const json_t *webp = gltf_extension(texture, "EXT_texture_webp");
    const long long source = gltf_index(webp, "source");
    return source >= 0 ? source : gltf_index(texture, "source");
}

/* The map that member `key` of `parent` asks for, if it does. */
static clshear_status read_map(gltf_reader *reader, const json_t *parent, const char *key,
                               cs_map *map)
{
    const json_t *info = json_object_get(parent, key);
    if (!json_is_object(info)) return CLSHEAR_OK;
    const long long index = gltf_index(info, "index"), set = gltf_index(info, "texCoord");
    const json_t *texture = gltf_at(reader, "textures", index);
    if (texture == NULL) return CLSHEAR_BAD_FILE;
    cs_map_init(map);
    map->set = set > 0 && set < 64 ? (int)set : 0;
    set_transform(info, map);
    const long long number = gltf_index(texture, "sampler");
    if (number >= 0) {
        const json_t *sampler = gltf_at(reader, "samplers", number);
        if (sampler == NULL) return CLSHEAR_BAD_FILE;
        map->wrap[0] = wrap_of(sampler, "wrapS");
        map->wrap[1] = wrap_of(sampler, "wrapT");
    }
    const long long source = source_of(texture);
    if (source >= 0) return add_image(reader, source, &map->image);
    map->missing = 1;
    cs_warn(reader->model->log,
            "%s: texture %lld has no image that can be read (extension %s); it is mid-grey",
            reader->model->path, index,
            gltf_extension(texture, "KHR_texture_basisu") != NULL ? "KHR_texture_basisu"
                                                                  : "not known");
    return CLSHEAR_OK;
}

/* ----- Materials ----- */

/* Of a map that the device does not use it is enough to know that it is there. */
static void note_map(const json_t *parent, const char *key, cs_map *map)
{
    if (json_is_object(json_object_get(parent, key))) map->missing = 1;
}

static void read_alpha(const json_t *json, cs_material_description *material)
{
    const char *mode = gltf_text(json, "alphaMode", "OPAQUE");
    if (strcmp(mode, "MASK") == 0) material->alpha_mode = CS_ALPHA_MASK;
    if (strcmp(mode, "BLEND") == 0) material->alpha_mode = CS_ALPHA_BLEND;
    material->alpha_cutoff = (float)gltf_number(json, "alphaCutoff", 0.5);
    material->double_sided = json_is_true(json_object_get(json, "doubleSided"));
}

/* Extensions of a material that the description has members for, and names of the others. */
static void read_extensions(const json_t *json, cs_material_description *material)
{
    const json_t *ext = gltf_extension(json, "KHR_materials_emissive_strength");
    material->emissive_strength = (float)gltf_number(ext, "emissiveStrength", 1.0);
    ext = gltf_extension(json, "KHR_materials_ior");
    material->ior = (float)gltf_number(ext, "ior", 1.5);
    ext = gltf_extension(json, "KHR_materials_transmission");
    material->transmission = (float)gltf_number(ext, "transmissionFactor", 0.0);
    note_map(ext, "transmissionTexture", &material->transmission_map);
    ext = gltf_extension(json, "KHR_materials_clearcoat");
    material->clearcoat = (float)gltf_number(ext, "clearcoatFactor", 0.0);
    material->clearcoat_roughness = (float)gltf_number(ext, "clearcoatRoughnessFactor", 0.0);
    ext = gltf_extension(json, "KHR_materials_sheen");
    gltf_floats(ext, "sheenColorFactor", material->sheen_colour, 3);
    material->sheen_roughness = (float)gltf_number(ext, "sheenRoughnessFactor", 0.0);
    material->unlit = gltf_extension(json, "KHR_materials_unlit") != NULL;
    static const struct {
        const char *name, *word;
    } others[] = {{"KHR_materials_volume", "a volume"},
                  {"KHR_materials_iridescence", "iridescence"},
                  {"KHR_materials_anisotropy", "anisotropy"},
                  {"KHR_materials_dispersion", "dispersion"},
                  {"KHR_materials_diffuse_transmission", "diffuse transmission"}};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++)
        if (gltf_extension(json, others[i].name) != NULL) cs_material_ask(material, others[i].word);
}

static clshear_status read_surface(gltf_reader *reader, const json_t *json,
                                   cs_material_description *material)
{
    const json_t *pbr = json_object_get(json, "pbrMetallicRoughness");
    const json_t *old = gltf_extension(json, "KHR_materials_pbrSpecularGlossiness");
    for (int c = 0; c < 3; c++)
        material->base_colour[c] = 1.0f;
    if (old != NULL) {
        gltf_floats(old, "diffuseFactor", material->base_colour, 4);
        cs_material_ask(material, "specular-glossiness");
        return read_map(reader, old, "diffuseTexture", &material->base_map);
    }
    gltf_floats(pbr, "baseColorFactor", material->base_colour, 4);
    material->metallic = (float)gltf_number(pbr, "metallicFactor", 1.0);
    material->roughness = (float)gltf_number(pbr, "roughnessFactor", 1.0);
    material->asks_gloss = json_object_get(pbr, "metallicFactor") != NULL ||
                           json_object_get(pbr, "roughnessFactor") != NULL;
    note_map(pbr, "metallicRoughnessTexture", &material->metallic_map);
    note_map(pbr, "metallicRoughnessTexture", &material->roughness_map);
    return read_map(reader, pbr, "baseColorTexture", &material->base_map);
}

static clshear_status read_material(gltf_reader *reader, long long index)
{
    char name[32];
    const json_t *json = gltf_at(reader, "materials", index);
    if (json == NULL) return CLSHEAR_BAD_FILE;
    cs_material_description *material = cs_model_extend(&reader->model->materials, 1);
    if (material == NULL) return cs_model_full(reader->model, reader->error);
    snprintf(name, sizeof name, "material %lld", index);
    cs_material_init(material, gltf_text(json, "name", name));
    gltf_floats(json, "emissiveFactor", material->emissive, 3);
    note_map(json, "emissiveTexture", &material->emissive_map);
    note_map(json, "normalTexture", &material->normal_map);
    note_map(json, "occlusionTexture", &material->occlusion_map);
    read_alpha(json, material);
    read_extensions(json, material);
    return read_surface(reader, json, material);
}

clshear_status gltf_materials(gltf_reader *reader)
{
    clshear_status status = CLSHEAR_OK;
    const size_t count = gltf_count(reader, "materials");
    for (size_t i = 0; i < count && status == CLSHEAR_OK; i++)
        status = read_material(reader, (long long)i);
    return status;
}
