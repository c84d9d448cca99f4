/* The connected parts of a scene. */
#ifndef CS_SCENE_PARTS_H
#define CS_SCENE_PARTS_H

#include "scene/scene.h"

/* Gives each vertex the number of a vertex of its part, the same for all of the part. Triangles
 * with a corner at the same position are connected. `parts` is empty before, uint32_t. */
clshear_status cs_scene_parts(const cs_scene *scene, cs_array *parts, cs_error *error);

#endif
