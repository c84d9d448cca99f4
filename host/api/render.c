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
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(film);
    return cs_message_keep(&scene->message,
                           cs_render(scene, settings, NULL, film, cs_thread_error()));
}

clshear_status clshear_render_extend(clshear_scene *scene, const clshear_settings *settings,
                                     const clshear_film *base, clshear_film **film)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(base);
    CS_NEEDS(film);
    return cs_message_keep(&scene->message,
                           cs_render(scene, settings, base, film, cs_thread_error()));
}

float clshear_lens_extent(const clshear_settings *settings)
{
    cs_view view;
    if (settings == NULL) return 0.0f;
    cs_view_of(settings, NULL, &view);
    return cs_lens_extent(&view);
}

/* Points of 4 or 5 coordinates. */
static clshear_status radiance_at(clshear_scene *scene, const clshear_settings *settings, int x,
                                  int y, size_t dimensions, const float *points, size_t count,
                                  float *rgb)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(points);
    CS_NEEDS(rgb);
    return cs_message_keep(&scene->message, cs_radiance(scene, settings, x, y, dimensions, points,
                                                        count, rgb, cs_thread_error()));
}

clshear_status clshear_radiance(clshear_scene *scene, const clshear_settings *settings, int x,
                                int y, const float *points, size_t count, float *rgb)
{
    return radiance_at(scene, settings, x, y, 4, points, count, rgb);
}

clshear_status clshear_moving_radiance(clshear_scene *scene, const clshear_settings *settings,
                                       int x, int y, const float *points, size_t count, float *rgb)
{
    return radiance_at(scene, settings, x, y, 5, points, count, rgb);
}

static clshear_status radiance_of(clshear_scene *scene, const clshear_settings *settings, int x,
                                  int y, const cs_pixel_shears *shears, size_t dimensions,
                                  const float *samples, size_t count, float *rgb)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(samples);
    CS_NEEDS(rgb);
    return cs_message_keep(&scene->message,
                           cs_radiance_of_samples(scene, settings, x, y, shears, dimensions,
                                                  samples, count, rgb, cs_thread_error()));
}

clshear_status clshear_radiance_of_samples(clshear_scene *scene, const clshear_settings *settings,
                                           int x, int y, float shear_px, const float *samples,
                                           size_t count, float *rgb)
{
    const cs_pixel_shears shears = {.shear_px = shear_px};
    return radiance_of(scene, settings, x, y, &shears, 4, samples, count, rgb);
}

clshear_status clshear_moving_radiance_of_samples(clshear_scene *scene,
                                                  const clshear_settings *settings, int x, int y,
                                                  float shear_px, const float velocity_px[2],
                                                  const float *samples, size_t count, float *rgb)
{
    CS_NEEDS(velocity_px);
    const cs_pixel_shears shears = {shear_px, {velocity_px[0], velocity_px[1]}};
    return radiance_of(scene, settings, x, y, &shears, 5, samples, count, rgb);
}

clshear_status clshear_pixel_motion(clshear_scene *scene, const clshear_settings *settings, int x,
                                    int y, int *moves, float velocity_px[2])
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(moves);
    CS_NEEDS(velocity_px);
    cs_velocity velocity = {0.0f, 0.0f};
    const clshear_status status =
        cs_pixel_motion(scene, settings, x, y, moves, &velocity, cs_thread_error());
    velocity_px[0] = velocity.x;
    velocity_px[1] = velocity.y;
    return cs_message_keep(&scene->message, status);
}

clshear_status clshear_pixel_shear(clshear_scene *scene, const clshear_settings *settings, int x,
                                   int y, float *shear_px)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(shear_px);
    return cs_message_keep(&scene->message,
                           cs_pixel_shear(scene, settings, x, y, shear_px, cs_thread_error()));
}
