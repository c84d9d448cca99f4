/* Variance of integrals, predicted from the spectra of samples and integrand. */
#ifndef CS_ANALYSIS_PREDICT_H
#define CS_ANALYSIS_PREDICT_H

#include "analysis/spectrum.h"

enum {
    CS_CONES = 8,       /* parts in two dimensions, without the tail */
    CS_MOST_PARTS = 17, /* parts in five dimensions */
    CS_CONE_LEVELS = 9  /* divisions into 1, 2, 4, ... 256 cones */
};

struct clshear_prediction {
    size_t parts;
    const char *names[CS_MOST_PARTS];
    double variances[CS_MOST_PARTS];
    double energies[CS_MOST_PARTS]; /* energy of each part; NaN in two dimensions */
    double variance;                /* sum of `variances` */
    /* Variance from means over parts of rings in 2^level cones; NaN in four dimensions. */
    double by_cones[CS_CONE_LEVELS];
    double energy; /* variance of the integrand itself */
};

/* Implement the public functions of these names. Errors go to the calling thread's error. */
clshear_status cs_predict_variance(const clshear_spectrum *samples, const float *integrand,
                                   size_t side, double mean_square, clshear_prediction *prediction);
clshear_status cs_predict_variance_4d(clshear_context *context, const clshear_points *samples,
                                      clshear_function function, void *user,
                                      const clshear_reach *reach, clshear_prediction *prediction);

#endif
