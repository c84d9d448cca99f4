/* Where to stand, what to focus on, how wide to open: what the settings leave open. */
#ifndef CS_RENDER_CAMERA_CHOICE_H
#define CS_RENDER_CAMERA_CHOICE_H

#include "render/objects.h"
#include "settings/settings.h"

/* As clshear_camera_complete. */
clshear_status cs_camera_complete(const clshear_scene *scene, clshear_settings *settings,
                                  cs_error *error);

/* Chooses eye, target, up and field of view where they are not set. */
clshear_status cs_camera_pose(const clshear_scene *scene, clshear_settings *settings,
                              cs_error *error);

/* As clshear_camera_focus. Eye, target, up and field of view must be set. */
clshear_status cs_camera_focus(const clshear_scene *scene, clshear_settings *settings, int x, int y,
                               cs_error *error);

#endif
