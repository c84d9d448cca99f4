/* Cameras: the file's, the framing one, and the thin lens as the kernels want it. */
#ifndef CS_SCENE_CAMERA_H
#define CS_SCENE_CAMERA_H

#include "clshear/device/camera.h"
#include "scene/scene.h"

struct aiScene;

/* Takes over the first camera of a scene file; 0 if it has no field of view that can be used. */
int cs_camera_import(cs_scene *scene, const struct aiScene *file);

/* The file's camera, or one that frames the bounding box, for an image of this size. */
cs_view cs_camera_of_scene(const cs_scene *scene, int width, int height);

/* Checks `camera` and computes its frame, but for the optics, which are all zeros. A focal distance
 * that is not chosen counts as 1: for pinhole rays it does not matter. */
clshear_status cs_camera_frame(const cs_view *camera, int width, int height, cs_camera *frame,
                               cs_error *error);

#endif
