/* Compressed glTF: buffer views of EXT_meshopt_compression, primitives of
 * KHR_draco_mesh_compression. */
#include <stdlib.h>
#include <string.h>

#include "import/gltf_reader.h"
#include "import/readers.h"

static const cs_import_modules *modules_of(const gltf_reader *reader)
{
    static const cs_import_modules none = {NULL, NULL, NULL};
    return reader->model->modules != NULL ? reader->model->modules : &none;
}

static clshear_status without_module(const gltf_reader *reader, const char *place, long long index,
                                     const char *extension)
{
    return gltf_complain(reader, place, index, "%s is read by the program clshear-import alone",
                         extension);
}

/* ----- Buffer views ----- */

static const char meshopt_name[] = "EXT_meshopt_compression";

static clshear_status unpack_view(gltf_reader *reader, long long index, const json_t *json,
                                  gltf_buffer *made)
{
    const unsigned char *data = NULL;
    size_t size = 0;
    const cs_meshopt_reader read = modules_of(reader)->meshopt;
    const long long count = gltf_index(json, "count"), stride = gltf_index(json, "byteStride");
    cs_error why = {""};
    clshear_status status = gltf_range(reader, json, index, &data, &size);
    if (status != CLSHEAR_OK) return status;
    if (read == NULL) return without_module(reader, "bufferViews", index, meshopt_name);
    if (count < 0 || stride <= 0)
        return gltf_complain(reader, "bufferViews", index, "%s has no count and byteStride",
                             meshopt_name);
    const cs_packed_view view = {.count = (size_t)count,
                                 .stride = (size_t)stride,
                                 .mode = gltf_text(json, "mode", ""),
                                 .filter = gltf_text(json, "filter", "NONE")};
    unsigned char *items = NULL;
    status = read(data, size, &view, &items, &why);
    if (status != CLSHEAR_OK) {
        free(items);
        if (status == CLSHEAR_OUT_OF_MEMORY) return cs_model_full(reader->model, reader->error);
        return gltf_complain(reader, "bufferViews", index, "%s: %s", meshopt_name, why.message);
    }
    made->owned = (char *)items;
    made->data = items;
    made->size = view.count * view.stride;
    return CLSHEAR_OK;
}

clshear_status gltf_packed_view(gltf_reader *reader, long long index, const json_t *view,
                                const unsigned char **data, size_t *size)
{
    gltf_buffer *made = &reader->views[index];
    if (made->data == NULL) {
        const clshear_status status =
            unpack_view(reader, index, gltf_extension(view, meshopt_name), made);
        if (status != CLSHEAR_OK) return status;
    }
    *data = made->data;
    *size = made->size;
    return CLSHEAR_OK;
}

int gltf_is_packed(const json_t *view)
{
    return gltf_extension(view, meshopt_name) != NULL;
}

size_t gltf_packed_stride(const gltf_reader *reader, long long index)
{
    const json_t *packed = gltf_extension(gltf_at(reader, "bufferViews", index), meshopt_name);
    const long long stride = gltf_index(packed, "byteStride");
    return stride > 0 ? (size_t)stride : 0;
}

/* ----- Primitives ----- */

static const char draco_name[] = "KHR_draco_mesh_compression";

static int is_required(const gltf_reader *reader)
{
    const json_t *required = json_object_get(reader->root, "extensionsRequired");
    for (size_t i = 0; i < json_array_size(required); i++) {
        const char *name = json_string_value(json_array_get(required, i));
        if (name != NULL && strcmp(name, draco_name) == 0) return 1;
    }
    return 0;
}

/* Gives an accessor the numbers that were unpacked for it, in the place of those it has. */
static void take_over(gltf_unpacked *accessor, const gltf_unpacked *made)
{
    free(accessor->values);
    *accessor = *made;
}

/* Notes what the accessors of a primitive want of its mesh. `wanted` has room for all of them, and
 * `accessors` for their numbers. */
static clshear_status list_attributes(gltf_reader *reader, const json_t *packed,
                                      const json_t *attributes, cs_packed_mesh *mesh,
                                      long long *accessors)
{
    const char *name;
    json_t *ignored;
    json_object_foreach(json_object_get(packed, "attributes"), name, ignored)
    {
        cs_packed_attribute *wanted = &mesh->attributes[mesh->attribute_count];
        const long long id = gltf_index(json_object_get(packed, "attributes"), name);
        const long long accessor = gltf_index(attributes, name);
        if (accessor == -1) continue;
        if (gltf_at(reader, "accessors", accessor) == NULL) return CLSHEAR_BAD_FILE;
        const clshear_status status =
            gltf_accessor_type(reader, accessor, &wanted->type, &wanted->components);
        if (status != CLSHEAR_OK) return status;
        wanted->id = id >= 0 && id < UINT32_MAX ? (uint32_t)id : UINT32_MAX;
        accessors[mesh->attribute_count++] = accessor;
    }
    return CLSHEAR_OK;
}

static clshear_status check_counts(const gltf_reader *reader, const char *place,
                                   const cs_packed_mesh *mesh, const long long *accessors)
{
    for (size_t i = 0; i < mesh->attribute_count; i++) {
        const long long count = gltf_index(gltf_at(reader, "accessors", accessors[i]), "count");
        if (count != (long long)mesh->vertex_count)
            return gltf_complain(reader, place, -1,
                                 "%s has %zu vertices, but accessors[%lld] says %lld", draco_name,
                                 mesh->vertex_count, accessors[i], count);
    }
    return CLSHEAR_OK;
}

/* Unpacks the mesh in the buffer view `view` into the accessors of the primitive. */
static clshear_status unpack_mesh(gltf_reader *reader, const char *place, const json_t *primitive,
                                  long long view, cs_packed_mesh *mesh, long long *accessors)
{
    const unsigned char *data = NULL;
    size_t size = 0, stride = 0;
    cs_error why = {""};
    const cs_draco_reader read = modules_of(reader)->draco;
    const json_t *packed = gltf_extension(primitive, draco_name);
    const long long indices = gltf_index(primitive, "indices");
    clshear_status status =
        list_attributes(reader, packed, json_object_get(primitive, "attributes"), mesh, accessors);
    if (status == CLSHEAR_OK) status = gltf_view(reader, view, &data, &size, &stride);
    if (status != CLSHEAR_OK) return status;
    if (gltf_at(reader, "accessors", indices) == NULL) return CLSHEAR_BAD_FILE;
    if (read == NULL) return without_module(reader, place, -1, draco_name);
    status = read(data, size, mesh, &why);
    if (status == CLSHEAR_OUT_OF_MEMORY) return cs_model_full(reader->model, reader->error);
    if (status != CLSHEAR_OK)
        return gltf_complain(reader, place, -1, "%s: %s", draco_name, why.message);
    status = check_counts(reader, place, mesh, accessors);
    if (status != CLSHEAR_OK) return status;
    for (size_t i = 0; i < mesh->attribute_count; i++) {
        cs_packed_attribute *from = &mesh->attributes[i];
        take_over(
            &reader->unpacked[accessors[i]],
            &(gltf_unpacked){from->values, view, from->type, from->components, mesh->vertex_count});
        from->values = NULL;
    }
    take_over(&reader->unpacked[indices],
              &(gltf_unpacked){mesh->indices, view, GLTF_UINT32, 1, mesh->index_count});
    mesh->indices = NULL;
    return CLSHEAR_OK;
}

static int came_from(const gltf_reader *reader, long long accessor, long long view)
{
    if (accessor < 0 || (size_t)accessor >= reader->accessor_count) return 0;
    const gltf_unpacked *unpacked = &reader->unpacked[accessor];
    return unpacked->values != NULL && unpacked->view == view;
}

/* Whether all that the primitive has in the buffer view is in its accessors already. */
static int is_unpacked(const gltf_reader *reader, const json_t *primitive, long long view)
{
    const json_t *attributes = json_object_get(primitive, "attributes");
    const char *name;
    json_t *ignored;
    json_object_foreach(json_object_get(gltf_extension(primitive, draco_name), "attributes"), name,
                        ignored)
    {
        const long long accessor = gltf_index(attributes, name);
        if (accessor != -1 && !came_from(reader, accessor, view)) return 0;
    }
    return came_from(reader, gltf_index(primitive, "indices"), view);
}

clshear_status gltf_unpack_primitive(gltf_reader *reader, const char *place,
                                     const json_t *primitive, int *is_list)
{
    const json_t *packed = gltf_extension(primitive, draco_name);
    const long long view = gltf_index(packed, "bufferView");
    const long long position = gltf_index(json_object_get(primitive, "attributes"), "POSITION");
    if (packed == NULL || position == -1) return CLSHEAR_OK;
    if (gltf_at(reader, "accessors", position) == NULL) return CLSHEAR_BAD_FILE;
    if (!is_required(reader) && gltf_has_bytes(reader, position)) return CLSHEAR_OK;
    *is_list = 1;
    if (is_unpacked(reader, primitive, view)) return CLSHEAR_OK;
    const size_t most = json_object_size(json_object_get(packed, "attributes")) + 1;
    cs_packed_mesh mesh = {.attributes = calloc(most, sizeof *mesh.attributes)};
    long long *accessors = calloc(most, sizeof *accessors);
    clshear_status status = CLSHEAR_OUT_OF_MEMORY;
    if (mesh.attributes == NULL || accessors == NULL)
        cs_model_full(reader->model, reader->error);
    else
        status = unpack_mesh(reader, place, primitive, view, &mesh, accessors);
    for (size_t i = 0; i < mesh.attribute_count; i++)
        free(mesh.attributes[i].values);
    free(mesh.attributes);
    free(mesh.indices);
    free(accessors);
    return status;
}
