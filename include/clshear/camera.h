/* clshear: camera, the settings of a perspective or orthographic camera with a thin lens. Raster
 * coordinates start at the top left corner of the image. */
#ifndef CLSHEAR_CAMERA_H
#define CLSHEAR_CAMERA_H

#include "common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Sets every camera setting that is not set yet; a render does the same on its own copy of the
 * settings.
 * - Eye, target, up, and field of view or CLSHEAR_ORTHOGRAPHIC: from the scene file's camera, the
 *   one that CLSHEAR_CAMERA names or else the first. Without one, the scene fills the picture as
 *   seen from the front and slightly above, or from where CLSHEAR_ORBIT says. A value of 0 of
 *   CLSHEAR_ORTHOGRAPHIC becomes the width that shows all of it.
 * - Focal distance: the focal plane, with its CLSHEAR_TILT, goes through what CLSHEAR_FOCUS_PIXEL
 *   sees, through CLSHEAR_FOCUS_POINT, or through what the middle pixel sees. If that is nothing,
 *   the distance is that of the centre of the bounding box.
 * - Lens radius: from CLSHEAR_F_STOP or CLSHEAR_BLUR. Without them, a point at infinity, or with
 *   parallel lines of sight the most blurred corner of the bounding box, blurs over 3 % of the
 *   shorter image axis. */
CLSHEAR_API clshear_status clshear_camera_complete(const clshear_scene *scene,
                                                   clshear_settings *settings);

/* Where neither the scene nor the settings have light: sets an even CLSHEAR_ENVIRONMENT and a soft
 * CLSHEAR_SUN at the camera's upper left, and a CLSHEAR_LIGHT in the eye if that is inside the
 * scene's bounding box. Completes the camera first. A render does the same, without changing the
 * settings. */
CLSHEAR_API clshear_status clshear_light_complete(const clshear_scene *scene,
                                                  clshear_settings *settings);

/* Sets the focal distance to the depth at the centre of pixel (x, y). */
CLSHEAR_API clshear_status clshear_camera_focus(const clshear_scene *scene,
                                                clshear_settings *settings, int x, int y);

#ifdef __cplusplus
}
#endif

#endif
