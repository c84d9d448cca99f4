/* The table of BSDFs, the ways in which surfaces scatter light: kernels, host and tests expand it.
 * Shared.
 *
 * X(identifier, name, suffix)
 * suffix: cs_bsdf_eval_<suffix> and cs_bsdf_sample_<suffix> are functions in this folder, see
 * bsdf.h. */
#ifndef CS_BSDF_LIST_H
#define CS_BSDF_LIST_H

#include "kernels/features.h"

#define CS_BSDF_LIST_ALL(X)           \
    X(LAMBERT, "lambert", lambert)    \
    X(STANDARD, "standard", standard) \
    X(GLASS, "glass", glass)

/* Programs without the feature MATERIALS (features.h) know the first one only. */
#if CS_HAS(MATERIALS)
#define CS_BSDF_LIST(X) CS_BSDF_LIST_ALL(X)
#define CS_BSDF_KINDS CS_BSDF_ALL
#else
#define CS_BSDF_LIST(X) X(LAMBERT, "lambert", lambert)
#define CS_BSDF_KINDS 1
#endif

#define CS_BSDF_IDENTIFIER(identifier, name, suffix) CS_BSDF_##identifier,

enum {
    CS_BSDF_LIST_ALL(CS_BSDF_IDENTIFIER) CS_BSDF_ALL
};

#endif
