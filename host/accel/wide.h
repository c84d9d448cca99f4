/* The wide hierarchy: that of accel.h with up to CS_WIDE children a node, for single rays. */
#ifndef CS_ACCEL_WIDE_H
#define CS_ACCEL_WIDE_H

#include "base/array.h"
#include "base/status.h"
#include "kernels/scene.h"

/* Makes the array of cs_wide_node of a hierarchy at rest from its `count` nodes, whose leaves name
 * `triangles` triangles. The root is node 0. The result is empty where single rays cannot walk
 * it: with fewer triangles than a leaf is tested for, or if it needs a larger stack than
 * CS_WIDE_STACK. Frees nothing of `nodes`. Fails when out of memory. */
clshear_status cs_wide_make(const cs_node *nodes, size_t count, size_t triangles, cs_array *wide,
                            cs_error *error);

#endif
