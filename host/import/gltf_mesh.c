/* Meshes of glTF. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec.h"
#include "import/gltf_reader.h"

/* A primitive being added: where its vertices begin in the pools. */
typedef struct gltf_primitive {
    gltf_reader *reader;
    char place[64]; /* for messages */
    const double *matrix;
    const json_t *json;
    const json_t *weights; /* of its morph targets, or NULL */
    gltf_skin *skin;
    size_t count;                                         /* vertices */
    uint32_t first_position, first_normal, first_texture; /* CS_NO_INDEX: none */
    uint32_t material;
} gltf_primitive;

static clshear_status wrong_count(const gltf_primitive *primitive, const char *what, size_t count)
{
    return gltf_complain(primitive->reader, primitive->place, -1, "has %zu %s for %zu positions",
                         count, what, primitive->count);
}

/* Refuses an attribute whose items have `given` numbers, fewer than `least`. */
static clshear_status check_width(const gltf_primitive *primitive, const char *attribute,
                                  size_t given, size_t least)
{
    if (given >= least) return CLSHEAR_OK;
    return gltf_complain(primitive->reader, primitive->place, -1,
                         "its %s has %zu number%s a vertex, but needs %zu", attribute, given,
                         given == 1 ? "" : "s", least);
}

static clshear_status add_positions(gltf_primitive *primitive, long long accessor)
{
    gltf_reader *reader = primitive->reader;
    cs_array *pool = &reader->model->positions;
    float *values = NULL;
    size_t given = 0;
    clshear_status status =
        gltf_read_floats(reader, accessor, 3, &values, &primitive->count, &given);
    if (status != CLSHEAR_OK) return status;
    status = gltf_morph(reader, primitive->json, primitive->weights, "POSITION", 3, values,
                        primitive->count);
    primitive->first_position = (uint32_t)pool->count;
    double(*added)[3] = cs_model_extend(pool, primitive->count);
    if (status == CLSHEAR_OK && given != 3)
        status = gltf_complain(reader, primitive->place, -1, "its POSITION is no VEC3");
    else if (status == CLSHEAR_OK && added == NULL)
        status = cs_model_full(reader->model, reader->error);
    for (size_t i = 0; status == CLSHEAR_OK && added != NULL && i < primitive->count; i++) {
        double m[16];
        gltf_skin_matrix(primitive->skin, i, primitive->matrix, m);
        for (int axis = 0; axis < 3; axis++)
            added[i][axis] = m[axis] * (double)values[3 * i] +
                             m[4 + axis] * (double)values[3 * i + 1] +
                             m[8 + axis] * (double)values[3 * i + 2] + m[12 + axis];
    }
    free(values);
    return status;
}

/* The matrix that moves normals: cofactors, which are the inverse transpose up to a factor. */
static void normal_matrix(const double *m, double rows[3][3])
{
    const double *columns[3] = {m, m + 4, m + 8};
    double cofactor[3][3];
    for (int k = 0; k < 3; k++)
        cs_vec_cross_double(columns[(k + 1) % 3], columns[(k + 2) % 3], cofactor[k]);
    const double sign = cs_vec_dot_double(columns[0], cofactor[0]) < 0.0 ? -1.0 : 1.0;
    for (int axis = 0; axis < 3; axis++)
        for (int k = 0; k < 3; k++)
            rows[axis][k] = sign * cofactor[k][axis];
}

static clshear_status add_normals(gltf_primitive *primitive, long long accessor)
{
    gltf_reader *reader = primitive->reader;
    cs_array *pool = &reader->model->normals;
    double rows[3][3];
    float *values = NULL;
    size_t given = 0, count = 0;
    clshear_status status = gltf_read_floats(reader, accessor, 3, &values, &count, &given);
    if (status != CLSHEAR_OK) return status;
    primitive->first_normal = (uint32_t)pool->count;
    float(*added)[3] = cs_model_extend(pool, count);
    status = check_width(primitive, "NORMAL", given, 3);
    if (status == CLSHEAR_OK && count != primitive->count)
        status = wrong_count(primitive, "normals", count);
    else if (status == CLSHEAR_OK && added == NULL)
        status = cs_model_full(reader->model, reader->error);
    if (status == CLSHEAR_OK)
        status =
            gltf_morph(reader, primitive->json, primitive->weights, "NORMAL", 3, values, count);
    for (size_t i = 0; status == CLSHEAR_OK && added != NULL && i < count; i++) {
        double turned[3], m[16];
        gltf_skin_matrix(primitive->skin, i, primitive->matrix, m);
        normal_matrix(m, rows);
        for (int axis = 0; axis < 3; axis++)
            turned[axis] = rows[axis][0] * (double)values[3 * i] +
                           rows[axis][1] * (double)values[3 * i + 1] +
                           rows[axis][2] * (double)values[3 * i + 2];
        const double length = sqrt(cs_vec_dot_double(turned, turned));
        for (int axis = 0; axis < 3; axis++)
            added[i][axis] =
                length > 0.0 && isfinite(length) ? (float)(turned[axis] / length) : 0.0f;
    }
    free(values);
    return status;
}

/* attribute: TEXCOORD_n, whose numbers the accessor has. */
static clshear_status add_textures(gltf_primitive *primitive, const char *attribute,
                                   long long accessor)
{
    gltf_reader *reader = primitive->reader;
    cs_array *pool = &reader->model->textures;
    float *values = NULL;
    size_t given = 0, count = 0;
    clshear_status status = gltf_read_floats(reader, accessor, 2, &values, &count, &given);
    if (status != CLSHEAR_OK) return status;
    primitive->first_texture = (uint32_t)pool->count;
    void *added = cs_model_extend(pool, count);
    status = check_width(primitive, attribute, given, 2);
    if (status == CLSHEAR_OK && count != primitive->count)
        status = wrong_count(primitive, "texture coordinates", count);
    else if (status == CLSHEAR_OK && added == NULL)
        status = cs_model_full(reader->model, reader->error);
    if (status == CLSHEAR_OK)
        status =
            gltf_morph(reader, primitive->json, primitive->weights, attribute, 2, values, count);
    if (status == CLSHEAR_OK && added != NULL && count > 0)
        memcpy(added, values, count * pool->item_size);
    free(values);
    return status;
}

static clshear_status add_colours(gltf_primitive *primitive, long long accessor)
{
    gltf_reader *reader = primitive->reader;
    float *values = NULL;
    size_t given = 0, count = 0;
    cs_material_description *material =
        (cs_material_description *)reader->model->materials.items + primitive->material;
    clshear_status status = gltf_read_colours(reader, accessor, &values, &count, &given);
    if (status != CLSHEAR_OK) return status;
    status = check_width(primitive, "COLOR_0", given, 3);
    if (status == CLSHEAR_OK && count != primitive->count)
        status = wrong_count(primitive, "colours", count);
    if (status == CLSHEAR_OK)
        status =
            gltf_morph(reader, primitive->json, primitive->weights, "COLOR_0", 4, values, count);
    for (size_t i = 0; i < count && status == CLSHEAR_OK; i++) {
        float *colour = values + 4 * i;
        for (size_t c = 0; c < 3; c++)
            if (!(colour[c] >= 0.0f && colour[c] <= 1e15f)) colour[c] = 0.0f;
        status = cs_model_set_colour(reader->model, primitive->first_position + i, colour,
                                     reader->error);
        if (given < 4 || colour[3] >= 1.0f || status != CLSHEAR_OK) continue;
        material->fades = 1;
        status = cs_model_set_opacity(reader->model, primitive->first_position + i,
                                      colour[3] >= 0.0f ? colour[3] : 0.0f, reader->error);
    }
    free(values);
    return status;
}

/* ----- Triangles ----- */

static clshear_status corner_of(const gltf_primitive *primitive, const uint32_t *indices,
                                size_t place, cs_corner *corner)
{
    const size_t index = indices != NULL ? indices[place] : place;
    if (index >= primitive->count)
        return gltf_complain(primitive->reader, primitive->place, -1,
                             "index %zu names vertex %zu, but there are %zu", place, index,
                             primitive->count);
    *corner = (cs_corner){primitive->first_position + (uint32_t)index, CS_NO_INDEX, CS_NO_INDEX};
    if (primitive->first_normal != CS_NO_INDEX)
        corner->normal = primitive->first_normal + (uint32_t)index;
    if (primitive->first_texture != CS_NO_INDEX)
        corner->texture = primitive->first_texture + (uint32_t)index;
    return CLSHEAR_OK;
}

/* Whether the node mirrors its mesh: the front of a triangle is then where its corners go round
 * clockwise, as solids need it. Joints, which move a skin in the node's place, are taken not to. */
static int turns_over(const gltf_primitive *primitive)
{
    const double *m = primitive->matrix;
    double across[3];
    cs_vec_cross_double(m, m + 4, across);
    return primitive->skin->which == NULL && cs_vec_dot_double(across, m + 8) < 0.0;
}

/* Triangles (4), a strip (5) or a fan (6) of `count` corners. */
static clshear_status add_triangles(const gltf_primitive *primitive, int mode,
                                    const uint32_t *indices, size_t count)
{
    gltf_reader *reader = primitive->reader;
    const size_t triangles = mode == 4 ? count / 3 : count > 2 ? count - 2 : 0;
    const int is_mirrored = turns_over(primitive);
    for (size_t i = 0; i < triangles; i++) {
        size_t places[3] = {i, i + 1 + (i & 1), i + 2 - (i & 1)};
        cs_corner corners[3];
        for (size_t k = 0; k < 3; k++) {
            if (mode == 4) places[k] = 3 * i + k;
            if (mode == 6) places[k] = k == 0 ? 0 : i + k;
            const size_t at = is_mirrored ? 2 - k : k;
            clshear_status status = corner_of(primitive, indices, places[k], &corners[at]);
            if (status != CLSHEAR_OK) return status;
        }
        clshear_status status =
            cs_model_add_polygon(reader->model, corners, 3, primitive->material, 0, reader->error);
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}

static clshear_status add_indexed(const gltf_primitive *primitive, const json_t *json, int mode)
{
    uint32_t *indices = NULL;
    size_t count = primitive->count;
    const long long accessor = gltf_index(json, "indices");
    clshear_status status = CLSHEAR_OK;
    if (accessor != -1) status = gltf_read_indices(primitive->reader, accessor, &indices, &count);
    if (status == CLSHEAR_OK) status = add_triangles(primitive, mode, indices, count);
    free(indices);
    return status;
}

/* The material's number in the model. glTF's default is white. */
static clshear_status find_material(gltf_primitive *primitive, const json_t *json)
{
    gltf_reader *reader = primitive->reader;
    const long long number = gltf_index(json, "material");
    if (number >= 0 || number == -2) {
        if (gltf_at(reader, "materials", number) == NULL) return CLSHEAR_BAD_FILE;
        primitive->material = (uint32_t)number;
        return CLSHEAR_OK;
    }
    if (reader->default_material < 0) {
        cs_material_description *material = cs_model_extend(&reader->model->materials, 1);
        if (material == NULL) return cs_model_full(reader->model, reader->error);
        cs_material_init(material, "default");
        for (int c = 0; c < 3; c++)
            material->base_colour[c] = 1.0f;
        reader->default_material = (int)reader->model->materials.count - 1;
    }
    primitive->material = (uint32_t)reader->default_material;
    return CLSHEAR_OK;
}

/* Binds the skin to as many vertices as there are positions. */
static clshear_status bind_skin(gltf_primitive *primitive, const json_t *attributes,
                                long long position)
{
    const json_t *accessor = gltf_at(primitive->reader, "accessors", position);
    if (accessor == NULL) return CLSHEAR_BAD_FILE;
    const long long count = gltf_index(accessor, "count");
    const int is_bound = primitive->skin->joint_count > 0;
    if (is_bound && gltf_index(attributes, "JOINTS_0") != -1 &&
        gltf_index(attributes, "WEIGHTS_0") == -1)
        return gltf_complain(primitive->reader, primitive->place, -1,
                             "has JOINTS_0, but no WEIGHTS_0");
    if (is_bound && json_object_get(attributes, "JOINTS_1") != NULL)
        gltf_note(primitive->reader, GLTF_MORE_JOINTS, primitive->place, -1);
    return gltf_skin_bind(primitive->reader, attributes, count > 0 ? (size_t)count : 0,
                          primitive->skin);
}

static clshear_status add_primitive(gltf_primitive *primitive, const json_t *json)
{
    clshear_status status = CLSHEAR_OK;
    gltf_reader *reader = primitive->reader;
    const json_t *attributes = json_object_get(json, "attributes");
    const double mode = gltf_number(json, "mode", 4.0);
    const long long position = gltf_index(attributes, "POSITION");
    char set[16];
    int is_list = 0;
    primitive->first_normal = primitive->first_texture = CS_NO_INDEX;
    if (position == -1) return CLSHEAR_OK;
    if (mode < 4.0 || mode > 6.0) {
        reader->model->without_area++;
        gltf_note(reader, GLTF_WITHOUT_AREA, primitive->place, -1);
        return CLSHEAR_OK;
    }
    CS_TRY(gltf_unpack_primitive(reader, primitive->place, json, &is_list));
    CS_TRY(find_material(primitive, json));
    CS_TRY(bind_skin(primitive, attributes, position));
    CS_TRY(add_positions(primitive, position));
    const long long normal = gltf_index(attributes, "NORMAL");
    if (normal >= 0) CS_TRY(add_normals(primitive, normal));
    const cs_material_description *material =
        (const cs_material_description *)reader->model->materials.items + primitive->material;
    const cs_map *placing = cs_material_placing(material);
    if (placing != NULL) {
        snprintf(set, sizeof set, "TEXCOORD_%d", placing->set);
        const long long texture = gltf_index(attributes, set);
        if (texture >= 0) CS_TRY(add_textures(primitive, set, texture));
    }
    const long long colour = gltf_index(attributes, "COLOR_0");
    if (colour >= 0) CS_TRY(add_colours(primitive, colour));
    CS_TRY(add_indexed(primitive, json, is_list ? 4 : (int)mode));
done:
    return status;
}

clshear_status gltf_mesh(gltf_reader *reader, const json_t *node, const double *matrix)
{
    const long long index = gltf_index(node, "mesh");
    const json_t *json = gltf_at(reader, "meshes", index);
    if (json == NULL) return CLSHEAR_BAD_FILE;
    const json_t *primitives = json_object_get(json, "primitives");
    const json_t *weights = json_object_get(node, "weights");
    gltf_skin skin;
    clshear_status status = gltf_skin_open(reader, node, &skin);
    for (size_t i = 0; i < json_array_size(primitives) && status == CLSHEAR_OK; i++) {
        gltf_primitive primitive = {
            .reader = reader,
            .matrix = matrix,
            .json = json_array_get(primitives, i),
            .weights = json_is_array(weights) ? weights : json_object_get(json, "weights"),
            .skin = &skin};
        snprintf(primitive.place, sizeof primitive.place, "meshes[%lld].primitives[%zu]", index, i);
        status = add_primitive(&primitive, primitive.json);
    }
    gltf_skin_close(&skin);
    return status;
}
