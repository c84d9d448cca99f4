/* Public functions that render. */
#include "render/render.h"

#include "api/arguments.h"
#include "clshear/analysis.h"
#include "clshear/clshear.h"
#include "clshear/device/camera.h"
#include "oracle/oracle.h"
#include "render/radiance.h"
#include "settings/view.h"

_Static_assert((int)CLSHEAR_SHEAR_NONE == (int)CS_SHEAR_NONE, "kinds of shears");
_Static_assert((int)CLSHEAR_SHEAR_TOROIDAL == (int)CS_SHEAR_TOROIDAL, "kinds of shears");
_Static_assert((int)CLSHEAR_SHEAR_EQUAL_AREA == (int)CS_SHEAR_EQUAL_AREA, "kinds of shears");
_Static_assert((int)CLSHEAR_ORACLE_CENTRE == (int)CS_RULE_CENTRE, "rules of the oracle");
_Static_assert((int)CLSHEAR_ORACLE_MEDIAN == (int)CS_RULE_MEDIAN, "rules of the oracle");
_Static_assert((int)CLSHEAR_ORACLE_NEAR == (int)CS_RULE_NEAR, "rules of the oracle");
_Static_assert((int)CLSHEAR_ORACLE_FAR == (int)CS_RULE_FAR, "rules of the oracle");

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
    cs_view_of(settings, &view);
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
