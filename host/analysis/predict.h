/* Variance of integrals, predicted from the spectra of samples and integrand. */
#ifndef CS_ANALYSIS_PREDICT_H
#define CS_ANALYSIS_PREDICT_H

#include "analysis/spectrum.h"

enum {
    CS_CONES = 8,      /* parts of a plane besides the tail */
    CS_MOST_PARTS = 12 /* of four dimensions */
};

struct clshear_prediction {
    size_t parts;
    const char *names[CS_MOST_PARTS];
    double variances[CS_MOST_PARTS];
    double energies[CS_MOST_PARTS]; /* NaN where they are not known by parts */
    double variance;                /* the sum of `variances` */
    double isotropic;               /* NaN for four dimensions */
    double energy;                  /* variance of the integrand itself */
};

/* As the public functions of these names; fail with the calling thread's message. */
clshear_status cs_predict_variance(const clshear_spectrum *samples, const float *integrand,
                                   size_t side, double mean_square, clshear_prediction *prediction);
clshear_status cs_predict_variance_4d(clshear_context *context, const clshear_points *samples,
                                      clshear_function function, void *user,
                                      const clshear_reach *reach, clshear_prediction *prediction);

#endif
