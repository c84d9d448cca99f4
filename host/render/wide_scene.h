/* The wide hierarchy of a scene on the device: made when a render first wants it. */
#ifndef CS_RENDER_WIDE_SCENE_H
#define CS_RENDER_WIDE_SCENE_H

#include "base/status.h"
#include "device/device.h"
#include "kernels/scene.h"
#include "render/footprint.h"

struct clshear_scene;

typedef struct cs_wide_scene cs_wide_scene;

/* One that is not made yet; NULL when out of memory. */
cs_wide_scene *cs_wide_scene_new(void);
void cs_wide_scene_free(cs_wide_scene *wide);

/* CS_FEATURE_WIDE where renders with these features let rays walk alone: paths among triangles that
 * are many and at rest, in packets as wide as a node. Otherwise 0. */
cs_u32 cs_wide_feature(const struct clshear_scene *scene, cs_u32 features);

/* Makes the hierarchy of a complete scene, if `features` has CS_FEATURE_WIDE and it is not made
 * yet. Several threads may call it. Clears CS_FEATURE_WIDE where rays cannot walk it. */
clshear_status cs_wide_scene_make(const struct clshear_scene *scene, cs_u32 *features,
                                  cs_error *error);

/* Bytes of it on the device; 0 as long as it is not made. */
size_t cs_wide_scene_bytes(cs_wide_scene *wide);

/* Bytes that it will take on the device where a render with these features is the first that wants
 * it, and what making it takes at once, these included. 0 where it is not to be made. */
double cs_wide_scene_expected(const struct clshear_scene *scene, cs_u32 features);
cs_footprint cs_wide_scene_making(const struct clshear_scene *scene, cs_u32 features);

/* Puts what there is of it among a scene's buffers. */
void cs_wide_scene_buffers(cs_wide_scene *wide, const cs_buffer *buffers[CS_SCENE_BUFFERS]);

#endif
