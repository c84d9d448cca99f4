/* clshear SCENE: scene file in, pictures out. */
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands/commands.h"
#include "commands/reference.h"
#include "commands/render_job.h"
#include "commands/scene_view.h"
#include "report/failure.h"
#include "report/picture.h"
#include "report/progress.h"
#include "report/statistics.h"

#define AT(member) offsetof(render_job, member)
#define PICTURES ".exr .png .jpg .jpeg .tif .tiff"
static const program_flag flags[] = {
    FILES_FLAG("out o output outfile", "write .exr, .png, .jpg or .tif; repeatable", "",
               AT(files.out), PICTURES),
    TEXT_FLAG("gain", "FILE", "write what the shear gains, in false colours", "", AT(files.gain),
              PICTURES),
    TEXT_FLAG("extend", "FILE", "go on from FILE up to --spp; other flags the same", "",
              AT(files.extend), ""),
    WHOLE_FLAG("frames", "A,B", "frames A to B of the animation, in numbered files", "", AT(frames),
               2, 1, 0, 999999),
    SWITCH_FLAG("stats", "print sizes, times and rays per second", AT(stats)),
    SWITCH_FLAG("list-samplers", "list the samplers and stop", AT(list_samplers)),
    SWITCH_FLAG("list-devices", "list the OpenCL devices and stop", AT(list_devices)),
    TEXT_FLAG("print-settings", "FORMAT", "print the reference of all flags, md or man, and stop",
              "", AT(reference), "md man"),
    SWITCH_FLAG("version", "print the version and stop", AT(version)),
};

static int run(void *job);

const program_command render_command = {
    .name = "",
    .usage = "clshear SCENE [flags]\n"
             "       clshear points [flags]      point sets\n"
             "       clshear spectrum [flags]    their power spectra\n"
             "       clshear slice SCENE [flags] the integrand of a pixel\n"
             "       clshear predict [flags]     variance expected from spectra\n"
             "       clshear converge [flags]    variance against samples\n"
             "       clshear merge FILES [flags] shards of a render, put together\n\n"
             "Render SCENE (OBJ, glTF, PLY, STL, OFF, 3MF) with depth of field. Each command\n"
             "has its own --help.\n\n"
             "  clshear scenes/cornell.obj --spp 1024 --out img.exr\n",
    .notes = "Words after -- are names, even those that begin with a dash.\n"
             "Without --out, writes the scene's name with .exr in the current folder.\n"
             "Exit status: 0 done, 1 failed, 2 wrong usage, 130 interrupted (what was\n"
             "rendered so far is written).\n",
    COMMAND_FLAGS(flags),
    .takes_scene = 1,
    .job_size = sizeof(render_job),
    .run = run,
};

static void print_device(void *user, int number, const char *name)
{
    (void)user;
    printf("%d: %s\n", number, name);
}

static int list_samplers(void)
{
    clshear_sampler_info info = {.struct_size = sizeof info};
    for (size_t i = 0; clshear_sampler_describe(i, &info); i++)
        printf("%-12s %s%s%s\n", info.name, info.about, info.progressive ? "; progressive" : "",
               info.is_default ? "; default" : "");
    return EXIT_DONE;
}

static int is_preview_wanted(void *user)
{
    (void)user;
    return preview_wanted();
}

/* Writes the picture so far; what fails is said, and tried again at the end. */
static void write_preview(void *user, clshear_film *film)
{
    const render_job *job = user;
    film_files_write(&job->files, &job->options, film, "going on");
}

/* Renders, or goes on with a film. */
static clshear_status make_film(render_job *job, clshear_scene *scene, clshear_film **film)
{
    clshear_film *base = NULL;
    const text_list *extend = &job->files.extend;
    clshear_status status =
        extend->count > 0 ? clshear_film_read(extend->items[0], &base) : CLSHEAR_OK;
    if (status != CLSHEAR_OK) return status;
    progress_line progress = progress_start(job->options.quiet);
    clshear_settings_set_progress(job->options.settings, progress_report, &progress);
    clshear_settings_set_preview(job->options.settings, is_preview_wanted, write_preview, job);
    status = base != NULL ? clshear_render_extend(scene, job->options.settings, base, film)
                          : clshear_render(scene, job->options.settings, film);
    progress_end(&progress);
    clshear_film_free(base);
    return status;
}

/* The pictures are written: the checkpoint has nothing that is not in them. */
static void remove_checkpoint(const clshear_settings *settings)
{
    char path[4096];
    if (clshear_settings_is_set(settings, CLSHEAR_CHECKPOINT) &&
        clshear_settings_get_text(settings, CLSHEAR_CHECKPOINT, path, sizeof path) == CLSHEAR_OK)
        remove(path);
}

static int render(render_job *job, const scene_view *view)
{
    clshear_film *film = NULL;
    clshear_film_info info = {.struct_size = sizeof info};
    const clshear_status status = make_film(job, view->scene, &film);
    if (status != CLSHEAR_OK) return exit_status_of(status);
    clshear_film_describe(film, &info);
    int code = film_files_write(&job->files, &job->options, film, "interrupted");
    if (code == EXIT_DONE && info.complete && !job->options.quiet)
        remark_on_picture(film, job->options.settings, job->has_lens);
    if (code == EXIT_DONE && !job->options.quiet) remark_on_end(film, job->options.settings);
    if (code == EXIT_DONE && info.complete) remove_checkpoint(job->options.settings);
    if (code == EXIT_DONE && job->stats)
        report_statistics(view->context, view->scene, job->options.settings, film);
    clshear_film_free(film);
    return code == EXIT_DONE && !info.complete ? EXIT_SIGNAL + interrupting_signal() : code;
}

/* A lens that opens, and that was not chosen by the program. */
static int given_a_lens(const clshear_settings *settings)
{
    double radius = 0.0;
    if (clshear_settings_is_set(settings, CLSHEAR_F_STOP)) return 1;
    return clshear_settings_is_set(settings, CLSHEAR_LENS_RADIUS) &&
           clshear_settings_get_number(settings, CLSHEAR_LENS_RADIUS, &radius) == CLSHEAR_OK &&
           radius > 0.0;
}

/* Opens the scene, renders and writes. */
static int render_scene(render_job *job)
{
    scene_view view = {0};
    int code = scene_view_open(&job->options, &view);
    if (code == EXIT_DONE) code = render(job, &view);
    scene_view_close(&view);
    return code;
}

/* The names of a list with a frame's number, owned by `numbered`. Returns 0 if memory is out. */
static int number_names(const text_list *list, int frame, text_list *numbered)
{
    numbered->count = 0;
    while (numbered->count < list->count) {
        char *name = film_files_numbered_name(list->items[numbered->count], frame);
        if (name == NULL) return 0;
        numbered->items[numbered->count++] = name;
    }
    return 1;
}

static void free_names(text_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        free((char *)list->items[i]);
}

/* One frame, with settings of its own: those that the scene completes differ from frame to frame.
 * The outputs have the frame's number before their endings. */
static int render_frame(const render_job *job, int frame)
{
    render_job one = *job;
    int code = EXIT_DONE;
    one.options.settings = NULL;
    one.files.gain.count = 0;
    if (!number_names(&job->files.out, frame, &one.files.out) ||
        !number_names(&job->files.gain, frame, &one.files.gain))
        code = complain(EXIT_FAILED, "out of memory");
    if (code == EXIT_DONE)
        code = exit_status_of(clshear_settings_copy(job->options.settings, &one.options.settings));
    if (code == EXIT_DONE)
        code = exit_status_of(
            clshear_settings_set_integer(one.options.settings, CLSHEAR_FRAME, frame));
    if (code == EXIT_DONE) code = render_check_files(&one);
    if (code == EXIT_DONE) code = render_scene(&one);
    free_names(&one.files.out);
    free_names(&one.files.gain);
    clshear_settings_free(one.options.settings);
    return code;
}

static int render_frames(render_job *job)
{
    if (job->frames.count == 0) return render_scene(job);
    const int first = (int)job->frames.items[0], last = (int)job->frames.items[1];
    if (first > last)
        return complain(EXIT_USAGE, "--frames %d,%d: the first is after the last", first, last);
    if (job->files.extend.count > 0)
        return complain(EXIT_USAGE, "--extend goes on with one picture, --frames makes many");
    if (clshear_settings_is_set(job->options.settings, CLSHEAR_CHECKPOINT))
        return complain(EXIT_USAGE, "--checkpoint is of one picture, --frames makes many");
    if (clshear_settings_is_set(job->options.settings, CLSHEAR_RECORD))
        return complain(EXIT_USAGE, "--record is of one picture, --frames makes many");
    int code = EXIT_DONE;
    for (int frame = first; frame <= last && code == EXIT_DONE; frame++)
        code = render_frame(job, frame);
    return code;
}

static int run(void *user)
{
    render_job *job = user;
    program_options *options = &job->options;
    if (job->version) printf("clshear %s\n", clshear_version());
    if (job->version) return EXIT_DONE;
    if (job->list_devices) return exit_status_of(clshear_list_devices(print_device, NULL));
    if (job->list_samplers) return list_samplers();
    if (job->reference.count > 0) return print_reference(job->reference.items[0]);
    if (options->scene == NULL)
        return complain(EXIT_USAGE, "no scene given; try: clshear SCENE --out img.exr");
    char *name = film_files_default_name(options->scene);
    if (name == NULL) return complain(EXIT_FAILED, "out of memory");
    if (job->files.out.count == 0) job->files.out.items[job->files.out.count++] = name;
    if (job->files.gain.count > 0) clshear_settings_set_integer(options->settings, CLSHEAR_GAIN, 1);
    progress_outlive_reader();
    job->has_lens = given_a_lens(options->settings);
    int code = render_check(job);
    if (code == EXIT_DONE) code = render_frames(job);
    free(name);
    return code;
}
