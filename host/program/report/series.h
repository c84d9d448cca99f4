/* Errors against numbers of samples: what `clshear converge` measures, as a table, as JSON and
 * drawn. */
#ifndef CS_PROGRAM_REPORT_SERIES_H
#define CS_PROGRAM_REPORT_SERIES_H

#include <clshear/analysis.h>
#include <stdio.h>

#include "report/plot.h"

enum {
    MOST_SERIES = 64
};

/* One curve. */
typedef struct error_series {
    char target[64];
    const char *sampler;
    const char *shear;
    clshear_convergence *result; /* owned */
} error_series;

typedef struct error_study {
    error_series series[MOST_SERIES];
    size_t count;
    uint32_t replicates;
    int has_reference;    /* errors are mean squared differences from it, else variances */
    int has_local_slopes; /* tables have the slopes between neighbouring numbers of samples */
} error_study;

void study_free(error_study *study);

/* Callbacks of write_file; `study` is an error_study. */
void study_write_csv(FILE *stream, const void *study);
void study_write_json(FILE *stream, const void *study);

/* A log-log plot with lines of slope -1, -1.5 and -2 through the first point of the first series.
 * Returns EXIT_DONE or EXIT_FAILED. */
int study_draw(const error_study *study, const plot_files *plot);

#endif
