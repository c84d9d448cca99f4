/* clshear slice: the integrand of a pixel over two of its coordinates, or over the four of film and
 * lens. */
#include <clshear/analysis.h>
#include <stdlib.h>
#include <string.h>

#include "commands/commands.h"
#include "commands/outputs.h"
#include "commands/scene_view.h"
#include "report/failure.h"
#include "report/output.h"
#include "report/slice_files.h"
#include "report/words.h"

typedef struct slice_job {
    program_options options;
    number_list pixel;
    text_list projection; /* two letters, or "4d" */
    number_list resolution;
    number_list at; /* of the coordinates that are not shown */
    text_list out;
    text_list spectrum;
    int no_line;
} slice_job;

#define AT(member) offsetof(slice_job, member)
static const program_flag flags[] = {
    WHOLE_FLAG("pixel", "X,Y", "the pixel", "", AT(pixel), 2, 1, 0, 65535),
    TEXT_FLAG("projection dims", "LETTERS", "two coordinates out of xyuvt, or 4d", "xu",
              AT(projection), ""),
    WHOLE_FLAG("resolution", "R", "values along a side, or W,H (256; 4d: 32)", "", AT(resolution),
               1, 2, 2, 8192),
    NUMBER_FLAG("at", "V", "the coordinates not shown, 0 to 1", "0.5", AT(at), 1, 1, 0, 1),
    FILES_FLAG("out o", ".exr, .png, .jpg, .tif; 4d: .npy; repeatable", "", AT(out),
               ".exr .png .jpg .tif .npy"),
    TEXT_FLAG("spectrum", "FILE", "the slice's power spectrum, .png or .exr", "", AT(spectrum),
              ".exr .png"),
    SWITCH_FLAG("no-line", "leave out the direction of the oracle's shear", AT(no_line)),
};

static int run(void *job);

const program_command slice_command = {
    .name = "slice",
    .usage = "clshear slice SCENE --pixel X,Y [flags]\n"
             "Draw the integrand of a pixel over two of film x y, lens u v and time t.\n\n"
             "  clshear slice scenes/cornell.obj --pixel 302,130 --out xu.png\n",
    .notes = "The first coordinate goes to the right, the second downwards; 0 to 1 is the\n"
             "pixel, the square around the aperture, or the open shutter. The line shows the\n"
             "fibres of the oracle's depth and velocity; in the spectrum (of the slice less\n"
             "its mean, through Hann's window) that of their energy. Without --out: slice.png,\n"
             "or slice.npy.\n",
    COMMAND_FLAGS(flags),
    .takes_scene = 1,
    .job_size = sizeof(slice_job),
    .run = run,
};

static const char letters[] = "xyuvt";
enum {
    COORDINATES = sizeof letters - 1
};

static int is_four(const slice_job *job)
{
    return strcmp(job->projection.items[0], "4d") == 0;
}

/* Sets the coordinates of point number `index`. */
static void place(const slice_job *job, const slice_values *slice, size_t index, float *point)
{
    const char *projection = job->projection.items[0];
    const size_t width = (size_t)slice->width;
    for (int d = 0; d < COORDINATES; d++)
        point[d] = (float)job->at.items[0];
    if (is_four(job)) {
        for (int d = 3; d >= 0; d--, index /= width)
            point[d] = ((float)(index % width) + 0.5f) / (float)width;
        return;
    }
    const size_t row = index / width;
    const long first = strchr(letters, projection[0]) - letters;
    const long second = strchr(letters, projection[1]) - letters;
    point[first] = ((float)(index % width) + 0.5f) / (float)width;
    point[second] = ((float)row + 0.5f) / (float)slice->height;
}

/* How the second coordinate moves the first along a fibre, from the oracle's shear and velocity:
 * x + s u - v t is constant, and so is y + s v - v t. */
static clshear_status find_slope(const slice_job *job, clshear_scene *scene, slice_values *slice)
{
    const clshear_settings *settings = job->options.settings;
    const double *pixel = job->pixel.items;
    const char *projection = job->projection.items[0];
    float shear = 0.0f, velocity[2] = {0.0f, 0.0f};
    double anamorphic = 1.0, ramps[2] = {0.0, 0.0};
    size_t count = 0;
    int moves = 0;
    if (job->no_line) return CLSHEAR_OK;
    clshear_status status =
        clshear_pixel_shear(scene, settings, (int)pixel[0], (int)pixel[1], &shear);
    if (status == CLSHEAR_OK)
        status =
            clshear_pixel_motion(scene, settings, (int)pixel[0], (int)pixel[1], &moves, velocity);
    if (status == CLSHEAR_OK)
        status = clshear_settings_get_number(settings, CLSHEAR_ANAMORPHIC, &anamorphic);
    if (status == CLSHEAR_OK)
        status = clshear_settings_get_numbers(settings, CLSHEAR_SHUTTER_RAMPS, ramps, 2, &count);
    /* Time is the part of the exposure: where the shutter is all open, less of the motion. */
    for (int i = 0; i < 2; i++)
        velocity[i] *= (float)(1.0 - 0.5 * (ramps[0] + ramps[1]));
    const double extent = (double)clshear_lens_extent(settings) * (double)shear;
    if (strcmp(projection, "xu") == 0) slice->slope = extent / anamorphic;
    if (strcmp(projection, "yv") == 0) slice->slope = extent;
    if (strcmp(projection, "xt") == 0) slice->slope = -(double)velocity[0];
    if (strcmp(projection, "yt") == 0) slice->slope = -(double)velocity[1];
    if (strcmp(projection, "ut") == 0 && extent != 0.0)
        slice->slope = -(double)velocity[0] * anamorphic / extent;
    if (strcmp(projection, "vt") == 0 && extent != 0.0)
        slice->slope = -(double)velocity[1] / extent;
    return status;
}

static int compute(const slice_job *job, clshear_scene *scene, slice_values *slice)
{
    const double *pixel = job->pixel.items;
    float *points = malloc(COORDINATES * slice->count * sizeof *points);
    slice->rgb = malloc(3 * slice->count * sizeof *slice->rgb);
    if (points == NULL || slice->rgb == NULL) {
        free(points);
        return complain(EXIT_FAILED, "out of memory");
    }
    for (size_t i = 0; i < slice->count; i++)
        place(job, slice, i, points + COORDINATES * i);
    clshear_status status = find_slope(job, scene, slice);
    if (status == CLSHEAR_OK)
        status = clshear_moving_radiance(scene, job->options.settings, (int)pixel[0], (int)pixel[1],
                                         points, slice->count, slice->rgb);
    free(points);
    return exit_status_of(status);
}

static int check(slice_job *job)
{
    const char *projection = job->projection.items[0];
    const int four = is_four(job);
    const number_list *resolution = &job->resolution;
    if (job->options.scene == NULL || job->pixel.count == 0)
        return complain(EXIT_USAGE, "give a SCENE and a --pixel; see clshear slice --help");
    if (!four && (strlen(projection) != 2 || strspn(projection, letters) != 2 ||
                  projection[0] == projection[1]))
        return complain(EXIT_USAGE, "--projection %s: must be two letters out of xyuvt, or 4d",
                        projection);
    if (four && (resolution->count > 1 || (resolution->count == 1 && resolution->items[0] > 64.0)))
        return complain(EXIT_USAGE, "--projection 4d: --resolution must be one number up to 64");
    if (four && job->spectrum.count > 0)
        return complain(EXIT_USAGE, "--spectrum needs a slice of two coordinates");
    for (size_t i = 0; i < job->out.count; i++)
        if (four != has_ending(".npy", job->out.items[i]))
            return complain(EXIT_USAGE,
                            "--out: .npy is for --projection 4d, and the only one for it");
    if (job->out.count == 0 && job->spectrum.count == 0)
        job->out.items[job->out.count++] = four ? "slice.npy" : "slice.png";
    output_files outputs = {0};
    outputs_add(&outputs, "out", job->out.items, job->out.count);
    outputs_add(&outputs, "spectrum", job->spectrum.items, job->spectrum.count);
    const int code = check_pixel(&job->options, "pixel", job->pixel.items);
    return code == EXIT_DONE ? check_outputs(&job->options, &outputs) : code;
}

static int write_files(const slice_job *job, const slice_values *slice)
{
    int code = EXIT_DONE;
    for (size_t i = 0; i < job->out.count && code == EXIT_DONE; i++)
        code = is_four(job) ? slice_write_npy(slice, job->out.items[i])
                            : slice_write_image(slice, job->out.items[i]);
    if (code == EXIT_DONE && job->spectrum.count > 0)
        code = slice_write_spectrum(slice, job->spectrum.items[0]);
    return code;
}

/* Width and height, and the number of points that follows from them. */
static slice_values shape_of(const slice_job *job)
{
    const number_list *resolution = &job->resolution;
    const double usual = is_four(job) ? 32.0 : 256.0;
    const double width = resolution->count > 0 ? resolution->items[0] : usual;
    const double height = resolution->count > 1 ? resolution->items[1] : width;
    const double count = is_four(job) ? width * width * width * width : width * height;
    return (slice_values){.width = (int)width, .height = (int)height, .count = (size_t)count};
}

static int run(void *user)
{
    slice_job *job = user;
    scene_view view = {0};
    int code = check(job);
    if (code != EXIT_DONE) return code;
    slice_values slice = shape_of(job);
    code = scene_view_open(&job->options, &view);
    if (code == EXIT_DONE) code = compute(job, view.scene, &slice);
    if (code == EXIT_DONE) code = write_files(job, &slice);
    free(slice.rgb);
    scene_view_close(&view);
    return code;
}
