/* Where a command's points come from: a sampler or a file. */
#ifndef CS_CLI_SOURCE_H
#define CS_CLI_SOURCE_H

#include "cli/job.h"

/* The first member of the job of commands that take points. */
typedef struct cli_source {
    const char *sampler;
    const char *in;
    uint32_t count, sets, seed;
    clshear_shear shear;
    float shear_px;
    int draws;              /* a flag was given that says what to draw */
    const char *projection; /* of commands that take two coordinates */
    clshear_context_options context;
    int help;
} cli_source;

const char *cli_store_source_sampler(void *target, const char *value);
const char *cli_store_source_count(void *target, const char *value);
const char *cli_store_source_sets(void *target, const char *value);
const char *cli_store_source_seed(void *target, const char *value);
const char *cli_store_source_shear(void *target, const char *value);
const char *cli_store_source_shear_px(void *target, const char *value);
const char *cli_store_source_in(void *target, const char *value);
const char *cli_store_source_projection(void *target, const char *value);
const char *cli_store_source_device(void *target, const char *value);
const char *cli_store_source_help(void *target, const char *value);

/* Their lines in a table of flags; `sets` is the default in words. */
#define CLI_SOURCE_FLAGS(sets)                                                                    \
    {"sampler", "NAME", "see clshear --list-samplers (sz)", cli_store_source_sampler},            \
        {"n count npoints", "N", "points in a set (1024)", cli_store_source_count},               \
        {"sets m nsets", "M", "independent sets (" sets ")", cli_store_source_sets},              \
        {"seed", "N", "another seed, other points (0)", cli_store_source_seed},                   \
        {"shear-px", "S", "shear by S pixels per (square) aperture (0: not)",                     \
         cli_store_source_shear_px},                                                              \
        {"shear", "KIND", "equal-area, toroidal or none (equal-area)", cli_store_source_shear},   \
    {                                                                                             \
        "in points", "FILE", "read these points instead (-: standard input)", cli_store_source_in \
    }

/* CLI_DONE, or CLI_USAGE with a line printed where flags exclude each other. */
int cli_source_check(const cli_source *source);

/* Draws or reads, shears, and keeps the coordinates named by `dimensions` (NULL: all). */
clshear_status cli_source_make(const cli_source *source, const char *dimensions,
                               clshear_points *points);

#endif
