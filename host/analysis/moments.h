/* Moments of measured values. */
#ifndef CS_ANALYSIS_MOMENTS_H
#define CS_ANALYSIS_MOMENTS_H

#include <stddef.h>

/* Implements clshear_variance_of. `count` is 2 or more. */
void cs_variance_of(const double *values, size_t count, double *variance, double *standard_error);

#endif
