/* Integrands of the unit square, and means of functions over point sets. */
#ifndef CS_ANALYSIS_INTEGRANDS_H
#define CS_ANALYSIS_INTEGRANDS_H

#include "points/points.h"

/* Implement the public functions of these names. Errors go to the calling thread's error. */
clshear_status cs_integrand_find(const char *name, clshear_integrand *integrand);
double cs_integrand_at(const clshear_integrand *integrand, double x, double y);
clshear_status cs_integrand_tabulate(const clshear_integrand *integrand, size_t side, float *cells,
                                     double *mean_square);
void cs_points_integrate(const clshear_points *points, const clshear_integrand *integrand,
                         int homogenise, uint32_t seed, double *means);
clshear_status cs_points_integrate_4d(const clshear_points *points, clshear_function function,
                                      void *user, int homogenise, uint32_t seed, double *means);

/* How many of their first coordinates are arguments of a function: 4 of x, y, u, v, 5 if t follows,
 * and 0 if they begin with others. */
size_t cs_points_arguments(const clshear_points *points);

#endif
