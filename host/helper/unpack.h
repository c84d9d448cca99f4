/* Compressed geometry, in a module of its own, clshear-import-unpack.so. */
#ifndef CS_HELPER_UNPACK_H
#define CS_HELPER_UNPACK_H

#include "import/packed.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A cs_draco_reader, by Draco. */
clshear_status cs_unpack_draco(const void *bytes, size_t size, cs_packed_mesh *mesh,
                               cs_error *error);

/* A cs_meshopt_reader, by meshoptimizer. */
clshear_status cs_unpack_meshopt(const void *bytes, size_t size, const cs_packed_view *view,
                                 unsigned char **unpacked, cs_error *error);

#ifdef __cplusplus
}
#endif

#endif
