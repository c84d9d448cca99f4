#include "study/convergence.h"

#include <stdio.h>
#include <stdlib.h>

#include "analysis/fit.h"
#include "analysis/integrands.h"
#include "render/render.h"

clshear_status cs_convergence_reserve(const cs_study *study, clshear_convergence *result,
                                      cs_error *error)
{
    const size_t sizes = study->sizes;
    if (study->counts == NULL || sizes < 2 || study->replicates < 2)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%zu sizes of %u replicates: must be 2 or more of both", sizes,
                       study->replicates);
    result->sizes = sizes;
    result->counts = calloc(sizes + 1, sizeof *result->counts);
    result->errors = calloc(sizes + 1, sizeof *result->errors);
    result->local = calloc(sizes, sizeof *result->local);
    if (result->counts == NULL || result->errors == NULL || result->local == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    return CLSHEAR_OK;
}

void cs_convergence_free(clshear_convergence *result)
{
    free(result->counts);
    free(result->errors);
    free(result->local);
    free(result->maps);
    *result = (clshear_convergence){0};
}

/* The fit over `sizes` sizes from number `first` on. */
static clshear_status fit_sizes(const double *values, size_t count, int are_parts,
                                const double *reference, size_t first, size_t sizes,
                                clshear_convergence *result, clshear_fit *fit)
{
    const uint32_t *counts = result->counts + first;
    double *errors = result->errors + first;
    values += first * count;
    return are_parts ? cs_fit_slope_of_parts(counts, sizes, values, count, errors, fit)
                     : cs_fit_slope(counts, sizes, values, count, reference, errors, fit);
}

clshear_status cs_convergence_fit(const double *values, size_t count, int are_parts,
                                  const double *reference, clshear_convergence *result)
{
    clshear_status status = CLSHEAR_OK;
    CS_TRY(fit_sizes(values, count, are_parts, reference, 0, result->sizes, result, &result->fit));
    for (size_t k = 0; k + 1 < result->sizes; k++)
        CS_TRY(fit_sizes(values, count, are_parts, reference, k, 2, result, &result->local[k]));
done:
    return status;
}

static clshear_status set(clshear_settings *settings, clshear_setting setting, double value,
                          cs_error *error)
{
    return cs_settings_set(settings, setting, &value, 1, error);
}

clshear_status cs_study_settings(const clshear_settings *given, const cs_study *study,
                                 uint32_t count, clshear_settings *settings, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    CS_TRY(given != NULL ? cs_settings_copy(given, settings, error)
                         : cs_settings_init(settings, error));
    CS_TRY(set(settings, CLSHEAR_REPLICATES, study->replicates, error));
    CS_TRY(set(settings, CLSHEAR_SPP, (double)count * study->replicates, error));
    CS_TRY(set(settings, CLSHEAR_ADAPTIVE, 0.0, error));
    CS_TRY(set(settings, CLSHEAR_GAIN, 0.0, error));
    CS_TRY(set(settings, CLSHEAR_EXTENDABLE, 0.0, error));
    if (!cs_is_set(settings, ORACLE) || cs_integer(settings, ORACLE) == CLSHEAR_ORACLE_PILOT)
        CS_TRY(set(settings, CLSHEAR_ORACLE, CLSHEAR_ORACLE_CENTRE, error));
done:
    return status;
}

/* Computes the mean of the largest size and the fit. `means` has sizes x replicates values. */
static clshear_status finish(const cs_study *study, const double *means, const double *reference,
                             clshear_convergence *result)
{
    const double *last = means + (study->sizes - 1) * study->replicates;
    result->mean = 0.0;
    for (uint32_t r = 0; r < study->replicates; r++)
        result->mean += last[r] / study->replicates;
    return cs_convergence_fit(means, study->replicates, 0, reference, result);
}

clshear_status cs_converge_integrand(const clshear_integrand *integrand, const char *sampler,
                                     uint32_t seed, const cs_study *study, const double *reference,
                                     clshear_convergence *result, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    clshear_points points = {0};
    double *means = calloc((study->sizes + 1) * study->replicates, sizeof *means);
    CS_REQUIRE(means != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    CS_TRY(cs_convergence_reserve(study, result, error));
    for (size_t k = 0; k < study->sizes; k++) {
        CS_TRY(cs_points_draw(sampler, study->counts[k], study->replicates, seed, 0, 0, &points));
        result->counts[k] = (uint32_t)points.count;
        cs_points_integrate(&points, integrand, 0, 0, means + k * study->replicates);
        cs_points_free(&points);
    }
    CS_TRY(finish(study, means, reference, result));
done:
    cs_points_free(&points);
    free(means);
    return status;
}

/* Mean of R, G and B of one replicate of the film's only pixel. */
static double pattern_mean(const clshear_film *film, uint32_t replicate)
{
    double sum = 0.0;
    for (const char *colour = "RGB"; *colour != '\0'; colour++) {
        char name[32];
        snprintf(name, sizeof name, "Pattern%u.%c", replicate, *colour);
        sum += (double)*cs_film_channel(film, name) / 3.0;
    }
    return sum;
}

/* Renders one pixel with `count` samples in each pattern. */
static clshear_status render_pixel(clshear_scene *scene, const clshear_settings *given, int x,
                                   int y, const cs_study *study, uint32_t count, uint32_t *drawn,
                                   double *means, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const double crop[4] = {x, x + 1, y, y + 1};
    clshear_settings settings = {0};
    clshear_film *film = NULL;
    CS_TRY(cs_study_settings(given, study, count, &settings, error));
    CS_TRY(cs_settings_set(&settings, CLSHEAR_CROP, crop, 4, error));
    CS_TRY(set(&settings, CLSHEAR_KEEP_PATTERNS, 1.0, error));
    CS_TRY(cs_render(scene, &settings, NULL, &film, error));
    CS_REQUIRE(film->info.complete, CLSHEAR_BAD_ARGUMENT, "stopped by the progress callback");
    *drawn = (uint32_t)(*cs_film_channel(film, "Samples") / (float)study->replicates + 0.5f);
    for (uint32_t r = 0; r < study->replicates; r++)
        means[r] = pattern_mean(film, r);
done:
    cs_film_free(film);
    cs_settings_free(&settings);
    return status;
}

clshear_status cs_converge_pixel(clshear_scene *scene, const clshear_settings *settings, int x,
                                 int y, const cs_study *study, const double *reference,
                                 clshear_convergence *result, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    double *means = calloc((study->sizes + 1) * study->replicates, sizeof *means);
    CS_REQUIRE(means != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    CS_TRY(cs_convergence_reserve(study, result, error));
    for (size_t k = 0; k < study->sizes; k++)
        CS_TRY(render_pixel(scene, settings, x, y, study, study->counts[k], &result->counts[k],
                            means + k * study->replicates, error));
    CS_TRY(finish(study, means, reference, result));
done:
    free(means);
    return status;
}
