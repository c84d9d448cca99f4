/* What every BSDF answers for a packet of surface points. Shared. */
#ifndef CS_BSDF_VALUE_H
#define CS_BSDF_VALUE_H

#include "clshear/device/sampler/grid.h"
#include "kernels/bsdf/list.h"
#include "kernels/surface.h"

#if CS_HAS(MATERIALS)

enum {
    CS_ALBEDO_ALL = 0,     /* of facets that are perfect mirrors, met once */
    CS_ALBEDO_SCHLICK = 1, /* with cs_schlick as reflectance */
    CS_ALBEDO_PLANES = 2
};

typedef struct cs_albedo {
    cs_vfloat plane[CS_ALBEDO_PLANES];
} cs_albedo;

/* What of the standard surface (standard.h) does not depend on `in`. */
typedef struct cs_standard {
    cs_vfloat out[3]; /* unit */
    cs_vfloat cosine; /* of it */
    cs_vfloat width;
    cs_vfloat metal; /* part; the rest is dielectric */
    cs_vfloat f0;    /* of the dielectric, and at grazing angles */
    cs_vfloat f90;
    cs_vfloat repeated;   /* of the dielectric, see cs_repeated_part */
    cs_vfloat repeats[3]; /* of the metal, times its part */
    cs_vfloat base[3];    /* colour of what is below the dielectric, times its part */
    cs_vfloat through;    /* part of the base that is transparent */
    cs_albedo albedo;     /* seen from `out` */
    cs_albedo average;
    cs_vfloat below;  /* part that coat and sheen leave */
    cs_vfloat fibres; /* what the sheen is scaled by: at grazing angles it would give too much */
    cs_vfloat coat;
    cs_vfloat coat_width;
    cs_vfloat coat_albedo;
    cs_vfloat chance_facets; /* of drawing by each lobe; the rest is diffuse on this side */
    cs_vfloat chance_coat;
    cs_vfloat chance_through; /* mirrored facets */
    cs_vfloat chance_behind;  /* diffuse on the other side */
    int has_coat;             /* whether any lane has a coat, sheen */
    int has_sheen;
} cs_standard;

#endif

/* Surfaces as seen from one direction in each lane: what all values for it have in common. */
typedef struct cs_bsdf_view {
    const cs_surface *surface;
    const cs_vfloat *out; /* to the viewer */
#if CS_HAS(MATERIALS)
    int has_standard;     /* whether any lane is a standard surface or partly glass */
    cs_standard standard; /* of all lanes, if so */
#endif
} cs_bsdf_view;

/* The BSDF's value of channel c is scale * colour[c]. The factors are apart because the order of
 * multiplications fixes the last bit of a picture. */
typedef struct cs_bsdf_value {
    cs_vfloat scale; /* per steradian */
    cs_vfloat colour[3];
    cs_vfloat density; /* per steradian, with which the BSDF's samples are in this direction */
} cs_bsdf_value;

/* A direction that was drawn from a density. */
typedef struct cs_bsdf_direction {
    cs_vfloat in[3];     /* unit vector, from the surface to where light comes from */
    cs_bsdf_value value; /* its density is 0 where nothing was drawn */
} cs_bsdf_direction;

#endif
