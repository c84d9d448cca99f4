/* clshear: prediction of the variance of an integral from the spectrum of its samples. */
#ifndef CLSHEAR_PREDICTION_H
#define CLSHEAR_PREDICTION_H

#include "integrands.h"
#include "spectrum.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct clshear_prediction clshear_prediction; /* predicted variance, by parts */

/* Predicts the variance of the mean of the integrand at N samples that are shifted at random around
 * the torus. It is exactly the sum over frequencies f of P_samples(f) P_integrand(f) / N.
 * `integrand` has side x side means of the function over cells of the unit square. `side` is even
 * and at least twice, better eight times, the longer side of the spectrum. `mean_square` is the
 * mean square of the function itself.
 *
 * The parts are eight cones of frequencies and the tail. Cone k covers the angles from k to k + 1
 * eighths of a half turn from the x axis (Singh & Jarosz 2017, eq. 8). The tail lies beyond the
 * spectrum and has the power of random points. */
CLSHEAR_API clshear_status clshear_predict_variance(const clshear_spectrum *samples,
                                                    const float *integrand, size_t side,
                                                    double mean_square,
                                                    clshear_prediction **prediction);

/* Highest frequencies, in each coordinate, of the sums in clshear_predict_variance_4d, and effort.
 */
typedef struct clshear_reach {
    size_t struct_size;
    uint32_t axis;  /* for parts of one coordinate: 1 to 65536; should be 4 N */
    uint32_t plane; /* for parts of two coordinates: 1 to 2047 */
    uint32_t block; /* for the block of three or more: 1 to 15; with the time 1 to 5 */
    size_t points;  /* samples of the function for a part, in each of eight grids: a grid has one in
                       every cell at least; 0: 2^19. Few make the energies noisy, not biased. */
} clshear_reach;

/* Predicts the variance of the mean of a function at N samples that are shifted at random around
 * the torus. The samples' coordinates must begin with x, y, u, v; if the time t is the fifth, it is
 * one more coordinate of the function. A full lattice of frequencies would be too small, so each
 * part covers its own range. The tail has the power of random points. The function's energy at a
 * frequency is the cross power of independently shifted grids, and so free of aliases and noise on
 * average.
 *
 * The parts are the frequencies of x, y, u and v alone, of xy, xu, xv, yu, yv and uv, of three or
 * more coordinates ("block"), and the rest ("tail"); with the time also those of t, xt, yt, ut and
 * vt. */
CLSHEAR_API clshear_status clshear_predict_variance_4d(clshear_context *context,
                                                       const clshear_points *samples,
                                                       clshear_function function, void *user,
                                                       const clshear_reach *reach,
                                                       clshear_prediction **prediction);
CLSHEAR_API void clshear_prediction_free(clshear_prediction *prediction);

/* The predicted variance, the sum of all parts. */
CLSHEAR_API double clshear_prediction_variance(const clshear_prediction *prediction);

/* The predicted variance with the power of each frequency replaced by its ring's mean (Pilleboue et
 * al. 2015). NaN in four dimensions. */
CLSHEAR_API double clshear_prediction_isotropic(const clshear_prediction *prediction);

/* The predicted variance with the power of each frequency replaced by the mean over its ring within
 * one of 2^`level` cones of directions, for levels 0 to 8: from the isotropic formula to, in the
 * limit of many cones, the anisotropic one (Singh & Jarosz 2017). Above 8 the prediction itself;
 * NaN in four dimensions. */
CLSHEAR_API double clshear_prediction_in_cones(const clshear_prediction *prediction, size_t level);

/* Variance of the integrand itself. */
CLSHEAR_API double clshear_prediction_energy(const clshear_prediction *prediction);

CLSHEAR_API size_t clshear_prediction_parts(const clshear_prediction *prediction);

/* Name of a part, its share of the predicted variance, and its share of the integrand's energy (NaN
 * in two dimensions). `part` is below clshear_prediction_parts. */
CLSHEAR_API const char *clshear_prediction_part_name(const clshear_prediction *prediction,
                                                     size_t part);
CLSHEAR_API double clshear_prediction_part_variance(const clshear_prediction *prediction,
                                                    size_t part);
CLSHEAR_API double clshear_prediction_part_energy(const clshear_prediction *prediction,
                                                  size_t part);

#ifdef __cplusplus
}
#endif

#endif
