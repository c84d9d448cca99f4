/* Slopes of errors over sample counts. */
#ifndef CS_ANALYSIS_FIT_H
#define CS_ANALYSIS_FIT_H

#include "base/status.h"
#include "clshear/analysis.h"

/* Implement the public functions of these names. Errors go to the calling thread's error. */
clshear_status cs_fit_slope(const uint32_t *counts, size_t sizes, const double *means,
                            size_t replicates, const double *reference, double *errors,
                            clshear_fit *fit);
clshear_status cs_fit_slope_of_parts(const uint32_t *counts, size_t sizes, const double *parts,
                                     size_t count, double *errors, clshear_fit *fit);

#endif
