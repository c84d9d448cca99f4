#include "scene/albedo.h"

#include "kernels/bsdf/bsdf.h"

const float cs_albedo_table[CS_ALBEDO_FLOATS] = {
#include "albedo_table.h" /* of the build, by make_albedo.c */
};
