/* The table of BSDFs, the ways in which surfaces scatter light: kernels, host and tests expand it.
 * Shared.
 *
 * X(identifier, name, suffix)
 * suffix: cs_bsdf_eval_<suffix> and cs_bsdf_sample_<suffix> are functions in this folder, see
 * bsdf.h. */
#ifndef CS_BSDF_LIST_H
#define CS_BSDF_LIST_H

#define CS_BSDF_LIST(X) X(LAMBERT, "lambert", lambert)

#define CS_BSDF_IDENTIFIER(identifier, name, suffix) CS_BSDF_##identifier,

enum {
    CS_BSDF_LIST(CS_BSDF_IDENTIFIER) CS_BSDF_KINDS
};

#endif
