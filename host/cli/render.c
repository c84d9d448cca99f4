/* Scene file in, pictures out. */
#include "cli/render.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/output.h"
#include "cli/parse.h"
#include "cli/progress.h"
#include "cli/scene.h"

static char default_output[4096];

static int fail(const clshear_context *context)
{
    fprintf(stderr, "clshear: %s\n", clshear_message(context));
    return CLI_FAILED;
}

static void print_device(void *user, int number, const char *name)
{
    (void)user;
    printf("%d: %s\n", number, name);
}

static int list_devices(void)
{
    return clshear_list_devices(print_device, NULL) == CLSHEAR_OK ? CLI_DONE : fail(NULL);
}

static int list_samplers(void)
{
    clshear_sampler_info info;
    for (size_t i = 0; clshear_sampler_describe(i, &info); i++)
        printf("%-12s %s%s%s\n", info.name, info.about, info.progressive ? "; progressive" : "",
               info.is_default ? "; default" : "");
    return CLI_DONE;
}

/* Without --out: the scene's name with .exr, in the current folder. */
static void choose_output(cli_job *job)
{
    if (job->output_count > 0) return;
    const char *slash = strrchr(job->scene, '/');
    const char *name = slash != NULL ? slash + 1 : job->scene;
    const char *dot = strrchr(name, '.');
    int length = dot != NULL ? (int)(dot - name) : (int)strlen(name);
    snprintf(default_output, sizeof default_output, "%.*s.exr", length, name);
    job->outputs[job->output_count++] = default_output;
}

/* Whether a picture can be written there, which must be known before a long render. */
static int check_output(const char *flag, const char *path)
{
    static const char *const known[] = {".exr", ".png", ".jpg", ".jpeg", ".tif", ".tiff"};
    const char *dot = strrchr(path, '.');
    int found = 0;
    for (size_t k = 0; k < sizeof known / sizeof *known && dot != NULL; k++)
        found |= strcasecmp(dot, known[k]) == 0;
    if (found && dot != path && dot[-1] != '/') return cli_check_place(flag, path);
    fprintf(stderr, "clshear: --%s %s: must be a name that ends in .exr, .png, .jpg or .tif\n",
            flag, path);
    return CLI_USAGE;
}

static int check_outputs(const cli_job *job)
{
    int code = CLI_DONE;
    for (int i = 0; i < job->output_count && code == CLI_DONE; i++)
        code = check_output("out", job->outputs[i]);
    if (job->gain != NULL && code == CLI_DONE) code = check_output("gain", job->gain);
    return code;
}

/* Writes a word as a shell reads it. */
static void write_word(FILE *stream, const char *word)
{
    const int plain = *word != '\0' && strpbrk(word, " \t\n\"'$&*;<>?\\`|()[]{}!#~") == NULL;
    if (!plain) fputc('\'', stream);
    for (; *word != '\0'; word++)
        fputs(*word == '\'' ? "'\\''" : (const char[]){*word, '\0'}, stream);
    if (!plain) fputc('\'', stream);
}

/* The command that was given; NULL when out of memory. */
static char *command_line(int argc, char **argv)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    if (stream == NULL) return NULL;
    for (int i = 0; i < argc; i++) {
        if (i > 0) fputc(' ', stream);
        write_word(stream, argv[i]);
    }
    fclose(stream);
    return text;
}

/* The mean over pixels and colours of a plane named PREFIX.R, PREFIX.G, PREFIX.B. */
static double mean_of(const clshear_film *film, const char *prefix)
{
    const clshear_film_info info = clshear_film_describe(film);
    const size_t pixels = (size_t)info.width * (size_t)info.height;
    double sum = 0.0;
    for (const char *letter = "RGB"; *letter != '\0'; letter++) {
        char name[32];
        snprintf(name, sizeof name, "%s.%c", prefix, *letter);
        const float *plane = clshear_film_channel(film, name);
        for (size_t i = 0; i < pixels && plane != NULL; i++)
            sum += (double)plane[i];
    }
    return sum / (3.0 * (double)pixels);
}

static void print_stats(const clshear_context *context, const clshear_scene *scene,
                        const clshear_film *film)
{
    const clshear_scene_info world = clshear_scene_describe(scene);
    const clshear_film_info info = clshear_film_describe(film);
    const double rays = (double)info.samples + (double)info.shadow_rays;
    printf("device       %s\n", clshear_device_name(context));
    printf("triangles    %zu (%zu without area dropped), %zu in leaves, %zu nodes\n",
           world.triangles, world.degenerate, world.references, world.nodes);
    printf("geometry     %.1f bytes per triangle on the device\n",
           (double)world.device_bytes / (double)world.triangles);
    printf("lights       %zu point or directional, %zu emissive triangles\n", world.lights,
           world.emitters);
    printf("load         %.3f s\n", world.load_s);
    printf("build        %.3f s\n", world.build_s);
    printf("prepass      %.3f s\n", info.prepass_s);
    printf("pilot        %.3f s, %.1f %% more samples\n", info.pilot_s,
           100.0 * (double)info.pilot_samples / (double)info.samples);
    printf("kernels      %.3f s\n", info.kernel_s);
    printf("render       %.3f s, prepass and kernels included\n", info.render_s);
    printf("samples      %.3f M, %.2f M/s\n", 1e-6 * (double)info.samples,
           1e-6 * (double)info.samples / info.kernel_s);
    printf("rays         %.3f M, %.2f M/s (primary and shadow)\n", 1e-6 * rays,
           1e-6 * rays / info.kernel_s);
    if (clshear_film_channel(film, "Variance.R") != NULL)
        printf("variance     %.3e of the image, mean over pixels and colours\n",
               mean_of(film, "Variance"));
}

/* What an interrupted render has to show. */
typedef enum held {
    HELD_NOTHING, /* no samples at all */
    HELD_PART,    /* some pixels have none */
    HELD_ALL
} held;

static held held_by(const clshear_film *film)
{
    const clshear_film_info info = clshear_film_describe(film);
    const size_t pixels = (size_t)info.width * (size_t)info.height;
    const float *samples = clshear_film_channel(film, "Samples");
    size_t sampled = 0;
    for (size_t i = 0; i < pixels; i++)
        sampled += samples[i] > 0.0f;
    return sampled == 0 ? HELD_NOTHING : sampled < pixels ? HELD_PART : HELD_ALL;
}

/* Whether an interrupted render would replace a file that is worth more: any, if it has pixels
 * without samples, and always the picture that it was to extend, which can be extended again. */
static int is_spared(const cli_job *job, const char *path, held content)
{
    struct stat out, base;
    if (content == HELD_NOTHING) return 1;
    if (stat(path, &out) != 0 || !S_ISREG(out.st_mode)) return 0;
    return content == HELD_PART || (job->extend != NULL && stat(job->extend, &base) == 0 &&
                                    out.st_ino == base.st_ino && out.st_dev == base.st_dev);
}

static void tell_interruption(const cli_job *job, const char *path, int spared, held content)
{
    if (spared && access(path, F_OK) == 0)
        fprintf(stderr, "clshear: interrupted; %s is left as it was\n", path);
    else if (spared)
        fprintf(stderr, "clshear: interrupted before the first samples; no %s\n", path);
    else if (!job->quiet)
        fprintf(stderr, "clshear: interrupted; %s holds the samples so far%s\n", path,
                content == HELD_PART ? ", some pixels none" : "");
}

static int write_outputs(const cli_job *job, const clshear_context *context, clshear_film *film,
                         const char *command, int interrupted)
{
    const held content = interrupted ? held_by(film) : HELD_ALL;
    const char *settings = cli_settings_words();
    if ((command != NULL &&
         clshear_film_annotate(film, "clshear.cmdline", command) != CLSHEAR_OK) ||
        (*settings != '\0' &&
         clshear_film_annotate(film, "clshear.settings", settings) != CLSHEAR_OK))
        return fail(context);
    int code = CLI_DONE; /* one output that fails must not cost the others */
    for (int i = 0; i < job->output_count; i++) {
        const int spared = interrupted && is_spared(job, job->outputs[i], content);
        if (!spared && clshear_film_write(film, job->outputs[i]) != CLSHEAR_OK)
            code = fail(context);
        else if (interrupted)
            tell_interruption(job, job->outputs[i], spared, content);
    }
    if (job->gain != NULL && clshear_film_channel(film, "Gain") != NULL &&
        clshear_film_write_ratio(film, "Gain", job->gain) != CLSHEAR_OK)
        code = fail(context);
    return code;
}

/* From a loaded scene to written files. */
static int render(cli_job *job, clshear_context *context, clshear_scene *scene, const char *command)
{
    clshear_camera camera;
    clshear_film *film = NULL;
    if (cli_choose_camera(job, scene, &camera) != CLSHEAR_OK) return fail(context);
    cli_tell_choices(job, scene, &camera);
    clshear_film *base = NULL;
    if (job->extend != NULL && clshear_film_read(context, job->extend, &base) != CLSHEAR_OK)
        return fail(context);
    job->options.extend = base;
    cli_progress progress = cli_progress_start(job->quiet);
    job->options.progress = cli_progress_report;
    job->options.progress_user = &progress;
    cli_catch_interrupt();
    clshear_status status = clshear_render(scene, &camera, &job->options, &film);
    cli_progress_end(&progress);
    clshear_film_free(base);
    if (status != CLSHEAR_OK && status != CLSHEAR_CANCELLED) return fail(context);
    int code = write_outputs(job, context, film, command, status == CLSHEAR_CANCELLED);
    if (code == CLI_DONE && job->stats) print_stats(context, scene, film);
    clshear_film_free(film);
    if (code != CLI_DONE) return code;
    return status == CLSHEAR_CANCELLED ? CLI_INTERRUPTED : CLI_DONE;
}

static int run(cli_job *job, const char *command)
{
    clshear_context *context = NULL;
    clshear_scene *scene = NULL;
    choose_output(job);
    int code = check_outputs(job);
    if (code != CLI_DONE) return code;
    code = cli_open_scene(job, &context, &scene);
    if (code == CLI_DONE) code = render(job, context, scene, command);
    cli_close_scene(job, context, scene);
    return code;
}

int cli_render(int argc, char **argv)
{
    const cli_job defaults = cli_job_defaults();
    cli_job job;
    int code = cli_parse_scene(&cli_render_command, &defaults, sizeof job, argc, argv, &job);
    if (code != CLI_DONE) return code;
    if (job.help) {
        cli_print_help(&cli_render_command);
        return CLI_DONE;
    }
    if (job.version) {
        printf("clshear %s\n", clshear_version());
        return CLI_DONE;
    }
    if (job.list_devices) return list_devices();
    if (job.list_samplers) return list_samplers();
    if (job.scene == NULL) {
        fprintf(stderr, "clshear: no scene given; try: clshear SCENE --out img.exr\n");
        return CLI_USAGE;
    }
    char *words = command_line(argc, argv);
    code = run(&job, words);
    free(words);
    return code;
}
