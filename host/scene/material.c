#include "scene/material.h"

#include <stdio.h>
#include <string.h>

static const float mid_grey = 0.5f;

void cs_map_init(cs_map *map)
{
    *map = (cs_map){.image = CS_NO_IMAGE, .across = {1, 0, 0}, .up = {0, 1, 0}, .gain = 1.0f};
}

void cs_material_init(cs_material_description *description, const char *name)
{
    *description = (cs_material_description){
        .base_colour = {mid_grey, mid_grey, mid_grey, 1.0f},
        .roughness = 1.0f,
        .emissive_strength = 1.0f,
        .normal_scale = 1.0f,
        .alpha_cutoff = 0.5f,
        .ior = 1.5f,
    };
    snprintf(description->name, sizeof description->name, "%s", name);
    cs_map *maps[] = {
        &description->base_map,         &description->metallic_map,     &description->roughness_map,
        &description->emissive_map,     &description->normal_map,       &description->bump_map,
        &description->occlusion_map,    &description->displacement_map, &description->alpha_map,
        &description->transmission_map, &description->specular_map};
    for (size_t i = 0; i < sizeof maps / sizeof *maps; i++)
        cs_map_init(maps[i]);
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

static int is_mapped(const cs_map *map)
{
    return map->image != CS_NO_IMAGE || map->missing;
}

static int is_coloured(const float *colour)
{
    return colour[0] > 0.0f || colour[1] > 0.0f || colour[2] > 0.0f;
}

void cs_material_whiten(cs_material_description *description)
{
    float *base = description->base_colour;
    if (!is_mapped(&description->base_map) || is_coloured(base)) return;
    for (int c = 0; c < 3; c++)
        base[c] = 1.0f;
}

void cs_material_unsupported(const cs_material_description *d, char *text, size_t size)
{
    const struct {
        int asked;
        const char *word;
    } table[] = {
        {d->asks_gloss && d->metallic > 0.0f, "metal"},
        {d->asks_gloss && d->roughness < 1.0f, "gloss"},
        {is_coloured(d->specular) && d->shininess > 0.0f, "highlights"},
        {is_mapped(&d->metallic_map) || is_mapped(&d->roughness_map) || is_mapped(&d->specular_map),
         "a gloss map"},
        {is_mapped(&d->emissive_map), "textured emission (taken as even)"},
        {is_mapped(&d->normal_map), "a normal map"},
        {is_mapped(&d->bump_map), "a bump map"},
        {is_mapped(&d->displacement_map), "displacement"},
        {is_mapped(&d->occlusion_map), "an occlusion map"},
        {d->alpha_mode == CS_ALPHA_MASK, "a cut-out by alpha"},
        {d->alpha_mode == CS_ALPHA_BLEND || is_mapped(&d->alpha_map), "opacity"},
        {d->transmission > 0.0f || is_mapped(&d->transmission_map), "transmission"},
        {d->clearcoat > 0.0f, "clear coat"},
        {is_coloured(d->sheen_colour), "sheen"},
        {d->unlit, "no shading (unlit)"},
    };
    *text = '\0';
    for (size_t i = 0; i < sizeof table / sizeof *table; i++)
        if (table[i].asked) append(text, size, table[i].word);
    if (d->other[0] != '\0') append(text, size, d->other);
}

cs_material cs_material_make(const cs_material_description *description, cs_i32 texture)
{
    cs_material made = {.texture = texture};
    const float *base = description->base_colour;
    for (int c = 0; c < 3; c++) {
        made.diffuse[c] = base[c];
        if (is_mapped(&description->base_map) && texture == CS_NO_TEXTURE)
            made.diffuse[c] = mid_grey;
        made.emission[c] = description->emissive[c] * description->emissive_strength;
    }
    return made;
}
