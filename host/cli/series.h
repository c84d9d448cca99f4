/* Errors against numbers of samples: what `clshear converge` measures, as a table, as JSON and
 * drawn. */
#ifndef CS_CLI_SERIES_H
#define CS_CLI_SERIES_H

#include <stdio.h>

#include "cli/plot.h"
#include "clshear/clshear.h"

enum {
    CLI_MOST_SIZES = 32,
    CLI_MOST_SERIES = 64
};

typedef struct cli_series {
    char target[64];
    const char *sampler;
    const char *shear;
    uint32_t counts[CLI_MOST_SIZES]; /* as the sampler has them */
    double errors[CLI_MOST_SIZES];
    double mean; /* at the largest size */
    clshear_fit fit;
} cli_series;

typedef struct cli_study {
    cli_series series[CLI_MOST_SERIES];
    int series_count;
    size_t sizes;
    uint32_t replicates;
    int has_reference; /* errors are mean squared differences from it, else variances */
} cli_study;

void cli_study_write_csv(FILE *stream, const void *study);
void cli_study_write_json(FILE *stream, const void *study);

/* A log-log plot with lines of slope -1, -1.5 and -2 through the first point of the first series.
 */
int cli_study_draw(const cli_study *study, const cli_plot *plot);

#endif
