/* A scene on its way through a pipe: records of a tag, a size and bytes. */
#ifndef CS_IMPORT_TRANSFER_H
#define CS_IMPORT_TRANSFER_H

#include "scene/scene.h"

enum {
    CS_RECORD_WARNING = 0x4e524157, /* a line */
    CS_RECORD_FAILURE = 0x4c494146, /* uint32_t status, a line */
    CS_RECORD_FRAME = 0x4d415246,   /* cs_scene_frame */
    CS_RECORD_ARRAY = 0x41525241,   /* the next of the scene's arrays */
    CS_RECORD_END = 0x2e444e45
};

typedef struct cs_record {
    uint32_t tag;
    uint32_t item_size; /* of an array: both sides must be built alike */
    uint64_t size;      /* bytes that follow */
} cs_record;

/* What a scene is besides its arrays. */
typedef struct cs_scene_frame {
    double origin[3];
    float bounds[2][3];
    uint64_t degenerate;
    uint64_t z_up; /* 0 or 1, as the next */
    uint64_t up_is_open;
} cs_scene_frame;

enum {
    CS_SCENE_ARRAYS = 13
};

/* The arrays of a scene, in the order in which they are sent. */
void cs_scene_arrays(cs_scene *scene, cs_array *arrays[CS_SCENE_ARRAYS]);

/* Sends a record, or all of a scene; 0 when nobody listens any more. */
int cs_send_record(int pipe, uint32_t tag, uint32_t item_size, const void *bytes, size_t size);
int cs_send_scene(int pipe, cs_scene *scene);

/* Whether everything in a scene that was received names what is there, and is in its range. */
int cs_scene_is_sound(cs_scene *scene);

#endif
