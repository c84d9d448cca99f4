/* The AOVs: arbitrary output variables, channels besides the radiance. Shared. */
#ifndef CS_KERNELS_AOV_H
#define CS_KERNELS_AOV_H

#include "clshear/device/dialect.h"

/* X(identifier, layer, letters): as in CLSHEAR_AOV_LIST, in the same order. In the file each letter
 * is a channel of the layer, on the device a plane. */
#define CS_AOV_LIST(X)             \
    X(ALBEDO, "Albedo", "RGB")     \
    X(NORMAL, "N", "XYZ")          \
    X(POSITION, "P", "XYZ")        \
    X(DEPTH, "Depth", "Z")         \
    X(COVERAGE, "Coverage", "A")   \
    X(EMISSION, "Emission", "RGB") \
    X(DIRECT, "Direct", "RGB")     \
    X(INDIRECT, "Indirect", "RGB")

#define CS_AOV_PLANES(identifier, layer, letters) \
    CS_PLANE_##identifier,                        \
        CS_END_PLANE_##identifier = CS_PLANE_##identifier + (int)sizeof(letters) - 2,

enum {
    CS_AOV_LIST(CS_AOV_PLANES) CS_PLANES
};

/* The bits of an AOV's planes in a set of planes. */
#define CS_PLANE_BITS(identifier) \
    ((2u << CS_END_PLANE_##identifier) - (1u << CS_PLANE_##identifier))

#endif
