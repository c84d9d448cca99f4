/* Public functions that render. */
#include "render/render.h"

#include "api/arguments.h"
#include "clshear/analysis.h"
#include "clshear/clshear.h"
#include "render/radiance.h"
#include "settings/view.h"

clshear_status clshear_render(clshear_scene *scene, const clshear_settings *settings,
                              clshear_film **film)
{
    CS_NEEDS(scene);
    CS_NEEDS(film);
    return cs_message_keep(&scene->message,
                           cs_render(scene, settings, NULL, film, cs_thread_error()));
}

clshear_status clshear_render_extend(clshear_scene *scene, const clshear_settings *settings,
                                     const clshear_film *base, clshear_film **film)
{
    CS_NEEDS(scene);
    CS_NEEDS(base);
    CS_NEEDS(film);
    return cs_message_keep(&scene->message,
                           cs_render(scene, settings, base, film, cs_thread_error()));
}

float clshear_lens_extent(const clshear_settings *settings)
{
    cs_view view;
    cs_view_of(settings, NULL, &view);
    return cs_lens_extent(&view);
}

clshear_status clshear_radiance(clshear_scene *scene, const clshear_settings *settings, int x,
                                int y, const float *points, size_t count, float *rgb)
{
    CS_NEEDS(scene);
    CS_NEEDS(points);
    CS_NEEDS(rgb);
    return cs_message_keep(
        &scene->message, cs_radiance(scene, settings, x, y, points, count, rgb, cs_thread_error()));
}

clshear_status clshear_radiance_of_samples(clshear_scene *scene, const clshear_settings *settings,
                                           int x, int y, float shear_px, const float *samples,
                                           size_t count, float *rgb)
{
    CS_NEEDS(scene);
    CS_NEEDS(samples);
    CS_NEEDS(rgb);
    return cs_message_keep(&scene->message,
                           cs_radiance_of_samples(scene, settings, x, y, shear_px, samples, count,
                                                  rgb, cs_thread_error()));
}

clshear_status clshear_pixel_shear(clshear_scene *scene, const clshear_settings *settings, int x,
                                   int y, float *shear_px)
{
    CS_NEEDS(scene);
    CS_NEEDS(shear_px);
    return cs_message_keep(&scene->message,
                           cs_pixel_shear(scene, settings, x, y, shear_px, cs_thread_error()));
}
