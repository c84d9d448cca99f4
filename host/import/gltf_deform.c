/* Skins and morph targets of glTF: what moves vertices apart from their node. */
#include <stdlib.h>
#include <string.h>

#include "import/gltf_reader.h"

/* Matrix of joint number `i` of a skin. inverse: what brings the mesh to the joint, or NULL. */
static clshear_status open_joint(gltf_reader *reader, long long skin, const json_t *joints,
                                 size_t i, const float *inverse, double *matrix)
{
    const json_t *joint = json_array_get(joints, i);
    double global[16], inverse_bind[16];
    const double place = json_is_number(joint) ? json_number_value(joint) : -1.0;
    if (!(place >= 0.0 && place < (double)gltf_count(reader, "nodes")))
        return gltf_complain(reader, "skins", skin, "joint %zu is no node", i);
    const clshear_status status = gltf_global_matrix(reader, (long long)place, global);
    if (status != CLSHEAR_OK) return status;
    memcpy(matrix, global, sizeof global);
    if (inverse == NULL) return CLSHEAR_OK;
    for (size_t k = 0; k < 16; k++)
        inverse_bind[k] = (double)inverse[k];
    gltf_multiply(global, inverse_bind, matrix);
    return CLSHEAR_OK;
}

clshear_status gltf_skin_open(gltf_reader *reader, const json_t *node, gltf_skin *skin)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = reader->error;
    float *inverse = NULL;
    size_t count = 0, given = 16;
    const long long number = gltf_index(node, "skin");
    *skin = (gltf_skin){0};
    if (number == -1) return CLSHEAR_OK;
    const json_t *json = gltf_at(reader, "skins", number);
    if (json == NULL) return CLSHEAR_BAD_FILE;
    const json_t *joints = json_object_get(json, "joints");
    const long long matrices = gltf_index(json, "inverseBindMatrices");
    if (matrices != -1) CS_TRY(gltf_read_floats(reader, matrices, 16, &inverse, &count, &given));
    if (matrices != -1 && (count < json_array_size(joints) || given != 16)) {
        status = gltf_complain(reader, "skins", number, "has %zu inverse matrices for %zu joints",
                               count, json_array_size(joints));
        goto done;
    }
    skin->joints = calloc(json_array_size(joints) + 1, sizeof *skin->joints);
    CS_REQUIRE(skin->joints != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for a skin");
    for (size_t i = 0; i < json_array_size(joints); i++)
        CS_TRY(open_joint(reader, number, joints, i, inverse != NULL ? inverse + 16 * i : NULL,
                          skin->joints[i]));
    skin->joint_count = json_array_size(joints);
done:
    free(inverse);
    if (status != CLSHEAR_OK) gltf_skin_close(skin);
    return status;
}

/* Takes the joints of the last primitive away. */
static void unbind(gltf_skin *skin)
{
    free(skin->which);
    free(skin->weights);
    skin->which = skin->weights = NULL;
}

void gltf_skin_close(gltf_skin *skin)
{
    unbind(skin);
    free(skin->joints);
    *skin = (gltf_skin){0};
}

clshear_status gltf_skin_bind(gltf_reader *reader, const json_t *attributes, size_t count,
                              gltf_skin *skin)
{
    clshear_status status = CLSHEAR_OK;
    size_t joints = 0, weights = 0, given = 0;
    unbind(skin);
    if (skin->joint_count == 0 || json_object_get(attributes, "JOINTS_0") == NULL)
        return CLSHEAR_OK;
    CS_TRY(gltf_read_floats(reader, gltf_index(attributes, "JOINTS_0"), 4, &skin->which, &joints,
                            &given));
    CS_TRY(gltf_read_floats(reader, gltf_index(attributes, "WEIGHTS_0"), 4, &skin->weights,
                            &weights, &given));
    if (joints != count || weights != count)
        status = gltf_complain(reader, "skins", -1, "%zu joints and %zu weights for %zu vertices",
                               joints, weights, count);
    for (size_t i = 0; i < 4 * count && status == CLSHEAR_OK; i++) {
        if (skin->which[i] >= 0.0f && skin->which[i] < (float)skin->joint_count) continue;
        if (skin->weights[i] == 0.0f)
            skin->which[i] = 0.0f; /* exporters leave anything there */
        else
            status = gltf_complain(reader, "skins", -1, "vertex %zu names joint %g of %zu", i / 4,
                                   (double)skin->which[i], skin->joint_count);
    }
done:
    if (status != CLSHEAR_OK) unbind(skin);
    return status;
}

void gltf_skin_matrix(const gltf_skin *skin, size_t vertex, const double *of_node, double *matrix)
{
    double total = 0.0;
    for (size_t k = 0; skin->which != NULL && k < 4; k++)
        total += (double)skin->weights[4 * vertex + k];
    memcpy(matrix, of_node, 16 * sizeof *matrix);
    if (skin->which == NULL) return;
    if (!(total > 0.0)) { /* the node is not what moves a skin */
        memcpy(matrix, skin->joints[(size_t)skin->which[4 * vertex]], 16 * sizeof *matrix);
        return;
    }
    memset(matrix, 0, 16 * sizeof *matrix);
    for (size_t k = 0; k < 4; k++) {
        const double weight = (double)skin->weights[4 * vertex + k] / total;
        const double *joint = skin->joints[(size_t)skin->which[4 * vertex + k]];
        for (int i = 0; i < 16; i++)
            matrix[i] += weight * joint[i];
    }
}

clshear_status gltf_morph(gltf_reader *reader, const json_t *primitive, const json_t *weights,
                          const char *attribute, size_t components, float *values, size_t count)
{
    const json_t *targets = json_object_get(primitive, "targets");
    const int is_colour = components == 4 && strcmp(attribute, "COLOR_0") == 0;
    for (size_t k = 0; k < json_array_size(targets) && k < json_array_size(weights); k++) {
        const float weight = (float)json_number_value(json_array_get(weights, k));
        const long long accessor = gltf_index(json_array_get(targets, k), attribute);
        float *change = NULL;
        size_t changed = 0, given = 0;
        if (weight == 0.0f || accessor == -1) continue;
        clshear_status status =
            is_colour ? gltf_read_colours(reader, accessor, &change, &changed, &given)
                      : gltf_read_floats(reader, accessor, components, &change, &changed, &given);
        if (status == CLSHEAR_OK && changed != count)
            status = gltf_complain(reader, "accessors", accessor,
                                   "a morph target has %zu items for %zu vertices", changed, count);
        for (size_t i = 0; i < components * count && status == CLSHEAR_OK; i++)
            values[i] += weight * change[i];
        free(change);
        if (status != CLSHEAR_OK) return status;
    }
    return CLSHEAR_OK;
}
