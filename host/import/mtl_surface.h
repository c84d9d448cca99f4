/* From the numbers of MTL to a surface. */
#ifndef CS_IMPORT_MTL_SURFACE_H
#define CS_IMPORT_MTL_SURFACE_H

#include "scene/material.h"

/* What the lines of a material say that has another sense in glTF's vocabulary. Negative: the file
 * does not say. */
typedef struct mtl_values {
    float highlight[3]; /* Ks: colour of highlights and mirrors */
    float exponent;     /* Ns: of the highlight */
    float ior;          /* Ni */
    float opacity;      /* d */
    float transparency; /* Tr: 1 - opacity */
    float filter[3];    /* Tf: colour of what passes through */
    float roughness;    /* Pr */
    float metallic;     /* Pm */
    float ambient[3];   /* Ka */
    float blender_most; /* Blender wrote the file, and this as Ns of roughness 0; else 0 */
    int model;          /* illum */
    int has_colour;     /* whether there is a Kd */
} mtl_values;

void mtl_values_init(mtl_values *values);

/* Completes a material whose lines are all read. Returns 1 where its Tr of 1, which would hide it,
 * is taken for opaque, as programs write it that mean what `d` does: nobody wants a material that
 * cannot be seen. */
int mtl_make_surface(const mtl_values *written, cs_material_description *material);

#endif
