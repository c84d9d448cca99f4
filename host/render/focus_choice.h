/* What to focus on and how wide to open the lens, where the settings leave it open. */
#ifndef CS_RENDER_FOCUS_CHOICE_H
#define CS_RENDER_FOCUS_CHOICE_H

#include "render/objects.h"
#include "settings/settings.h"

/* All of them need eye, target, up, and field of view or width. */

/* As clshear_camera_focus. */
clshear_status cs_camera_focus(const clshear_scene *scene, clshear_settings *settings, int x, int y,
                               cs_error *error);

/* Sets the focal distance unless it is set: so that the focal plane goes through what the settings
 * name, or the middle pixel sees. `depth` becomes the depth of that; where nothing is named, the
 * focal distance. */
clshear_status cs_choose_focus(const clshear_scene *scene, clshear_settings *settings, float *depth,
                               cs_error *error);

/* Sets the lens radius unless it is set, for something in focus at this depth. */
clshear_status cs_choose_lens(const clshear_scene *scene, clshear_settings *settings, float depth,
                              cs_error *error);

#endif
