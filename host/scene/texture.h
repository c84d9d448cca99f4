/* Textures of a scene. */
#ifndef CS_SCENE_TEXTURE_H
#define CS_SCENE_TEXTURE_H

#include "scene/scene.h"

/* Appends the texels of an image file, or of the `size` bytes of one in `memory`, as a texture that
 * repeats; `label` is what messages call it. Texels are base + gain * those of the file. */
clshear_status cs_texture_add(cs_scene *scene, const char *path, const char *label,
                              const void *memory, size_t size, float base, float gain,
                              cs_i32 *texture, cs_error *error);

/* The same texels with these wraps (CS_TEXTURE_): `texture`, where it has them, or another. */
clshear_status cs_texture_wrapped(cs_scene *scene, cs_u32 wrap_s, cs_u32 wrap_t, cs_i32 *texture,
                                  cs_error *error);

#endif
