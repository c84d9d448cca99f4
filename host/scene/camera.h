/* Cameras: the file's, the framing one, and the thin lens as the kernels want it. */
#ifndef CS_SCENE_CAMERA_H
#define CS_SCENE_CAMERA_H

#include "clshear/device/camera.h"
#include "scene/scene.h"

/* Place of the file's camera called `name`, or of that number from 0; -1 if there is none. */
int cs_camera_find(const cs_scene *scene, const char *name);

/* Camera `number` of the file, or where that is negative one that frames the bounding box, for an
 * image of this size. Relative to the scene's origin, as all of the scene. */
cs_view cs_camera_of_scene(const cs_scene *scene, int number, int width, int height);

/* Slopes of the focal plane: change of its depth over a unit of length to the right and down, on
 * the optical axis and perpendicular to it. */
void cs_focal_slopes(const cs_view *view, float *slopes);

/* Checks `camera` and computes its frame, but for the optics, which are all zeros. A focal distance
 * that is not chosen counts as 1: for pinhole rays it does not matter, and the rise of the focal
 * plane is that of a focal distance of 1. */
clshear_status cs_camera_frame(const cs_view *camera, int width, int height, cs_camera *frame,
                               cs_error *error);

#endif
