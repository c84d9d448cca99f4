/* A whole render: settings -> camera -> plan -> passes -> film. */
#ifndef CS_RENDER_RENDER_H
#define CS_RENDER_RENDER_H

#include "render/objects.h"
#include "settings/settings.h"

/* As clshear_render, or clshear_render_extend where `base` is not NULL. */
clshear_status cs_render(clshear_scene *scene, const clshear_settings *settings,
                         const clshear_film *base, clshear_film **film, cs_error *error);

#endif
