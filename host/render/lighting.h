/* The lights of one render: the scene's, and those of the settings. */
#ifndef CS_RENDER_LIGHTING_H
#define CS_RENDER_LIGHTING_H

#include "render/objects.h"
#include "settings/settings.h"

typedef struct cs_lighting {
    cs_buffer *lights; /* cs_light */
    cs_u32 count;
} cs_lighting;

/* Freed by cs_lighting_free. Start from zeros. */
clshear_status cs_lighting_make(const clshear_scene *scene, const clshear_settings *settings,
                                cs_lighting *lighting, cs_error *error);
void cs_lighting_free(cs_lighting *lighting);

#endif
