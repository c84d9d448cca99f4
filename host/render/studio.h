/* Light for scenes that have none. */
#ifndef CS_RENDER_STUDIO_H
#define CS_RENDER_STUDIO_H

#include "render/objects.h"
#include "settings/settings.h"

/* Sets an even environment and a soft sun at the camera's upper left, where neither the scene nor
 * the settings have light; and a point light in the eye, where surfaces hide the sky in more than
 * three quarters of all directions. None of them can end up inside an object. The camera must be
 * complete. */
clshear_status cs_studio_complete(const clshear_scene *scene, clshear_settings *settings,
                                  cs_error *error);

#endif
