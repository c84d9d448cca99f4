/* Materials of a model, and what is said of them. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import/build_parts.h"

enum {
    MOST_NAMES = 4 /* of materials in one line */
};

static void make_colour(float *colour, const cs_model *model, const char *what, const char *name)
{
    if (!cs_is_colour(colour)) {
        cs_warn(model->log,
                "%s: %s \"%s\" has the colour %g %g %g, which must be 0 to 1e15; taken as 0",
                model->path, what, name, (double)colour[0], (double)colour[1], (double)colour[2]);
        colour[0] = colour[1] = colour[2] = 0.0f;
    }
}

/* Warns of surfaces that give more light than they get. Of those that do more than scatter it,
 * cs_material_make takes no more than 1. */
static void check_albedo(const cs_model *model, const cs_material_description *material,
                         const cs_material *made)
{
    const float *c = made->diffuse;
    if (c[0] > 1.0f || c[1] > 1.0f || c[2] > 1.0f)
        cs_warn(model->log,
                "%s: material \"%s\" has the colour %g %g %g: above 1 it reflects more light than "
                "arrives; kept",
                model->path, material->name, (double)c[0], (double)c[1], (double)c[2]);
}

/* One line for all materials that ask for the same things; `done` marks those that are named. */
static void report_alike(const cs_model *model, size_t first, char *done)
{
    const cs_material_description *all = model->materials.items;
    char asked[512], other[512], names[512] = "";
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
            cs_model_plain(model, "default", added);
        }
        triangles[i].material = number;
    }
    return CLSHEAR_OK;
}

clshear_status cs_build_materials(cs_model *model, cs_scene *scene, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array known = cs_known_textures();
    CS_TRY(add_default(model, error));
    cs_material_description *all = model->materials.items;
    for (size_t i = 0; i < model->materials.count; i++) {
        cs_material_textures textures;
        make_colour(all[i].base_colour, model, "material", all[i].name);
        make_colour(all[i].emissive, model, "material", all[i].name);
        CS_TRY(cs_build_textures(model, scene, &all[i], &known, &textures, error));
        cs_material *made = cs_array_extend(&scene->materials, 1);
        CS_REQUIRE(made != NULL, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", model->path);
        *made = cs_material_make(&all[i], &textures);
        check_albedo(model, &all[i], made);
        make_colour(made->emission, model, "emission of material", all[i].name);
        if ((made->flags & CS_MATERIAL_BLEND) && made->alpha == 0.0f)
            cs_warn(
                model->log,
                "%s: material \"%s\" has the opacity 0 and cannot be seen; if that is a mistake, "
                "write d 1 (MTL) or an alpha of 1",
                model->path, all[i].name);
    }
    report_unsupported(model);
done:
    cs_array_free(&known);
    return status;
}
