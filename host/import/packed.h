/* Geometry that files hold in compressed form, and what unpacks it: libraries that clshear-import
 * loads when a file needs them. */
#ifndef CS_IMPORT_PACKED_H
#define CS_IMPORT_PACKED_H

#include <stddef.h>
#include <stdint.h>

#include "base/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/* An attribute of a mesh that Draco has compressed. */
typedef struct cs_packed_attribute {
    uint32_t id;       /* its number in the mesh */
    int type;          /* that components are wanted in, as glTF numbers types: 5120 to 5126 */
    size_t components; /* wanted of each vertex, 1 to 16 */
    void *values;      /* found: those of all vertices, one behind the other */
} cs_packed_attribute;

/* A mesh that Draco has compressed. Who asks for it frees values and indices, also after a failure.
 */
typedef struct cs_packed_mesh {
    cs_packed_attribute *attributes;
    size_t attribute_count;
    size_t vertex_count; /* found */
    uint32_t *indices;   /* found: three for each triangle; some may name no vertex */
    size_t index_count;
} cs_packed_mesh;

/* Unpacks a mesh: the attributes whose numbers are given, and the triangles. */
typedef clshear_status (*cs_draco_reader)(const void *bytes, size_t size, cs_packed_mesh *mesh,
                                          cs_error *error);

/* How meshoptimizer has compressed a buffer view. */
typedef struct cs_packed_view {
    size_t count;       /* of items */
    size_t stride;      /* bytes of an item */
    const char *mode;   /* "ATTRIBUTES", "TRIANGLES" or "INDICES" */
    const char *filter; /* "NONE", "OCTAHEDRAL", "QUATERNION" or "EXPONENTIAL" */
} cs_packed_view;

/* Unpacks a buffer view: `count` times `stride` bytes, which the caller frees. */
typedef clshear_status (*cs_meshopt_reader)(const void *bytes, size_t size,
                                            const cs_packed_view *view, unsigned char **unpacked,
                                            cs_error *error);

#ifdef __cplusplus
}
#endif

#endif
