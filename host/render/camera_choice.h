/* Where to stand and how much to show, where the settings leave it open. */
#ifndef CS_RENDER_CAMERA_CHOICE_H
#define CS_RENDER_CAMERA_CHOICE_H

#include "render/objects.h"
#include "settings/settings.h"

/* Whether +Z is up, and not +Y: by the settings, or else by the convention of the file's format. */
int cs_z_is_up(const cs_scene *scene, const clshear_settings *settings);

/* As clshear_camera_complete. */
clshear_status cs_camera_complete(const clshear_scene *scene, clshear_settings *settings,
                                  cs_error *error);

/* Chooses eye, target, up, and field of view or width where they are not set. */
clshear_status cs_camera_pose(const clshear_scene *scene, clshear_settings *settings,
                              cs_error *error);

#endif
