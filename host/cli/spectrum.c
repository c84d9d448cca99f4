#include "cli/spectrum.h"

#include <stdlib.h>
#include <string.h>

#include "cli/flags.h"
#include "cli/output.h"
#include "cli/parse.h"
#include "cli/plot.h"
#include "cli/source.h"

enum {
    MOST_DIRECTIONS = 8
};

typedef struct spectrum_job {
    cli_source source; /* first: the stores of points write there */
    int resolution[2];
    const char *outputs[CLI_MAX_OUTPUTS];
    int output_count;
    double directions[MOST_DIRECTIONS][2];
    int direction_count;
    cli_plot plot;
    int keep_dc;
} spectrum_job;

static const char *store_resolution(void *target, const char *value)
{
    spectrum_job *job = target;
    return cli_read_sides(value, job->resolution);
}

static const char *store_direction(void *target, const char *value)
{
    spectrum_job *job = target;
    if (job->direction_count == MOST_DIRECTIONS) return "given at most 5 times";
    double *direction = job->directions[job->direction_count++];
    return cli_read_numbers(value, 2, direction) && (direction[0] != 0.0 || direction[1] != 0.0)
               ? NULL
               : "two numbers, not both 0";
}

static const char *store_out(void *target, const char *value)
{
    static const char *const known[] = {".exr", ".png", ".jpg", ".tif", ".csv"};
    spectrum_job *job = target;
    const char *dot = strrchr(value, '.');
    int found = strcmp(value, "-") == 0;
    for (size_t i = 0; i < sizeof known / sizeof *known && dot != NULL; i++)
        found |= strcmp(dot, known[i]) == 0;
    if (job->output_count == CLI_MAX_OUTPUTS) return "given at most 16 times";
    job->outputs[job->output_count++] = value;
    return found ? NULL : "-, or a name that ends in .exr, .png, .jpg, .tif or .csv";
}

static const char *store_plot(void *target, const char *value)
{
    spectrum_job *job = target;
    return cli_read_plot_path(value, &job->plot.path);
}

static const char *store_keep(void *target, const char *value)
{
    spectrum_job *job = target;
    (void)value;
    job->plot.keep = 1;
    return NULL;
}

static const char *store_dc(void *target, const char *value)
{
    spectrum_job *job = target;
    (void)value;
    job->keep_dc = 1;
    return NULL;
}

static const cli_flag flags[] = {
    CLI_SOURCE_FLAGS("100"),
    {"projection dims", "LETTERS", "two coordinates out of xyuvpq (xy)",
     cli_store_source_projection},
    {"resolution", "R", "frequencies along a side, or W,H (256)", store_resolution},
    {"direction", "X,Y", "profile along this direction too; repeatable", store_direction},
    {"out o", "FILE", ".exr .png .tif: the plane; .csv -: rings; repeatable", store_out},
    {"dc", NULL, "keep frequency 0 in pictures and data", store_dc},
    {"plot", "FILE", "draw rings and profiles, .png or .svg, by gnuplot", store_plot},
    {"keep", NULL, "leave the plot's data and script beside it", store_keep},
    {"device", "NAME", "OpenCL device: number or part of its name", cli_store_source_device},
    {"help h", NULL, "print this and stop", cli_store_source_help},
};

static const cli_command command = {
    .name = "spectrum",
    .summary = "usage: clshear spectrum [flags]\n"
               "Measure the expected power spectrum of a sampler or of point files.\n\n"
               "  clshear spectrum --sampler mj --projection xu --out mj.png --plot rings.png\n",
    .notes = "Power is 1 for random points. The table has for each radius the ring's mean and\n"
             "anisotropy (dB; -10: isotropic) and the power along the axes, the diagonal and\n"
             "every --direction. Without --out, the table goes to standard output.\n",
    .flags = flags,
    .flag_count = sizeof flags / sizeof *flags,
};

/* Everything read off a spectrum. */
typedef struct table {
    const spectrum_job *job;
    size_t radii;
    float *mean;
    float *anisotropy_db;
    float *along[MOST_DIRECTIONS];
} table;

static int fill(table *t, const spectrum_job *job, const clshear_spectrum *spectrum)
{
    t->job = job;
    t->radii = clshear_spectrum_radius(spectrum);
    float *memory = calloc((2 + MOST_DIRECTIONS) * (t->radii + 1), sizeof *memory);
    if (memory == NULL) return 0;
    t->mean = memory;
    t->anisotropy_db = memory + t->radii;
    clshear_spectrum_radial(spectrum, t->mean, t->anisotropy_db);
    for (int d = 0; d < job->direction_count; d++) {
        t->along[d] = memory + (size_t)(2 + d) * t->radii;
        clshear_spectrum_along(spectrum, job->directions[d][0], job->directions[d][1], t->along[d]);
    }
    return 1;
}

static void write_table(FILE *stream, const void *user)
{
    const table *t = user;
    fprintf(stream, "radius,mean,anisotropy_db");
    for (int d = 0; d < t->job->direction_count; d++)
        fprintf(stream, ",along %g:%g", t->job->directions[d][0], t->job->directions[d][1]);
    fprintf(stream, "\n");
    for (size_t r = 0; r < t->radii; r++) {
        fprintf(stream, "%zu,%.6g,%.4g", r + 1, (double)t->mean[r], (double)t->anisotropy_db[r]);
        for (int d = 0; d < t->job->direction_count; d++)
            fprintf(stream, ",%.6g", (double)t->along[d][r]);
        fprintf(stream, "\n");
    }
}

static void write_script(FILE *stream, const void *user)
{
    const table *t = user;
    fprintf(stream, "set datafile separator ','\nset xlabel 'frequency'\nset ylabel 'power'\n"
                    "set yrange [0:*]\nset key outside top center horizontal\nplot \\\n");
    for (int d = 0; d < t->job->direction_count; d++)
        fprintf(stream,
                "  data using 1:%d skip 1 with lines lc rgb '%s' title 'along (%g, %g)', \\\n",
                4 + d, cli_plot_colour(d + 1), t->job->directions[d][0], t->job->directions[d][1]);
    fprintf(stream,
            "  data using 1:2 skip 1 with lines lw 2 lc rgb '%s' title 'mean of the ring'\n",
            cli_plot_colour(0));
}

static int fail(const char *message)
{
    fprintf(stderr, "clshear: %s\n", message);
    return CLI_FAILED;
}

static int write_outputs(const spectrum_job *job, const clshear_spectrum *spectrum)
{
    table t = {0};
    int code = CLI_DONE;
    if (!fill(&t, job, spectrum)) return fail("out of memory");
    for (int i = 0; i < job->output_count && code == CLI_DONE; i++) {
        const char *path = job->outputs[i], *dot = strrchr(path, '.');
        if (strcmp(path, "-") == 0 || strcmp(dot, ".csv") == 0)
            code = cli_write_file(path, write_table, &t);
        else if (clshear_spectrum_write(spectrum, job->keep_dc, path) != CLSHEAR_OK)
            code = fail(clshear_message(NULL));
    }
    if (code == CLI_DONE && job->plot.path != NULL && t.radii < 2)
        code = fail("--plot: too few frequencies; give a larger --resolution");
    else if (code == CLI_DONE)
        code = cli_plot_draw(&job->plot, write_table, write_script, &t);
    free(t.mean);
    return code;
}

static int measure(const spectrum_job *job)
{
    clshear_points points = {0};
    clshear_context *context = NULL;
    clshear_spectrum spectrum = {0};
    const char *projection = job->source.projection;
    int code = CLI_FAILED;
    if (projection == NULL && job->source.in == NULL) projection = "xy";
    if (cli_source_make(&job->source, projection, &points) != CLSHEAR_OK ||
        clshear_context_create(&job->source.context, &context) != CLSHEAR_OK)
        fail(clshear_message(NULL));
    else if (clshear_spectrum_measure(context, &points, (size_t)job->resolution[0],
                                      (size_t)job->resolution[1], &spectrum) != CLSHEAR_OK)
        fail(clshear_message(context));
    else
        code = write_outputs(job, &spectrum);
    clshear_points_free(&points);
    clshear_spectrum_free(&spectrum);
    clshear_context_free(context);
    return code;
}

int cli_spectrum(int argc, char **argv)
{
    spectrum_job job = {.source = {.count = 1024, .sets = 100, .shear = CLSHEAR_SHEAR_EQUAL_AREA},
                        .resolution = {256, 256},
                        .directions = {{1, 0}, {0, 1}, {1, 1}},
                        .direction_count = 3};
    int code = cli_parse_words(&command, &job, argc, argv, NULL);
    if (code != CLI_DONE) return code;
    if (job.source.help) {
        cli_print_help(&command);
        return CLI_DONE;
    }
    code = cli_source_check(&job.source);
    if (code != CLI_DONE) return code;
    if (job.output_count == 0 && job.plot.path == NULL) job.outputs[job.output_count++] = "-";
    code = cli_check_places("out", job.outputs, job.output_count);
    if (code == CLI_DONE) code = cli_check_place("plot", job.plot.path);
    return code == CLI_DONE ? measure(&job) : code;
}
