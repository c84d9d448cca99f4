/* The integrand of a pixel, at points that the caller chooses. */
#ifndef CS_RENDER_RADIANCE_H
#define CS_RENDER_RADIANCE_H

#include "clshear/device/camera_sample.h"
#include "render/objects.h"
#include "settings/settings.h"

/* By what a pixel's samples are sheared. */
typedef struct cs_pixel_shears {
    cs_f32 shear_px;
    cs_velocity velocity_px; /* while the shutter is open */
} cs_pixel_shears;

/* As clshear_radiance and clshear_radiance_of_samples, and those of moving scenes. A point has 4 or
 * 5 `dimensions`. */
clshear_status cs_radiance(clshear_scene *scene, const clshear_settings *settings, int x, int y,
                           size_t dimensions, const float *points, size_t count, float *rgb,
                           cs_error *error);
clshear_status cs_radiance_of_samples(clshear_scene *scene, const clshear_settings *settings, int x,
                                      int y, const cs_pixel_shears *shears, size_t dimensions,
                                      const float *samples, size_t count, float *rgb,
                                      cs_error *error);

/* Whether anything moves, and the velocity of what the centre of a pixel sees in the middle of the
 * shutter, pixels while it is open. */
clshear_status cs_pixel_motion(clshear_scene *scene, const clshear_settings *settings, int x, int y,
                               int *moves, cs_velocity *velocity_px, cs_error *error);

/* The shear in pixels that the settings' oracle gives a pixel; the pilot counts as centre. */
clshear_status cs_pixel_shear(clshear_scene *scene, const clshear_settings *settings, int x, int y,
                              float *shear_px, cs_error *error);

#endif
