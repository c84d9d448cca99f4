#include "analysis/moments.h"

#include <math.h>

void cs_variance_of(const double *values, size_t count, double *variance, double *standard_error)
{
    const double n = (double)count;
    double mean = 0.0, second = 0.0, fourth = 0.0;
    for (size_t i = 0; i < count; i++)
        mean += values[i] / n;
    for (size_t i = 0; i < count; i++) {
        const double square = (values[i] - mean) * (values[i] - mean);
        second += square / (n - 1.0);
        fourth += square * square / n;
    }
    *variance = second;
    *standard_error = sqrt(fmax(fourth - second * second, 0.0) / n);
}
