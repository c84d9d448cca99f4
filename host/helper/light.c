#include "helper/light.h"

#include <assimp/commonMetaData.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/pi.h"
#include "helper/metadata.h"
#include "helper/node.h"

static int is_collada(const struct aiScene *file)
{
    return strcmp(cs_metadata_text(file, AI_METADATA_SOURCE_FORMAT), "Collada Importer") == 0;
}

/* Whether the lights of a file are those of Blender's exporter of FBX or Collada, in watts. Before
 * Blender 2.80 lights had a distance at which they are half as bright, as Assimp takes them. */
static int has_watts(const struct aiScene *file)
{
    const char *exporter = is_collada(file) ? "Blender " : "Blender (stable FBX IO) - ";
    const char *name = cs_metadata_text(file, AI_METADATA_SOURCE_GENERATOR);
    int major = 0, minor = 0;
    if (strncmp(name, exporter, strlen(exporter)) != 0) return 0;
    return sscanf(name + strlen(exporter), "%4d.%4d", &major, &minor) == 2 &&
           (major > 2 || (major == 2 && minor >= 80));
}

/* How many units of the scene are a metre: UnitScaleFactor of FBX is the unit in centimetres;
 * Assimp turns Collada's units into metres. */
static double units_of_metre(const struct aiScene *file)
{
    if (is_collada(file)) return 1.0;
    const double unit = cs_metadata_number(file, "UnitScaleFactor", 1.0);
    return unit > 0.0 && isfinite(unit) ? 100.0 / unit : 100.0;
}

/* Sets the angles of a spot that has as much light as Blender's. Blender's light falls in the part
 * `blend` of the cosines, smoothly, which leaves half of the light there; ours falls by the square,
 * which leaves a third. */
static void blend_cone(double outer_angle, double blend, float cone[2])
{
    const double outer = cos(outer_angle);
    cone[0] = (float)acos(outer + 0.75 * fmin(fmax(blend, 0.0), 1.0) * (1.0 - outer));
    cone[1] = (float)outer_angle;
}

/* In Collada, Assimp has the outer angle as the inner one, and adds to it the angle whose cosine,
 * to the power of `blend`, is a tenth: a right angle, within the digits, if `blend` is small. */
static double blend_of_collada(const float cone[2])
{
    const double least = 0.2, usual = 0.15; /* Blender's own */
    const double blend = log(0.1) / log(cos(2.0 * ((double)cone[1] - (double)cone[0])));
    return blend >= least ? blend : usual;
}

/* In FBX, the inner angle is the part `1 - blend` of the outer one. */
static void take_cone(const struct aiScene *file, cs_model_light *light)
{
    float *cone = light->cone;
    if (is_collada(file))
        blend_cone((double)cone[0], blend_of_collada(cone), cone);
    else if (cone[1] > 0.0f)
        blend_cone((double)cone[1], 1.0 - (double)cone[0] / (double)cone[1], cone);
}

/* Makes watts of a light in all directions, which Blender shows as the brightness of points and
 * spots, radiant intensity in the file's units. They always fade with the squared distance,
 * whatever the file says. Of a sun, Blender's number is its irradiance. */
static void take_watts(const struct aiScene *file, const struct aiLight *source,
                       cs_model_light *light)
{
    const double metre = units_of_metre(file), scale = metre * metre / (4.0 * CS_PI_DOUBLE);
    const float colour[3] = {source->mColorDiffuse.r, source->mColorDiffuse.g,
                             source->mColorDiffuse.b};
    memset(light->fading, 0, sizeof light->fading);
    for (int c = 0; c < 3; c++)
        light->colour[c] = (float)((double)colour[c] * scale);
    if (light->kind == CS_MODEL_SPOT) take_cone(file, light);
}

static int take_kind(const struct aiLight *source, cs_model_light *light)
{
    light->kind = CS_MODEL_POINT;
    if (source->mType == aiLightSource_DIRECTIONAL) light->kind = CS_MODEL_DIRECTIONAL;
    if (source->mType == aiLightSource_SPOT) light->kind = CS_MODEL_SPOT;
    return light->kind != CS_MODEL_POINT || source->mType == aiLightSource_POINT;
}

/* Collada's lights fade as the file says. Of other formats Assimp has no more than the square: its
 * constant is a distance in FBX, and it fades linearly where the file says nothing. A light that
 * does not fade otherwise does not fade. */
static void take_fading(const struct aiScene *file, const struct aiLight *source,
                        cs_model_light *light)
{
    const float fading[3] = {source->mAttenuationConstant, source->mAttenuationLinear,
                             source->mAttenuationQuadratic};
    double sum = 0.0;
    for (int i = is_collada(file) ? 0 : 2; i < 3; i++) {
        light->fading[i] = fading[i] > 0.0f && isfinite(fading[i]) ? (double)fading[i] : 0.0;
        sum += light->fading[i];
    }
    if (!(sum > 0.0)) light->fading[0] = 1.0;
}

int cs_light_read(const struct aiScene *file, const struct aiLight *source, cs_model_light *light)
{
    const struct aiMatrix4x4 matrix = cs_node_matrix(file, source->mName.data);
    memset(light, 0, sizeof *light);
    snprintf(light->name, sizeof light->name, "%.*s", CS_MODEL_NAME - 1, source->mName.data);
    if (!take_kind(source, light)) return 0;
    if (light->kind != CS_MODEL_DIRECTIONAL) take_fading(file, source, light);
    cs_node_transform(&matrix, &source->mPosition, 1.0, light->position);
    cs_node_transform(&matrix, &source->mDirection, 0.0, light->axis);
    light->cone[0] = 0.5f * source->mAngleInnerCone;
    light->cone[1] = 0.5f * source->mAngleOuterCone;
    light->colour[0] = source->mColorDiffuse.r;
    light->colour[1] = source->mColorDiffuse.g;
    light->colour[2] = source->mColorDiffuse.b;
    if (light->kind != CS_MODEL_DIRECTIONAL && has_watts(file)) take_watts(file, source, light);
    return 1;
}
