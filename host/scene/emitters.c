/* The table of emissive triangles. */
#include "scene/emitters.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec.h"
#include "kernels/vector.h"
#include "scene/emission_map.h"

static double area_of(const cs_scene *scene, size_t triangle)
{
    const uint32_t *corner = ((const uint32_t(*)[3])scene->indices.items)[triangle];
    const float(*positions)[3] = scene->positions.items;
    double e1[3], e2[3], normal[3];
    cs_vec_subtract_double(positions[corner[1]], positions[corner[0]], e1);
    cs_vec_subtract_double(positions[corner[2]], positions[corner[0]], e2);
    cs_vec_cross_double(e1, e2, normal);
    return 0.5 * sqrt(cs_vec_dot_double(normal, normal));
}

/* The mean of a triangle's emissive texture, by the box around its texture coordinates. */
static double mean_of_map(const cs_scene *scene, size_t triangle, const cs_emission_map *map)
{
    const uint32_t *corner = ((const uint32_t(*)[3])scene->indices.items)[triangle];
    const cs_vertex *vertices = scene->vertices.items;
    float low[2], high[2];
    for (int i = 0; i < 2; i++) {
        const float a = vertices[corner[0]].texture[i], b = vertices[corner[1]].texture[i],
                    c = vertices[corner[2]].texture[i];
        low[i] = fminf(a, fminf(b, c));
        high[i] = fmaxf(a, fmaxf(b, c));
    }
    return cs_emission_map_mean(map, low, high);
}

/* Fills in one emitter. part: by which a texture lessens its mean radiance. */
static void describe(const cs_scene *scene, size_t triangle, double part, cs_emitter *emitter)
{
    const uint32_t *corner = ((const uint32_t(*)[3])scene->indices.items)[triangle];
    const float(*positions)[3] = scene->positions.items;
    emitter->face = (uint32_t)triangle;
    emitter->material = ((const uint32_t *)scene->triangle_materials.items)[triangle];
    const cs_material *look = (const cs_material *)scene->materials.items + emitter->material;
    const uint8_t flags = ((const uint8_t *)scene->triangle_flags.items)[triangle];
    const int mapped = flags & CS_FACE_TEXTURED;
    memcpy(emitter->corner, positions[corner[0]], sizeof emitter->corner);
    memcpy(emitter->radiance, look->emission, sizeof emitter->radiance);
    cs_vec_subtract(positions[corner[1]], positions[corner[0]], emitter->edge1);
    cs_vec_subtract(positions[corner[2]], positions[corner[0]], emitter->edge2);
    emitter->area = (float)area_of(scene, triangle);
    emitter->luminance = (float)((double)cs_luminance(look->emission) * part);
    if (look->flags & (CS_MATERIAL_BLEND | CS_MATERIAL_MASK)) emitter->varies |= CS_EMITTER_COVERS;
    if (mapped && (look->emission_texture > 0 || emitter->varies))
        emitter->varies |= CS_EMITTER_TEXTURED;
    if (emitter->varies && (flags & CS_FACE_COLOURED)) emitter->varies |= CS_EMITTER_COLOURED;
}

/* Appends a triangle if it shines. maps: of the scene's textures, made when they are wanted. */
static clshear_status append(const cs_scene *scene, size_t triangle, cs_emission_map *maps,
                             cs_array *table, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const uint32_t material = ((const uint32_t *)scene->triangle_materials.items)[triangle];
    const cs_material *look = (const cs_material *)scene->materials.items + material;
    const int mapped = ((const uint8_t *)scene->triangle_flags.items)[triangle] & CS_FACE_TEXTURED;
    double part = 1.0;
    if (!(cs_luminance(look->emission) > 0.0f) || look->flags & CS_MATERIAL_UNLIT)
        return CLSHEAR_OK;
    if (mapped && look->emission_texture > 0) {
        const cs_u32 index = look->emission_texture - 1;
        const cs_texture *texture = (const cs_texture *)scene->textures.items + index;
        if (maps[index].sums == NULL)
            CS_TRY(cs_emission_map_make(scene, texture, &maps[index], error));
        part = mean_of_map(scene, triangle, &maps[index]);
    }
    if (!((float)((double)cs_luminance(look->emission) * part) > 0.0f)) return CLSHEAR_OK;
    cs_emitter *emitter = cs_array_extend(table, 1);
    CS_REQUIRE(emitter != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for emissive triangles");
    describe(scene, triangle, part, emitter);
done:
    return status;
}

/* Probabilities in proportion to power, of emitters whose radiance does not vary. */
static void tabulate(cs_emitters *emitters)
{
    cs_emitter *table = emitters->table.items;
    double below = 0.0;
    for (size_t i = 0; i < emitters->table.count; i++) {
        if (table[i].varies) continue;
        emitters->even++;
        emitters->power += (double)table[i].area * (double)table[i].luminance;
    }
    for (size_t i = 0; i < emitters->table.count && emitters->even > 0; i++) {
        if (!table[i].varies) below += (double)table[i].area * (double)table[i].luminance;
        table[i].cumulative = (float)(below / emitters->power);
        /* As the search in the rounded table finds it, so that the estimate stays unbiased. */
        table[i].probability = table[i].cumulative - (i > 0 ? table[i - 1].cumulative : 0.0f);
    }
}

/* Luminance that the whole scene's surfaces emit, a unit of their area. */
static double mean_light(const cs_scene *scene, const cs_array *table)
{
    const cs_emitter *all = table->items;
    double emitted = 0.0, area = 0.0;
    for (size_t i = 0; i < table->count; i++)
        emitted += (double)all[i].area * (double)all[i].luminance;
    for (size_t i = 0; i < scene->indices.count && table->count > 0; i++)
        area += area_of(scene, i);
    return area > 0.0 ? emitted / area : 0.0;
}

clshear_status cs_emitters_make(const cs_scene *scene, cs_emitters *emitters, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t textures = scene->textures.count;
    cs_emission_map *maps = calloc(textures + 1, sizeof *maps);
    emitters->table.item_size = sizeof(cs_emitter);
    emitters->nodes.item_size = sizeof(cs_emitter_node);
    CS_REQUIRE(maps != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t i = 0; i < scene->indices.count; i++)
        CS_TRY(append(scene, i, maps, &emitters->table, error));
    tabulate(emitters);
    emitters->light = mean_light(scene, &emitters->table);
    if (emitters->table.count > 0)
        CS_TRY(cs_emitter_tree_build(scene, &emitters->table, &emitters->nodes, error));
done:
    for (size_t i = 0; i < textures && maps != NULL; i++)
        cs_emission_map_free(&maps[i]);
    free(maps);
    return status;
}

void cs_emitters_free(cs_emitters *emitters)
{
    cs_array_free(&emitters->table);
    cs_array_free(&emitters->nodes);
}

void cs_emitters_number(const cs_emitters *emitters, cs_triangle *triangles, size_t count)
{
    const cs_emitter *table = emitters->table.items;
    for (size_t i = 0; i < count && emitters->table.count > 0; i++) {
        size_t low = 0, high = emitters->table.count - 1;
        while (low < high) {
            const size_t middle = (low + high) / 2;
            if (table[middle].face < triangles[i].face)
                low = middle + 1;
            else
                high = middle;
        }
        triangles[i].emitter = table[low].face == triangles[i].face ? (cs_u32)low + 1 : 0;
    }
}
