/* Meshes that Draco compresses. */
#ifndef CS_TESTS_PACK_MESH_H
#define CS_TESTS_PACK_MESH_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct test_mesh {
    size_t vertex_count;
    size_t triangle_count;
    const float *positions; /* three numbers of each vertex */
    const float *normals;   /* three */
    const float *textures;  /* two */
    const uint8_t *colours; /* four, parts of 255 */
    const uint16_t *indices;
} test_mesh;

/* Compresses a mesh into `bytes`, which has room for `most`. Without loss, in the order of its
 * vertices and triangles; or is_short: in another order, and positions, normals and coordinates to
 * 14 bits. Its attributes have the numbers 0 to 3, in the order above. Returns the number of bytes;
 * 0: it failed. */
size_t test_pack_draco(const test_mesh *mesh, int is_short, unsigned char *bytes, size_t most);

#ifdef __cplusplus
}
#endif

#endif
