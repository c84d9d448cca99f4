/* The wide hierarchy: that of accel.h with up to CS_WIDE children a node, for single rays. */
#ifndef CS_ACCEL_WIDE_H
#define CS_ACCEL_WIDE_H

#include "base/array.h"
#include "base/status.h"
#include "kernels/scene.h"

/* In the kernels' layout. */
typedef struct cs_wide_bvh {
    cs_array nodes;  /* cs_wide_node; the root is node 0 */
    cs_array leaves; /* cs_wide_leaf */
} cs_wide_bvh;

void cs_wide_bvh_free(cs_wide_bvh *wide);

/* Makes the wide hierarchy of a binary one at rest: of `count` nodes, whose leaves name
 * `triangles`. The result is empty if a walk of it needs a larger stack than CS_WIDE_STACK, and
 * where there is but one leaf. Fails when out of memory. */
clshear_status cs_wide_bvh_make(const cs_node *nodes, size_t count, const cs_triangle *triangles,
                                cs_wide_bvh *wide, cs_error *error);

/* Bytes of the wide hierarchy that is to be expected of so many triangles in the binary one. */
double cs_wide_bvh_expected(size_t triangles);

#endif
