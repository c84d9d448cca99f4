/* Convergence studies: the error of a pattern at increasing sample counts. */
#ifndef CS_STUDY_CONVERGENCE_H
#define CS_STUDY_CONVERGENCE_H

#include "clshear/analysis.h"
#include "film/film.h"
#include "render/objects.h"
#include "settings/settings.h"

struct clshear_convergence {
    size_t sizes;
    uint32_t *counts; /* samples in a pattern, one entry per size */
    double *errors;   /* error of a pattern, one entry per size */
    double mean;      /* mean over all patterns of the largest size */
    clshear_fit fit;
    clshear_fit *local; /* between a size and the next, sizes - 1 entries */
    float *maps;        /* of images: errors of the pixels, one plane per size; else NULL */
    int window[4];      /* of images: x0, x1, y0, y1 in the full image, px */
};

/* The sample counts of a study, and the number of patterns at each. */
typedef struct cs_study {
    const uint32_t *counts; /* samples in a pattern, rising */
    size_t sizes;           /* length of `counts`, 2 or more */
    uint32_t replicates;    /* patterns of each size, 2 or more */
} cs_study;

/* Allocates a result with `sizes` entries. Initialise it to zero; free it with
 * cs_convergence_free. */
clshear_status cs_convergence_reserve(const cs_study *study, clshear_convergence *result,
                                      cs_error *error);
void cs_convergence_free(clshear_convergence *result);

/* Computes errors and slopes. `values` has `count` values for each size: means of replicates, whose
 * error is the variance or the mean squared difference from *reference; or, with `are_parts`, parts
 * of the error, whose mean it is. */
clshear_status cs_convergence_fit(const double *values, size_t count, int are_parts,
                                  const double *reference, clshear_convergence *result);

/* Implement the public functions of these names. */
clshear_status cs_converge_integrand(const clshear_integrand *integrand, const char *sampler,
                                     uint32_t seed, const cs_study *study, const double *reference,
                                     clshear_convergence *result, cs_error *error);
clshear_status cs_converge_pixel(clshear_scene *scene, const clshear_settings *settings, int x,
                                 int y, const cs_study *study, const double *reference,
                                 clshear_convergence *result, cs_error *error);
clshear_status cs_converge_image(clshear_scene *scene, const clshear_settings *settings,
                                 const cs_study *study, const clshear_film *reference,
                                 clshear_convergence *result, cs_error *error);

/* Makes the settings of one render of a study, with `count` samples in each replicate. The pilot is
 * replaced by the centre and adaptive sampling is off, because the study measures one fixed
 * pattern. Initialise `settings` to zero; free it with cs_settings_free. */
clshear_status cs_study_settings(const clshear_settings *given, const cs_study *study,
                                 uint32_t count, clshear_settings *settings, cs_error *error);

#endif
