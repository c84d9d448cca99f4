#ifndef CS_CLI_SLICE_H
#define CS_CLI_SLICE_H

#include "cli/job.h"

/* Begins with a cli_job: the flags of rendering write there. */
typedef struct cli_slice_job {
    cli_job render;
    int pixel[2];
    int pixel_given;
    char projection[3]; /* two letters, or "4d" */
    int resolution[2];
    float at; /* of the coordinates that are not shown */
    int no_line;
    const char *outputs[CLI_MAX_OUTPUTS];
    int output_count;
    const char *spectrum; /* file of the power spectrum; NULL: none */
} cli_slice_job;

/* What a slice shows. */
typedef struct cli_slice {
    int width;
    int height;
    size_t count; /* of points: width * height, or of all four dimensions */
    float *rgb;   /* 3 floats a point */
    /* Along the fibres of the oracle's depth the first coordinate changes by -slope when the second
     * changes by 1; 0 where the two do not belong together. */
    double slope;
} cli_slice;

/* Writes the outputs and the spectrum; CLI_DONE or CLI_FAILED, with a line printed. */
int cli_slice_write(const cli_slice_job *job, const cli_slice *slice);

/* The command `clshear slice`; argv[0] is its name. Returns the exit status. */
int cli_slice_run(int argc, char **argv);

#endif
