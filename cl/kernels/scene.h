/* The structs and constants of a scene's buffers on the device. Shared.
 *
 * Structs hold 4-byte scalars and arrays of them only, so that both compilers agree on the layout;
 * CS_SHARED_WORDS proves it. Arrays of them are padded to 4 words. */
#ifndef CS_KERNELS_SCENE_H
#define CS_KERNELS_SCENE_H

#include "clshear/device/dialect.h"

enum {
    CS_STACK = 64,     /* entries of the traversal stack: the deepest hierarchy a device can walk */
    CS_MAX_LEAF = 4,   /* triangles in a leaf */
    CS_LEAF = 1 << 30, /* set in a child reference that names triangles; low bits: first */
    CS_LEAF_SHIFT = 27,  /* bits 27 to 29 of a leaf reference: number of triangles, less one */
    CS_WIDE = 16,        /* children of a node of the wide hierarchy, at most */
    CS_WIDE_LEAF = 4,    /* triangles in a leaf there */
    CS_WIDE_STACK = 192, /* entries of the stack of a walk there */
    CS_NO_TEXTURE = -1,
    CS_NO_HIT = -1,
    CS_MATERIAL_PARAMETERS = 16 /* numbers of a material that its BSDF alone knows */
};

/* Lanes of the narrowest packets whose rays may walk the wide hierarchy. */
#define CS_WIDE_LEAST_PACKET 8

/* The buffers of a scene, in the order of kernels' arguments: X(identifier, name, type of the
 * elements). Structs, kernel parameters and the host's arrays are made from it. */
#define CS_SCENE_BUFFER_LIST(X)                         \
    X(NODES, nodes, cs_node)                            \
    X(TRIANGLES, triangles, cs_triangle)                \
    X(FACES, faces, cs_face)                            \
    X(VERTICES, vertices, cs_vertex)                    \
    X(COLOURS, colours, cs_colour)                      \
    X(TANGENTS, tangents, cs_tangent)                   \
    X(MATERIALS, materials, cs_material)                \
    X(TEXTURES, textures, cs_texture)                   \
    X(TEXELS, texels, half)                             \
    X(LIGHTS, lights, cs_light)                         \
    X(EMITTERS, emitters, cs_emitter)                   \
    X(EMITTER_NODES, emitter_nodes, cs_emitter_node)    \
    X(ENVIRONMENT, environment, cs_f32)                 \
    X(ALBEDOS, albedos, cs_f32)                         \
    X(NODE_STEPS, node_steps, cs_node_step)             \
    X(TRIANGLE_STEPS, triangle_steps, cs_triangle_step) \
    X(NORMAL_STEPS, normal_steps, cs_normal_step)       \
    X(EMITTER_STEPS, emitter_steps, cs_triangle_step)   \
    X(WIDE_NODES, wide_nodes, cs_wide_node)             \
    X(WIDE_LEAVES, wide_leaves, cs_wide_leaf)

#define CS_SCENE_IDENTIFIER(identifier, name, type) CS_SCENE_##identifier,

typedef enum cs_scene_buffer {
    CS_SCENE_BUFFER_LIST(CS_SCENE_IDENTIFIER) CS_SCENE_BUFFERS
} cs_scene_buffer;

/* A node of the binary hierarchy: the boxes of both children, so that one fetch decides both. */
typedef struct cs_node {
    cs_f32 bounds[2][3][2]; /* child, axis, low and high */
    cs_u32 child[2];        /* index of a node, or CS_LEAF | (count - 1) << CS_LEAF_SHIFT | first */
    cs_u32 axis;            /* child 0 lies on the low side of this axis */
    cs_u32 padding;
} cs_node;
CS_SHARED_WORDS(cs_node, 16);

/* A node of the wide hierarchy, for single rays: boxes of all children in bytes, relative to the
 * box around them. Four cache lines. */
typedef struct cs_wide_node {
    cs_u32 child[CS_WIDE]; /* index of a node, or CS_LEAF | index of a leaf; 0: there is none */
    cs_u32 planes[3][2][CS_WIDE / 4]; /* axis, low and high, a byte for each child */
    cs_u32 order[8][2]; /* for each octant of directions, children from far to near: 4 bits each,
                         * even places in the first word */
    cs_f32 low[4];      /* where byte 0 is; three and padding */
    cs_f32 step[4];     /* from one byte to the next; likewise */
} cs_wide_node;
CS_SHARED_WORDS(cs_wide_node, 64);

/* A leaf of the wide hierarchy: consecutive triangles, their numbers beside each other. */
typedef struct cs_wide_leaf {
    cs_f32 corner[3][CS_WIDE_LEAF];
    cs_f32 edge1[3][CS_WIDE_LEAF];
    cs_f32 edge2[3][CS_WIDE_LEAF];
    cs_u32 first; /* index of the first triangle in the array of cs_triangle. A leaf of fewer than
                   * CS_WIDE_LEAF triangles repeats its last one */
    cs_u32 padding[3];
} cs_wide_leaf;
CS_SHARED_WORDS(cs_wide_leaf, 40);

/* A triangle: corner, two edges, their cross product, and what flat shading needs besides. */
typedef struct cs_triangle {
    cs_f32 corner[3];
    cs_u32 face; /* index into the array of cs_face */
    cs_f32 edge1[3];
    cs_u32 material;
    cs_f32 edge2[3];
    cs_u32 flags;     /* CS_FACE_ bits */
    cs_f32 normal[3]; /* cross(edge1, edge2), not normalised */
    cs_u32 emitter;   /* index into the array of cs_emitter, from 1 on; 0: none */
} cs_triangle;
CS_SHARED_WORDS(cs_triangle, 16);

/* The steps: how what moves changes from where the shutter opens to where it closes, linearly in
 * between. As many as there are nodes, triangles, vertices and emitters; none where nothing moves.
 */

/* Of the boxes of a node's children, which hold the children at every time. */
typedef struct cs_node_step {
    cs_f32 bounds[2][3][2]; /* child, axis, low and high */
} cs_node_step;
CS_SHARED_WORDS(cs_node_step, 12);

/* Of a triangle, or of an emitter. */
typedef struct cs_triangle_step {
    cs_f32 corner[3];
    cs_f32 edge1[3];
    cs_f32 edge2[3];
    cs_f32 padding[3];
} cs_triangle_step;
CS_SHARED_WORDS(cs_triangle_step, 12);

/* Of a vertex. */
typedef struct cs_normal_step {
    cs_f32 normal[3];
} cs_normal_step;
CS_SHARED_WORDS(cs_normal_step, 3);

enum {
    CS_FACE_SMOOTH = 1,   /* its vertices have normals */
    CS_FACE_TEXTURED = 2, /* its material has a texture */
    CS_FACE_COLOURED = 4  /* its vertices have colours */
};

/* The vertices of a smooth, textured or coloured triangle. */
typedef struct cs_face {
    cs_u32 vertex[3];
} cs_face;
CS_SHARED_WORDS(cs_face, 3);

/* Shading data of a vertex. */
typedef struct cs_vertex {
    cs_f32 normal[3];
    cs_f32 texture[2];
} cs_vertex;
CS_SHARED_WORDS(cs_vertex, 5);

/* Linear colour of a vertex, which multiplies the albedo, and its alpha, which multiplies the
 * material's. The buffer is empty where no vertex has one. */
typedef struct cs_colour {
    cs_f32 value[3];
    cs_f32 alpha; /* 0 to 1 */
} cs_colour;
CS_SHARED_WORDS(cs_colour, 4);

/* Which way a texture's first coordinate grows at a vertex: a unit vector, or zeros. A vertex has
 * two, the second for triangles on which the texture is mirrored. The buffer is empty without
 * normal maps. */
typedef struct cs_tangent {
    cs_f32 value[3];
} cs_tangent;
CS_SHARED_WORDS(cs_tangent, 3);

typedef struct cs_material {
    cs_f32 diffuse[3];  /* albedo, linear Rec.709; multiplies the texture if there is one */
    cs_i32 texture;     /* index, or CS_NO_TEXTURE */
    cs_f32 emission[3]; /* radiance, both sides */
    cs_u32 bsdf;        /* CS_BSDF_ kind */
    cs_f32 parameters[CS_MATERIAL_PARAMETERS]; /* as the BSDF's kind says */
    cs_f32 alpha;          /* part that covers what is behind; multiplies the texture's */
    cs_f32 cutoff;         /* with CS_MATERIAL_MASK: alpha from which on it covers all */
    cs_u32 flags;          /* CS_MATERIAL_ bits */
    cs_u32 facets_texture; /* green: roughness, blue: metallic; index from 1 on, 0: none */
    cs_u32 normal_texture; /* the same */
    cs_u32 emission_texture;
    cs_f32 normal_scale;
    cs_f32 padding;
} cs_material;
CS_SHARED_WORDS(cs_material, 32);

enum {
    CS_MATERIAL_BLEND = 1, /* alpha counts */
    CS_MATERIAL_MASK = 2,  /* alpha is all or nothing */
    CS_MATERIAL_UNLIT = 4  /* shows its colour to the camera and takes no part in light */
};

/* The parameters of CS_BSDF_STANDARD and, from the index on, of CS_BSDF_GLASS. */
enum {
    CS_PARAMETER_ROUGHNESS,
    CS_PARAMETER_METALLIC,
    CS_PARAMETER_F0,  /* reflectance of the dielectric, met head-on */
    CS_PARAMETER_F90, /* and at grazing angles */
    CS_PARAMETER_TRANSMISSION,
    CS_PARAMETER_COAT,
    CS_PARAMETER_COAT_ROUGHNESS,
    CS_PARAMETER_SHEEN, /* three: its colour */
    CS_PARAMETER_SHEEN_ROUGHNESS = CS_PARAMETER_SHEEN + 3,
    CS_PARAMETER_INDEX,     /* of refraction, inside; outside it is 1 */
    CS_PARAMETER_ABSORPTION /* three: a unit of length */
};

#define CS_COAT_F0 0.04f /* KHR_materials_clearcoat: an index of refraction of 1.5 */

/* How coordinates outside an image are taken. */
enum {
    CS_TEXTURE_REPEAT = 0,
    CS_TEXTURE_CLAMP = 1,
    CS_TEXTURE_MIRROR = 2,
    CS_TEXTURE_WRAP_BITS = 2, /* of each of the two in cs_texture.lookup */
    CS_TEXTURE_WRAP_MASK = 3,
    CS_TEXTURE_NEAREST = 16 /* in cs_texture.lookup: the texel at a place, not a blend of four */
};

typedef struct cs_texture {
    cs_u32 first; /* index of its top left texel; texels are 4 halves, linear Rec.709 */
    cs_u32 width;
    cs_u32 height;
    /* CS_TEXTURE_ kind across, the one up shifted by CS_TEXTURE_WRAP_BITS; CS_TEXTURE_NEAREST */
    cs_u32 lookup;
} cs_texture;
CS_SHARED_WORDS(cs_texture, 4);

/* A light; its kind says which members count and what its colour is (light/). */
typedef struct cs_light {
    cs_f32 position[3];
    cs_u32 kind;    /* CS_LIGHT_ */
    cs_f32 axis[3]; /* unit vector from what is lit towards the light; of some kinds, an edge */
    cs_u32 count;   /* emissive triangles */
    cs_f32 colour[3];
    cs_f32 parameters[5]; /* numbers that the kind alone knows */
} cs_light;
CS_SHARED_WORDS(cs_light, 16);

/* An emissive triangle from which area-light samples are drawn. */
typedef struct cs_emitter {
    cs_f32 corner[3];
    cs_f32 cumulative; /* in the choice by power: probability of this emitter and all before it */
    cs_f32 edge1[3];
    cs_f32 probability; /* in that choice; 0 where the radiance varies */
    cs_f32 edge2[3];
    cs_f32 area;
    cs_f32 radiance[3]; /* without what varies */
    cs_f32 luminance;   /* of the mean radiance */
    cs_u32 node;        /* its leaf in the array of cs_emitter_node */
    cs_u32 face;        /* index into the array of cs_face */
    cs_u32 material;
    cs_u32 varies; /* CS_EMITTER_ bits */
} cs_emitter;
CS_SHARED_WORDS(cs_emitter, 20);

enum {
    CS_EMITTER_COVERS = 1,   /* multiplied by alpha */
    CS_EMITTER_TEXTURED = 2, /* multiplied by textures */
    CS_EMITTER_COLOURED = 4  /* its vertices have an alpha */
};

enum {
    CS_EMITTER_ROOT = 1 /* node 0 is not used: both children of a node stand at 2 k and 2 k + 1 */
};

/* A node of the tree of emitters: what bounds the light of all triangles below it. */
typedef struct cs_emitter_node {
    cs_f32 centre[3]; /* of a sphere around them */
    cs_f32 radius;
    cs_f32 axis[3]; /* unit; of a cone with their normals, or the opposite ones */
    cs_f32 cosine;  /* of the cone's half angle, 0 to 1 */
    cs_f32 power;   /* areas times luminances */
    cs_u32 child;   /* the first of two nodes, or CS_LEAF | index of an emitter */
    cs_u32 parent;
    cs_u32 padding;
} cs_emitter_node;
CS_SHARED_WORDS(cs_emitter_node, 12);

#endif
