/* What 3MF files build. */
#include <string.h>

#include "helper/three_mf.h"

enum {
    MOST_DEPTH = 64,
    MOST_VISITS = 1000000
};

static clshear_status full(const mf_reader *reader)
{
    return cs_model_full(reader->model, reader->error);
}

static mf_matrix product(const mf_matrix *inner, const mf_matrix *outer)
{
    mf_matrix result = {{0}};
    for (int row = 0; row < 4; row++)
        for (int column = 0; column < 3; column++) {
            double sum = row == 3 ? outer->value[9 + column] : 0.0;
            for (int k = 0; k < 3; k++)
                sum += inner->value[3 * row + k] * outer->value[3 * k + column];
            result.value[3 * row + column] = sum;
        }
    return result;
}

/* What an id names, in the list that it belongs to; NULL for nothing. */
static const void *find(const mf_places *names, const mf_id *id, const cs_array *list)
{
    const uint32_t number = cs_index_map_find(&names->ids, id);
    if (number == UINT32_MAX) return NULL;
    const size_t place = ((const size_t *)names->places.items)[number];
    return (const char *)list->items + place * list->item_size;
}

/* The colour at a place of a group; NULL where there is none, or the group has none that are read.
 */
static mf_colour *find_colour(mf_reader *reader, mf_id id, long long place)
{
    const mf_group *group = find(&reader->of_groups, &id, &reader->groups);
    if (group != NULL && group->count == 0) return NULL; /* told already */
    if (group != NULL && place >= 0 && (size_t)place < group->count)
        return (mf_colour *)reader->colours.items + group->first + place;
    reader->has_wrong_colour = 1;
    return NULL;
}

static clshear_status material_of(const mf_reader *reader, mf_colour *colour, uint32_t *number)
{
    *number = colour->material;
    if (*number != CS_NO_INDEX) return CLSHEAR_OK;
    cs_material_description *material = cs_model_extend(&reader->model->materials, 1);
    if (material == NULL) return full(reader);
    cs_material_init(material, colour->name);
    memcpy(material->base_colour, colour->value, sizeof colour->value);
    if (colour->value[3] < 1.0f) material->alpha_mode = CS_ALPHA_BLEND;
    colour->material = *number = (uint32_t)reader->model->materials.count - 1;
    return CLSHEAR_OK;
}

/* Corners of a triangle get positions of its own, with a colour and an opacity each. material: the
 * triangle's. */
static clshear_status colour_corners(mf_reader *reader, mf_id group, const long long *places,
                                     uint32_t material, cs_corner *corners)
{
    cs_model *model = reader->model;
    for (int i = 0; i < 3; i++) {
        const size_t index = model->positions.count;
        double *position = cs_model_extend(&model->positions, 1);
        if (position == NULL) return full(reader);
        memcpy(position, (double(*)[3])model->positions.items + corners[i].position,
               3 * sizeof *position);
        corners[i].position = (uint32_t)index;
        const mf_colour *colour = find_colour(reader, group, places[i]);
        if (colour == NULL) continue;
        clshear_status status = cs_model_set_colour(model, index, colour->value, reader->error);
        if (status == CLSHEAR_OK && colour->value[3] < 1.0f) {
            cs_material_description *faded =
                (cs_material_description *)model->materials.items + material;
            faded->alpha_mode = CS_ALPHA_BLEND;
            faded->fades = 1;
            status = cs_model_set_opacity(model, index, colour->value[3], reader->error);
        }
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}

/* A white material for triangles whose corners have colours. */
static clshear_status white_material(mf_reader *reader, uint32_t *number)
{
    mf_colour white = {{1, 1, 1, 1}, CS_NO_INDEX, "colours"};
    return material_of(reader, &white, number);
}

/* Gives a triangle the colour that it names, or its object. */
static clshear_status colour_triangle(mf_reader *reader, const mf_object *object,
                                      const mf_triangle *triangle, cs_corner *corners,
                                      uint32_t *material, uint32_t *white)
{
    const mf_id group = {object->id.part,
                         triangle->group != MF_NONE ? triangle->group : object->group};
    long long places[3];
    for (int i = 0; i < 3; i++) {
        places[i] = triangle->colour[i];
        if (places[i] == MF_NONE) places[i] = object->colour != MF_NONE ? object->colour : 0;
    }
    *material = CS_NO_INDEX;
    if (group.number == MF_NONE) return CLSHEAR_OK;
    if (places[0] == places[1] && places[0] == places[2]) {
        mf_colour *colour = find_colour(reader, group, places[0]);
        return colour != NULL ? material_of(reader, colour, material) : CLSHEAR_OK;
    }
    clshear_status status = CLSHEAR_OK;
    if (find_colour(reader, group, places[0]) == NULL) return CLSHEAR_OK;
    if (*white == CS_NO_INDEX) status = white_material(reader, white);
    *material = *white;
    return status == CLSHEAR_OK ? colour_corners(reader, group, places, *white, corners) : status;
}

/* The positions of an object in its place. */
static clshear_status add_vertices(mf_reader *reader, const mf_object *object,
                                   const mf_matrix *matrix)
{
    const double(*vertices)[3] = reader->vertices.items;
    double(*positions)[3] = cs_model_extend(&reader->model->positions, object->vertices);
    if (positions == NULL) return full(reader);
    for (size_t i = 0; i < object->vertices; i++)
        for (int axis = 0; axis < 3; axis++) {
            positions[i][axis] = matrix->value[9 + axis];
            for (int k = 0; k < 3; k++)
                positions[i][axis] +=
                    vertices[object->first_vertex + i][k] * matrix->value[3 * k + axis];
        }
    return CLSHEAR_OK;
}

static clshear_status add_mesh(mf_reader *reader, const mf_object *object, const mf_matrix *matrix)
{
    cs_model *model = reader->model;
    const mf_triangle *triangles = reader->triangles.items;
    const size_t first = model->positions.count;
    uint32_t material, white = CS_NO_INDEX;
    clshear_status status = add_vertices(reader, object, matrix);
    for (size_t i = 0; i < object->triangles && status == CLSHEAR_OK; i++) {
        const mf_triangle *triangle = &triangles[object->first_triangle + i];
        cs_corner corners[3];
        for (int k = 0; k < 3; k++) {
            if (triangle->vertex[k] >= object->vertices)
                return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                               "%s: triangle %zu of object %lld names vertex %u, but there are %zu",
                               model->path, i, object->id.number, triangle->vertex[k],
                               object->vertices);
            corners[k] =
                (cs_corner){(uint32_t)first + triangle->vertex[k], CS_NO_INDEX, CS_NO_INDEX};
        }
        status = colour_triangle(reader, object, triangle, corners, &material, &white);
        if (status == CLSHEAR_OK)
            status = cs_model_add_polygon(model, corners, 3, material, 0, reader->error);
    }
    return status;
}

static clshear_status place(mf_reader *reader, const mf_component *component,
                            const mf_matrix *outer, int depth)
{
    const char *path = reader->model->path;
    const mf_object *object = find(&reader->of_objects, &component->object, &reader->objects);
    if (object == NULL)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: names object %lld, which is not there",
                       path, component->object.number);
    if (depth > MOST_DEPTH || ++reader->visits > MOST_VISITS)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: its components %s", path,
                       depth > MOST_DEPTH ? "lie within each other without an end"
                                          : "are more than a million");
    const mf_matrix matrix = product(&component->matrix, outer);
    clshear_status status = add_mesh(reader, object, &matrix);
    for (size_t i = 0; i < object->components && status == CLSHEAR_OK; i++)
        status = place(reader,
                       (const mf_component *)reader->components.items + object->first_component + i,
                       &matrix, depth + 1);
    return status;
}

clshear_status mf_build(mf_reader *reader)
{
    static const mf_matrix identity = {{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}};
    const mf_component *items = reader->items.items;
    const char *path = reader->model->path;
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < reader->items.count && status == CLSHEAR_OK; i++)
        status = place(reader, &items[i], &identity, 0);
    if (status != CLSHEAR_OK) return status;
    if (reader->has_wrong_colour)
        cs_warn(reader->model->log,
                "%s: some triangles name colours that are not there; they are plain", path);
    if (reader->model->triangles.count > 0) return CLSHEAR_OK;
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: %s", path,
                   reader->items.count == 0 ? "nothing in it is to be built"
                                            : "there are no triangles in what it builds");
}
