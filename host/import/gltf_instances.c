/* Instances of a glTF node's mesh: EXT_mesh_gpu_instancing. */
#include <stdlib.h>

#include "import/gltf_reader.h"

/* What one attribute says of all instances. */
typedef struct gltf_placing {
    const char *name;
    size_t components;
    float *values; /* NULL: none are given; owned */
    size_t count;
} gltf_placing;

enum {
    TRANSLATION,
    ROTATION,
    SCALE,
    PLACINGS
};

/* What *count is before an attribute says it. */
#define NOT_GIVEN SIZE_MAX

/* *count: the number of instances; all attributes have as many. */
static clshear_status read_placing(gltf_reader *reader, const json_t *attributes,
                                   gltf_placing *placing, size_t *count)
{
    size_t given = 0;
    const long long accessor = gltf_index(attributes, placing->name);
    if (accessor == -1) return CLSHEAR_OK;
    const clshear_status status = gltf_read_floats(reader, accessor, placing->components,
                                                   &placing->values, &placing->count, &given);
    if (status != CLSHEAR_OK) return status;
    if (given != placing->components)
        return gltf_complain(reader, "accessors", accessor, "is no VEC%zu for the %s of instances",
                             placing->components, placing->name);
    if (*count != NOT_GIVEN && placing->count != *count)
        return gltf_complain(reader, "accessors", accessor,
                             "is the %s of %zu instances, but %zu have another attribute",
                             placing->name, placing->count, *count);
    *count = placing->count;
    return CLSHEAR_OK;
}

static void copy(const gltf_placing *placing, size_t instance, double *values)
{
    for (size_t c = 0; c < placing->components && placing->values != NULL; c++)
        values[c] = (double)placing->values[placing->components * instance + c];
}

clshear_status gltf_instances(gltf_reader *reader, const json_t *instances, const json_t *node,
                              const double *matrix)
{
    gltf_placing placings[PLACINGS] = {
        {"TRANSLATION", 3, NULL, 0}, {"ROTATION", 4, NULL, 0}, {"SCALE", 3, NULL, 0}};
    const json_t *attributes = json_object_get(instances, "attributes");
    size_t count = NOT_GIVEN;
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < PLACINGS && status == CLSHEAR_OK; i++)
        status = read_placing(reader, attributes, &placings[i], &count);
    if (count == NOT_GIVEN) count = 1; /* what else an instance may have does not place it */
    for (size_t i = 0; i < count && status == CLSHEAR_OK; i++) {
        double t[3] = {0, 0, 0}, q[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1}, own[16], placed[16];
        copy(&placings[TRANSLATION], i, t);
        copy(&placings[ROTATION], i, q);
        copy(&placings[SCALE], i, s);
        gltf_compose(t, q, s, own);
        gltf_multiply(matrix, own, placed);
        status = gltf_mesh(reader, node, placed);
    }
    for (size_t i = 0; i < PLACINGS; i++)
        free(placings[i].values);
    return status;
}
