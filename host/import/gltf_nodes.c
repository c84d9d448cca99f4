/* Nodes, cameras and lights of glTF. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import/gltf_reader.h"

/* A node that waits, with what its parents do to it. */
typedef struct gltf_visit {
    long long node;
    double matrix[16]; /* columns */
    int is_hidden;     /* its mesh and lights, and those below it */
    int is_root;       /* the scene names it */
} gltf_visit;

static void identity(double *m)
{
    for (int i = 0; i < 16; i++)
        m[i] = i % 5 == 0 ? 1.0 : 0.0;
}

void gltf_multiply(const double *a, const double *b, double *product)
{
    for (int column = 0; column < 4; column++)
        for (int row = 0; row < 4; row++) {
            double sum = 0.0;
            for (int k = 0; k < 4; k++)
                sum += a[4 * k + row] * b[4 * column + k];
            product[4 * column + row] = sum;
        }
}

void gltf_compose(const double *translation, const double *q, const double *s, double *m)
{
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double scale = length > 0.0 ? 1.0 / length : 1.0;
    const double x = scale * q[0], y = scale * q[1], z = scale * q[2], w = scale * q[3];
    const double rotation[3][3] = {
        {1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
        {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
        {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
    identity(m);
    for (int column = 0; column < 3; column++)
        for (int row = 0; row < 3; row++)
            m[4 * column + row] = s[column] * rotation[column][row];
    for (int axis = 0; axis < 3; axis++)
        m[12 + axis] = translation[axis];
}

/* The node's own transformation. */
static void local_matrix(const json_t *node, double *m)
{
    double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    identity(m);
    if (json_is_array(json_object_get(node, "matrix"))) {
        gltf_numbers(node, "matrix", m, 16);
        return;
    }
    gltf_numbers(node, "translation", t, 3);
    gltf_numbers(node, "rotation", q, 4);
    gltf_numbers(node, "scale", s, 3);
    gltf_compose(t, q, s, m);
}

/* The node that an element of a list names, -1 if it is no index. */
static long long node_in(const json_t *list, size_t place)
{
    const json_t *value = json_array_get(list, place);
    const double number = json_is_number(value) ? json_number_value(value) : -1.0;
    return number >= 0.0 && number < 9e15 ? (long long)number : -1;
}

/* Notes of each node which one has it among its children: the first, if there are more. Returns 0
 * where memory is out. */
static int find_parents(gltf_reader *reader)
{
    const json_t *nodes = json_object_get(reader->root, "nodes");
    const size_t count = json_array_size(nodes);
    reader->nodes = calloc(count + 1, sizeof *reader->nodes);
    if (reader->nodes == NULL) return 0;
    for (size_t i = 0; i < count; i++)
        reader->nodes[i].parent = -1;
    for (size_t i = 0; i < count; i++) {
        const json_t *children = json_object_get(json_array_get(nodes, i), "children");
        for (size_t k = 0; k < json_array_size(children); k++) {
            const long long child = node_in(children, k);
            if (child < 0 || (size_t)child >= count) continue;
            if (reader->nodes[child].parent < 0) reader->nodes[child].parent = (long long)i;
        }
    }
    return 1;
}

/* Lists a node and those above it whose places are not known yet, upwards. */
static clshear_status list_unknown(gltf_reader *reader, long long node, cs_array *path)
{
    while (node >= 0 && !reader->nodes[node].is_known) {
        long long *added = cs_array_extend(path, 1);
        if (added == NULL) return cs_model_full(reader->model, reader->error);
        *added = node;
        if (path->count > gltf_count(reader, "nodes"))
            return gltf_complain(reader, "nodes", node, "is its own parent");
        node = reader->nodes[node].parent;
    }
    return CLSHEAR_OK;
}

/* Skins ask for the places of all their joints, which share most of what is above them: each is
 * found once. */
clshear_status gltf_global_matrix(gltf_reader *reader, long long node, double *matrix)
{
    cs_array path = {.item_size = sizeof(long long)};
    if (gltf_at(reader, "nodes", node) == NULL) return CLSHEAR_BAD_FILE;
    if (reader->nodes == NULL && !find_parents(reader))
        return cs_model_full(reader->model, reader->error);
    clshear_status status = list_unknown(reader, node, &path);
    for (size_t i = path.count; i > 0 && status == CLSHEAR_OK; i--) {
        const long long number = ((const long long *)path.items)[i - 1];
        const json_t *json = gltf_at(reader, "nodes", number);
        gltf_node_place *place = &reader->nodes[number];
        double local[16];
        local_matrix(json, local);
        if (place->parent >= 0)
            gltf_multiply(reader->nodes[place->parent].matrix, local, place->matrix);
        else
            memcpy(place->matrix, local, sizeof local);
        place->is_known = 1;
    }
    if (status == CLSHEAR_OK) memcpy(matrix, reader->nodes[node].matrix, 16 * sizeof *matrix);
    cs_array_free(&path);
    return status;
}

/* ----- Cameras ----- */

static int camera_is_named(const cs_model *model, const char *name)
{
    const cs_model_camera *cameras = model->cameras.items;
    for (size_t i = 0; i < model->cameras.count; i++)
        if (strncmp(cameras[i].name, name, CS_MODEL_NAME - 1) == 0) return 1;
    return 0;
}

static clshear_status add_camera(gltf_reader *reader, long long index, const json_t *node,
                                 const double *m)
{
    cs_model *model = reader->model;
    const json_t *json = gltf_at(reader, "cameras", index);
    if (json == NULL) return CLSHEAR_BAD_FILE;
    char number[32];
    snprintf(number, sizeof number, "camera %lld", index);
    const char *name = gltf_text(json, "name", number), *of_node = gltf_text(node, "name", NULL);
    if (of_node != NULL && (camera_is_named(model, name) || name == number)) name = of_node;
    cs_model_camera *camera = cs_model_extend(&model->cameras, 1);
    if (camera == NULL) return cs_model_full(model, reader->error);
    snprintf(camera->name, sizeof camera->name, "%.*s", CS_MODEL_NAME - 1, name);
    for (int i = 0; i < 3; i++) {
        camera->eye[i] = m[12 + i];
        camera->forward[i] = -m[8 + i];
        camera->up[i] = m[4 + i];
    }
    if (strcmp(gltf_text(json, "type", "perspective"), "perspective") == 0)
        camera->fov = gltf_number(json_object_get(json, "perspective"), "yfov", 0.0);
    else
        camera->height =
            2.0 * fabs(gltf_number(json_object_get(json, "orthographic"), "ymag", 0.0));
    return CLSHEAR_OK;
}

/* ----- Lights ----- */

static clshear_status add_light(gltf_reader *reader, long long index, const json_t *node,
                                const double *m)
{
    const json_t *all =
        json_object_get(gltf_extension(reader->root, "KHR_lights_punctual"), "lights");
    const json_t *json = index >= 0 ? json_array_get(all, (size_t)index) : NULL;
    if (json == NULL)
        return gltf_complain(reader, "lights", -1, "%lld is asked for, but there are %zu", index,
                             json_array_size(all));
    const char *type = gltf_text(json, "type", "");
    const char *name = gltf_text(json, "name", gltf_text(node, "name", type));
    cs_model_light light = {.kind = CS_MODEL_POINT};
    double colour[3] = {1, 1, 1};
    snprintf(light.name, sizeof light.name, "%.*s", CS_MODEL_NAME - 1, name);
    if (strcmp(type, "directional") == 0)
        light.kind = CS_MODEL_DIRECTIONAL;
    else if (strcmp(type, "spot") == 0)
        light.kind = CS_MODEL_SPOT;
    else if (strcmp(type, "point") != 0) {
        cs_warn(reader->model->log, "%s: light \"%s\" is of a kind that is not supported; left out",
                reader->model->path, light.name);
        return CLSHEAR_OK;
    }
    gltf_numbers(json, "color", colour, 3);
    const double intensity = gltf_number(json, "intensity", 1.0);
    const json_t *spot = json_object_get(json, "spot");
    light.cone[0] = (float)gltf_number(spot, "innerConeAngle", 0.0);
    light.cone[1] = (float)gltf_number(spot, "outerConeAngle", 0.7853981633974483);
    light.range = (float)gltf_number(json, "range", 0.0);
    for (int i = 0; i < 3; i++) {
        light.position[i] = m[12 + i];
        light.axis[i] = -m[8 + i];
        light.colour[i] = (float)(colour[i] * intensity);
    }
    cs_model_light *added = cs_model_extend(&reader->model->lights, 1);
    if (added == NULL) return cs_model_full(reader->model, reader->error);
    *added = light;
    return CLSHEAR_OK;
}

/* ----- The walk ----- */

static clshear_status push(gltf_reader *reader, cs_array *waiting, const gltf_visit *visit)
{
    gltf_visit *added = cs_array_extend(waiting, 1);
    if (added == NULL) return cs_model_full(reader->model, reader->error);
    *added = *visit;
    return CLSHEAR_OK;
}

/* Lets the children of a node wait. */
static clshear_status push_children(gltf_reader *reader, cs_array *waiting, const json_t *node,
                                    const double *matrix, int is_hidden)
{
    const json_t *list = json_object_get(node, "children");
    clshear_status status = CLSHEAR_OK;
    gltf_visit visit = {.is_hidden = is_hidden};
    memcpy(visit.matrix, matrix, sizeof visit.matrix);
    for (size_t i = json_array_size(list); i > 0 && status == CLSHEAR_OK; i--) {
        visit.node = node_in(list, i - 1); /* the first one comes off first */
        status = push(reader, waiting, &visit);
    }
    return status;
}

static clshear_status visit_node(gltf_reader *reader, cs_array *waiting, const gltf_visit *visit,
                                 char *seen)
{
    clshear_status status = CLSHEAR_OK;
    const json_t *node = gltf_at(reader, "nodes", visit->node);
    double local[16], matrix[16];
    if (node == NULL) return CLSHEAR_BAD_FILE;
    if (seen[visit->node] && visit->is_root) {
        gltf_note(reader, GLTF_DOUBLED, "nodes", visit->node);
        return CLSHEAR_OK;
    }
    if (seen[visit->node]++)
        return gltf_complain(reader, "nodes", visit->node,
                             "has two parents, or is its own; nodes must be a tree");
    const json_t *visible = json_object_get(gltf_extension(node, "KHR_node_visibility"), "visible");
    const int is_hidden = visit->is_hidden || json_is_false(visible);
    local_matrix(node, local);
    gltf_multiply(visit->matrix, local, matrix);
    const long long camera = gltf_index(node, "camera");
    const json_t *light = gltf_extension(node, "KHR_lights_punctual");
    const json_t *instances = gltf_extension(node, "EXT_mesh_gpu_instancing");
    if (gltf_index(node, "mesh") != -1 && !is_hidden)
        CS_TRY(instances == NULL ? gltf_mesh(reader, node, matrix)
                                 : gltf_instances(reader, instances, node, matrix));
    if (camera != -1) CS_TRY(add_camera(reader, camera, node, matrix));
    if (light != NULL && !is_hidden)
        CS_TRY(add_light(reader, gltf_index(light, "light"), node, matrix));
    CS_TRY(push_children(reader, waiting, node, matrix, is_hidden));
done:
    return status;
}

/* Marks the nodes that others have as children. The caller frees the marks; NULL: out of memory. */
static char *find_children(const gltf_reader *reader)
{
    const json_t *nodes = json_object_get(reader->root, "nodes");
    const size_t count = json_array_size(nodes);
    char *is_child = calloc(count + 1, 1);
    for (size_t i = 0; i < count && is_child != NULL; i++) {
        const json_t *children = json_object_get(json_array_get(nodes, i), "children");
        for (size_t k = 0; k < json_array_size(children); k++) {
            const long long child = node_in(children, k);
            if (child >= 0 && (size_t)child < count) is_child[child] = 1;
        }
    }
    return is_child;
}

/* Lets the nodes of the scene wait; where the file names no scene (NULL), those that are no
 * children. Children that the scene names go below, so that they come off after their parents. */
static clshear_status push_roots(gltf_reader *reader, cs_array *waiting, const json_t *scene)
{
    const json_t *list = json_object_get(scene, "nodes");
    const size_t nodes = gltf_count(reader, "nodes");
    const size_t count = scene != NULL ? json_array_size(list) : nodes;
    clshear_status status = CLSHEAR_OK;
    gltf_visit visit = {.is_root = 1};
    char *is_child = find_children(reader);
    if (is_child == NULL) return cs_model_full(reader->model, reader->error);
    identity(visit.matrix);
    for (int children = scene != NULL; children >= 0; children--)
        for (size_t i = count; i > 0 && status == CLSHEAR_OK; i--) {
            visit.node = scene != NULL ? node_in(list, i - 1) : (long long)i - 1;
            const int known = visit.node >= 0 && (size_t)visit.node < nodes;
            if ((known && is_child[visit.node]) == children) status = push(reader, waiting, &visit);
        }
    free(is_child);
    return status;
}

clshear_status gltf_nodes(gltf_reader *reader)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = reader->error;
    cs_array waiting = {.item_size = sizeof(gltf_visit)};
    const json_t *scene = NULL;
    char *seen = calloc(gltf_count(reader, "nodes") + 1, 1);
    CS_REQUIRE(seen != NULL, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", reader->model->path);
    const long long chosen = gltf_index(reader->root, "scene");
    if (gltf_count(reader, "scenes") > 0) {
        scene = gltf_at(reader, "scenes", chosen >= 0 ? chosen : 0);
        if (scene == NULL) status = CLSHEAR_BAD_FILE;
    }
    if (gltf_count(reader, "scenes") > 1)
        cs_warn(reader->model->log, "%s: %zu scenes, of which number %lld is shown",
                reader->model->path, gltf_count(reader, "scenes"), chosen >= 0 ? chosen : 0);
    if (status == CLSHEAR_OK) status = push_roots(reader, &waiting, scene);
    while (status == CLSHEAR_OK && waiting.count > 0) {
        const gltf_visit visit = ((const gltf_visit *)waiting.items)[--waiting.count];
        status = visit_node(reader, &waiting, &visit, seen);
    }
    if (status == CLSHEAR_OK && gltf_count(reader, "animations") > 0 && !reader->model->is_played)
        cs_warn(reader->model->log,
                "%s: animations are not played; --frame or --shutter play the first",
                reader->model->path);
done:
    cs_array_free(&waiting);
    free(seen);
    return status;
}
