/* clshear points: point sets in and out. */
#include "commands/commands.h"
#include "commands/point_source.h"
#include "report/failure.h"
#include "report/output.h"
#include "report/words.h"

typedef struct points_job {
    point_source source;
    text_list out;
} points_job;

static const program_flag flags[] = {
    POINT_SOURCE_FLAGS("independent sets (1)"),
    TEXT_FLAG("dims", "LETTERS", "coordinates, in this order, out of xyuvpqt (xyuv)", "",
              offsetof(point_source, letters), ""),
    TEXT_FLAG("out o", "FILE", ".exr, .csv, or text; - is standard output", "-",
              offsetof(points_job, out), ""),
};
static const clshear_setting settings[] = {POINT_SOURCE_SETTINGS};

static int run(void *job);

const program_command points_command = {
    .name = "points",
    .usage = "clshear points [flags]\n"
             "Write the points of a sampler: film x y, lens u v, light p q, time t, in [0, 1).\n\n"
             "  clshear points --sampler sobol --n 256 --sets 10 --dims xu --out points.txt\n",
    .notes = "Text has a point a line and a line # between sets; .csv has commas instead of\n"
             "spaces; .exr has a channel for each coordinate and a row for each set.\n",
    COMMAND_FLAGS(flags),
    COMMAND_SETTINGS(settings),
    .job_size = sizeof(points_job),
    .run = run,
};

static int check(const points_job *job)
{
    const char *out = job->out.items[0];
    if (has_ending(".png .jpg .jpeg .tif .tiff", out))
        return complain(EXIT_USAGE, "--out %s: must be a text, .csv or .exr file, not a picture",
                        out);
    output_files outputs = {0};
    outputs_add(&outputs, "out", job->out.items, 1);
    const int code = point_source_check(&job->source, "dims", 0);
    return code == EXIT_DONE ? point_source_check_outputs(&job->source, &outputs) : code;
}

static int write_points(const points_job *job)
{
    clshear_points *points = NULL;
    clshear_status status =
        point_source_make(&job->source, (size_t)number_or(&job->source.sets, 1.0),
                          seed_of(&job->source.options), "xyuv", &points);
    if (status == CLSHEAR_OK) status = clshear_points_write(points, job->out.items[0]);
    clshear_points_free(points);
    return exit_status_of(status);
}

static int run(void *job)
{
    const int code = check(job);
    return code == EXIT_DONE ? write_points(job) : code;
}
