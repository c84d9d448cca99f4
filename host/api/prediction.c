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
    return cs_integrand_at(integrand, x, y);
}

clshear_status clshear_integrand_tabulate(const clshear_integrand *integrand, size_t side,
                                          float *cells, double *mean_square)
{
    CS_NEEDS(integrand);
    CS_NEEDS(cells);
    CS_NEEDS(mean_square);
    return cs_integrand_tabulate(integrand, side, cells, mean_square);
}

/* Hands a prediction over to the caller, or nothing after a failure. */
static clshear_status hand_over(clshear_status status, const clshear_prediction *made,
                                clshear_prediction **prediction)
{
    if (status != CLSHEAR_OK) return status;
    clshear_prediction *handle = malloc(sizeof *handle);
    if (handle == NULL) return cs_fail(cs_thread_error(), CLSHEAR_OUT_OF_MEMORY, "out of memory");
    *handle = *made;
    *prediction = handle;
    return CLSHEAR_OK;
}

clshear_status clshear_predict_variance(const clshear_spectrum *samples, const float *integrand,
                                        size_t side, double mean_square,
                                        clshear_prediction **prediction)
{
    CS_NEEDS(samples);
    CS_NEEDS(integrand);
    CS_NEEDS(prediction);
    clshear_prediction made;
    const clshear_status status = cs_predict_variance(samples, integrand, side, mean_square, &made);
    return hand_over(status, &made, prediction);
}

clshear_status clshear_predict_variance_4d(clshear_context *context, const clshear_points *samples,
                                           clshear_function function, void *user,
                                           const clshear_reach *reach,
                                           clshear_prediction **prediction)
{
    CS_NEEDS(context);
    CS_NEEDS(samples);
    CS_NEEDS(reach);
    CS_NEEDS(prediction);
    clshear_prediction made;
    clshear_reach copy;
    clshear_status status = cs_struct_in(&copy, sizeof copy, reach, "reach");
    if (status == CLSHEAR_OK)
        status = cs_predict_variance_4d(context, samples, function, user, &copy, &made);
    return cs_message_keep(&context->message, hand_over(status, &made, prediction));
}

void clshear_prediction_free(clshear_prediction *prediction)
{
    free(prediction);
}

double clshear_prediction_variance(const clshear_prediction *prediction)
{
    return prediction->variance;
}

double clshear_prediction_isotropic(const clshear_prediction *prediction)
{
    return prediction->isotropic;
}

double clshear_prediction_energy(const clshear_prediction *prediction)
{
    return prediction->energy;
}

size_t clshear_prediction_parts(const clshear_prediction *prediction)
{
    return prediction->parts;
}

const char *clshear_prediction_part_name(const clshear_prediction *prediction, size_t part)
{
    return prediction->names[part];
}

double clshear_prediction_part_variance(const clshear_prediction *prediction, size_t part)
{
    return prediction->variances[part];
}

double clshear_prediction_part_energy(const clshear_prediction *prediction, size_t part)
{
    return prediction->energies[part];
}
