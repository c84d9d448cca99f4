/* What can be said of a render's flags before its scene is read. */
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "commands/outputs.h"
#include "commands/render_job.h"
#include "report/failure.h"

/* Whether the formats of the outputs hold a picture of this size. */
static int check_formats(const render_job *job)
{
    const clshear_settings *settings = job->options.settings;
    double crop[4];
    size_t count = 0;
    int64_t width = 0, height = 0;
    clshear_settings_get_integer(settings, CLSHEAR_WIDTH, &width);
    clshear_settings_get_integer(settings, CLSHEAR_HEIGHT, &height);
    if (clshear_settings_is_set(settings, CLSHEAR_CROP) &&
        clshear_settings_get_numbers(settings, CLSHEAR_CROP, crop, 4, &count) == CLSHEAR_OK) {
        width = (int64_t)(crop[1] - crop[0]);
        height = (int64_t)(crop[3] - crop[2]);
    }
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < job->files.out.count && status == CLSHEAR_OK; i++)
        status = clshear_film_check_path(job->files.out.items[i], (int)width, (int)height);
    return exit_status_of(status);
}

/* Adds the file that a setting names, if it is set; `path` has room for it. */
static void add_setting(const render_job *job, clshear_setting setting, const char *flag,
                        char path[SETTING_TEXT], output_files *outputs)
{
    const char *const paths[] = {path};
    if (setting_text(job->options.settings, setting, path) != NULL)
        outputs_add(outputs, flag, paths, 1);
}

int render_check_files(const render_job *job)
{
    const film_files *files = &job->files;
    char checkpoint[SETTING_TEXT], record[SETTING_TEXT], preview[SETTING_TEXT];
    output_files pictures = {0}, others = {0}, all;
    outputs_add(&pictures, "out", files->out.items, files->out.count);
    int code = outputs_check(&pictures);
    if (code == EXIT_DONE) code = check_formats(job);
    outputs_add(&others, "gain", files->gain.items, files->gain.count);
    add_setting(job, CLSHEAR_CHECKPOINT, "checkpoint", checkpoint, &others);
    add_setting(job, CLSHEAR_RECORD, "record", record, &others);
    all = pictures;
    for (size_t i = 0; i < others.count; i++)
        outputs_add(&all, others.flags[i], &others.paths[i], 1);
    if (code == EXIT_DONE) code = check_outputs(&job->options, &all);
    /* The last preview is the picture, and may have its name. A picture may go on with itself; of
     * previews in its place, a killed render would leave one without the samples so far. */
    add_setting(job, CLSHEAR_PREVIEW, "preview", preview, &others);
    if (code == EXIT_DONE)
        code = outputs_spare(&others, "--extend", files->extend.items, files->extend.count);
    return code == EXIT_DONE ? check_outputs(&job->options, &others) : code;
}

/* Whether an output is an EXR, or (`is_exr` 0) whether one is not. */
static int has_output(const render_job *job, int is_exr)
{
    for (size_t i = 0; i < job->files.out.count; i++) {
        const char *dot = strrchr(job->files.out.items[i], '.');
        if ((dot != NULL && strcasecmp(dot, ".exr") == 0) == is_exr) return 1;
    }
    return 0;
}

/* The number of the choice that a setting has, which is its default where it is not set. */
static int64_t choice_of(const clshear_settings *settings, clshear_setting setting)
{
    int64_t number = 0;
    clshear_settings_get_integer(settings, setting, &number);
    return number;
}

/* A flag that may do nothing. Only those of the command line are told: a settings file describes
 * its scene for any use. */
typedef struct idle_flag {
    int has_use;
    const char *name;
    const char *needs;
} idle_flag;

static void tell(const render_job *job, const idle_flag *list, size_t count)
{
    for (size_t i = 0; i < count && !job->options.quiet; i++)
        if (!list[i].has_use && value_on_line(&job->options, list[i].name) != NULL)
            fprintf(stderr, "clshear: --%s is not used: it needs %s\n", list[i].name,
                    list[i].needs);
}

/* Tells the flags of the line that only some formats of pictures obey. */
static void tell_of_formats(const render_job *job)
{
    static const char exr[] = "an .exr among the outputs; add --out FILE.exr";
    static const char other[] = "an output that is no .exr";
    const int has_exr = has_output(job, 1);
    const int has_other =
        has_output(job, 0) || clshear_settings_is_set(job->options.settings, CLSHEAR_PREVIEW);
    const idle_flag list[] = {
        {has_exr, "aov", exr},
        {has_exr, "extendable", exr},
        {has_exr, "keep-patterns", exr},
        {has_exr || job->files.gain.count > 0, "gain-channel", exr},
        {has_other, "exposure", other},
        {has_other, "auto-exposure", other},
        {has_other, "tone", other},
    };
    tell(job, list, sizeof list / sizeof *list);
    if (!has_exr && !job->options.quiet &&
        clshear_settings_is_set(job->options.settings, CLSHEAR_SHARD))
        fprintf(stderr, "clshear: the shard cannot be merged without %s\n", exr);
}

/* Tells those that other flags make use of. */
static void tell_of_flags(const render_job *job)
{
    const clshear_settings *settings = job->options.settings;
#define GIVEN(setting) clshear_settings_is_set(settings, CLSHEAR_##setting)
    const int shears = choice_of(settings, CLSHEAR_SHEAR) != CLSHEAR_SHEAR_NONE;
    const int is_polygon = choice_of(settings, CLSHEAR_APERTURE) == CLSHEAR_APERTURE_POLYGON;
    const int plays = GIVEN(FRAME) || job->frames.count > 0;
    const int moves = plays || GIVEN(SHUTTER) || GIVEN(CAMERA_TO) || GIVEN(TO) || GIVEN(TURNTABLE);
    const idle_flag list[] = {
        {GIVEN(F_STOP), "unit", "--fstop"},
        {GIVEN(CHECKPOINT) || GIVEN(PREVIEW), "every", "--checkpoint or --preview"},
        {GIVEN(ENVIRONMENT), "environment-rotation", "--environment"},
        {GIVEN(ENVIRONMENT), "environment-strength", "--environment"},
        {is_polygon, "blades", "the aperture that it makes, without another --aperture behind it"},
        {is_polygon, "blade-rotation", "--blades"},
        {shears && !GIVEN(SHEAR_PX), "oracle", "a shear to choose: no --shear none, no --shear-px"},
        {shears, "shear-px", "a shear: no --shear none"},
        {choice_of(settings, CLSHEAR_BOUNCES) > 0, "clamp", "--bounces above 0"},
        {job->frames.count == 0, "frame", "to be without --frames, which gives the frames"},
        {plays, "fps", "--frame or --frames"},
        {plays && !GIVEN(SHUTTER), "shutter-angle", "--frame or --frames, and no --shutter"},
        {moves, "shutter-ramps", "something that moves: --frame, --camera-to, --to, --turntable"},
    };
#undef GIVEN
    tell(job, list, sizeof list / sizeof *list);
}

int render_check(const render_job *job)
{
    const int code = render_check_files(job);
    if (code != EXIT_DONE) return code;
    tell_of_formats(job);
    tell_of_flags(job);
    return EXIT_DONE;
}
