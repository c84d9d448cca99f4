#ifndef CS_CLI_PREDICT_H
#define CS_CLI_PREDICT_H

#include <stddef.h>

/* Variance of values, and its standard error from their fourth moment. */
typedef struct cli_measurement {
    double variance;
    double error;
} cli_measurement;

/* `count`: 2 or more. */
cli_measurement cli_measurement_of(const double *values, size_t count);

/* The command `clshear predict`; argv[0] is its name. Returns the exit status. */
int cli_predict(int argc, char **argv);

#endif
