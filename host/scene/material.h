/* What a file says of a material, in the vocabulary of glTF's metallic-roughness model and of MTL,
 * whether or not a renderer can follow it. Importers fill it in; cs_material_make turns it into
 * what the device knows. */
#ifndef CS_SCENE_MATERIAL_H
#define CS_SCENE_MATERIAL_H

#include "scene/scene.h"

enum {
    CS_NO_IMAGE = -1,
    CS_MATERIAL_NAME = 128
};

/* How texture coordinates outside the image are taken. */
typedef enum cs_wrap {
    CS_WRAP_REPEAT = CS_TEXTURE_REPEAT,
    CS_WRAP_CLAMP = CS_TEXTURE_CLAMP,
    CS_WRAP_MIRROR = CS_TEXTURE_MIRROR
} cs_wrap;

/* A use of an image. cs_map_init gives the defaults. */
typedef struct cs_map {
    int image;        /* index into the importer's images, or CS_NO_IMAGE */
    int missing;      /* 1: the file names an image that is not there */
    cs_wrap wrap[2];  /* across, up */
    int set;          /* of texture coordinates */
    double across[3]; /* coordinate s of the image = across . (s, t, 1) of the vertex */
    double up[3];     /* coordinate t of the image, which grows upwards */
    float base;       /* texel = base + gain * texel of the file */
    float gain;
} cs_map;

typedef enum cs_alpha_mode {
    CS_ALPHA_OPAQUE,
    CS_ALPHA_MASK,
    CS_ALPHA_BLEND
} cs_alpha_mode;

/* cs_material_init gives the defaults, which ask for nothing but grey. */
typedef struct cs_material_description {
    char name[CS_MATERIAL_NAME];
    float base_colour[4]; /* linear, with opacity */
    cs_map base_map;
    float metallic;
    float roughness;
    cs_map metallic_map, roughness_map; /* glTF: the same image */
    float emissive[3];                  /* radiance */
    float emissive_strength;
    cs_map emissive_map;
    cs_map normal_map, bump_map, occlusion_map, displacement_map;
    float normal_scale;
    cs_alpha_mode alpha_mode;
    float alpha_cutoff;
    cs_map alpha_map;
    float ior;
    float transmission;
    cs_map transmission_map;
    float clearcoat, clearcoat_roughness;
    float sheen_colour[3], sheen_roughness;
    float specular[3]; /* MTL's Ks */
    float shininess;   /* MTL's Ns */
    cs_map specular_map;
    int unlit;
    int double_sided;
    int asks_gloss;  /* the file gives metallic, roughness or a gloss that counts */
    char other[128]; /* further things asked for, by name, separated by ", " */
} cs_material_description;

void cs_map_init(cs_map *map);
void cs_material_init(cs_material_description *description, const char *name);

/* Notes something that the material asks for and that has no member here; each name once. */
void cs_material_ask(cs_material_description *description, const char *name);

/* Makes a black colour that multiplies a map white: what exporters of MTL and others leave there.
 */
void cs_material_whiten(cs_material_description *description);

/* What the material asks for and the device lacks, as words separated by ", "; "" if nothing. */
void cs_material_unsupported(const cs_material_description *description, char *text, size_t size);

/* The device's material. `texture`: the base map's place on the device, or CS_NO_TEXTURE. */
cs_material cs_material_make(const cs_material_description *description, cs_i32 texture);

#endif
