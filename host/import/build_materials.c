/* Materials of a model, their textures, and what is said of them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import/build_parts.h"
#include "scene/texture.h"

enum {
    MOST_NAMES = 4 /* of materials in one line */
};

/* An image that was read, or could not be. */
typedef struct loaded {
    int image;
    float base, gain;
    cs_i32 texture; /* that repeats, or CS_NO_TEXTURE */
} loaded;

static void make_colour(float *colour, const cs_model *model, const char *what, const char *name)
{
    if (!cs_is_colour(colour)) {
        cs_warn(model->log,
                "%s: %s \"%s\" has the colour %g %g %g, which must be 0 to 1e15; taken as 0",
                model->path, what, name, (double)colour[0], (double)colour[1], (double)colour[2]);
        colour[0] = colour[1] = colour[2] = 0.0f;
    }
}

/* Warns of surfaces that give more light than they get. */
static void check_albedo(const cs_model *model, const cs_material_description *material)
{
    const float *c = material->base_colour;
    if (c[0] > 1.0f || c[1] > 1.0f || c[2] > 1.0f)
        cs_warn(model->log,
                "%s: material \"%s\" has the colour %g %g %g: above 1 it reflects more light than "
                "arrives; kept",
                model->path, material->name, (double)c[0], (double)c[1], (double)c[2]);
}

static clshear_status read_image(const cs_model *model, cs_scene *scene, loaded *one,
                                 cs_error *error)
{
    const cs_image_source *source = (const cs_image_source *)model->images.items + one->image;
    cs_error reason;
    if (source->bytes == NULL && *source->path == '\0') {
        cs_warn(model->log, "%s: texture %s is not there; it is mid-grey", model->path,
                source->label);
        return CLSHEAR_OK;
    }
    clshear_status status =
        cs_texture_add(scene, source->path, source->label, source->bytes, source->size, one->base,
                       one->gain, &one->texture, &reason);
    if (status == CLSHEAR_OUT_OF_MEMORY)
        return cs_fail(error, status, "%s: %s", model->path, reason.message);
    if (status != CLSHEAR_OK)
        cs_warn(model->log, "%s: texture %s; it is mid-grey", model->path, reason.message);
    return CLSHEAR_OK;
}

static clshear_status find_texture(const cs_model *model, cs_scene *scene, const cs_map *map,
                                   cs_array *known, cs_i32 *texture, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    *texture = CS_NO_TEXTURE;
    if (map->image == CS_NO_IMAGE) return CLSHEAR_OK;
    loaded *one = known->items;
    size_t i = 0;
    while (i < known->count &&
           (one[i].image != map->image || one[i].base != map->base || one[i].gain != map->gain))
        i++;
    if (i == known->count) {
        one = cs_array_extend(known, 1);
        if (one == NULL) return cs_model_full(model, error);
        *one = (loaded){map->image, map->base, map->gain, CS_NO_TEXTURE};
        status = read_image(model, scene, one, error);
        one = known->items;
    }
    *texture = one[i].texture;
    if (status != CLSHEAR_OK || *texture == CS_NO_TEXTURE) return status;
    return cs_texture_wrapped(scene, (cs_u32)map->wrap[0], (cs_u32)map->wrap[1], texture, error);
}

/* One line for all materials that ask for the same things; `done` marks those that are named. */
static void report_alike(const cs_model *model, size_t first, char *done)
{
    const cs_material_description *all = model->materials.items;
    char asked[256], other[256], names[512] = "";
    size_t count = 0;
    cs_material_unsupported(&all[first], asked, sizeof asked);
    if (*asked == '\0') return;
    for (size_t i = first; i < model->materials.count; i++) {
        if (done[i]) continue;
        cs_material_unsupported(&all[i], other, sizeof other);
        if (strcmp(asked, other) != 0) continue;
        done[i] = 1;
        const size_t used = strlen(names);
        if (count++ < MOST_NAMES)
            snprintf(names + used, sizeof names - used, "%s\"%.60s\"", used > 0 ? ", " : "",
                     all[i].name);
    }
    char more[32] = "";
    if (count > MOST_NAMES) snprintf(more, sizeof more, " and %zu more", count - MOST_NAMES);
    cs_warn(model->log, "%s: material%s %s%s: not supported, left out: %s", model->path,
            count > 1 ? "s" : "", names, more, asked);
}

static void report_unsupported(const cs_model *model)
{
    char *done = calloc(model->materials.count + 1, 1);
    for (size_t i = 0; i < model->materials.count && done != NULL; i++)
        if (!done[i]) report_alike(model, i, done);
    free(done);
}

void cs_report_plain(const cs_model *model, const size_t *plain)
{
    const cs_material_description *all = model->materials.items;
    for (size_t i = 0; i < model->materials.count; i++)
        if (plain[i] > 0)
            cs_warn(model->log,
                    "%s: material \"%s\" has a texture, but %zu of its triangles have no texture "
                    "coordinates; they have its plain colour",
                    model->path, all[i].name, plain[i]);
}

/* The default for triangles without a material, if there are any. */
static clshear_status add_default(cs_model *model, cs_error *error)
{
    cs_model_triangle *triangles = model->triangles.items;
    uint32_t number = CS_NO_INDEX;
    for (size_t i = 0; i < model->triangles.count; i++) {
        if (triangles[i].material < model->materials.count) continue;
        if (number == CS_NO_INDEX) {
            number = (uint32_t)model->materials.count;
            cs_material_description *added = cs_model_extend(&model->materials, 1);
            if (added == NULL) return cs_model_full(model, error);
            cs_material_init(added, "default");
        }
        triangles[i].material = number;
    }
    return CLSHEAR_OK;
}

clshear_status cs_build_materials(cs_model *model, cs_scene *scene, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array known = {.item_size = sizeof(loaded)};
    CS_TRY(add_default(model, error));
    cs_material_description *all = model->materials.items;
    for (size_t i = 0; i < model->materials.count; i++) {
        cs_i32 texture = CS_NO_TEXTURE;
        make_colour(all[i].base_colour, model, "material", all[i].name);
        make_colour(all[i].emissive, model, "material", all[i].name);
        check_albedo(model, &all[i]);
        CS_TRY(find_texture(model, scene, &all[i].base_map, &known, &texture, error));
        cs_material *made = cs_array_extend(&scene->materials, 1);
        CS_REQUIRE(made != NULL, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", model->path);
        *made = cs_material_make(&all[i], texture);
        make_colour(made->emission, model, "emission of material", all[i].name);
    }
    report_unsupported(model);
done:
    cs_array_free(&known);
    return status;
}
