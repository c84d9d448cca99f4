#include "cli/points.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "cli/flags.h"
#include "cli/output.h"
#include "cli/parse.h"
#include "cli/source.h"

typedef struct points_job {
    cli_source source;
    const char *out;
    const char *dimensions;
} points_job;

static const char *store_dimensions(void *target, const char *value)
{
    points_job *job = target;
    job->dimensions = value;
    return *value != '\0' && strspn(value, "xyuvpq") == strlen(value) ? NULL
                                                                      : "letters out of xyuvpq";
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

static const cli_flag flags[] = {
    CLI_SOURCE_FLAGS("1"),
    {"dims", "LETTERS", "coordinates, in this order, out of xyuvpq (xyuv)", store_dimensions},
    {"out o", "FILE", ".exr, .csv, or text; - is standard output (-)", store_out},
    {"help h", NULL, "print this and stop", cli_store_source_help},
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

int cli_points(int argc, char **argv)
{
    points_job job = {.source = {.count = 1024, .sets = 1, .shear = CLSHEAR_SHEAR_EQUAL_AREA},
                      .out = "-"};
    clshear_points points = {0};
    int code = cli_parse_words(&command, &job, argc, argv, NULL);
    if (code != CLI_DONE) return code;
    if (job.source.help) {
        cli_print_help(&command);
        return CLI_DONE;
    }
    code = cli_source_check(&job.source);
    if (code == CLI_DONE) code = cli_check_place("out", job.out);
    if (code != CLI_DONE) return code;
    const char *all = job.source.in == NULL ? "xyuv" : NULL;
    clshear_status status =
        cli_source_make(&job.source, job.dimensions != NULL ? job.dimensions : all, &points);
    if (status == CLSHEAR_OK) status = clshear_points_write(&points, job.out);
    clshear_points_free(&points);
    if (status == CLSHEAR_OK) return CLI_DONE;
    fprintf(stderr, "clshear: %s\n", clshear_message(NULL));
    return CLI_FAILED;
}
