/* The first picture of a room: from inside. */
#ifndef CS_RENDER_INTERIOR_H
#define CS_RENDER_INTERIOR_H

#include "render/objects.h"

/* Whether the scene is a closed room with many things in it (`is_room`), and if so a view from
 * inside: level, at eye height, where many of the things are seen. Eye and target are relative to
 * the scene's origin. The lens is not chosen. */
clshear_status cs_interior_view(const clshear_scene *scene, int z_up, int *is_room, cs_view *view,
                                cs_error *error);

/* The part of the directions around a point, 0 to 1, in which nothing hides the sky: surfaces with
 * alpha do not. The point is relative to the scene's origin. */
float cs_interior_sky(const clshear_scene *scene, const float *point);

/* The distance, in lengths of `direction`, of the first surface without alpha; INFINITY if there is
 * none, and where the search ended behind too many surfaces with alpha. `from` is relative to the
 * scene's origin. */
float cs_interior_distance(const clshear_scene *scene, const float *from, const float *direction);

#endif
