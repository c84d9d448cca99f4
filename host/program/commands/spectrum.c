/* clshear spectrum: expected power spectra of point sets. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands/commands.h"
#include "commands/point_source.h"
#include "report/failure.h"
#include "report/output.h"
#include "report/plot.h"
#include "report/words.h"

enum {
    AXES = 3, /* directions of profiles that are always made */
    MOST_DIRECTIONS = AXES + 5
};

typedef struct spectrum_job {
    point_source source;
    number_list resolution;
    number_list directions;
    text_list out;
    text_list plot;
    int keep;
    int keep_dc;
} spectrum_job;

#define AT(member) offsetof(spectrum_job, member)
static const program_flag flags[] = {
    POINT_SOURCE_FLAGS("independent sets (100)"),
    TEXT_FLAG("projection dims", "LETTERS", "two coordinates out of xyuvpqt (xy)", "",
              offsetof(point_source, letters), ""),
    WHOLE_FLAG("resolution", "R", "frequencies along a side, or W,H", "256", AT(resolution), 1, 2,
               2, 8192),
    {"direction", "X,Y", "profile along this direction too; repeatable", "", FLAG_NUMBER,
     AT(directions), 1, 2, MOST_DIRECTIONS - AXES, -1e9, 1e9, ""},
    FILES_FLAG("out o", ".exr .png .tif: the plane; .csv -: rings; repeatable", "", AT(out),
               "- .exr .png .jpg .tif .csv"),
    SWITCH_FLAG("dc", "keep frequency 0 in pictures and data", AT(keep_dc)),
    TEXT_FLAG("plot", "FILE", "draw rings and profiles, .png or .svg, by gnuplot", "", AT(plot),
              ".png .svg"),
    SWITCH_FLAG("keep", "leave the plot's data and script beside it", AT(keep)),
};
static const clshear_setting settings[] = {POINT_SOURCE_SETTINGS, CLSHEAR_DEVICE, CLSHEAR_THREADS};

static int run(void *job);

const program_command spectrum_command = {
    .name = "spectrum",
    .usage = "clshear spectrum [flags]\n"
             "Measure the expected power spectrum of a sampler or of point files.\n\n"
             "  clshear spectrum --sampler mj --projection xu --out mj.png --plot rings.png\n",
    .notes = "Power is 1 for random points. The table has for each radius the ring's mean and\n"
             "anisotropy (dB; -10: isotropic) and the power along the axes, the diagonal and\n"
             "every --direction. Without --out, the table goes to standard output.\n",
    COMMAND_FLAGS(flags),
    COMMAND_SETTINGS(settings),
    .job_size = sizeof(spectrum_job),
    .run = run,
};

/* Everything read off a spectrum. */
typedef struct table {
    double directions[MOST_DIRECTIONS][2];
    int direction_count;
    size_t radii;
    float *mean;
    float *anisotropy_db;
    float *along[MOST_DIRECTIONS];
} table;

static void choose_directions(table *t, const spectrum_job *job)
{
    static const double axes[AXES][2] = {{1, 0}, {0, 1}, {1, 1}};
    memcpy(t->directions, axes, sizeof axes);
    memcpy(t->directions + AXES, job->directions.items, job->directions.count * sizeof(double));
    t->direction_count = AXES + (int)job->directions.count / 2;
}

static int fill(table *t, const spectrum_job *job, const clshear_spectrum *spectrum)
{
    choose_directions(t, job);
    t->radii = clshear_spectrum_radius(spectrum);
    float *memory = calloc((2 + MOST_DIRECTIONS) * (t->radii + 1), sizeof *memory);
    if (memory == NULL) return 0;
    t->mean = memory;
    t->anisotropy_db = memory + t->radii;
    clshear_spectrum_radial(spectrum, t->mean, t->anisotropy_db);
    for (int d = 0; d < t->direction_count; d++) {
        t->along[d] = memory + (size_t)(2 + d) * t->radii;
        clshear_spectrum_along(spectrum, t->directions[d][0], t->directions[d][1], t->along[d]);
    }
    return 1;
}

static void write_table(FILE *stream, const void *user)
{
    const table *t = user;
    fprintf(stream, "radius,mean,anisotropy_db");
    for (int d = 0; d < t->direction_count; d++)
        fprintf(stream, ",along %g:%g", t->directions[d][0], t->directions[d][1]);
    fprintf(stream, "\n");
    for (size_t r = 0; r < t->radii; r++) {
        fprintf(stream, "%zu,%.6g,%.4g", r + 1, (double)t->mean[r], (double)t->anisotropy_db[r]);
        for (int d = 0; d < t->direction_count; d++)
            fprintf(stream, ",%.6g", (double)t->along[d][r]);
        fprintf(stream, "\n");
    }
}

static void write_script(FILE *stream, const void *user)
{
    const table *t = user;
    fprintf(stream, "set datafile separator ','\nset xlabel 'frequency'\nset ylabel 'power'\n"
                    "set yrange [0:*]\nset key outside top center horizontal\nplot \\\n");
    for (int d = 0; d < t->direction_count; d++)
        fprintf(stream,
                "  data using 1:%d skip 1 with lines lc rgb '%s' title 'along (%g, %g)', \\\n",
                4 + d, plot_colour(d + 1), t->directions[d][0], t->directions[d][1]);
    fprintf(stream,
            "  data using 1:2 skip 1 with lines lw 2 lc rgb '%s' title 'mean of the ring'\n",
            plot_colour(0));
}

static int write_outputs(const spectrum_job *job, const clshear_spectrum *spectrum)
{
    table t = {0};
    int code = EXIT_DONE;
    const plot_files plot = {job->plot.count > 0 ? job->plot.items[0] : NULL, job->keep};
    if (!fill(&t, job, spectrum)) return complain(EXIT_FAILED, "out of memory");
    for (size_t i = 0; i < job->out.count && code == EXIT_DONE; i++) {
        const char *path = job->out.items[i];
        if (strcmp(path, "-") == 0 || has_ending(".csv", path))
            code = write_file(path, write_table, &t);
        else
            code = exit_status_of(clshear_spectrum_write(spectrum, job->keep_dc, path));
    }
    if (code == EXIT_DONE && plot.path != NULL && t.radii < 2)
        code = complain(EXIT_USAGE, "--plot: too few frequencies; give a larger --resolution");
    else if (code == EXIT_DONE)
        code = plot_draw(&plot, write_table, write_script, &t);
    free(t.mean);
    return code;
}

static int measure(const spectrum_job *job)
{
    const double *sides = job->resolution.items;
    const size_t width = (size_t)sides[0], height = (size_t)sides[job->resolution.count - 1];
    clshear_points *points = NULL;
    clshear_context *context = NULL;
    clshear_spectrum *spectrum = NULL;
    clshear_status status =
        point_source_make(&job->source, (size_t)number_or(&job->source.sets, 100.0),
                          seed_of(&job->source.options), "xy", &points);
    if (status == CLSHEAR_OK)
        status = clshear_context_create(job->source.options.settings, &context);
    if (status == CLSHEAR_OK)
        status = clshear_spectrum_measure(context, points, width, height, &spectrum);
    const int code = status == CLSHEAR_OK ? write_outputs(job, spectrum) : exit_status_of(status);
    clshear_points_free(points);
    clshear_spectrum_free(spectrum);
    clshear_context_free(context);
    return code;
}

static int check(spectrum_job *job)
{
    const double *direction = job->directions.items;
    output_files outputs = {0};
    int code = point_source_check(&job->source, "projection", 2);
    for (size_t i = 0; i < job->directions.count && code == EXIT_DONE; i += 2)
        if (direction[i] == 0.0 && direction[i + 1] == 0.0)
            code = complain(EXIT_USAGE, "--direction 0,0: must be two numbers, not both 0");
    if (job->out.count == 0 && job->plot.count == 0) job->out.items[job->out.count++] = "-";
    outputs_add(&outputs, "out", job->out.items, job->out.count);
    outputs_add(&outputs, "plot", job->plot.items, job->plot.count);
    return code == EXIT_DONE ? point_source_check_outputs(&job->source, &outputs) : code;
}

static int run(void *job)
{
    const int code = check(job);
    return code == EXIT_DONE ? measure(job) : code;
}
