/* The integrand of a pixel, at points that the caller chooses. */
#ifndef CS_RENDER_RADIANCE_H
#define CS_RENDER_RADIANCE_H

#include "render/objects.h"
#include "settings/settings.h"

/* As clshear_radiance and clshear_radiance_of_samples. */
clshear_status cs_radiance(clshear_scene *scene, const clshear_settings *settings, int x, int y,
                           const float *points, size_t count, float *rgb, cs_error *error);
clshear_status cs_radiance_of_samples(clshear_scene *scene, const clshear_settings *settings, int x,
                                      int y, float shear_px, const float *samples, size_t count,
                                      float *rgb, cs_error *error);

/* The shear in pixels that the settings' oracle gives a pixel; the pilot counts as centre. */
clshear_status cs_pixel_shear(clshear_scene *scene, const clshear_settings *settings, int x, int y,
                              float *shear_px, cs_error *error);

#endif
