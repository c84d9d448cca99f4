#include "render/studio.h"

#include <math.h>

#include "base/pi.h"
#include "base/vec.h"
#include "render/lighting.h"

/* A white surface that faces the sun shows 1: 0.4 by the environment, 0.6 by the sun. */
static const char *const environment = "0.4,0.4,0.4";
static const double key_radiance = 0.6;
static const double key_diameter_deg = 10.0;

/* Emission that varies over surfaces is often a screen or a label, which leaves a scene dark: it
 * counts as light if all surfaces together emit this radiance in the mean. */
static const double least_light = 0.2;

static int has_light(const clshear_scene *scene, const clshear_settings *settings)
{
    return scene->scene.lights.count > 0 || scene->device_scene.even_emitters > 0 ||
           scene->device_scene.emitted_light > least_light ||
           cs_is_set(settings, ENVIRONMENT)
#define OR_SET(identifier, suffix) || cs_is_set(settings, identifier)
               CS_LIGHT_SETTING_LIST(OR_SET);
#undef OR_SET
}

static void normalise(double *vector)
{
    const double length = sqrt(cs_vec_dot_double(vector, vector));
    for (int i = 0; i < 3; i++)
        vector[i] /= length > 0.0 ? length : 1.0;
}

/* Towards the sun: left of the camera, above it, and behind it. */
static void key_direction(const clshear_settings *settings, double *towards)
{
    const double *eye = cs_numbers(settings, EYE), *target = cs_numbers(settings, TARGET);
    double ahead[3], right[3], up[3];
    for (int i = 0; i < 3; i++)
        ahead[i] = target[i] - eye[i];
    normalise(ahead);
    cs_vec_cross_double(ahead, cs_numbers(settings, UP), right);
    normalise(right);
    cs_vec_cross_double(right, ahead, up);
    for (int i = 0; i < 3; i++)
        towards[i] = -0.6 * right[i] + 0.8 * up[i] - 0.9 * ahead[i];
    normalise(towards);
    for (int i = 0; i < 3; i++) /* few digits, to be copied */
        towards[i] = round(1e3 * towards[i]) / 1e3;
}

static int eye_is_inside(const clshear_scene *scene, const clshear_settings *settings)
{
    int inside = 1;
    for (int i = 0; i < 3; i++) {
        const double eye = cs_numbers(settings, EYE)[i] - scene->scene.origin[i];
        inside &=
            eye > (double)scene->scene.bounds[0][i] && eye < (double)scene->scene.bounds[1][i];
    }
    return inside;
}

clshear_status cs_studio_complete(const clshear_scene *scene, clshear_settings *settings,
                                  cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    double sun[7] = {[6] = key_diameter_deg}, light[6];
    if (has_light(scene, settings)) return CLSHEAR_OK;
    const double distance = cs_number(settings, FOCAL_DISTANCE);
    key_direction(settings, sun);
    for (int c = 0; c < 3; c++) {
        sun[3 + c] = round(1e3 * key_radiance * CS_PI_DOUBLE) / 1e3;
        light[c] = cs_numbers(settings, EYE)[c];
        light[3 + c] = key_radiance * CS_PI_DOUBLE * distance * distance;
    }
    CS_TRY(cs_settings_set_text(settings, CS_INDEX_ENVIRONMENT, environment, error));
    CS_TRY(cs_settings_set(settings, CLSHEAR_SUN, sun, 7, error));
    if (eye_is_inside(scene, settings))
        CS_TRY(cs_settings_set(settings, CLSHEAR_LIGHT, light, 6, error));
done:
    return status;
}
