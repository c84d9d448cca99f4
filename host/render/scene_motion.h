/* Where a scene's surfaces are when the shutter closes. */
#ifndef CS_RENDER_SCENE_MOTION_H
#define CS_RENDER_SCENE_MOTION_H

#include "import/import.h"
#include "render/objects.h"
#include "settings/settings.h"

/* Times of the file's animation at which the shutter opens and closes, s; returns 0 if none is
 * played. `settings` may be NULL. */
int cs_shutter_times(const clshear_settings *settings, double times_s[2]);

/* Gives a scene that was read from `path` its places where the shutter closes: from the file of
 * --to, from the file's own animation, and turned as --turntable says. options: those it was read
 * with. */
clshear_status cs_scene_read_motion(clshear_scene *scene, const char *path,
                                    const cs_import_options *options,
                                    const clshear_settings *settings, cs_error *error);

#endif
