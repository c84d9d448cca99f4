/* Accessors of glTF: numbers in buffer views. */
#include <stdlib.h>
#include <string.h>

#include "import/gltf_reader.h"

/* Where the numbers of an accessor, or of its sparse part, are. */
typedef struct gltf_span {
    const unsigned char *data; /* NULL: zeros */
    size_t stride;
    size_t count;
    size_t components;
    int type; /* of a component */
    int normalised;
} gltf_span;

static size_t size_of(int type)
{
    return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4;
}

static size_t components_of(const char *type)
{
    static const char *const names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    for (size_t i = 0; i < 4; i++)
        if (strcmp(type, names[i]) == 0) return i + 1;
    return strcmp(type, "MAT4") == 0 ? 16 : 0;
}

/* Points `span`, whose other members are set, at `count` items in a buffer view. */
static clshear_status point_into(gltf_reader *reader, const json_t *json, long long accessor,
                                 gltf_span *span)
{
    size_t size = 0, stride = 0;
    const size_t item = span->components * size_of(span->type);
    const long long offset = gltf_index(json, "byteOffset");
    const long long view = gltf_index(json, "bufferView");
    clshear_status status = gltf_view(reader, view, &span->data, &size, &stride);
    if (status != CLSHEAR_OK) return status;
    const size_t begin = offset > 0 ? (size_t)offset : 0;
    span->stride = stride > 0 ? stride : item;
    /* Only the extension says that items are filled up, in a view without a stride of its own. */
    if (stride == 0 && gltf_packed_stride(reader, view) > item)
        span->stride = gltf_packed_stride(reader, view);
    if (offset == -2 || span->stride < item)
        return gltf_complain(reader, "accessors", accessor,
                             "its byteOffset or byteStride cannot be");
    if (span->count > 0 && (begin > size || (span->count - 1) * span->stride + item > size - begin))
        return gltf_complain(reader, "accessors", accessor,
                             "%zu items do not fit into the %zu bytes of its bufferView",
                             span->count, size);
    span->data += begin;
    return CLSHEAR_OK;
}

clshear_status gltf_accessor_type(const gltf_reader *reader, long long index, int *type,
                                  size_t *components)
{
    const json_t *json = gltf_at(reader, "accessors", index);
    if (json == NULL) return CLSHEAR_BAD_FILE;
    const long long given = gltf_index(json, "componentType");
    *components = components_of(gltf_text(json, "type", ""));
    *type = (int)given;
    if (given < 5120 || given > 5126 || *components == 0)
        return gltf_complain(reader, "accessors", index, "its type or componentType is not known");
    return CLSHEAR_OK;
}

/* Makes `span` that of numbers which were unpacked. */
static void point_at_unpacked(const gltf_unpacked *unpacked, gltf_span *span)
{
    span->type = unpacked->type;
    span->components = unpacked->components;
    span->data = unpacked->values;
    span->stride = unpacked->components * size_of(unpacked->type);
    span->count = unpacked->count;
}

static clshear_status open_accessor(gltf_reader *reader, long long index, const json_t **json,
                                    gltf_span *span)
{
    *json = gltf_at(reader, "accessors", index);
    if (*json == NULL) return CLSHEAR_BAD_FILE;
    const long long count = gltf_index(*json, "count");
    *span = (gltf_span){.normalised = json_is_true(json_object_get(*json, "normalized"))};
    const clshear_status status = gltf_accessor_type(reader, index, &span->type, &span->components);
    if (status != CLSHEAR_OK) return status;
    if (reader->unpacked[index].values != NULL) {
        point_at_unpacked(&reader->unpacked[index], span);
        return CLSHEAR_OK;
    }
    const int is_there = gltf_index(*json, "bufferView") != -1;
    /* What has no bytes in the file must not fill the memory. */
    if (count < 0)
        return gltf_complain(reader, "accessors", index,
                             "its count is no whole number of 0 or more");
    if (count > (is_there ? 3LL * CS_MODEL_MOST : 1LL << 24))
        return gltf_complain(reader, "accessors", index, "a count of %lld cannot be", count);
    span->count = (size_t)count;
    return is_there ? point_into(reader, *json, index, span) : CLSHEAR_OK;
}

/* The type of indices whose exporter calls them signed, which glTF has not: the bytes are the same.
 */
static int unsigned_type(int type)
{
    return type == 5120 || type == 5122 || type == 5124 ? type + 1 : type;
}

static double component_at(const unsigned char *at, const gltf_span *span)
{
    uint32_t word = 0;
    for (size_t i = 0; i < size_of(span->type); i++)
        word |= (uint32_t)at[i] << 8 * i;
    double value = (double)word, most = 1.0;
    float single;
    switch (span->type) {
    case 5120:
        value = (double)(int8_t)word;
        most = 127.0;
        break;
    case 5121:
        most = 255.0;
        break;
    case 5122:
        value = (double)(int16_t)word;
        most = 32767.0;
        break;
    case 5123:
        most = 65535.0;
        break;
    case 5124: /* glTF has no such type; its meaning is plain */
        value = (double)(int32_t)word;
        most = 2147483647.0;
        break;
    case 5125:
        most = 4294967295.0;
        break;
    default:
        memcpy(&single, &word, sizeof single);
        return (double)single;
    }
    if (!span->normalised) return value;
    return value / most < -1.0 ? -1.0 : value / most;
}

static void copy_item(const gltf_span *span, size_t item, size_t most, float *target)
{
    for (size_t c = 0; c < span->components && c < most; c++)
        target[c] =
            (float)component_at(span->data + item * span->stride + c * size_of(span->type), span);
}

/* What an accessor's numbers become: floats, `most` components each, or indices, which would not be
 * exact as floats beyond 2^24. */
typedef struct gltf_target {
    float *floats;
    uint32_t *indices; /* NULL: floats */
    size_t most;
} gltf_target;

/* Puts item `from` of the span in the place `to`. */
static void copy_to(const gltf_span *span, size_t from, const gltf_target *target, size_t to)
{
    if (target->indices != NULL)
        target->indices[to] = (uint32_t)component_at(span->data + from * span->stride, span);
    else
        copy_item(span, from, target->most, target->floats + to * target->most);
}

/* Replaces the items that the sparse part names. */
static clshear_status apply_sparse(gltf_reader *reader, long long index, const json_t *json,
                                   const gltf_span *span, const gltf_target *target)
{
    const json_t *sparse = json_object_get(json, "sparse");
    if (!json_is_object(sparse)) return CLSHEAR_OK;
    const json_t *places = json_object_get(sparse, "indices");
    const long long count = gltf_index(sparse, "count");
    const long long given = gltf_index(places, "componentType");
    const int type = given >= 5120 && given <= 5126 ? unsigned_type((int)given) : 0;
    if (count < 0 || (size_t)count > span->count || (type != 5121 && type != 5123 && type != 5125))
        return gltf_complain(reader, "accessors", index, "its sparse part cannot be");
    gltf_span which = {.components = 1, .type = type, .count = (size_t)count};
    gltf_span what = *span;
    what.count = (size_t)count;
    clshear_status status = point_into(reader, places, index, &which);
    if (status == CLSHEAR_OK)
        status = point_into(reader, json_object_get(sparse, "values"), index, &what);
    for (size_t i = 0; i < (size_t)count && status == CLSHEAR_OK; i++) {
        const double place = component_at(which.data + i * which.stride, &which);
        if (place >= (double)span->count)
            return gltf_complain(reader, "accessors", index,
                                 "its sparse part names item %.0f of %zu", place, span->count);
        copy_to(&what, i, target, (size_t)place);
    }
    return status;
}

/* All numbers of an accessor, those of its sparse part in their places. */
static clshear_status read_items(gltf_reader *reader, long long index, const json_t *json,
                                 const gltf_span *span, const gltf_target *target)
{
    for (size_t i = 0; i < span->count && span->data != NULL; i++)
        copy_to(span, i, target, i);
    return apply_sparse(reader, index, json, span, target);
}

int gltf_has_bytes(const gltf_reader *reader, long long index)
{
    const json_t *all = json_object_get(reader->root, "accessors");
    const json_t *json = index >= 0 ? json_array_get(all, (size_t)index) : NULL;
    return gltf_index(json, "bufferView") != -1 || json_is_object(json_object_get(json, "sparse"));
}

/* is_share: whole numbers are parts of 1, even if the accessor does not say so. */
static clshear_status read_floats(gltf_reader *reader, long long index, size_t most, int is_share,
                                  float **values, size_t *count, size_t *given)
{
    const json_t *json = NULL;
    gltf_span span;
    clshear_status status = open_accessor(reader, index, &json, &span);
    if (status != CLSHEAR_OK) return status;
    span.normalised |= is_share;
    float *made = calloc(span.count + 1, most * sizeof *made);
    if (made == NULL) return cs_model_full(reader->model, reader->error);
    const gltf_target target = {.floats = made, .most = most};
    status = read_items(reader, index, json, &span, &target);
    if (status != CLSHEAR_OK) {
        free(made);
        return status;
    }
    *values = made;
    *count = span.count;
    *given = span.components;
    return CLSHEAR_OK;
}

clshear_status gltf_read_floats(gltf_reader *reader, long long index, size_t most, float **values,
                                size_t *count, size_t *given)
{
    return read_floats(reader, index, most, 0, values, count, given);
}

clshear_status gltf_read_colours(gltf_reader *reader, long long index, float **values,
                                 size_t *count, size_t *given)
{
    return read_floats(reader, index, 4, 1, values, count, given);
}

clshear_status gltf_read_indices(gltf_reader *reader, long long index, uint32_t **values,
                                 size_t *count)
{
    const json_t *json = NULL;
    gltf_span span;
    clshear_status status = open_accessor(reader, index, &json, &span);
    if (status != CLSHEAR_OK) return status;
    span.type = unsigned_type(span.type);
    if (span.components != 1 || (span.type != 5121 && span.type != 5123 && span.type != 5125))
        return gltf_complain(reader, "accessors", index, "its type is none of indices");
    span.normalised = 0;
    uint32_t *made = calloc(span.count + 1, sizeof *made);
    if (made == NULL) return cs_model_full(reader->model, reader->error);
    const gltf_target target = {.indices = made};
    status = read_items(reader, index, json, &span, &target);
    if (status != CLSHEAR_OK) {
        free(made);
        return status;
    }
    *values = made;
    *count = span.count;
    return CLSHEAR_OK;
}
