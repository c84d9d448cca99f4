#include "import/model.h"

#include <stdlib.h>
#include <string.h>

#include "import/colour.h"
#include "import/polygon.h"

void cs_model_init(cs_model *model, const char *path, const cs_log *log)
{
    *model = (cs_model){.path = path, .log = log, .cutting = 1e9};
    model->positions.item_size = 3 * sizeof(double);
    model->colours.item_size = 3 * sizeof(float);
    model->opacities.item_size = sizeof(float);
    model->normals.item_size = 3 * sizeof(float);
    model->textures.item_size = 2 * sizeof(float);
    model->triangles.item_size = sizeof(cs_model_triangle);
    model->materials.item_size = sizeof(cs_material_description);
    model->images.item_size = sizeof(cs_image_source);
    model->lights.item_size = sizeof(cs_model_light);
    model->cameras.item_size = sizeof(cs_model_camera);
}

void cs_model_free(cs_model *model)
{
    cs_image_source *images = model->images.items;
    for (size_t i = 0; i < model->images.count; i++) {
        free(images[i].path);
        free(images[i].label);
        free(images[i].bytes);
    }
    cs_array *arrays[] = {&model->positions, &model->colours,   &model->opacities, &model->normals,
                          &model->textures,  &model->triangles, &model->materials, &model->images,
                          &model->lights,    &model->cameras};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        cs_array_free(arrays[i]);
}

void *cs_model_extend(cs_array *array, size_t count)
{
    static double nothing;
    if (count == 0) return &nothing; /* not NULL: there is room for it */
    if (count > CS_MODEL_MOST || array->count > CS_MODEL_MOST - count) return NULL;
    return cs_array_extend(array, count);
}

clshear_status cs_model_full(const cs_model *model, cs_error *error)
{
    return cs_fail(error, CLSHEAR_OUT_OF_MEMORY,
                   "%s: does not fit into memory, or has more than %d triangles or vertices",
                   model->path, CS_MODEL_MOST);
}

clshear_status cs_model_set_colour(cs_model *model, size_t index, const float *colour,
                                   cs_error *error)
{
    const size_t before = model->colours.count;
    if (index >= before) {
        float(*added)[3] = cs_model_extend(&model->colours, index + 1 - before);
        if (added == NULL) return cs_model_full(model, error);
        for (size_t i = before; i <= index; i++)
            for (int c = 0; c < 3; c++)
                added[i - before][c] = CS_NO_COLOUR;
    }
    float *value = ((float(*)[3])model->colours.items)[index];
    for (int c = 0; c < 3; c++)
        value[c] = cs_colour_value((double)colour[c], 0);
    return CLSHEAR_OK;
}

clshear_status cs_model_set_opacity(cs_model *model, size_t index, float opacity, cs_error *error)
{
    const size_t before = model->opacities.count;
    if (index >= before) {
        float *added = cs_model_extend(&model->opacities, index + 1 - before);
        if (added == NULL) return cs_model_full(model, error);
        for (size_t i = before; i < index; i++)
            added[i - before] = 1.0f;
    }
    ((float *)model->opacities.items)[index] = opacity;
    return CLSHEAR_OK;
}

clshear_status cs_model_add_image(cs_model *model, const char *path, const char *label,
                                  const void *bytes, size_t size, int *image, cs_error *error)
{
    const cs_image_source *images = model->images.items;
    for (size_t i = 0; i < model->images.count; i++)
        if ((images[i].bytes == NULL) == (bytes == NULL) && strcmp(images[i].path, path) == 0 &&
            strcmp(images[i].label, label) == 0) {
            *image = (int)i;
            return CLSHEAR_OK;
        }
    cs_image_source *added = cs_model_extend(&model->images, 1);
    if (added == NULL) return cs_model_full(model, error);
    added->path = strdup(path);
    added->label = strdup(label);
    if (bytes != NULL) {
        added->bytes = malloc(size + 1);
        added->size = size;
        if (added->bytes != NULL) memcpy(added->bytes, bytes, size);
    }
    if (added->path == NULL || added->label == NULL || (bytes != NULL && added->bytes == NULL))
        return cs_model_full(model, error);
    *image = (int)model->images.count - 1;
    return CLSHEAR_OK;
}

void cs_model_plain(const cs_model *model, const char *name, cs_material_description *material)
{
    cs_material_init(material, name);
    for (int c = 0; c < 3 && model->colours.count > 0; c++)
        material->base_colour[c] = 1.0f;
}

clshear_status cs_model_add_polygon(cs_model *model, const cs_corner *corners, size_t count,
                                    uint32_t material, uint32_t group, cs_error *error)
{
    const double(*positions)[3] = model->positions.items;
    uint32_t few[3 * 2];
    uint32_t *cut = few;
    if (count < 3) {
        model->without_area++;
        return CLSHEAR_OK;
    }
    cs_model_triangle *triangles = cs_model_extend(&model->triangles, count - 2);
    if (count > 4) cut = malloc(3 * (count - 2) * sizeof *cut);
    if (triangles == NULL || cut == NULL) {
        if (cut != few) free(cut);
        return cs_model_full(model, error);
    }
    cs_polygon_cut(positions, corners, count, &model->cutting, cut);
    for (size_t i = 0; i < count - 2; i++) {
        for (int k = 0; k < 3; k++)
            triangles[i].corner[k] = corners[cut[3 * i + (size_t)k]];
        triangles[i].material = material;
        triangles[i].group = group;
    }
    if (cut != few) free(cut);
    return CLSHEAR_OK;
}
