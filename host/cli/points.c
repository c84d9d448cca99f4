#include "cli/points.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "cli/flags.h"
#include "cli/job.h"
#include "cli/parse.h"

typedef struct points_job {
    const char *sampler;
    const char *in;
    const char *out;
    const char *dimensions;
    uint32_t count, sets, seed;
    clshear_shear shear;
    float shear_px;
    int draws; /* a flag was given that says what to draw */
    int help;
} points_job;

static const char *store_sampler(void *target, const char *value)
{
    points_job *job = target;
    job->sampler = value;
    job->draws = 1;
    return cli_check_sampler(value);
}

static const char *store_count(void *target, const char *value)
{
    points_job *job = target;
    job->draws = 1;
    return cli_read_count(value, 1, &job->count) ? NULL : "a whole number from 1";
}

static const char *store_sets(void *target, const char *value)
{
    points_job *job = target;
    job->draws = 1;
    return cli_read_count(value, 1, &job->sets) ? NULL : "a whole number from 1";
}

static const char *store_seed(void *target, const char *value)
{
    points_job *job = target;
    job->draws = 1;
    return cli_read_count(value, 0, &job->seed) ? NULL : "a whole number from 0 to 4294967295";
}

static const char *store_shear(void *target, const char *value)
{
    points_job *job = target;
    return cli_read_shear(value, &job->shear);
}

static const char *store_shear_px(void *target, const char *value)
{
    points_job *job = target;
    return cli_read_floats(value, 1, &job->shear_px) ? NULL : "a number of pixels";
}

static const char *store_dimensions(void *target, const char *value)
{
    points_job *job = target;
    job->dimensions = value;
    return *value != '\0' && strspn(value, "xyuvpq") == strlen(value) ? NULL
                                                                      : "letters out of xyuvpq";
}

static const char *store_in(void *target, const char *value)
{
    points_job *job = target;
    job->in = value;
    return NULL;
}

static const char *store_out(void *target, const char *value)
{
    points_job *job = target;
    static const char *const pictures[] = {".png", ".jpg", ".jpeg", ".tif", ".tiff"};
    const char *dot = strrchr(value, '.');
    job->out = value;
    if (*value == '\0') return "a file, or - for standard output";
    for (size_t i = 0; i < sizeof pictures / sizeof *pictures && dot != NULL; i++)
        if (strcasecmp(dot, pictures[i]) == 0) return "a text, .csv or .exr file, not a picture";
    return NULL;
}

static const char *store_help(void *target, const char *value)
{
    points_job *job = target;
    (void)value;
    job->help = 1;
    return NULL;
}

static const cli_flag flags[] = {
    {"sampler", "NAME", "see clshear --list-samplers", store_sampler},
    {"n count npoints", "N", "points in a set (1024)", store_count},
    {"sets m nsets", "M", "independent sets (1)", store_sets},
    {"seed", "N", "another seed, other points (0)", store_seed},
    {"shear-px", "S", "shear by S pixels per (square) aperture (0: not)", store_shear_px},
    {"shear", "KIND", "equal-area, toroidal or none (equal-area)", store_shear},
    {"dims", "LETTERS", "coordinates, in this order, out of xyuvpq (xyuv)", store_dimensions},
    {"in points", "FILE", "read these points instead (-: standard input)", store_in},
    {"out o", "FILE", ".exr, .csv, or text; - is standard output (-)", store_out},
    {"help h", NULL, "print this and stop", store_help},
};

static const cli_command command = {
    .name = "points",
    .summary = "usage: clshear points [flags]\n"
               "Write the points of a sampler: film x y, lens u v, light p q, all in [0, 1).\n\n"
               "  clshear points --sampler sobol --n 256 --sets 10 --dims xu --out points.txt\n",
    .notes = "Text has a point a line and a line # between sets; .csv has commas instead of\n"
             "spaces; .exr has a channel for each coordinate and a row for each set.\n",
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
};

/* Draws or reads, shears, and projects. */
static clshear_status make(const points_job *job, clshear_points *points)
{
    clshear_status status = job->in != NULL ? clshear_points_read(job->in, points)
                                            : clshear_points_draw(job->sampler, job->count,
                                                                  job->sets, job->seed, points);
    if (status == CLSHEAR_OK && job->in == NULL && points->count != job->count)
        fprintf(stderr, "clshear: sampler %s has no sets of %u points: %zu\n", job->sampler,
                job->count, points->count);
    if (status == CLSHEAR_OK && job->shear_px != 0.0f)
        status = clshear_points_shear(points, job->shear, job->shear_px);
    const char *dimensions = job->dimensions;
    if (dimensions == NULL && job->in == NULL) dimensions = "xyuv";
    if (status == CLSHEAR_OK && dimensions != NULL)
        status = clshear_points_select(points, dimensions);
    return status;
}

int cli_points(int argc, char **argv)
{
    points_job job = {.count = 1024, .sets = 1, .shear = CLSHEAR_SHEAR_EQUAL_AREA, .out = "-"};
    clshear_points points = {0};
    int code = cli_parse_words(&command, &job, argc, argv, NULL);
    if (code != CLI_DONE) return code;
    if (job.help) {
        cli_print_help(&command);
        return CLI_DONE;
    }
    if (job.in != NULL && job.draws) {
        fprintf(stderr,
                "clshear: --in %s brings its points: leave out --sampler, --n, --sets, --seed\n",
                job.in);
        return CLI_USAGE;
    }
    clshear_status status = make(&job, &points);
    if (status == CLSHEAR_OK) status = clshear_points_write(&points, job.out);
    clshear_points_free(&points);
    if (status == CLSHEAR_OK) return CLI_DONE;
    fprintf(stderr, "clshear: %s\n", clshear_message(NULL));
    return CLI_FAILED;
}
