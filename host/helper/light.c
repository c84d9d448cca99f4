#include "helper/light.h"

#include <assimp/commonMetaData.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/pi.h"
#include "helper/node.h"

static const struct aiMetadataEntry *find_entry(const struct aiScene *file, const char *key)
{
    const struct aiMetadata *all = file->mMetaData;
    for (unsigned i = 0; all != NULL && i < all->mNumProperties; i++)
        if (strcmp(all->mKeys[i].data, key) == 0) return &all->mValues[i];
    return NULL;
}

/* Whether the lights of an FBX file are those of Blender's exporter, in watts. Before Blender 2.80
 * lights had a distance at which they are half as bright, as Assimp takes them. */
static int has_watts(const struct aiScene *file)
{
    static const char exporter[] = "Blender (stable FBX IO) - ";
    const struct aiMetadataEntry *entry = find_entry(file, AI_METADATA_SOURCE_GENERATOR);
    int major = 0, minor = 0;
    if (entry == NULL || entry->mType != AI_AISTRING) return 0;
    const char *name = ((const struct aiString *)entry->mData)->data;
    if (strncmp(name, exporter, sizeof exporter - 1) != 0) return 0;
    return sscanf(name + sizeof exporter - 1, "%4d.%4d", &major, &minor) == 2 &&
           (major > 2 || (major == 2 && minor >= 80));
}

/* How many of an FBX file's units are a metre: UnitScaleFactor is the unit in centimetres. */
static double units_of_metre(const struct aiScene *file)
{
    const struct aiMetadataEntry *entry = find_entry(file, "UnitScaleFactor");
    double unit = 1.0;
    if (entry != NULL && entry->mType == AI_FLOAT) unit = (double)*(const float *)entry->mData;
    if (entry != NULL && entry->mType == AI_DOUBLE) unit = *(const double *)entry->mData;
    return unit > 0.0 && isfinite(unit) ? 100.0 / unit : 100.0;
}

/* The inner angle of a spot with as much light as Blender's has. Blender's inner angle is the part
 * `1 - blend` of the outer one, but its light falls in the part `blend` of the cosines, smoothly,
 * which leaves half of the light there; ours falls by the square, which leaves a third. */
static float inner_of_blend(const float cone[2])
{
    if (!(cone[1] > 0.0f)) return cone[0];
    const double blend = fmin(fmax(1.0 - (double)cone[0] / (double)cone[1], 0.0), 1.0);
    const double outer = cos((double)cone[1]);
    return (float)acos(outer + 0.75 * blend * (1.0 - outer));
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
    light->is_even = 0;
    for (int c = 0; c < 3; c++)
        light->colour[c] = (float)((double)colour[c] * scale);
    if (light->kind == CS_MODEL_SPOT) light->cone[0] = inner_of_blend(light->cone);
}

static int take_kind(const struct aiLight *source, cs_model_light *light)
{
    light->kind = CS_MODEL_POINT;
    if (source->mType == aiLightSource_DIRECTIONAL) light->kind = CS_MODEL_DIRECTIONAL;
    if (source->mType == aiLightSource_SPOT) light->kind = CS_MODEL_SPOT;
    return light->kind != CS_MODEL_POINT || source->mType == aiLightSource_POINT;
}

int cs_light_read(const struct aiScene *file, const struct aiLight *source, cs_model_light *light)
{
    const struct aiMatrix4x4 matrix = cs_node_matrix(file, source->mName.data);
    double fade = (double)source->mAttenuationQuadratic;
    memset(light, 0, sizeof *light);
    snprintf(light->name, sizeof light->name, "%.*s", CS_MODEL_NAME - 1, source->mName.data);
    if (!take_kind(source, light)) return 0;
    light->is_even = light->kind != CS_MODEL_DIRECTIONAL && !(fade > 0.0);
    if (light->kind == CS_MODEL_DIRECTIONAL || light->is_even) fade = 1.0;
    cs_node_transform(&matrix, &source->mPosition, 1.0, light->position);
    cs_node_transform(&matrix, &source->mDirection, 0.0, light->axis);
    light->cone[0] = 0.5f * source->mAngleInnerCone;
    light->cone[1] = 0.5f * source->mAngleOuterCone;
    light->colour[0] = source->mColorDiffuse.r / (float)fade;
    light->colour[1] = source->mColorDiffuse.g / (float)fade;
    light->colour[2] = source->mColorDiffuse.b / (float)fade;
    if (light->kind != CS_MODEL_DIRECTIONAL && has_watts(file)) take_watts(file, source, light);
    return 1;
}
