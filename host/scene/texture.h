/* Textures of a scene. */
#ifndef CS_SCENE_TEXTURE_H
#define CS_SCENE_TEXTURE_H

#include "image/image_io.h"
#include "scene/scene.h"

enum {
    CS_TEXTURE_LAYERS = 2, /* images of one texture at most */
    CS_TEXTURE_ALL = 15    /* all channels */
};

/* Channels of an image that go into a texture. */
typedef struct cs_texture_layer {
    cs_texels image;   /* no halves: the channels stay 1 */
    unsigned channels; /* bit c: channel c */
} cs_texture_layer;

/* Appends a texture that repeats. Each channel comes from the layer that has it, and is 1 where
 * none has it. The largest image gives the size; a layer with all channels stands alone. */
clshear_status cs_texture_add(cs_scene *scene, const cs_texture_layer *layers, size_t count,
                              cs_i32 *texture, cs_error *error);

/* The same texels with this cs_texture.lookup: `texture`, where it has that, or another. */
clshear_status cs_texture_look_up(cs_scene *scene, cs_u32 lookup, cs_i32 *texture, cs_error *error);

/* Whether alpha is 1 everywhere. */
int cs_texture_covers(const cs_scene *scene, cs_i32 texture);

#endif
