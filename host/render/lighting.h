/* The lights of one render: the scene's, and those of the settings. */
#ifndef CS_RENDER_LIGHTING_H
#define CS_RENDER_LIGHTING_H

#include "render/objects.h"
#include "settings/settings.h"

/* The settings that are lists of lights: X(identifier, suffix of the function that reads it). */
#define CS_LIGHT_SETTING_LIST(X) \
    X(LIGHT, point)              \
    X(SUN, sun)                  \
    X(SPHERE, sphere)            \
    X(QUAD, quad)

typedef struct cs_lighting {
    cs_array list;          /* cs_light */
    cs_buffer *lights;      /* the same on the device */
    cs_buffer *environment; /* an image and its tables; NULL: none */
    cs_u32 environment_fingerprint;
    cs_u32 count;
    cs_u32 features;   /* CS_FEATURE_ bits that the lights need */
    cs_u32 area_count; /* of them: lights that are sampled by a pair of the tuple */
} cs_lighting;

/* The scene's lights, those of the settings, the environment, and all emissive triangles as one;
 * the default light where all are none. Freed by cs_lighting_free. Start from zeros. */
clshear_status cs_lighting_make(const clshear_scene *scene, const clshear_settings *settings,
                                cs_lighting *lighting, cs_error *error);
void cs_lighting_free(cs_lighting *lighting);

/* Those of the lights that rays can meet, for as long as the lighting lives. */
cs_shapes cs_lighting_shapes(const cs_lighting *lighting);

/* The scene's buffers in the order of the list, with these lights. */
void cs_lit_buffers(const clshear_scene *scene, const cs_lighting *lighting,
                    const cs_buffer *buffers[CS_SCENE_BUFFERS]);

#endif
