/* PLY: vertices, faces, strips and fans of triangles. */
#include <stdlib.h>
#include <string.h>

#include "import/find_file.h"
#include "import/ply_items.h"
#include "import/readers.h"

int cs_is_ply(const cs_bytes *bytes, const char *path)
{
    const int marked = bytes->size >= 4 && memcmp(bytes->data, "ply", 3) == 0 &&
                       (bytes->data[3] == '\n' || bytes->data[3] == '\r' || bytes->data[3] == ' ');
    return marked || cs_has_suffix(path, ".ply");
}

/* ----- Vertices ----- */

/* What texture coordinates are in, and the role behind it; or CS_PLY_NO_ROLE. */
static cs_ply_role coordinates_of(const cs_ply_scalars *given)
{
    const int *there = given->is_there;
    if (there[CS_PLY_S] && there[CS_PLY_T]) return CS_PLY_S;
    return there[CS_PLY_TX] && there[CS_PLY_TY] && !there[CS_PLY_TZ] ? CS_PLY_TX : CS_PLY_NO_ROLE;
}

static clshear_status add_vertex(cs_ply_reader *reader, const cs_ply_scalars *given)
{
    cs_model *model = reader->model;
    double *position = cs_model_extend(&model->positions, 1);
    if (position == NULL) return cs_model_full(model, reader->error);
    memcpy(position, &given->value[CS_PLY_X], 3 * sizeof *position);
    reader->has_normals = given->is_there[CS_PLY_NX] && given->is_there[CS_PLY_NZ];
    if (reader->has_normals) {
        float *normal = cs_model_extend(&model->normals, 1);
        if (normal == NULL) return cs_model_full(model, reader->error);
        for (int i = 0; i < 3; i++)
            normal[i] = (float)given->value[CS_PLY_NX + i];
    }
    const cs_ply_role s = coordinates_of(given);
    reader->has_coordinates = s != CS_PLY_NO_ROLE;
    if (reader->has_coordinates) {
        float *st = cs_model_extend(&model->textures, 1);
        if (st == NULL) return cs_model_full(model, reader->error);
        st[0] = (float)given->value[s];
        st[1] = (float)given->value[s + 1];
    }
    float colour[3];
    model->has_unused_alpha |= given->is_there[CS_PLY_ALPHA] &&
                               given->value[CS_PLY_ALPHA] < cs_ply_most(given->type[CS_PLY_ALPHA]);
    if (!cs_ply_colour(given, colour)) return CLSHEAR_OK;
    return cs_model_set_colour(model, model->positions.count - 1, colour, reader->error);
}

/* ----- Faces ----- */

/* Texture coordinates of a face's own. */
static clshear_status add_coordinates(cs_ply_reader *reader, cs_corner *corners, size_t count)
{
    const double *texts = reader->texts.items;
    if (reader->texts.count < 2 * count || count == 0) return CLSHEAR_OK;
    cs_array *pool = &reader->model->textures;
    const size_t first = pool->count;
    float(*added)[2] = cs_model_extend(pool, count);
    if (added == NULL) return cs_model_full(reader->model, reader->error);
    for (size_t i = 0; i < count; i++) {
        added[i][0] = (float)texts[2 * i];
        added[i][1] = (float)texts[2 * i + 1];
        corners[i].texture = (uint32_t)(first + i);
    }
    return CLSHEAR_OK;
}

/* Positions of a face's own, which have its colour. */
static clshear_status add_coloured(cs_ply_reader *reader, cs_corner *corners, size_t count,
                                   const float *colour)
{
    cs_array *pool = &reader->model->positions;
    for (size_t i = 0; i < count; i++) {
        const size_t place = pool->count;
        double *position = cs_model_extend(pool, 1);
        if (position == NULL) return cs_model_full(reader->model, reader->error);
        memcpy(position, ((double(*)[3])pool->items)[corners[i].position], 3 * sizeof *position);
        corners[i].position = (uint32_t)place;
        clshear_status status = cs_model_set_colour(reader->model, place, colour, reader->error);
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}

static clshear_status add_face(cs_ply_reader *reader, const cs_ply_element *element, size_t item,
                               size_t vertices, const cs_ply_scalars *given)
{
    clshear_status status = CLSHEAR_OK;
    cs_model *model = reader->model;
    cs_error *error = reader->error;
    cs_corner *corners = reader->corners.items;
    const size_t count = reader->corners.count;
    float colour[3];
    for (size_t i = 0; i < count; i++) {
        if (corners[i].position >= vertices)
            return cs_ply_complain(reader, element, item, "it names a vertex that is not there");
        if (reader->has_normals) corners[i].normal = corners[i].position;
        if (reader->has_coordinates) corners[i].texture = corners[i].position;
    }
    CS_TRY(add_coordinates(reader, corners, count));
    if (cs_ply_colour(given, colour)) CS_TRY(add_coloured(reader, corners, count, colour));
    uint32_t material = 0;
    const double number = given->value[CS_PLY_TEXTURE_NUMBER];
    if (number < 0.0) material = CS_NO_INDEX; /* -1: this face has none */
    if (number > 0.0 && number < (double)reader->head.texture_count) material = (uint32_t)number;
    CS_TRY(cs_model_add_polygon(model, corners, count, material, 0, error));
done:
    return status;
}

/* A strip: each index makes a triangle with the two before it; or a fan: with the first one and the
 * one before it. -1 begins anew. */
static clshear_status add_strip(cs_ply_reader *reader, const cs_ply_element *element, size_t item,
                                size_t vertices, int is_fan)
{
    const cs_corner *corners = reader->corners.items;
    size_t length = 0;
    for (size_t i = 0; i < reader->corners.count; i++) {
        if (corners[i].position == CS_NO_INDEX) {
            length = 0;
            continue;
        }
        if (corners[i].position >= vertices)
            return cs_ply_complain(reader, element, item, "it names a vertex that is not there");
        if (++length < 3) continue;
        const size_t odd = (length - 3) & 1;
        cs_corner triangle[3] = {corners[i - 2 + odd], corners[i - 1 - odd], corners[i]};
        if (is_fan) {
            triangle[0] = corners[i + 1 - length];
            triangle[1] = corners[i - 1];
        }
        for (int k = 0; k < 3; k++) {
            if (reader->has_normals) triangle[k].normal = triangle[k].position;
            if (reader->has_coordinates) triangle[k].texture = triangle[k].position;
        }
        clshear_status status =
            cs_model_add_polygon(reader->model, triangle, 3, 0, 0, reader->error);
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}

/* ----- Elements ----- */

/* Whether the rest of the file can hold as many items as the head says. */
static clshear_status check_count(const cs_ply_reader *reader, const cs_ply_element *element)
{
    size_t least = 0;
    for (size_t p = 0; p < element->property_count; p++) {
        const cs_ply_property *property = &element->properties[p];
        const int is_list = property->count_type != CS_PLY_NO_TYPE;
        least +=
            cs_ply_least_size(reader->head.format, is_list ? property->count_type : property->type);
        least += reader->head.format == CS_PLY_ASCII; /* a blank */
    }
    const size_t left = (size_t)(reader->cursor.end - reader->cursor.at) + 1;
    if (element->count <= left / (least > 0 ? least : 1)) return CLSHEAR_OK;
    return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                   "%s: says that it has %zu of \"%s\", more than the file can hold; it was cut",
                   reader->model->path, element->count, element->name);
}

static clshear_status read_element(cs_ply_reader *reader, const cs_ply_element *element,
                                   size_t *vertices)
{
    const int is_vertex = strcmp(element->name, "vertex") == 0;
    const int has_indices = cs_ply_has_role(element, CS_PLY_INDICES);
    const int is_fan = strcmp(element->name, "trifans") == 0 && has_indices;
    const int is_strip = (is_fan || strcmp(element->name, "tristrips") == 0) && has_indices;
    const int is_face = strcmp(element->name, "face") == 0 && has_indices;
    if (element->property_count == 0) return CLSHEAR_OK;
    clshear_status status = check_count(reader, element);
    if (status == CLSHEAR_OK && (is_strip || is_face) && *vertices == 0 && element->count > 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: has faces but no vertices",
                       reader->model->path);
    if (is_vertex && *vertices > 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: has vertices twice",
                       reader->model->path);
    for (size_t i = 0; i < element->count && status == CLSHEAR_OK; i++) {
        cs_ply_scalars given = {0};
        status = cs_ply_read_item(reader, element, i, &given);
        if (status != CLSHEAR_OK) return status;
        if (is_vertex)
            status = add_vertex(reader, &given);
        else if (is_face)
            status = add_face(reader, element, i, *vertices, &given);
        else if (is_strip)
            status = add_strip(reader, element, i, *vertices, is_fan);
    }
    if (is_vertex) *vertices = reader->model->positions.count;
    return status;
}

/* Goes past an element whose faces wait for the vertices behind it. */
static clshear_status pass_element(cs_ply_reader *reader, const cs_ply_element *element)
{
    if (element->property_count == 0) return CLSHEAR_OK;
    clshear_status status = check_count(reader, element);
    for (size_t i = 0; i < element->count && status == CLSHEAR_OK; i++) {
        cs_ply_scalars given = {0};
        status = cs_ply_read_item(reader, element, i, &given);
    }
    return status;
}

/* Reads what lies before the vertices after them; leaves the cursor behind the last item. */
static clshear_status read_in_turn(cs_ply_reader *reader)
{
    clshear_status status = CLSHEAR_OK;
    const char *starts[CS_PLY_ELEMENTS];
    const cs_ply_element *elements = reader->head.elements;
    size_t vertices = 0, before = 0;
    while (before < reader->head.element_count && strcmp(elements[before].name, "vertex") != 0)
        before++;
    for (size_t i = 0; i < reader->head.element_count; i++) {
        starts[i] = reader->cursor.at;
        status = i < before ? pass_element(reader, &elements[i])
                            : read_element(reader, &elements[i], &vertices);
        if (status != CLSHEAR_OK) return status;
    }
    const char *behind = reader->cursor.at;
    for (size_t i = 0; i < before && status == CLSHEAR_OK; i++) {
        reader->cursor.at = starts[i];
        status = read_element(reader, &elements[i], &vertices);
    }
    reader->cursor.at = behind;
    return status;
}

/* A material for each texture; one at least. */
static clshear_status add_materials(cs_ply_reader *reader)
{
    clshear_status status = CLSHEAR_OK;
    cs_model *model = reader->model;
    char folder[CS_FILE_PATH], found[CS_FILE_PATH];
    const char *folders[] = {folder};
    cs_error *error = reader->error;
    cs_folder_of(model->path, folder, sizeof folder);
    for (size_t i = 0; i < reader->head.texture_count || i == 0; i++) {
        cs_material_description *material = cs_model_extend(&model->materials, 1);
        if (material == NULL) return cs_model_full(model, error);
        cs_model_plain(model, "default", material);
        if (reader->head.texture_count == 0) continue;
        const char *name = reader->head.textures[i];
        const int there = cs_find_file(name, folders, 1, found);
        for (int c = 0; c < 3; c++)
            material->base_colour[c] = 1.0f;
        CS_TRY(cs_model_add_image(model, there ? found : "", there ? found : name, NULL, 0,
                                  &material->base_map.image, error));
    }
done:
    return status;
}

/* Why there is nothing to render, if there is not. */
static clshear_status check(const cs_ply_reader *reader)
{
    const char *path = reader->model->path;
    if (reader->model->triangles.count > 0) return CLSHEAR_OK;
    for (size_t i = 0; i < reader->head.element_count; i++)
        if (strcmp(reader->head.elements[i].name, "range_grid") == 0)
            return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                           "%s: range grids are not supported; convert it to faces", path);
    if (reader->model->positions.count > 0)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: has %zu points but no faces; make a surface of them first", path,
                       reader->model->positions.count);
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: there are no faces in it", path);
}

/* Tells of what lies behind the last item that the head counts, but for blanks and zeros. */
static void report_rest(const cs_ply_reader *reader)
{
    const char *at = reader->cursor.at, *end = reader->cursor.end;
    while (at != end && (unsigned char)*at <= ' ')
        at++;
    if (at != end)
        cs_warn(reader->model->log,
                "%s: goes on behind the last item that its head counts; %zu bytes are left out",
                reader->model->path, (size_t)(end - at));
}

static clshear_status read_elements(cs_ply_reader *reader, cs_bytes *bytes)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = reader->error;
    size_t items = 0;
    CS_TRY(cs_ply_read_head(bytes, reader->model->path, &reader->head, error));
    for (size_t i = 0; i < reader->head.element_count; i++) {
        const cs_ply_element *element = &reader->head.elements[i];
        items += element->property_count > 0 ? element->count : 0;
        CS_REQUIRE(strcmp(element->name, "vertex") != 0 || element->count == 0 ||
                       (cs_ply_has_role(element, CS_PLY_X) && cs_ply_has_role(element, CS_PLY_Y) &&
                        cs_ply_has_role(element, CS_PLY_Z)),
                   CLSHEAR_BAD_FILE, "%s: its vertices have no x, y, z", reader->model->path);
        CS_REQUIRE(strcmp(element->name, "face") != 0 || element->count == 0 ||
                       cs_ply_has_role(element, CS_PLY_INDICES),
                   CLSHEAR_BAD_FILE, "%s: its faces have no list called vertex_indices",
                   reader->model->path);
    }
    reader->cursor = (cs_ply_cursor){bytes->data,
                                     bytes->data + reader->head.size,
                                     bytes->data + bytes->size,
                                     reader->head.format,
                                     0,
                                     NULL};
    cs_ply_find_rows(&reader->cursor, items);
    CS_TRY(read_in_turn(reader));
    for (size_t i = 0; i < reader->head.element_count; i++)
        if (strcmp(reader->head.elements[i].name, "material") == 0)
            cs_warn(reader->model->log, "%s: its element \"material\" is not supported; left out",
                    reader->model->path);
    if (reader->is_longer)
        cs_warn(reader->model->log,
                "%s: has lines with more numbers than the head says; those behind are left out",
                reader->model->path);
    CS_TRY(add_materials(reader));
    CS_TRY(check(reader));
    report_rest(reader);
done:
    return status;
}

clshear_status cs_read_ply(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    cs_ply_reader *reader = calloc(1, sizeof *reader);
    if (reader == NULL) return cs_model_full(model, error);
    model->up_is_open = 1;
    reader->model = model;
    reader->error = error;
    reader->corners.item_size = sizeof(cs_corner);
    reader->texts.item_size = sizeof(double);
    clshear_status status = CLSHEAR_OK;
    if (bytes->size > 0 && (unsigned char)bytes->data[0] >= 0xef) /* a byte order mark */
        status = cs_bytes_to_utf8(bytes, model->path, error);
    if (status == CLSHEAR_OK && (bytes->size < 3 || memcmp(bytes->data, "ply", 3) != 0))
        status =
            cs_fail(error, CLSHEAR_BAD_FILE, "%s:1: a PLY file begins with \"ply\"", model->path);
    if (status == CLSHEAR_OK) status = read_elements(reader, bytes);
    cs_array_free(&reader->corners);
    cs_array_free(&reader->texts);
    free(reader);
    return status;
}
