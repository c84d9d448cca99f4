#include "render/studio.h"

#include <math.h>
#include <stdlib.h>

#include "base/pi.h"
#include "base/vec.h"
#include "render/interior.h"
#include "render/lighting.h"

/* A white surface that faces the sun shows 1: 0.4 by the environment, 0.6 by the sun. */
static const char *const environment = "0.4,0.4,0.4";
static const double key_radiance = 0.6;
static const double key_diameter_deg = 10.0;

/* Emission that varies over surfaces is often a screen or a label, which leaves a scene dark: it
 * counts as light if all surfaces together emit this radiance in the mean. */
static const double least_light = 0.2;

/* Below this part of all directions without a surface, the eye is inside. */
static const float least_sky = 0.25f;

/* Where the light in the eye makes a surface of albedo 0.5 white, as a part of lit_distance. */
static const double least_part = 0.55;

enum {
    LIT_PLACES = 16 /* along each side of the picture */
};

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

/* The camera's place, relative to the scene's origin, and its axes, unit vectors. */
typedef struct stand {
    double eye[3], ahead[3], right[3], up[3];
} stand;

static stand stand_of(const clshear_scene *scene, const clshear_settings *settings)
{
    stand at;
    for (int i = 0; i < 3; i++) {
        at.eye[i] = cs_numbers(settings, EYE)[i] - scene->scene.origin[i];
        at.ahead[i] = cs_numbers(settings, TARGET)[i] - cs_numbers(settings, EYE)[i];
    }
    normalise(at.ahead);
    cs_vec_cross_double(at.ahead, cs_numbers(settings, UP), at.right);
    normalise(at.right);
    cs_vec_cross_double(at.right, at.ahead, at.up);
    return at;
}

/* Towards the sun: left of the camera, above it, and behind it. */
static void key_direction(const stand *at, double *towards)
{
    for (int i = 0; i < 3; i++)
        towards[i] = -0.6 * at->right[i] + 0.8 * at->up[i] - 0.9 * at->ahead[i];
    normalise(towards);
    for (int i = 0; i < 3; i++) /* few digits, to be copied */
        towards[i] = round(1e3 * towards[i]) / 1e3;
}

/* Whether the eye sees too little of the sky for that to light what is around. */
static int eye_is_inside(const clshear_scene *scene, const stand *at)
{
    const float eye[3] = {(float)at->eye[0], (float)at->eye[1], (float)at->eye[2]};
    return cs_interior_sky(scene, eye) < least_sky;
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The distance at which the light in the eye shows what it would show in the open: the geometric
 * mean of those in the middle of the picture, but so near that nine tenths of what is seen there do
 * not burn; `otherwise` if nothing is seen. */
static double lit_distance(const clshear_scene *scene, const clshear_settings *settings,
                           const stand *at, double otherwise)
{
    const float eye[3] = {(float)at->eye[0], (float)at->eye[1], (float)at->eye[2]};
    const double half = tan(cs_number(settings, FOV) * CS_PI_DOUBLE / 360.0);
    double distances[LIT_PLACES * LIT_PLACES], logarithms = 0.0;
    size_t count = 0;
    for (int k = 0; k < LIT_PLACES * LIT_PLACES; k++) {
        const int column = k % LIT_PLACES, row = k / LIT_PLACES;
        const double x = half * (2.0 * (column + 0.5) / LIT_PLACES - 1.0);
        const double y = half * (2.0 * (row + 0.5) / LIT_PLACES - 1.0);
        double direction[3];
        for (int i = 0; i < 3; i++)
            direction[i] = at->ahead[i] + x * at->right[i] + y * at->up[i];
        normalise(direction);
        const float towards[3] = {(float)direction[0], (float)direction[1], (float)direction[2]};
        const double distance = (double)cs_interior_distance(scene, eye, towards);
        if (!isfinite(distance)) continue;
        logarithms += log(distance);
        distances[count++] = distance;
    }
    if (count == 0) return otherwise;
    qsort(distances, count, sizeof *distances, compare_doubles);
    return fmin(exp(logarithms / (double)count), distances[count / 10] / least_part);
}

clshear_status cs_studio_complete(const clshear_scene *scene, clshear_settings *settings,
                                  cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    double sun[7] = {[6] = key_diameter_deg}, light[6];
    if (has_light(scene, settings)) return CLSHEAR_OK;
    const stand at = stand_of(scene, settings);
    const double distance = lit_distance(scene, settings, &at, cs_number(settings, FOCAL_DISTANCE));
    key_direction(&at, sun);
    for (int c = 0; c < 3; c++) {
        sun[3 + c] = round(1e3 * key_radiance * CS_PI_DOUBLE) / 1e3;
        light[c] = cs_numbers(settings, EYE)[c];
        light[3 + c] = key_radiance * CS_PI_DOUBLE * distance * distance;
    }
    CS_TRY(cs_settings_set_text(settings, CS_INDEX_ENVIRONMENT, environment, error));
    CS_TRY(cs_settings_set(settings, CLSHEAR_SUN, sun, 7, error));
    if (eye_is_inside(scene, &at))
        CS_TRY(cs_settings_set(settings, CLSHEAR_LIGHT, light, 6, error));
done:
    return status;
}
