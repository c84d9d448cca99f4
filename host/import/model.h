/* What a scene file holds, as its reader found it: the seam between formats and the scene.
 *
 * Positions are double and as in the file, after the transformations of its nodes. Attributes lie
 * in pools, and corners of triangles name them, as OBJ does it. */
#ifndef CS_IMPORT_MODEL_H
#define CS_IMPORT_MODEL_H

#include "base/array.h"
#include "scene/material.h"

enum {
    CS_MODEL_MOST = (1 << 27) - 1, /* triangles, and entries of a pool */
    CS_MODEL_NAME = 64
};

#define CS_NO_INDEX UINT32_MAX

/* In place of the colours of a position that has been given none yet. */
#define CS_NO_COLOUR (-1.0f)

typedef struct cs_corner {
    uint32_t position;
    uint32_t normal;  /* or CS_NO_INDEX */
    uint32_t texture; /* or CS_NO_INDEX */
} cs_corner;

typedef struct cs_model_triangle {
    cs_corner corner[3];
    uint32_t material; /* or CS_NO_INDEX: the format's default */
    uint32_t group;    /* normals are smooth among triangles of one group; 0: flat */
} cs_model_triangle;

/* An image that materials use: a file, or the bytes of one. */
typedef struct cs_image_source {
    char *path;  /* what can be opened, or "" where the file is not there; owned */
    char *label; /* what messages call it; owned */
    void *bytes; /* NULL: read the file; owned */
    size_t size;
} cs_image_source;

typedef enum cs_model_light_kind {
    CS_MODEL_POINT,
    CS_MODEL_DIRECTIONAL,
    CS_MODEL_SPOT
} cs_model_light_kind;

typedef struct cs_model_light {
    char name[CS_MODEL_NAME];
    cs_model_light_kind kind;
    double position[3];
    double axis[3];   /* where a directional or spot light shines to; any length */
    float colour[3];  /* radiant intensity, but for `fading`; directional: irradiance */
    float cone[2];    /* of a spot: inner and outer half angle, radians */
    float range;      /* 0: none */
    double fading[3]; /* as light models of old have it, colour is irradiance, divided by the first
                         number, the second times the distance and the third times its square;
                         zeros: it is none of these */
} cs_model_light;

typedef struct cs_model_camera {
    char name[CS_MODEL_NAME];
    double eye[3];
    double forward[3]; /* any length */
    double up[3];
    double fov;    /* vertical, radians */
    double height; /* what the picture shows of parallel lines of sight, above 0; or 0, and fov
                      counts */
} cs_model_camera;

struct cs_import_modules;

typedef struct cs_model {
    const char *path; /* of the file, for messages */
    const cs_log *log;
    const struct cs_import_modules *modules; /* NULL: none */
    int is_played;                           /* whether the animation is */
    double time_s;                           /* of the animation */
    cs_array positions;                      /* double[3] */
    cs_array colours;     /* float[3], linear, one for each position; or none at all */
    cs_array opacities;   /* float, 0 to 1, of positions that have colours; of those beyond, 1 */
    cs_array normals;     /* float[3] */
    cs_array textures;    /* float[2] */
    cs_array triangles;   /* cs_model_triangle */
    cs_array materials;   /* cs_material_description */
    cs_array images;      /* cs_image_source */
    cs_array lights;      /* cs_model_light */
    cs_array cameras;     /* cs_model_camera */
    int z_up;             /* convention of the format: +Z is up and -Y in front; else +Y and +Z */
    int up_is_open;       /* the format has no such convention, and +Y is a guess */
    double cutting;       /* points that may still be looked at to cut polygons */
    size_t without_area;  /* faces with fewer than three corners: points and lines */
    int has_unused_alpha; /* some position has an alpha that the material does not use */
} cs_model;

void cs_model_init(cs_model *model, const char *path, const cs_log *log);
void cs_model_free(cs_model *model);

/* Room for `count` more items of one of the arrays, zeroed; NULL where there would be more than
 * CS_MODEL_MOST, or with no memory. */
void *cs_model_extend(cs_array *array, size_t count);

/* Records that the model is too large for memory, or for what the renderer can count. */
clshear_status cs_model_full(const cs_model *model, cs_error *error);

/* Gives the position number `index` a linear colour, of which negative values and those that are no
 * numbers become 0. Positions that get none are white. */
clshear_status cs_model_set_colour(cs_model *model, size_t index, const float *colour,
                                   cs_error *error);

/* Gives the position number `index` an opacity: 0 to 1. Positions that get none have 1. */
clshear_status cs_model_set_opacity(cs_model *model, size_t index, float opacity, cs_error *error);

/* A material of which no more is known than a name: mid-grey; white where positions have colours,
 * so that they show those and not half of them. */
void cs_model_plain(const cs_model *model, const char *name, cs_material_description *material);

/* Adds an image, or finds it: a file (`path`), or a copy of `size` bytes. Those with the same path
 * and label are one; labels of images that are bytes tell them apart. */
clshear_status cs_model_add_image(cs_model *model, const char *path, const char *label,
                                  const void *bytes, size_t size, int *image, cs_error *error);

/* Adds the triangles of a polygon with `count` corners. */
clshear_status cs_model_add_polygon(cs_model *model, const cs_corner *corners, size_t count,
                                    uint32_t material, uint32_t group, cs_error *error);

#endif
