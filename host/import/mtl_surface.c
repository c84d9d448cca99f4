#include "import/mtl_surface.h"

#include <math.h>
#include <string.h>

#include "kernels/vector.h"

void mtl_values_init(mtl_values *values)
{
    *values = (mtl_values){.highlight = {-1, -1, -1},
                           .exponent = -1,
                           .ior = -1,
                           .opacity = -1,
                           .transparency = -1,
                           .filter = {-1, -1, -1},
                           .roughness = -1,
                           .metallic = -1,
                           .ambient = {-1, -1, -1},
                           .model = -1};
}

static float limited(float value, float most)
{
    return value > 0.0f ? fminf(value, most) : 0.0f;
}

/* Illumination models of the MTL specification: those with mirrors, those with glass, and of these
 * the ones that refract. */
static int is_mirror(int model)
{
    return model == 3 || model == 5 || model == 8;
}

static int is_glass(int model)
{
    return model == 4 || model == 6 || model == 7 || model == 9;
}

static int refracts(int model)
{
    return model == 6 || model == 7;
}

/* Fresnel's reflectance, met head-on. An index of 1 or less is what exporters leave there. */
static float reflectance_of(float ior)
{
    const float index = ior > 1.0f && ior < 10.0f ? ior : 1.5f, edge = (index - 1) / (index + 1);
    return edge * edge;
}

/* Opacity; `d` counts before `Tr`, with which it is often confused. */
static float opacity_of(const mtl_values *values)
{
    if (values->opacity >= 0.0f) return limited(values->opacity, 1.0f);
    if (values->transparency >= 0.0f) return 1.0f - limited(values->transparency, 1.0f);
    return 1.0f;
}

/* Glass lets pass what its opacity leaves, in the colour of the filter, which is white where the
 * file gives none. Exporters write model 4 for everything, so that an opaque material is glass only
 * if it refracts. */
static int make_glass(const mtl_values *values, float opacity, cs_material_description *material)
{
    if (!is_glass(values->model) || cs_map_is_used(&material->alpha_map)) return 0;
    if (opacity == 1.0f && !(refracts(values->model) && values->ior > 1.0f)) return 0;
    const float through = opacity < 1.0f ? 1.0f - opacity : 1.0f;
    const int has_filter =
        values->filter[0] > 0.0f || values->filter[1] > 0.0f || values->filter[2] > 0.0f;
    for (int c = 0; c < 3; c++) {
        const float passed = has_filter ? limited(values->filter[c], 1.0f) : 1.0f;
        material->base_colour[c] += through * (passed - material->base_colour[c]);
    }
    material->transmission = through;
    material->reflectance = reflectance_of(values->ior);
    material->grazing = 1.0f;
    material->roughness = values->roughness >= 0.0f ? values->roughness : 0.0f;
    return 1;
}

static void make_see_through(float opacity, cs_material_description *material)
{
    material->base_colour[3] = opacity;
    if (opacity < 1.0f || cs_map_is_used(&material->alpha_map))
        material->alpha_mode = CS_ALPHA_BLEND;
}

/* A highlight is the reflection of a dielectric, as Blender's importer takes it: 8 % of Ks, so that
 * the 0.5 that exporters leave there is glTF's 4 %. */
static void make_highlight(const mtl_values *values, cs_material_description *material)
{
    const float grey = limited(cs_luminance(values->highlight), 1.0f);
    material->reflectance = 0.08f * grey;
    material->grazing = fminf(2.0f * grey, 1.0f);
}

/* The physical numbers (Pr, Pm, ...) are glTF's. */
static int is_physical(const mtl_values *values, const cs_material_description *material)
{
    return values->roughness >= 0.0f || values->metallic >= 0.0f ||
           cs_map_is_used(&material->metallic_map) ||
           (cs_map_is_used(&material->roughness_map) &&
            material->roughness_map.use.kind == CS_TEXELS_DATA);
}

static void make_physical(const mtl_values *values, cs_material_description *material)
{
    if (values->highlight[0] >= 0.0f) {
        make_highlight(values, material);
    } else {
        material->reflectance = reflectance_of(values->ior);
        material->grazing = 1.0f;
    }
    if (values->roughness >= 0.0f) material->roughness = values->roughness;
    material->metallic = cs_map_is_used(&material->metallic_map) ? 1.0f : 0.0f;
    if (values->metallic >= 0.0f) material->metallic = values->metallic;
}

/* A map of exponents multiplies Ns, and becomes roughnesses when it is read. */
static void set_gloss(const mtl_values *values, float without, cs_material_description *material)
{
    cs_map *map = &material->roughness_map;
    material->roughness =
        values->exponent > 0.0f ? cs_roughness_of_exponent(values->exponent) : without;
    if (map->use.kind != CS_TEXELS_GLOSS) return;
    const float most = values->exponent > 0.0f ? values->exponent : 1.0f;
    map->use.base *= most;
    map->use.gain *= most;
    if (map->image != CS_NO_IMAGE) material->roughness = 1.0f;
}

static int is_black(const float *colour)
{
    return !(colour[0] > 0.0f || colour[1] > 0.0f || colour[2] > 0.0f);
}

/* Blender from 2.80 on writes metals as mirrors with their metalness as Ka, and 1.45 as Ni. Before,
 * Ka was the colour of the mirror, Ks that of highlights, and Ni was 1. */
static mtl_values take_blender(const mtl_values *written)
{
    mtl_values values = *written;
    if (!(values.blender_most > 0.0f) || values.model != 3) return values;
    if (!(values.ambient[0] >= 0.0f)) return values;
    if (!(values.ior > 1.0f)) {
        memcpy(values.highlight, values.ambient, sizeof values.highlight);
        return values;
    }
    if (values.metallic < 0.0f) values.metallic = limited(values.ambient[0], 1.0f);
    if (values.roughness < 0.0f && values.exponent >= 0.0f)
        values.roughness = 1.0f - sqrtf(limited(values.exponent / values.blender_most, 1.0f));
    return values;
}

int mtl_make_surface(const mtl_values *written, cs_material_description *material)
{
    const mtl_values all = take_blender(written), *values = &all;
    const float opacity = opacity_of(values);
    const int model = values->model;
    if (!values->has_colour && cs_map_is_used(&material->base_map))
        material->base_colour[0] = material->base_colour[1] = material->base_colour[2] = 1.0f;
    if (make_glass(values, opacity, material)) return 0;
    const int is_turned = opacity == 0.0f && values->opacity < 0.0f;
    make_see_through(is_turned ? 1.0f : opacity, material);
    if (is_physical(values, material)) {
        set_gloss(values, 0.5f, material);
        make_physical(values, material);
    } else if (is_mirror(model) && !is_black(values->highlight)) {
        float colour[3];
        for (int c = 0; c < 3; c++)
            colour[c] = limited(values->highlight[c], 1.0f);
        set_gloss(values, 0.0f, material);
        cs_material_reflect(material, colour);
        if (model == 5 && material->metallic == 0.0f)
            material->reflectance = reflectance_of(values->ior);
    } else if (model != 0 && model != 1 && !is_black(values->highlight) &&
               values->exponent > 0.0f) {
        set_gloss(values, 1.0f, material);
        make_highlight(values, material);
    }
    return is_turned;
}
