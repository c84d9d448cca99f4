/* What a file says of a material, in the vocabulary of glTF's metallic-roughness model. Importers
 * fill it in; cs_material_make turns it into what the device knows. */
#ifndef CS_SCENE_MATERIAL_H
#define CS_SCENE_MATERIAL_H

#include "image/texel_kinds.h"
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
    int is_nearest;   /* 1: texels do not blend: each shows its edges */
    int set;          /* of texture coordinates */
    double across[3]; /* coordinate s of the image = across . (s, t, 1) of the vertex */
    double up[3];     /* coordinate t of the image, which grows upwards */
    cs_texel_use use;
} cs_map;

typedef enum cs_alpha_mode {
    CS_ALPHA_OPAQUE,
    CS_ALPHA_MASK,
    CS_ALPHA_BLEND
} cs_alpha_mode;

/* cs_material_init gives the defaults, which ask for nothing but Lambert's grey. Maps multiply the
 * number of the same name. */
typedef struct cs_material_description {
    char name[CS_MATERIAL_NAME];
    float base_colour[4]; /* linear, with opacity */
    cs_map base_map;      /* its alpha is opacity, unless there is an alpha_map */
    float metallic;       /* 0 to 1 */
    float roughness;      /* 0 to 1; its square is the width of the facets */
    cs_map metallic_map;  /* in blue */
    cs_map roughness_map; /* in green */
    float reflectance;    /* of the dielectric, met head-on; 0 to 1 */
    float grazing;        /* the same at grazing angles; both 0: Lambert's surface */
    float emissive[3];    /* radiance */
    float emissive_strength;
    cs_map emissive_map;
    cs_map normal_map;
    float normal_scale;
    cs_alpha_mode alpha_mode;
    float alpha_cutoff;
    cs_map alpha_map;
    int fades;          /* 1: some vertices have an alpha below 1 */
    float transmission; /* part of the base that is transparent; 0 to 1 */
    float thickness;    /* of the solid, world units; 0: a thin wall */
    float ior;          /* of the solid; 1 to 10 */
    float attenuation_colour[3], attenuation_distance; /* as in clshear_material */
    float clearcoat, clearcoat_roughness;
    float sheen_colour[3], sheen_roughness;
    int unlit;
    char other[256]; /* further things asked for, by name, separated by ", " */
} cs_material_description;

void cs_map_init(cs_map *map);
void cs_material_init(cs_material_description *description, const char *name);

/* Whether there is an image, or would be. */
int cs_map_is_used(const cs_map *map);

/* Notes something that the material asks for and that has no member here; each name once. */
void cs_material_ask(cs_material_description *description, const char *name);

/* Makes a black colour that multiplies a map white: what exporters of MTL and others leave there.
 */
void cs_material_whiten(cs_material_description *description);

/* Makes the surface mirror a colour: a metal where its base is black, otherwise a dielectric, whose
 * reflection is grey. */
void cs_material_reflect(cs_material_description *description, const float *colour);

/* The map whose texture coordinates the vertices have: all maps share them. NULL: there is none. */
const cs_map *cs_material_placing(const cs_material_description *description);

/* What the material asks for and the device lacks, as words separated by ", "; "" if nothing. */
void cs_material_unsupported(const cs_material_description *description, char *text, size_t size);

/* Places of a material's maps on the device, or CS_NO_TEXTURE. */
typedef struct cs_material_textures {
    cs_i32 base; /* colour and alpha */
    cs_i32 facets;
    cs_i32 normal;
    cs_i32 emission;
    int covers; /* 1: the base map's alpha is 1 everywhere */
} cs_material_textures;

/* The device's material. Numbers out of their range are moved to its end. */
cs_material cs_material_make(const cs_material_description *description,
                             const cs_material_textures *textures);

#endif
