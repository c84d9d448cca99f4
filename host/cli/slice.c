#include "cli/slice.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/output.h"
#include "cli/render.h"
#include "cli/scene.h"

static const char letters[] = "xyuv";

static const char *store_pixel(void *target, const char *value)
{
    cli_slice_job *job = target;
    job->pixel_given = 1;
    return cli_read_ints(value, 2, 0, 65535, job->pixel) ? NULL : "x,y";
}

static const char *store_projection(void *target, const char *value)
{
    cli_slice_job *job = target;
    const int two = strlen(value) == 2 && strspn(value, letters) == 2 && value[0] != value[1];
    if (!two && strcmp(value, "4d") != 0) return "two letters out of xyuv, or 4d";
    memcpy(job->projection, value, sizeof job->projection);
    return NULL;
}

static const char *store_resolution(void *target, const char *value)
{
    cli_slice_job *job = target;
    return cli_read_sides(value, job->resolution);
}

static const char *store_at(void *target, const char *value)
{
    cli_slice_job *job = target;
    return cli_read_floats(value, 1, &job->at) && job->at >= 0.0f && job->at <= 1.0f
               ? NULL
               : "a number from 0 to 1";
}

static const char *store_out(void *target, const char *value)
{
    static const char *const known[] = {".exr", ".png", ".jpg", ".tif", ".npy"};
    cli_slice_job *job = target;
    const char *dot = strrchr(value, '.');
    int found = 0;
    for (size_t i = 0; i < sizeof known / sizeof *known && dot != NULL; i++)
        found |= strcmp(dot, known[i]) == 0;
    if (job->output_count == CLI_MAX_OUTPUTS) return "given at most 16 times";
    job->outputs[job->output_count++] = value;
    return found ? NULL : "a name that ends in .exr, .png, .jpg, .tif, or .npy for 4d";
}

static const char *store_spectrum(void *target, const char *value)
{
    cli_slice_job *job = target;
    const char *dot = strrchr(value, '.');
    job->spectrum = value;
    return dot != NULL && (strcmp(dot, ".exr") == 0 || strcmp(dot, ".png") == 0)
               ? NULL
               : "a name that ends in .exr or .png";
}

static const char *store_no_line(void *target, const char *value)
{
    cli_slice_job *job = target;
    (void)value;
    job->no_line = 1;
    return NULL;
}

static const cli_flag own_flags[] = {
    {"pixel", "X,Y", "the pixel", store_pixel},
    {"projection dims", "LETTERS", "two coordinates out of xyuv, or 4d (xu)", store_projection},
    {"resolution", "R", "values along a side, or W,H (256; 4d: 32)", store_resolution},
    {"at", "V", "the coordinates not shown, 0 to 1 (0.5)", store_at},
    {"out o", "FILE", ".exr, .png, .jpg, .tif; 4d: .npy; repeatable", store_out},
    {"spectrum", "FILE", "the slice's power spectrum, .png or .exr", store_spectrum},
    {"no-line", NULL, "leave out the direction of the oracle's shear", store_no_line},
};
enum {
    OWN_FLAGS = sizeof own_flags / sizeof *own_flags
};

static const cli_command help = {
    .name = "slice",
    .summary = "usage: clshear slice SCENE --pixel X,Y [flags]\n"
               "Draw the integrand of a pixel over two of its four coordinates.\n\n"
               "  clshear slice scenes/cornell.obj --pixel 302,130 --out xu.png\n",
    .notes = "The first coordinate goes to the right, the second downwards; 0 to 1 is the\n"
             "pixel, or the square around the aperture. The line shows the fibres of the\n"
             "oracle's depth; in the spectrum (of the slice less its mean, through Hann's\n"
             "window) that of their energy. Flags of rendering say camera, lens, light and\n"
             "--oracle. Without --out: slice.png, or slice.npy.\n",
    .flags = own_flags,
    .flag_count = OWN_FLAGS,
};

static int fail(const char *message)
{
    fprintf(stderr, "clshear: %s\n", message);
    return CLI_FAILED;
}

/* Sets the coordinates of point number `index`. */
static void place(const cli_slice_job *job, size_t index, float *point)
{
    for (int d = 0; d < 4; d++)
        point[d] = job->at;
    if (strcmp(job->projection, "4d") == 0) {
        const size_t r = (size_t)job->resolution[0];
        for (int d = 3; d >= 0; d--, index /= r)
            point[d] = ((float)(index % r) + 0.5f) / (float)r;
        return;
    }
    const size_t width = (size_t)job->resolution[0];
    const long first = strchr(letters, job->projection[0]) - letters;
    const long second = strchr(letters, job->projection[1]) - letters;
    point[first] = ((float)(index % width) + 0.5f) / (float)width;
    const size_t row = index / width;
    point[second] = ((float)row + 0.5f) / (float)job->resolution[1];
}

/* How the second coordinate moves the first along a fibre, from the oracle's shear. */
static clshear_status find_slope(const cli_slice_job *job, clshear_scene *scene,
                                 const clshear_camera *camera, cli_slice *slice)
{
    float shear = 0.0f;
    const clshear_status status = cli_find_shear(&job->render, scene, camera, job->pixel, &shear);
    if (status != CLSHEAR_OK) return status;
    const double anamorphic = camera->anamorphic > 0.0f ? (double)camera->anamorphic : 1.0;
    const double extent = (double)clshear_lens_extent(camera) * (double)shear;
    slice->slope = 0.0;
    if (strcmp(job->projection, "xu") == 0) slice->slope = extent / anamorphic;
    if (strcmp(job->projection, "yv") == 0) slice->slope = extent;
    return CLSHEAR_OK;
}

static int compute(const cli_slice_job *job, clshear_context *context, clshear_scene *scene,
                   cli_slice *slice)
{
    clshear_camera camera;
    float *points = malloc(4 * slice->count * sizeof *points);
    clshear_status status = CLSHEAR_OK;
    int code = CLI_FAILED;
    slice->rgb = malloc(3 * slice->count * sizeof *slice->rgb);
    if (points == NULL || slice->rgb == NULL) {
        free(points);
        return fail("out of memory");
    }
    for (size_t i = 0; i < slice->count; i++)
        place(job, i, points + 4 * i);
    status = cli_choose_camera(&job->render, scene, &camera);
    if (status == CLSHEAR_OK) cli_tell_choices(&job->render, scene, &camera);
    if (status == CLSHEAR_OK) status = find_slope(job, scene, &camera, slice);
    if (status == CLSHEAR_OK)
        status =
            clshear_radiance(scene, &camera, job->render.options.width, job->render.options.height,
                             job->pixel[0], job->pixel[1], points, slice->count, slice->rgb);
    code = status == CLSHEAR_OK ? CLI_DONE : fail(clshear_message(context));
    free(points);
    return code;
}

static int check(const cli_slice_job *job)
{
    const int four = strcmp(job->projection, "4d") == 0;
    const char *wrong = NULL;
    if (job->render.scene == NULL || !job->pixel_given)
        wrong = "give a SCENE and a --pixel; see clshear slice --help";
    else if (four && (job->resolution[0] > 64 || job->resolution[0] != job->resolution[1]))
        wrong = "--projection 4d: --resolution must be one number up to 64";
    else if (four && job->spectrum != NULL)
        wrong = "--spectrum needs a slice of two coordinates";
    for (int i = 0; i < job->output_count && wrong == NULL; i++)
        if (four != (strcmp(strrchr(job->outputs[i], '.'), ".npy") == 0))
            wrong = "--out: .npy is for --projection 4d, and the only one for it";
    if (wrong == NULL) return cli_check_pixel(&job->render, "pixel", job->pixel);
    fprintf(stderr, "clshear: %s\n", wrong);
    return CLI_USAGE;
}

static int run(cli_slice_job *job)
{
    clshear_context *context = NULL;
    clshear_scene *scene = NULL;
    const size_t width = (size_t)job->resolution[0], height = (size_t)job->resolution[1];
    const int four = strcmp(job->projection, "4d") == 0;
    cli_slice slice = {.width = (int)width,
                       .height = (int)height,
                       .count = four ? width * width * width * width : width * height};
    int code = cli_open_scene(&job->render, &context, &scene);
    if (code == CLI_DONE) code = compute(job, context, scene, &slice);
    if (code == CLI_DONE) code = cli_slice_write(job, &slice);
    free(slice.rgb);
    cli_close_scene(&job->render, context, scene);
    return code;
}

int cli_slice_run(int argc, char **argv)
{
    cli_flag flags[CLI_MOST_FLAGS];
    const cli_command command = cli_scene_command("slice", own_flags, OWN_FLAGS, flags);
    const cli_slice_job defaults = {
        .render = cli_job_defaults(), .projection = "xu", .resolution = {0, 0}, .at = 0.5f};
    cli_slice_job job;
    int code = cli_parse_scene(&command, &defaults, sizeof job, argc, argv, &job);
    if (code != CLI_DONE) return code;
    if (job.render.help) {
        cli_print_help(&help);
        return CLI_DONE;
    }
    if (job.resolution[0] == 0)
        job.resolution[0] = job.resolution[1] = strcmp(job.projection, "4d") == 0 ? 32 : 256;
    if (job.output_count == 0 && job.spectrum == NULL)
        job.outputs[job.output_count++] =
            strcmp(job.projection, "4d") == 0 ? "slice.npy" : "slice.png";
    code = check(&job);
    if (code == CLI_DONE) code = cli_check_places("out", job.outputs, job.output_count);
    if (code == CLI_DONE) code = cli_check_place("spectrum", job.spectrum);
    return code == CLI_DONE ? run(&job) : code;
}
