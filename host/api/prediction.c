/* Public functions of integrands and of predicted variance. */
#include <stdlib.h>

#include "analysis/integrands.h"
#include "analysis/predict.h"
#include "api/arguments.h"

clshear_status clshear_integrand_find(const char *name, clshear_integrand *integrand)
{
    clshear_integrand found;
    CS_NEEDS(name);
    CS_NEEDS(integrand);
    const clshear_status status = cs_integrand_find(name, &found);
    if (status == CLSHEAR_OK) cs_struct_out(integrand, &found, sizeof found);
    return status;
}

double clshear_integrand_at(const clshear_integrand *integrand, double x, double y)
{
    CS_PLAIN_FLOATS;
    clshear_integrand copy;
    if (integrand == NULL) return 0.0;
    const clshear_status status = cs_struct_in(&copy, sizeof copy, integrand, "integrand");
    return status == CLSHEAR_OK ? cs_integrand_at(&copy, x, y) : 0.0;
}

clshear_status clshear_integrand_tabulate(const clshear_integrand *integrand, size_t side,
                                          float *cells, double *mean_square)
{
    CS_PLAIN_FLOATS;
    CS_TAKE(clshear_integrand, copy, integrand);
    CS_NEEDS(cells);
    CS_NEEDS(mean_square);
    return cs_integrand_tabulate(&copy, side, cells, mean_square);
}

clshear_status clshear_predict_variance(const clshear_spectrum *samples, const float *integrand,
                                        size_t side, double mean_square,
                                        clshear_prediction **prediction)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(samples);
    CS_NEEDS(integrand);
    CS_NEEDS(prediction);
    clshear_prediction made;
    clshear_status status = cs_predict_variance(samples, integrand, side, mean_square, &made);
    clshear_prediction *handle = cs_handle(&status, &made, sizeof made);
    if (handle != NULL) *prediction = handle;
    return status;
}

clshear_status clshear_predict_variance_4d(clshear_context *context, const clshear_points *samples,
                                           clshear_function function, void *user,
                                           const clshear_reach *reach,
                                           clshear_prediction **prediction)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(context);
    CS_NEEDS(samples);
    CS_NEEDS(function);
    CS_NEEDS(reach);
    CS_NEEDS(prediction);
    clshear_prediction made;
    clshear_reach copy;
    clshear_status status = cs_struct_in(&copy, sizeof copy, reach, "reach");
    if (status == CLSHEAR_OK)
        status = cs_predict_variance_4d(context, samples, function, user, &copy, &made);
    clshear_prediction *handle = cs_handle(&status, &made, sizeof made);
    if (handle != NULL) *prediction = handle;
    return cs_message_keep(&context->message, status);
}

void clshear_prediction_free(clshear_prediction *prediction)
{
    free(prediction);
}

CS_GETTER(double, prediction, variance)

double clshear_prediction_isotropic(const clshear_prediction *prediction)
{
    return prediction != NULL ? prediction->by_cones[0] : 0.0;
}

double clshear_prediction_in_cones(const clshear_prediction *prediction, size_t level)
{
    if (prediction == NULL) return 0.0;
    return level < CS_CONE_LEVELS ? prediction->by_cones[level] : prediction->variance;
}

CS_GETTER(double, prediction, energy)
CS_GETTER(size_t, prediction, parts)
CS_GETTER_AT(const char *, prediction, part_name, names, parts)
CS_GETTER_AT(double, prediction, part_variance, variances, parts)
CS_GETTER_AT(double, prediction, part_energy, energies, parts)
