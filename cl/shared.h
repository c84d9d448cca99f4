/* Every struct and constant that crosses between host and device. Shared.
 *
 * Structs hold 4-byte scalars and arrays of them only, so that both compilers agree on the layout;
 * CS_SHARED_WORDS proves it. Arrays of them are padded to 4 words. */
#ifndef CS_SHARED_H
#define CS_SHARED_H

#include "dialect.h"

enum {
    CS_BOX = 8,          /* samples that are neighbours in the first pair: half of */
    CS_BLOCK = 16,       /* samples whose order within a pattern is kept together */
    CS_FLUSH_BLOCKS = 4, /* blocks between two updates of a pixel's state */
    CS_STACK = 64,       /* traversal stack, so the deepest hierarchy a device can walk */
    CS_MAX_PATTERN =
        1 << 20,        /* samples in one pattern: strata must stay wider than a float's ulp */
    CS_MAX_LEAF = 4,    /* triangles in a leaf */
    CS_LEAF = 1 << 30,  /* set in a child reference that names triangles; low bits: first */
    CS_LEAF_SHIFT = 27, /* bits 27..29 of a leaf reference: number of triangles, less one */
    CS_NO_TEXTURE = -1,
    CS_NO_HIT = -1
};

/* How (pixel, lens) tuples are slid along the fibres of the integrand. */
enum {
    CS_SHEAR_NONE = 0,
    CS_SHEAR_TOROIDAL = 1,
    CS_SHEAR_EQUAL_AREA = 2
};

enum {
    CS_APERTURE_DISK = 0,
    CS_APERTURE_SQUARE = 1,
    CS_APERTURE_POLYGON = 2, /* convex: tabulated by its chords */
    CS_APERTURE_IMAGE = 3    /* texels of different brightness */
};

/* The table that belongs to a cs_optics: the filter's steps, then rows of floats, each of them a
 * segment of a profile (cl/profile.h). */
enum {
    CS_FILTER_STEPS = 16,
    CS_PROFILE_COLUMNS = 8
};

enum {
    CS_LIGHT_POINT = 0,      /* vector = position, colour = intensity */
    CS_LIGHT_DIRECTIONAL = 1 /* vector = unit direction towards the light, colour = irradiance */
};

/* A node of the binary hierarchy: the boxes of both children, so that one fetch decides both. */
typedef struct cs_node {
    f32 bounds[2][3][2]; /* child, axis, low and high */
    u32 child[2];        /* index of a node, or CS_LEAF | (count - 1) << CS_LEAF_SHIFT | first */
    u32 axis;            /* child 0 lies on the low side of this axis */
    u32 padding;
} cs_node;
CS_SHARED_WORDS(cs_node, 16);

/* A triangle: corner, two edges, their cross product, and what flat shading needs besides. */
typedef struct cs_triangle {
    f32 corner[3];
    u32 face; /* index into the array of cs_face */
    f32 edge1[3];
    u32 material;
    f32 edge2[3];
    u32 flags;     /* CS_FACE_ bits */
    f32 normal[3]; /* cross(edge1, edge2), not normalised */
    u32 padding;
} cs_triangle;
CS_SHARED_WORDS(cs_triangle, 16);

enum {
    CS_FACE_SMOOTH = 1,  /* its vertices have normals */
    CS_FACE_TEXTURED = 2 /* its material has a texture */
};

/* The vertices of a smooth or textured triangle. */
typedef struct cs_face {
    u32 vertex[3];
} cs_face;
CS_SHARED_WORDS(cs_face, 3);

/* Shading data of a vertex. */
typedef struct cs_vertex {
    f32 normal[3];
    f32 texture[2];
} cs_vertex;
CS_SHARED_WORDS(cs_vertex, 5);

typedef struct cs_material {
    f32 diffuse[3];  /* albedo, linear Rec.709; multiplies the texture if there is one */
    i32 texture;     /* index, or CS_NO_TEXTURE */
    f32 emission[3]; /* radiance, both sides */
    u32 padding;
} cs_material;
CS_SHARED_WORDS(cs_material, 8);

typedef struct cs_texture {
    u32 first; /* index of its top left texel; texels are 4 halves, linear Rec.709 */
    u32 width;
    u32 height;
    u32 padding;
} cs_texture;
CS_SHARED_WORDS(cs_texture, 4);

typedef struct cs_light {
    f32 vector[3];
    u32 kind;
    f32 colour[3];
    u32 padding;
} cs_light;
CS_SHARED_WORDS(cs_light, 8);

/* An emissive triangle in the table from which area-light samples are drawn. */
typedef struct cs_emitter {
    f32 corner[3];
    f32 cumulative; /* probability of this emitter and all before it */
    f32 edge1[3];
    f32 probability;
    f32 edge2[3];
    f32 area;
    f32 radiance[3];
    f32 padding;
} cs_emitter;
CS_SHARED_WORDS(cs_emitter, 16);

/* Shape of the aperture and the pixel filter. Lens coordinates (u, v) are centred; one unit of them
 * is cs_camera.aperture_width. */
typedef struct cs_optics {
    u32 aperture;         /* CS_APERTURE_ */
    u32 closed;           /* box filter one pixel wide, square or disk: maps in closed form */
    f32 squeeze;          /* width of the aperture as a part of what its shape says */
    u32 filter_steps;     /* the filter is constant on each of these parts of its width */
    f32 filter_width;     /* px */
    f32 filter_deviation; /* standard deviation, px */
    u32 segments[2];      /* of the profiles of u and of v given u, where they are tabulated */
    f32 reach[2];         /* largest |u| and |v| */
    f32 deviation[2];     /* standard deviations of u and v */
} cs_optics;
CS_SHARED_WORDS(cs_optics, 12);

/* Pinhole frame and thin lens. World units; unit vectors. */
typedef struct cs_camera {
    f32 eye[3];
    f32 right[3];
    f32 down[3];
    f32 forward[3];
    f32 focal_distance;
    f32 pixel_width;    /* of one pixel on the focal plane */
    f32 aperture_width; /* side of a square or image aperture; of the square as large as others */
    f32 centre_px[2];   /* raster coordinates of the optical axis */
    cs_optics optics;
} cs_camera;
CS_SHARED_WORDS(cs_camera, 29);

/* What one pixel has gathered. Channels are linear Rec.709 radiance. */
typedef struct cs_pixel {
    f32 sum[3]; /* of the unfinished pattern, with what rounding lost in `carry` */
    f32 carry[3];
    f32 pattern_sum[3]; /* of the means of finished patterns, likewise */
    f32 pattern_carry[3];
    f32 pattern_m2[3];  /* squared deviations of the pattern means */
    f32 sample_mean[3]; /* of all samples */
    f32 sample_m2[3];
    u32 samples; /* of all patterns */
    u32 pending; /* of the unfinished pattern */
    u32 patterns;
    u32 shadow_rays;
} cs_pixel;
CS_SHARED_WORDS(cs_pixel, 25);

#endif
