/* Buffer views that meshoptimizer has compressed. The library ends the program by an assertion
 * where its arguments do not fit, so they are checked here before. Source: EXT_meshopt_compression,
 * "Specifying compressed views". */
#include <meshoptimizer.h>

#include <stdlib.h>
#include <string.h>

#include "helper/unpack.h"

/* Bytes that a compressed one may stand for: items that are all alike take two bits for sixteen
 * bytes of each of their columns. */
static const size_t most_expansion = 64;

static clshear_status refuse(cs_error *error)
{
    return cs_fail(error, CLSHEAR_BAD_FILE, "its mode, filter, count and byteStride do not fit");
}

/* A filter: it makes numbers of the decoded items, in place. */
typedef struct meshopt_filter {
    const char *name;
    void (*apply)(void *items, size_t count, size_t stride);
    size_t strides[2]; /* bytes of an item that it takes; 0, 0: any multiple of 4 */
} meshopt_filter;

static const meshopt_filter filters[] = {
    {"NONE", NULL, {0, 0}},
    {"OCTAHEDRAL", meshopt_decodeFilterOct, {4, 8}},
    {"QUATERNION", meshopt_decodeFilterQuat, {8, 8}},
    {"EXPONENTIAL", meshopt_decodeFilterExp, {0, 0}},
};

static const meshopt_filter *find_filter(const cs_packed_view *view)
{
    for (size_t i = 0; i < sizeof filters / sizeof *filters; i++) {
        const meshopt_filter *filter = &filters[i];
        if (strcmp(filter->name, view->filter) != 0) continue;
        const int fits = filter->strides[0] == 0 || filter->strides[0] == view->stride ||
                         filter->strides[1] == view->stride;
        return fits ? filter : NULL;
    }
    return NULL;
}

static int decode_attributes(const unsigned char *bytes, size_t size, const cs_packed_view *view,
                             unsigned char *items)
{
    return meshopt_decodeVertexBuffer(items, view->count, view->stride, bytes, size);
}

static int decode_triangles(const unsigned char *bytes, size_t size, const cs_packed_view *view,
                            unsigned char *items)
{
    return meshopt_decodeIndexBuffer(items, view->count, view->stride, bytes, size);
}

static int decode_indices(const unsigned char *bytes, size_t size, const cs_packed_view *view,
                          unsigned char *items)
{
    return meshopt_decodeIndexSequence(items, view->count, view->stride, bytes, size);
}

typedef int (*meshopt_decoder)(const unsigned char *bytes, size_t size, const cs_packed_view *view,
                               unsigned char *items);

/* The decoder of the view's mode, or NULL where the view is none that it takes. */
static meshopt_decoder find_decoder(const cs_packed_view *view)
{
    const int is_index = view->stride == 2 || view->stride == 4;
    if (strcmp(view->mode, "ATTRIBUTES") == 0)
        return view->stride > 0 && view->stride <= 256 && view->stride % 4 == 0 ? decode_attributes
                                                                                : NULL;
    if (!is_index || strcmp(view->filter, "NONE") != 0) return NULL;
    if (strcmp(view->mode, "TRIANGLES") == 0) return view->count % 3 == 0 ? decode_triangles : NULL;
    return strcmp(view->mode, "INDICES") == 0 ? decode_indices : NULL;
}

clshear_status cs_unpack_meshopt(const void *bytes, size_t size, const cs_packed_view *view,
                                 unsigned char **unpacked, cs_error *error)
{
    const meshopt_decoder decode = find_decoder(view);
    const meshopt_filter *filter = find_filter(view);
    if (decode == NULL || filter == NULL) return refuse(error);
    if (view->count > most_expansion * size / view->stride)
        return cs_fail(error, CLSHEAR_BAD_FILE, "its %zu bytes cannot be %zu items", size,
                       view->count);
    *unpacked = calloc(view->count + 1, view->stride);
    if (*unpacked == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "needs more memory than there is");
    if (decode(bytes, size, view, *unpacked) != 0)
        return cs_fail(error, CLSHEAR_BAD_FILE, "its data are damaged");
    if (filter->apply != NULL) filter->apply(*unpacked, view->count, view->stride);
    return CLSHEAR_OK;
}
