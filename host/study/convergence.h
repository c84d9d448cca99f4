/* Studies of convergence: the error of many patterns at rising numbers of samples. */
#ifndef CS_STUDY_CONVERGENCE_H
#define CS_STUDY_CONVERGENCE_H

#include "clshear/analysis.h"
#include "film/film.h"
#include "render/objects.h"
#include "settings/settings.h"

struct clshear_convergence {
    size_t sizes;
    uint32_t *counts; /* samples in a pattern of each size */
    double *errors;   /* of each size */
    double mean;      /* of all patterns of the last size */
    clshear_fit fit;
};

/* What all studies are asked: which numbers of samples, and how many patterns of each. */
typedef struct cs_study {
    const uint32_t *counts; /* rising */
    size_t sizes;           /* 2 or more */
    uint32_t replicates;    /* 2 or more */
} cs_study;

/* Room for a result of so many sizes. Start from zeros; freed by cs_convergence_free. */
clshear_status cs_convergence_reserve(size_t sizes, clshear_convergence *result, cs_error *error);
void cs_convergence_free(clshear_convergence *result);

/* As the public functions of these names. */
clshear_status cs_converge_integrand(const clshear_integrand *integrand, const char *sampler,
                                     uint32_t seed, const cs_study *study, const double *reference,
                                     clshear_convergence *result, cs_error *error);
clshear_status cs_converge_pixel(clshear_scene *scene, const clshear_settings *settings, int x,
                                 int y, const cs_study *study, const double *reference,
                                 clshear_convergence *result, cs_error *error);
clshear_status cs_converge_image(clshear_scene *scene, const clshear_settings *settings,
                                 const cs_study *study, const clshear_film *reference,
                                 clshear_convergence *result, cs_error *error);

/* Settings of one render of a study: `count` samples in each replicate; the pilot counts as centre,
 * and nothing is adaptive, since it is one pattern that is measured. `settings` starts from zeros
 * and is freed by cs_settings_free. */
clshear_status cs_study_settings(const clshear_settings *given, const cs_study *study,
                                 uint32_t count, clshear_settings *settings, cs_error *error);

#endif
