/* Materials, textures and images of glTF. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "base/vec.h"
#include "import/find_file.h"
#include "import/gltf_reader.h"

/* ----- Images ----- */

static clshear_status add_file(gltf_reader *reader, const char *uri, int *image)
{
    char found[CS_FILE_PATH];
    const int there = gltf_find_file(reader, uri, found);
    return cs_model_add_image(reader->model, there ? found : "", there ? found : uri, NULL, 0,
                              image, reader->error);
}

/* An image that is nowhere. */
static clshear_status add_nothing(gltf_reader *reader, long long index, int *image)
{
    char label[32];
    snprintf(label, sizeof label, "image %lld", index);
    return cs_model_add_image(reader->model, "", label, NULL, 0, image, reader->error);
}

/* The embedded image of this label in the model, or CS_NO_IMAGE. */
static int known_image(const cs_model *model, const char *label)
{
    const cs_image_source *images = model->images.items;
    for (size_t i = 0; i < model->images.count; i++)
        if (images[i].bytes != NULL && strcmp(images[i].label, label) == 0) return (int)i;
    return CS_NO_IMAGE;
}

/* An image of the file as one of the model: the same one for all textures that ask for it. */
static clshear_status add_image(gltf_reader *reader, long long index, int *image)
{
    const json_t *json = gltf_at(reader, "images", index);
    if (json == NULL) return CLSHEAR_BAD_FILE;
    const char *uri = gltf_text(json, "uri", NULL);
    char label[80], *owned = NULL;
    const unsigned char *data = NULL;
    size_t size = 0, stride = 0;
    clshear_status status;
    const long long view = gltf_index(json, "bufferView");
    if (view == -1 && (uri == NULL || *uri == '\0')) return add_nothing(reader, index, image);
    if (uri != NULL && *uri == '\0') uri = NULL;
    if (uri != NULL && !gltf_is_data(uri)) return add_file(reader, uri, image);
    snprintf(label, sizeof label, "embedded image %lld", index);
    *image = known_image(reader->model, label);
    if (*image != CS_NO_IMAGE) return CLSHEAR_OK;
    if (uri != NULL) {
        status = gltf_uri(reader, "images", index, uri, &owned, &size);
        data = (const unsigned char *)owned;
    } else {
        status = gltf_view(reader, view, &data, &size, &stride);
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
    const cs_texel_use use = map->use;
    cs_map_init(map);
    map->use = use;
    map->use.is_srgb = 1; /* glTF 2.0, on images: what a PNG says of its colours is ignored */
    map->set = set > 0 && set < 64 ? (int)set : 0;
    set_transform(info, map);
    const long long number = gltf_index(texture, "sampler");
    if (number >= 0) {
        const json_t *sampler = gltf_at(reader, "samplers", number);
        if (sampler == NULL) return CLSHEAR_BAD_FILE;
        map->wrap[0] = wrap_of(sampler, "wrapS");
        map->wrap[1] = wrap_of(sampler, "wrapT");
        map->is_nearest = gltf_index(sampler, "magFilter") == 9728;
    }
    const long long source = source_of(texture);
    if (source >= 0) return add_image(reader, source, &map->image);
    map->missing = 1;
    const int is_basisu = gltf_extension(texture, "KHR_texture_basisu") != NULL;
    gltf_note(reader, is_basisu ? GLTF_BASISU : GLTF_WITHOUT_IMAGE, "textures", index);
    return CLSHEAR_OK;
}

/* ----- Materials ----- */

/* Notes a map that the device has no place for, unless the factor that multiplies it is 0. */
static void ask_map(const json_t *parent, const char *key, const char *word, float factor,
                    cs_material_description *material)
{
    if (json_is_object(json_object_get(parent, key)) && factor != 0.0f)
        cs_material_ask(material, word);
}

static void read_alpha(const json_t *json, cs_material_description *material)
{
    const char *mode = gltf_text(json, "alphaMode", "OPAQUE");
    if (strcasecmp(mode, "MASK") == 0)
        material->alpha_mode = CS_ALPHA_MASK;
    else if (strcasecmp(mode, "BLEND") == 0)
        material->alpha_mode = CS_ALPHA_BLEND;
    else if (strcasecmp(mode, "OPAQUE") != 0)
        cs_material_ask(material, "an alphaMode that glTF does not have (taken as OPAQUE)");
    material->alpha_cutoff = (float)gltf_number(json, "alphaCutoff", 0.5);
}

/* The dielectric's reflection, by KHR_materials_ior and KHR_materials_specular: f0 is that of the
 * index times the colour, and both that and f90 are multiplied by the factor. */
static void read_reflection(const json_t *json, cs_material_description *material)
{
    const json_t *ext = gltf_extension(json, "KHR_materials_specular");
    const double ior = gltf_number(gltf_extension(json, "KHR_materials_ior"), "ior", 1.5);
    const double edge = (ior - 1.0) / (ior + 1.0);
    material->ior = (float)ior;
    double colour[3] = {1, 1, 1};
    gltf_numbers(ext, "specularColorFactor", colour, 3);
    const double grey = cs_luminance_double(colour[0], colour[1], colour[2]);
    const double factor = gltf_number(ext, "specularFactor", 1.0);
    material->reflectance = (float)(fmin(edge * edge * grey, 1.0) * factor);
    material->grazing = (float)factor;
    if (factor != 0.0 && (colour[0] != colour[1] || colour[1] != colour[2]))
        cs_material_ask(material, "a coloured reflection (taken as grey)");
    ask_map(ext, "specularTexture", "a map of the reflection", material->grazing, material);
    ask_map(ext, "specularColorTexture", "a map of the reflection", material->grazing, material);
}

/* Layers above and transparency below. */
static void read_layers(const json_t *json, cs_material_description *material)
{
    const json_t *ext = gltf_extension(json, "KHR_materials_transmission");
    material->transmission = (float)gltf_number(ext, "transmissionFactor", 0.0);
    ask_map(ext, "transmissionTexture", "a map of transmission", material->transmission, material);
    ext = gltf_extension(json, "KHR_materials_volume");
    material->thickness = (float)gltf_number(ext, "thicknessFactor", 0.0);
    gltf_floats(ext, "attenuationColor", material->attenuation_colour, 3);
    material->attenuation_distance = (float)gltf_number(ext, "attenuationDistance", 0.0);
    ext = gltf_extension(json, "KHR_materials_clearcoat");
    material->clearcoat = (float)gltf_number(ext, "clearcoatFactor", 0.0);
    material->clearcoat_roughness = (float)gltf_number(ext, "clearcoatRoughnessFactor", 0.0);
    const float coat = material->clearcoat;
    ask_map(ext, "clearcoatTexture", "a map of the clear coat", coat, material);
    ask_map(ext, "clearcoatRoughnessTexture", "a map of the clear coat", coat, material);
    ask_map(ext, "clearcoatNormalTexture", "a normal map of the clear coat", coat, material);
    ext = gltf_extension(json, "KHR_materials_sheen");
    gltf_floats(ext, "sheenColorFactor", material->sheen_colour, 3);
    material->sheen_roughness = (float)gltf_number(ext, "sheenRoughnessFactor", 0.0);
    const float *colour = material->sheen_colour;
    const float sheen = fmaxf(fmaxf(colour[0], colour[1]), colour[2]);
    ask_map(ext, "sheenColorTexture", "a map of sheen", sheen, material);
    ask_map(ext, "sheenRoughnessTexture", "a map of sheen", sheen, material);
}

int gltf_reads_of_material(const char *extension)
{
    static const char *const known[] = {"KHR_materials_emissive_strength",
                                        "KHR_materials_ior",
                                        "KHR_materials_specular",
                                        "KHR_materials_transmission",
                                        "KHR_materials_volume",
                                        "KHR_materials_clearcoat",
                                        "KHR_materials_sheen",
                                        "KHR_materials_unlit",
                                        "KHR_materials_pbrSpecularGlossiness"};
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcmp(known[i], extension) == 0) return 1;
    return 0;
}

/* Whether an extension of a material changes nothing, since its factor is 0, as by default. */
static int is_idle(const char *extension, const json_t *value)
{
    static const char *const factors[][2] = {
        {"KHR_materials_anisotropy", "anisotropyStrength"},
        {"KHR_materials_diffuse_transmission", "diffuseTransmissionFactor"},
        {"KHR_materials_dispersion", "dispersion"},
        {"KHR_materials_iridescence", "iridescenceFactor"}};
    for (size_t i = 0; i < sizeof factors / sizeof *factors; i++)
        if (strcmp(factors[i][0], extension) == 0)
            return gltf_number(value, factors[i][1], 0.0) == 0.0;
    return 0;
}

/* Asks for the extensions that are not read, by name. */
static void read_others(const json_t *json, cs_material_description *material)
{
    const char *name;
    json_t *value;
    json_object_foreach(json_object_get(json, "extensions"), name, value)
    {
        if (!gltf_reads_of_material(name) && strlen(name) < 60 && !is_idle(name, value))
            cs_material_ask(material, name);
    }
}

static clshear_status read_emission(gltf_reader *reader, const json_t *json,
                                    cs_material_description *material)
{
    const json_t *ext = gltf_extension(json, "KHR_materials_emissive_strength");
    gltf_floats(json, "emissiveFactor", material->emissive, 3);
    material->emissive_strength = (float)gltf_number(ext, "emissiveStrength", 1.0);
    material->unlit = gltf_extension(json, "KHR_materials_unlit") != NULL;
    return read_map(reader, json, "emissiveTexture", &material->emissive_map);
}

static clshear_status read_normals(gltf_reader *reader, const json_t *json,
                                   cs_material_description *material)
{
    const json_t *info = json_object_get(json, "normalTexture");
    material->normal_scale = (float)gltf_number(info, "scale", 1.0);
    return read_map(reader, json, "normalTexture", &material->normal_map);
}

/* KHR_materials_pbrSpecularGlossiness (`ext`) of the material `json`. Its specular colour may be a
 * metal's. */
static clshear_status read_glossiness(gltf_reader *reader, const json_t *json, const json_t *ext,
                                      cs_material_description *material)
{
    float colour[3] = {1, 1, 1};
    gltf_floats(ext, "diffuseFactor", material->base_colour, 4);
    gltf_floats(ext, "specularFactor", colour, 3);
    material->roughness = (float)(1.0 - gltf_number(ext, "glossinessFactor", 1.0));
    if (json_is_object(json_object_get(ext, "specularGlossinessTexture"))) {
        cs_material_ask(material, "a map of specular colour and gloss");
        material->roughness = 1.0f;
        colour[0] = colour[1] = colour[2] = 0.04f;
    }
    clshear_status status = read_map(reader, ext, "diffuseTexture", &material->base_map);
    cs_material_reflect(material, colour);
    read_layers(json, material);
    return status;
}

/* Where nothing is said of metal, gloss or layers, the surface is Lambert's, which the default, a
 * metal of roughness 1, nearly looks like. */
static int asks_for_more(const json_t *json)
{
    static const char *const keys[] = {"metallicFactor", "roughnessFactor",
                                       "metallicRoughnessTexture"};
    static const char *const extensions[] = {"KHR_materials_ior", "KHR_materials_specular",
                                             "KHR_materials_transmission",
                                             "KHR_materials_clearcoat", "KHR_materials_sheen"};
    const json_t *pbr = json_object_get(json, "pbrMetallicRoughness");
    int more = 0;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        more |= json_object_get(pbr, keys[i]) != NULL;
    for (size_t i = 0; i < sizeof extensions / sizeof *extensions; i++)
        more |= gltf_extension(json, extensions[i]) != NULL;
    return more;
}

static clshear_status read_surface(gltf_reader *reader, const json_t *json,
                                   cs_material_description *material)
{
    const json_t *pbr = json_object_get(json, "pbrMetallicRoughness");
    const json_t *old = gltf_extension(json, "KHR_materials_pbrSpecularGlossiness");
    clshear_status status = CLSHEAR_OK;
    for (int c = 0; c < 3; c++)
        material->base_colour[c] = 1.0f;
    if (old != NULL) return read_glossiness(reader, json, old, material);
    gltf_floats(pbr, "baseColorFactor", material->base_colour, 4);
    CS_TRY(read_map(reader, pbr, "baseColorTexture", &material->base_map));
    if (!asks_for_more(json) || material->unlit) return status;
    material->metallic = (float)gltf_number(pbr, "metallicFactor", 1.0);
    material->roughness = (float)gltf_number(pbr, "roughnessFactor", 1.0);
    CS_TRY(read_map(reader, pbr, "metallicRoughnessTexture", &material->metallic_map));
    material->roughness_map = material->metallic_map;
    read_reflection(json, material);
    read_layers(json, material);
done:
    return status;
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
    read_alpha(json, material);
    read_others(json, material);
    clshear_status status = read_emission(reader, json, material);
    if (status == CLSHEAR_OK) status = read_normals(reader, json, material);
    if (status == CLSHEAR_OK) status = read_surface(reader, json, material);
    return status;
}

clshear_status gltf_materials(gltf_reader *reader)
{
    clshear_status status = CLSHEAR_OK;
    const size_t count = gltf_count(reader, "materials");
    for (size_t i = 0; i < count && status == CLSHEAR_OK; i++)
        status = read_material(reader, (long long)i);
    return status;
}
