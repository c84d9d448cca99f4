/* clshear: scene, the triangles, materials and lights, and the hierarchy over them.
 *
 * World space is right-handed, in any unit. Radiance is linear Rec.709. */
#ifndef CLSHEAR_SCENE_H
#define CLSHEAR_SCENE_H

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum clshear_alpha_mode {
    CLSHEAR_ALPHA_OPAQUE = 0, /* alpha is not used */
    CLSHEAR_ALPHA_MASK = 1,   /* nothing is there where it is below the cutoff */
    CLSHEAR_ALPHA_BLEND = 2   /* it is the part that covers what is behind */
} clshear_alpha_mode;

/* The surface of glTF 2.0 and its extensions; all numbers without a remark are 0 to 1. */
typedef struct clshear_material {
    size_t struct_size;
    float base_colour[3]; /* of a metal's reflection, or of what is below a dielectric's */
    float metallic;
    float roughness;
    float ior;          /* index of refraction of the dielectric: 1 to 10 */
    float specular;     /* the dielectric's reflection is multiplied by it; 0: Lambert's surface */
    float transmission; /* part of the base that is transparent, as a thin wall or a solid */
    float alpha;
    clshear_alpha_mode alpha_mode;
    float alpha_cutoff;
    float clearcoat;
    float clearcoat_roughness;
    float sheen_colour[3];
    float sheen_roughness;
    float emission[3]; /* radiance, on both sides; 0 to 1e15 */
    int unlit;         /* not 0: shows its base colour and takes no part in light */
    int double_sided;  /* kept; all surfaces have two sides */
    int solid;         /* not 0: what is transparent refracts, with `ior` on the side of a triangle
                          from which its corners run clockwise. The surface has to be closed. An ior
                          below 1.01 is taken as a thin wall */
    float attenuation_colour[3]; /* of white light, what is left inside a solid after ... */
    float attenuation_distance;  /* ... this way, in units of the scene; 0: all of it */
    uint32_t reserved;           /* 0 */
} clshear_material;

/* A triangle mesh with one material. */
typedef struct clshear_mesh {
    size_t struct_size;
    const float *positions;  /* 3 floats per vertex */
    const float *normals;    /* 3 floats per vertex; NULL: flat shading */
    const uint32_t *indices; /* 3 per triangle */
    size_t vertex_count;
    size_t triangle_count;
    float diffuse[3];  /* albedo of a Lambertian surface; 0 to 1e15, physical up to 1 */
    float emission[3]; /* radiance, on both sides; 0 to 1e15 */
    uint32_t
        material; /* what clshear_scene_add_material gave, in the place of those two; 0: none */
    const float *positions_to; /* where the vertices are when the shutter closes; NULL: at rest */
    const float *normals_to;   /* likewise; NULL: those above */
} clshear_mesh;

typedef enum clshear_light_kind {
    CLSHEAR_LIGHT_POINT = 0,
    CLSHEAR_LIGHT_DIRECTIONAL = 1,
    CLSHEAR_LIGHT_SPOT = 2,
    CLSHEAR_LIGHT_SPHERE = 3, /* seen by the camera, and hides what is behind it */
    CLSHEAR_LIGHT_QUAD = 4    /* a parallelogram; the same */
} clshear_light_kind;

typedef struct clshear_light {
    size_t struct_size;
    clshear_light_kind kind;
    float position[3]; /* position of a point or spot light, centre of a sphere, corner of a quad */
    float direction[3]; /* direction towards a directional light, or in which a spot light shines;
                         * any length above 0 */
    float colour[3];    /* radiant intensity of a point light, and of a spot light on its axis;
                         * irradiance of a directional light; radiance of a sphere or quad */
    float diameter_deg; /* angle that a directional light takes in the sky; 0: sharp shadows */
    float inner_deg;    /* angle from a spot light's axis up to which it is full */
    float outer_deg;    /* angle from which on it is dark: above the inner one, at most 90 */
    float radius;       /* of a sphere, above 0 */
    float edge1[3];     /* edges of a quad from its corner. It shines on the side from which the */
    float edge2[3];     /* turn from edge1 to edge2 is against the clock; the other is black */
} clshear_light;

typedef struct clshear_scene_info {
    size_t struct_size;
    size_t triangles;    /* triangles in the scene */
    size_t degenerate;   /* triangles without area, which are left out */
    size_t nodes;        /* nodes of the hierarchy */
    size_t references;   /* triangles in its leaves; spatial splits repeat some */
    size_t device_bytes; /* geometry on the device: nodes, triangles, faces, vertices, and the wide
                          * hierarchy as soon as a render with bounces has made it */
    size_t lights;       /* added lights and those of the file */
    size_t emitters;     /* emissive triangles */
    int file_camera;     /* 1 if the file has a camera */
    double load_s;       /* time spent reading the file */
    double build_s;      /* time spent building the hierarchy */
    double low[3];       /* corners of the bounding box, in coordinates of the file */
    double high[3];
} clshear_scene_info;

/* Reads OBJ, glTF 2.0, PLY, STL, OFF or another format that Assimp supports, and completes the
 * scene. Of the settings (NULL: fallbacks), those that say how the file is read count:
 * CLSHEAR_SMOOTH, and for motion CLSHEAR_FRAME, _FPS, _SHUTTER, _SHUTTER_ANGLE, _TO, _TURNTABLE.
 * Give the same ones to the render: there they have no effect, but its film names them; others are
 * warned of. Repairs are reported to the context's warning callback: missing material files and
 * textures, invalid colours (negative or not finite), degenerate triangles.
 *
 * The program clshear-import reads the file, in a process with limits on time and memory, so that a
 * damaged file ends in a message. It is looked for beside the library, in libexec/clshear, and at
 * the path in the environment variable CLSHEAR_IMPORT. Without it, OBJ, glTF, PLY, STL and OFF
 * are read in the calling process, and other formats are refused.
 *
 * A scene that lies far from the origin is moved there, with a warning, since the device computes
 * with floats. Cameras and lights, in settings and added, stay in the coordinates of the file. */
CLSHEAR_API clshear_status clshear_scene_load(clshear_context *context, const char *path,
                                              const clshear_settings *settings,
                                              clshear_scene **scene);

/* Cameras of the scene's file: the name of number `index` from 0, or NULL past the last one. Owned
 * by the scene. CLSHEAR_CAMERA chooses one. */
CLSHEAR_API const char *clshear_scene_camera(const clshear_scene *scene, size_t index);

/* Creates an empty scene. Add meshes to it and then complete it. */
CLSHEAR_API clshear_status clshear_scene_create(clshear_context *context, clshear_scene **scene);
CLSHEAR_API clshear_status clshear_scene_add_mesh(clshear_scene *scene, const clshear_mesh *mesh);

/* Fills in glTF's defaults: white metal, fully rough. struct_size is set by the caller. */
CLSHEAR_API void clshear_material_init(clshear_material *material);

/* Adds a material for meshes to come, and gives its number, 1 or more. */
CLSHEAR_API clshear_status clshear_scene_add_material(clshear_scene *scene,
                                                      const clshear_material *material,
                                                      uint32_t *number);

/* Builds the hierarchy and uploads the scene to the device. No mesh can be added afterwards. */
CLSHEAR_API clshear_status clshear_scene_complete(clshear_scene *scene);

/* Adds a light, before or after the scene is complete. A scene with neither lights nor emissive
 * triangles is rendered in a neutral studio (clshear_light_complete), unless the settings have
 * lights. */
CLSHEAR_API clshear_status clshear_scene_add_light(clshear_scene *scene,
                                                   const clshear_light *light);

/* Fills in `info`. The caller sets `info->struct_size`. */
CLSHEAR_API void clshear_scene_describe(const clshear_scene *scene, clshear_scene_info *info);

/* The message of the last failed call on this object; see clshear_context_message. */
CLSHEAR_API const char *clshear_scene_message(const clshear_scene *scene);
CLSHEAR_API void clshear_scene_free(clshear_scene *scene);

#ifdef __cplusplus
}
#endif

#endif
