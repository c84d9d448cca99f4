#include "scene/material.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "kernels/bsdf/list.h"
#include "kernels/vector.h"

static const float mid_grey = 0.5f;

void cs_map_init(cs_map *map)
{
    *map = (cs_map){.image = CS_NO_IMAGE,
                    .across = {1, 0, 0},
                    .up = {0, 1, 0},
                    .use = {.kind = CS_TEXELS_DATA, .gain = 1.0f}};
}

void cs_material_init(cs_material_description *description, const char *name)
{
    *description = (cs_material_description){
        .base_colour = {mid_grey, mid_grey, mid_grey, 1.0f},
        .roughness = 1.0f,
        .ior = 1.5f,
        .attenuation_colour = {1.0f, 1.0f, 1.0f},
        .emissive_strength = 1.0f,
        .normal_scale = 1.0f,
        .alpha_cutoff = 0.5f,
    };
    snprintf(description->name, sizeof description->name, "%s", name);
    cs_map *maps[] = {&description->base_map,      &description->metallic_map,
                      &description->roughness_map, &description->emissive_map,
                      &description->normal_map,    &description->alpha_map};
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++)
        cs_map_init(maps[i]);
    description->base_map.use.kind = description->emissive_map.use.kind = CS_TEXELS_COLOUR;
    description->alpha_map.use.kind = CS_TEXELS_OPACITY;
}

static void append(char *text, size_t size, const char *word)
{
    const size_t used = strlen(text);
    snprintf(text + used, size - used, "%s%s", used > 0 ? ", " : "", word);
}

void cs_material_ask(cs_material_description *description, const char *name)
{
    if (strstr(description->other, name) != NULL) return;
    append(description->other, sizeof description->other, name);
}

int cs_map_is_used(const cs_map *map)
{
    return map->image != CS_NO_IMAGE || map->missing;
}

static int is_coloured(const float *colour)
{
    return colour[0] > 0.0f || colour[1] > 0.0f || colour[2] > 0.0f;
}

static void whiten(float *colour)
{
    if (!is_coloured(colour)) colour[0] = colour[1] = colour[2] = 1.0f;
}

void cs_material_whiten(cs_material_description *description)
{
    if (cs_map_is_used(&description->base_map)) whiten(description->base_colour);
    if (description->emissive_map.image != CS_NO_IMAGE) whiten(description->emissive);
}

void cs_material_reflect(cs_material_description *description, const float *colour)
{
    float *base = description->base_colour;
    if (!is_coloured(base) && !cs_map_is_used(&description->base_map)) {
        memcpy(base, colour, 3 * sizeof *base);
        description->metallic = 1.0f;
        return;
    }
    description->reflectance = cs_luminance(colour);
    description->grazing = description->reflectance > 0.0f ? 1.0f : 0.0f;
}

const cs_map *cs_material_placing(const cs_material_description *description)
{
    const cs_map *maps[] = {&description->base_map,     &description->roughness_map,
                            &description->metallic_map, &description->normal_map,
                            &description->emissive_map, &description->alpha_map};
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++)
        if (maps[i]->image != CS_NO_IMAGE) return maps[i];
    return NULL;
}

/* Whether a map wants other texture coordinates than the vertices have. */
static int is_apart(const cs_material_description *d, const cs_map *map)
{
    const cs_map *placing = cs_material_placing(d);
    if (map->image == CS_NO_IMAGE) return 0;
    int differs = map->set != placing->set;
    for (int i = 0; i < 3; i++)
        differs |= map->across[i] != placing->across[i] || map->up[i] != placing->up[i];
    return differs;
}

void cs_material_unsupported(const cs_material_description *d, char *text, size_t size)
{
    const int shines = is_coloured(d->emissive);
    const struct {
        int asked;
        const char *word;
    } table[] = {
        {d->metallic_map.missing || d->roughness_map.missing, "a gloss map"},
        {d->emissive_map.missing && shines, "textured emission (taken as even)"},
        {d->normal_map.missing, "a normal map"},
        {d->alpha_map.missing, "an opacity map"},
        {is_apart(d, &d->metallic_map) || is_apart(d, &d->roughness_map) ||
             is_apart(d, &d->normal_map) || is_apart(d, &d->alpha_map) ||
             (is_apart(d, &d->emissive_map) && shines),
         "texture coordinates that differ between its maps (those of the first count)"},
    };
    *text = '\0';
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (table[i].asked) append(text, size, table[i].word);
    if (d->other[0] != '\0') append(text, size, d->other);
}

/* Whether there is more than Lambert's surface. */
static int is_standard(const cs_material_description *d)
{
    return d->metallic > 0.0f || d->reflectance > 0.0f || d->grazing > 0.0f ||
           d->transmission > 0.0f || d->clearcoat > 0.0f || is_coloured(d->sheen_colour);
}

static float part(float value)
{
    return value > 0.0f ? fminf(value, 1.0f) : 0.0f; /* of NaN too */
}

/* What is within: it takes light away, and bends it by a finite index, whatever the file says. */
static void set_solid(const cs_material_description *d, cs_material *made)
{
    const float most_ior = 1e6f;
    float colour[3];
    for (int c = 0; c < 3; c++)
        colour[c] = part(d->attenuation_colour[c]);
    cs_standard_solid(fminf(d->ior, most_ior), colour, d->attenuation_distance, made);
}

static void set_standard(const cs_material_description *d, cs_material *made)
{
    float *p = made->parameters;
    made->bsdf = CS_BSDF_STANDARD;
    p[CS_PARAMETER_ROUGHNESS] = part(d->roughness);
    p[CS_PARAMETER_METALLIC] = part(d->metallic);
    p[CS_PARAMETER_F0] = part(d->reflectance);
    p[CS_PARAMETER_F90] = fmaxf(part(d->grazing), part(d->reflectance));
    p[CS_PARAMETER_TRANSMISSION] = part(d->transmission);
    p[CS_PARAMETER_COAT] = part(d->clearcoat);
    p[CS_PARAMETER_COAT_ROUGHNESS] = part(d->clearcoat_roughness);
    p[CS_PARAMETER_SHEEN_ROUGHNESS] = part(d->sheen_roughness);
    for (int c = 0; c < 3; c++) {
        p[CS_PARAMETER_SHEEN + c] = part(d->sheen_colour[c]);
        made->diffuse[c] = part(made->diffuse[c]);
    }
    if (d->thickness > 0.0f) set_solid(d, made);
}

static void set_alpha(const cs_material_description *d, int covers, cs_material *made)
{
    made->alpha = part(d->base_colour[3]);
    made->cutoff = d->alpha_cutoff > 0.0f ? fminf(d->alpha_cutoff, 2.0f) : 0.0f;
    if (covers && !d->fades &&
        (d->alpha_mode == CS_ALPHA_BLEND ? made->alpha == 1.0f : made->alpha >= made->cutoff))
        return; /* everywhere there */
    if (d->alpha_mode == CS_ALPHA_BLEND) made->flags |= CS_MATERIAL_BLEND;
    if (d->alpha_mode == CS_ALPHA_MASK) made->flags |= CS_MATERIAL_MASK;
}

static float limited_scale(float value)
{
    return fabsf(value) < 1e6f ? value : 1.0f; /* of NaN too */
}

cs_material cs_material_make(const cs_material_description *description,
                             const cs_material_textures *textures)
{
    const cs_material_description *d = description;
    cs_material made = {.texture = textures->base,
                        .normal_scale = limited_scale(d->normal_scale),
                        .normal_texture = (cs_u32)(textures->normal + 1)};
    for (int c = 0; c < 3; c++) {
        made.diffuse[c] = d->base_colour[c];
        if (cs_map_is_used(&d->base_map) && textures->base == CS_NO_TEXTURE)
            made.diffuse[c] = mid_grey;
        made.emission[c] = d->emissive[c] * d->emissive_strength;
        if (d->emissive_map.image != CS_NO_IMAGE && textures->emission == CS_NO_TEXTURE)
            made.emission[c] *= mid_grey;
    }
    set_alpha(d, textures->base == CS_NO_TEXTURE || textures->covers, &made);
    if (d->unlit) {
        made.flags |= CS_MATERIAL_UNLIT;
        made.normal_texture = 0;
        memset(made.emission, 0, sizeof made.emission);
        return made;
    }
    made.emission_texture = (cs_u32)(textures->emission + 1);
    if (!is_standard(d)) return made;
    made.facets_texture = (cs_u32)(textures->facets + 1);
    set_standard(d, &made);
    return made;
}
