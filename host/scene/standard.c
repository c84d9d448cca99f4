/* Materials as callers give them, and what they ask of the kernels. */
#include <math.h>
#include <string.h>

#include "kernels/bsdf/list.h"
#include "kernels/features.h"
#include "scene/scene.h"

void cs_standard_defaults(clshear_material *material)
{
    *material = (clshear_material){.struct_size = sizeof *material,
                                   .base_colour = {1.0f, 1.0f, 1.0f},
                                   .metallic = 1.0f,
                                   .roughness = 1.0f,
                                   .ior = 1.5f,
                                   .specular = 1.0f,
                                   .alpha = 1.0f,
                                   .alpha_mode = CLSHEAR_ALPHA_OPAQUE,
                                   .alpha_cutoff = 0.5f,
                                   .attenuation_colour = {1.0f, 1.0f, 1.0f}};
}

static clshear_status check(const clshear_material *material, cs_error *error)
{
    const struct {
        const char *name;
        float value;
    } parts[] = {{"metallic", material->metallic},
                 {"roughness", material->roughness},
                 {"specular", material->specular},
                 {"transmission", material->transmission},
                 {"alpha", material->alpha},
                 {"alpha_cutoff", material->alpha_cutoff},
                 {"clearcoat", material->clearcoat},
                 {"clearcoat_roughness", material->clearcoat_roughness},
                 {"sheen_roughness", material->sheen_roughness}};
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++)
        if (!(parts[i].value >= 0.0f && parts[i].value <= 1.0f))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "material: %s %g: must be 0 to 1",
                           parts[i].name, (double)parts[i].value);
    for (int c = 0; c < 3; c++)
        if (!(material->base_colour[c] >= 0.0f && material->base_colour[c] <= 1.0f) ||
            !(material->sheen_colour[c] >= 0.0f && material->sheen_colour[c] <= 1.0f))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "material: base_colour and sheen_colour must be 0 to 1");
    if (!cs_is_colour(material->emission))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "material: emission must be 0 to 1e15");
    if (!(material->ior >= 1.0f && material->ior <= 10.0f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "material: ior %g: must be 1 to 10",
                       (double)material->ior);
    for (int c = 0; c < 3; c++)
        if (!(material->attenuation_colour[c] >= 0.0f && material->attenuation_colour[c] <= 1.0f))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "material: attenuation_colour must be 0 to 1");
    if (!(material->attenuation_distance >= 0.0f && material->attenuation_distance <= 1e15f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "material: attenuation_distance %g: must be 0 to 1e15",
                       (double)material->attenuation_distance);
    if (material->alpha_mode < CLSHEAR_ALPHA_OPAQUE || material->alpha_mode > CLSHEAR_ALPHA_BLEND)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "material: alpha mode %d is not known",
                       (int)material->alpha_mode);
    return CLSHEAR_OK;
}

void cs_standard_solid(float ior, const float *attenuation_colour, float attenuation_distance,
                       cs_material *made)
{
    const float least_ior = 1.01f; /* below, floats lose the facets that bend light so little */
    const float darkest = 1e-6f;   /* black would be infinite absorption */
    if (ior < least_ior || !(made->parameters[CS_PARAMETER_TRANSMISSION] > 0.0f)) return;
    made->bsdf = CS_BSDF_GLASS;
    made->parameters[CS_PARAMETER_INDEX] = ior;
    for (int c = 0; c < 3 && attenuation_distance > 0.0f; c++)
        made->parameters[CS_PARAMETER_ABSORPTION + c] =
            -logf(fmaxf(attenuation_colour[c], darkest)) / fmaxf(attenuation_distance, 1e-15f);
}

clshear_status cs_standard_make(const clshear_material *material, cs_material *made,
                                cs_error *error)
{
    clshear_status status = check(material, error);
    if (status != CLSHEAR_OK) return status;
    const float edge = (material->ior - 1.0f) / (material->ior + 1.0f);
    *made = (cs_material){.texture = CS_NO_TEXTURE,
                          .bsdf = CS_BSDF_STANDARD,
                          .alpha = material->alpha,
                          .cutoff = material->alpha_cutoff,
                          .normal_scale = 1.0f};
    float *p = made->parameters;
    p[CS_PARAMETER_ROUGHNESS] = material->roughness;
    p[CS_PARAMETER_METALLIC] = material->metallic;
    p[CS_PARAMETER_F0] = material->specular * edge * edge;
    p[CS_PARAMETER_F90] = material->specular;
    p[CS_PARAMETER_TRANSMISSION] = material->transmission;
    p[CS_PARAMETER_COAT] = material->clearcoat;
    p[CS_PARAMETER_COAT_ROUGHNESS] = material->clearcoat_roughness;
    p[CS_PARAMETER_SHEEN_ROUGHNESS] = material->sheen_roughness;
    memcpy(p + CS_PARAMETER_SHEEN, material->sheen_colour, sizeof material->sheen_colour);
    memcpy(made->diffuse, material->base_colour, sizeof made->diffuse);
    if (!material->unlit) memcpy(made->emission, material->emission, sizeof made->emission);
    if (material->alpha_mode == CLSHEAR_ALPHA_MASK) made->flags |= CS_MATERIAL_MASK;
    if (material->alpha_mode == CLSHEAR_ALPHA_BLEND) made->flags |= CS_MATERIAL_BLEND;
    if (material->unlit) made->flags |= CS_MATERIAL_UNLIT;
    if (material->solid)
        cs_standard_solid(material->ior, material->attenuation_colour,
                          material->attenuation_distance, made);
    return CLSHEAR_OK;
}

clshear_status cs_scene_add_standard(cs_scene *scene, const clshear_material *material,
                                     uint32_t *number, cs_error *error)
{
    cs_material made;
    clshear_status status = cs_standard_make(material, &made, error);
    if (status != CLSHEAR_OK) return status;
    cs_material *added = cs_array_extend(&scene->materials, 1);
    if (added == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    *added = made;
    *number = (uint32_t)scene->materials.count;
    return CLSHEAR_OK;
}

/* Whether there are textures besides the base colour's. */
static int has_maps(const cs_material *material)
{
    return material->facets_texture > 0 || material->normal_texture > 0 ||
           material->emission_texture > 0;
}

int cs_material_is_textured(const cs_material *material)
{
    return material->texture != CS_NO_TEXTURE || has_maps(material);
}

/* What textures and colours of vertices ask of the kernels. */
static cs_u32 colouring_needs(const cs_scene *scene)
{
    const cs_texture *textures = scene->textures.items;
    cs_u32 features = scene->colours.count > 0 ? CS_FEATURE_COLOURS : 0;
    if (scene->textures.count > 0) features |= CS_FEATURE_TEXTURES;
    for (size_t i = 0; i < scene->textures.count; i++)
        if (textures[i].lookup != CS_TEXTURE_REPEAT) features |= CS_FEATURE_LOOKUPS;
    return features;
}

cs_material_needs cs_scene_material_needs(const cs_scene *scene)
{
    cs_material_needs needs = {.features = colouring_needs(scene)};
    const cs_material *materials = scene->materials.items;
    for (size_t i = 0; i < scene->materials.count; i++) {
        const cs_material *m = &materials[i];
        if (m->bsdf != CS_BSDF_LAMBERT || m->flags != 0 || has_maps(m))
            needs.features |= CS_FEATURE_MATERIALS | CS_FEATURE_PATHS;
        needs.see_through |= (m->flags & (CS_MATERIAL_BLEND | CS_MATERIAL_MASK)) != 0;
        needs.textured_emission |= m->emission_texture > 0;
    }
    return needs;
}
