/* Public functions of convergence studies and fits. */
#include <stdlib.h>
#include <string.h>

#include "analysis/fit.h"
#include "analysis/moments.h"
#include "api/arguments.h"
#include "study/convergence.h"

clshear_status clshear_fit_slope(const uint32_t *counts, size_t sizes, const double *means,
                                 size_t replicates, const double *reference, double *errors,
                                 clshear_fit *fit)
{
    CS_PLAIN_FLOATS;
    clshear_fit made;
    CS_NEEDS(counts);
    CS_NEEDS(means);
    CS_NEEDS(errors);
    CS_NEEDS(fit);
    const clshear_status status =
        cs_fit_slope(counts, sizes, means, replicates, reference, errors, &made);
    if (status == CLSHEAR_OK) cs_struct_out(fit, &made, sizeof made);
    return status;
}

clshear_status clshear_fit_slope_of_parts(const uint32_t *counts, size_t sizes, const double *parts,
                                          size_t count, double *errors, clshear_fit *fit)
{
    CS_PLAIN_FLOATS;
    clshear_fit made;
    CS_NEEDS(counts);
    CS_NEEDS(parts);
    CS_NEEDS(errors);
    CS_NEEDS(fit);
    const clshear_status status = cs_fit_slope_of_parts(counts, sizes, parts, count, errors, &made);
    if (status == CLSHEAR_OK) cs_struct_out(fit, &made, sizeof made);
    return status;
}

clshear_status clshear_variance_of(const double *values, size_t count, double *variance,
                                   double *standard_error)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(values);
    CS_NEEDS(variance);
    CS_NEEDS(standard_error);
    if (count < 2)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "%zu values: must be 2 or more",
                       count);
    cs_variance_of(values, count, variance, standard_error);
    return CLSHEAR_OK;
}

CS_HAND_OVER(convergence)

clshear_status clshear_converge_integrand(const clshear_integrand *integrand, const char *sampler,
                                          uint32_t seed, const uint32_t *counts, size_t sizes,
                                          uint32_t replicates, const double *reference,
                                          clshear_convergence **result)
{
    CS_PLAIN_FLOATS;
    CS_TAKE(clshear_integrand, copy, integrand);
    CS_NEEDS(counts);
    CS_NEEDS(result);
    const cs_study study = {counts, sizes, replicates};
    clshear_convergence made = {0};
    const clshear_status status =
        cs_converge_integrand(&copy, sampler, seed, &study, reference, &made, cs_thread_error());
    return hand_over(status, &made, result);
}

clshear_status clshear_converge_pixel(clshear_scene *scene, const clshear_settings *settings, int x,
                                      int y, const uint32_t *counts, size_t sizes,
                                      uint32_t replicates, const double *reference,
                                      clshear_convergence **result)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(counts);
    CS_NEEDS(result);
    clshear_convergence made = {0};
    const cs_study study = {counts, sizes, replicates};
    const clshear_status status =
        cs_converge_pixel(scene, settings, x, y, &study, reference, &made, cs_thread_error());
    return cs_message_keep(&scene->message, hand_over(status, &made, result));
}

clshear_status clshear_converge_image(clshear_scene *scene, const clshear_settings *settings,
                                      const uint32_t *counts, size_t sizes, uint32_t replicates,
                                      const clshear_film *reference, clshear_convergence **result)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(counts);
    CS_NEEDS(result);
    clshear_convergence made = {0};
    const cs_study study = {counts, sizes, replicates};
    return cs_message_keep(
        &scene->message,
        hand_over(cs_converge_image(scene, settings, &study, reference, &made, cs_thread_error()),
                  &made, result));
}

CS_FREES(convergence)

CS_GETTER(size_t, convergence, sizes)
CS_GETTER(double, convergence, mean)
CS_GETTER_AT(uint32_t, convergence, count, counts, sizes)
CS_GETTER_AT(double, convergence, error, errors, sizes)

void clshear_convergence_fit(const clshear_convergence *result, clshear_fit *fit)
{
    if (result != NULL) cs_struct_out(fit, &result->fit, sizeof result->fit);
}

const float *clshear_convergence_map(const clshear_convergence *result, size_t index, int window[4])
{
    if (result == NULL || result->maps == NULL || index >= result->sizes) return NULL;
    const size_t width = (size_t)(result->window[1] - result->window[0]);
    const size_t height = (size_t)(result->window[3] - result->window[2]);
    if (window != NULL) memcpy(window, result->window, sizeof result->window);
    return result->maps + index * width * height;
}

void clshear_convergence_local_fit(const clshear_convergence *result, size_t index,
                                   clshear_fit *fit)
{
    if (result == NULL || result->sizes < 2 || index >= result->sizes - 1) return;
    cs_struct_out(fit, &result->local[index], sizeof result->local[index]);
}
