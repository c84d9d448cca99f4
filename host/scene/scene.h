/* What is rendered: triangles with materials, textures, lights, perhaps a camera. */
#ifndef CS_SCENE_SCENE_H
#define CS_SCENE_SCENE_H

#include "base/array.h"
#include "base/status.h"
#include "clshear/clshear.h"
#include "kernels/light/list.h"
#include "kernels/scene.h"
#include "optics/view.h"

enum {
    CS_CAMERA_NAME = 64,
    CS_CAMERA_LIST = 512 /* bytes that cs_scene_list_cameras fills at most */
};

/* A camera of the file. */
typedef struct cs_scene_camera {
    char name[CS_CAMERA_NAME];
    cs_view view;    /* fov and orthographic are vertical until an image size is known */
    int moves;       /* whether it does while the shutter is open */
    float eye_to[3]; /* where it closes, if so */
    float target_to[3];
} cs_scene_camera;

typedef struct cs_scene {
    cs_array positions;    /* float[3] a vertex */
    cs_array vertices;     /* cs_vertex; as many as positions */
    cs_array positions_to; /* float[3], where the shutter closes; as many as positions, or none */
    cs_array normals_to;   /* float[3], likewise; as many as positions_to */
    cs_array colours;      /* cs_colour; as many as positions, or none */
    cs_array indices;      /* uint32_t[3] a triangle */
    cs_array triangle_materials; /* uint32_t a triangle */
    cs_array triangle_flags;     /* uint8_t a triangle, CS_FACE_ */
    cs_array materials;          /* cs_material */
    cs_array textures;           /* cs_texture */
    cs_array texels;             /* uint16_t[4] */
    cs_array lights;             /* cs_light */
    cs_array cameras;            /* cs_scene_camera, of the file */
    size_t degenerate;           /* triangles left out */
    float bounds[2][3];          /* low and high corner */
    int z_up;         /* convention of the format: +Z is up and -Y in front; else +Y and +Z */
    int up_is_open;   /* the format has no such convention, and +Y is a guess */
    double origin[3]; /* in coordinates of the file; all others here are relative to it */
} cs_scene;

void cs_scene_init(cs_scene *scene);
void cs_scene_free(cs_scene *scene);

size_t cs_scene_triangle_count(const cs_scene *scene);

/* Whether any of its surfaces moves while the shutter is open. */
int cs_scene_moves(const cs_scene *scene);

/* Makes room for the places of all vertices where the shutter closes: at first those where it
 * opens. 0 if out of memory. */
int cs_scene_start_moving(cs_scene *scene);

/* The place of a corner, 0 to 2, of a triangle at a time of the shutter, 0 to 1. */
void cs_scene_corner(const cs_scene *scene, size_t triangle, int corner, float time, float *place);

/* Appends the triangles of `mesh` with a material that is already known. `name` is for messages.
 * Drops triangles without area. */
clshear_status cs_scene_add_mesh(cs_scene *scene, const clshear_mesh *mesh, uint32_t material,
                                 const char *name, cs_error *error);

/* Whether three corners span an area that can be rendered. */
int cs_triangle_has_area(const float *a, const float *b, const float *c);

/* Checks that there is something to render and computes the bounds. */
clshear_status cs_scene_finish(cs_scene *scene, const char *name, cs_error *error);

/* glTF's defaults. */
void cs_standard_defaults(clshear_material *material);

/* Checks a material and converts it for the device. */
clshear_status cs_standard_make(const clshear_material *material, cs_material *made,
                                cs_error *error);

/* Makes the transparent part of a standard surface refract as a solid does; arguments as in
 * clshear_material. */
void cs_standard_solid(float ior, const float *attenuation_colour, float attenuation_distance,
                       cs_material *made);

/* The same as cs_standard_make, appended to the scene; `number` becomes its index and 1. */
clshear_status cs_scene_add_standard(cs_scene *scene, const clshear_material *material,
                                     uint32_t *number, cs_error *error);

/* Whether the device reads texture coordinates of its triangles. */
int cs_material_is_textured(const cs_material *material);

/* What the scene's materials ask of the kernels. */
typedef struct cs_material_needs {
    cs_u32 features;       /* CS_FEATURE_ bits */
    int see_through;       /* alpha counts somewhere */
    int textured_emission; /* some material has it, whether or not a triangle has the material */
} cs_material_needs;

cs_material_needs cs_scene_material_needs(const cs_scene *scene);

/* Whether three numbers can be a colour: 0 to 1e15, whose squares and sums are still floats. */
int cs_is_colour(const float *colour);

/* Checks a light and converts it for the device. name: what messages call it. */
clshear_status cs_light_make(const clshear_light *light, const char *name, cs_light *made,
                             cs_error *error);

/* The same, appended to the scene. */
clshear_status cs_scene_add_light(cs_scene *scene, const clshear_light *light, cs_error *error);

/* Names of the first eight cameras of the file, each after its number. */
void cs_scene_list_cameras(const cs_scene *scene, char names[CS_CAMERA_LIST]);

/* How the triangle moves while the shutter is open. */
cs_triangle_step cs_scene_step(const cs_scene *scene, size_t triangle);

#endif
