#include "cli/scene.h"

#include "cli/render.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/parse.h"

static char settings_path[4096];

static void override_vector(const cli_vector *given, float *value)
{
    if (given->given) memcpy(value, given->value, sizeof given->value);
}

clshear_status cli_choose_camera(const cli_job *job, const clshear_scene *scene,
                                 clshear_camera *camera)
{
    const int width = job->options.width, height = job->options.height;
    clshear_status status = clshear_scene_camera(scene, width, height, camera);
    if (status != CLSHEAR_OK) return status;
    override_vector(&job->eye, camera->eye);
    override_vector(&job->target, camera->target);
    override_vector(&job->up, camera->up);
    if (job->fov.given) camera->fov_deg = job->fov.value;
    camera->aperture = job->aperture;
    camera->image = &job->aperture_image;
    camera->blades = job->blades;
    camera->blade_rotation_deg = job->blade_rotation_deg;
    camera->anamorphic = job->anamorphic;
    if (job->f_stop.given)
        camera->lens_radius = clshear_lens_radius(camera, job->f_stop.value, job->unit_m.value);
    if (job->lens_radius.given) camera->lens_radius = job->lens_radius.value;
    if (job->focal_distance.given) camera->focal_distance = job->focal_distance.value;
    if (job->focus_pixel_given)
        status = clshear_camera_focus(scene, width, height, job->focus_pixel[0],
                                      job->focus_pixel[1], camera);
    if (status != CLSHEAR_OK) return status;
    const int lens_chosen = camera->lens_radius >= 0.0f;
    const int focus_chosen = camera->focal_distance > 0.0f;
    status = clshear_camera_complete(scene, width, height, camera);
    if (status != CLSHEAR_OK || job->quiet) return status;
    if (!focus_chosen && camera->lens_radius > 0.0f)
        fprintf(stderr, "clshear: focused on the middle of the picture, --focal-distance %g\n",
                (double)camera->focal_distance);
    if (!lens_chosen)
        fprintf(stderr, "clshear: no lens given, a moderate blur: --lens-radius %g\n",
                (double)camera->lens_radius);
    return CLSHEAR_OK;
}

void cli_tell_choices(const cli_job *job, const clshear_scene *scene, const clshear_camera *camera)
{
    const clshear_scene_info info = clshear_scene_describe(scene);
    if (job->quiet) return;
    if (!info.file_camera && !job->eye.given)
        fprintf(stderr, "clshear: no camera given, the scene is framed: --eye %g,%g,%g\n",
                (double)camera->eye[0], (double)camera->eye[1], (double)camera->eye[2]);
    if (info.lights + info.emitters == 0)
        fprintf(stderr, "clshear: no light given, a point light above the scene's middle\n");
}

/* "path/scene.obj" -> "path/scene.flags", if that file exists. */
static const char *settings_beside(const char *scene)
{
    const char *dot = strrchr(scene, '.'), *slash = strrchr(scene, '/');
    if (dot == NULL || (slash != NULL && dot < slash)) return NULL;
    snprintf(settings_path, sizeof settings_path, "%.*s.flags", (int)(dot - scene), scene);
    FILE *stream = fopen(settings_path, "rb");
    if (stream == NULL) return NULL;
    fclose(stream);
    return settings_path;
}

/* Reads the settings file and then the line again, which wins; its lights and outputs replace the
 * file's. The file beside a scene is about renders: other commands take what it says of the scene,
 * but not its outputs, nor flags that mean something else to them. `line`: what the line says by
 * itself. */
static int read_over_settings(const cli_command *command, const char *settings, const cli_job *line,
                              int argc, char **argv, cli_job *job)
{
    const int beside = line->settings == NULL, renders = command->name == NULL;
    int code = cli_parse_settings(beside ? &cli_render_command : command, job, settings);
    if (code != CLI_DONE) return code;
    if (!line->quiet) fprintf(stderr, "clshear: settings from %s\n", settings);
    if (line->light_count > 0) job->light_count = 0;
    if (line->output_count > 0 || !renders) job->output_count = 0;
    if (!renders) job->gain = job->extend = NULL;
    return cli_parse_words(command, job, argc, argv, &job->scene);
}

cli_command cli_scene_command(const char *name, const cli_flag *own, size_t count, cli_flag *flags)
{
    const cli_command *render = &cli_render_command;
    memcpy(flags, own, count * sizeof *flags);
    memcpy(flags + count, render->flags, render->flag_count * sizeof *flags);
    return (cli_command){
        .name = name, .flags = flags, .flag_count = count + render->flag_count, .most_operands = 1};
}

int cli_parse_scene(const cli_command *command, const void *defaults, size_t size, int argc,
                    char **argv, void *result)
{
    cli_job *job = result, line;
    memcpy(result, defaults, size);
    int code = cli_parse_words(command, job, argc, argv, &job->scene);
    const int renders = command->name == NULL;
    if (code != CLI_DONE || job->help || job->scene == NULL) return code;
    if (renders && (job->version || job->list_devices || job->list_samplers)) return CLI_DONE;
    line = *job;
    const char *settings = line.settings != NULL ? line.settings : settings_beside(line.scene);
    if (settings == NULL) return CLI_DONE;
    memcpy(result, defaults, size);
    return read_over_settings(command, settings, &line, argc, argv, job);
}

static void warn(void *user, const char *line)
{
    const cli_job *job = user;
    if (!job->quiet) fprintf(stderr, "clshear: %s\n", line);
}

static int fail(const clshear_context *context)
{
    fprintf(stderr, "clshear: %s\n", clshear_message(context));
    return CLI_FAILED;
}

int cli_open_scene(cli_job *job, clshear_context **context, clshear_scene **scene)
{
    job->context.warn = warn;
    job->context.warn_user = job;
    if (job->aperture_file != NULL &&
        clshear_aperture_image_read(job->aperture_file, &job->aperture_image) != CLSHEAR_OK)
        return fail(NULL);
    if (clshear_context_create(&job->context, context) != CLSHEAR_OK) return fail(NULL);
    if (clshear_scene_load(*context, job->scene, scene) != CLSHEAR_OK) return fail(*context);
    for (int i = 0; i < job->light_count; i++)
        if (clshear_scene_add_light(*scene, &job->lights[i]) != CLSHEAR_OK) return fail(*context);
    return CLI_DONE;
}

void cli_close_scene(cli_job *job, clshear_context *context, clshear_scene *scene)
{
    clshear_scene_free(scene);
    clshear_context_free(context);
    clshear_aperture_image_free(&job->aperture_image);
}

int cli_check_pixel(const cli_job *job, const char *flag, const int *pixel)
{
    const clshear_options *options = &job->options;
    if (pixel[0] < options->width && pixel[1] < options->height) return CLI_DONE;
    fprintf(stderr, "clshear: --%s %d,%d: is outside the %d x %d image\n", flag, pixel[0], pixel[1],
            options->width, options->height);
    return CLI_USAGE;
}

clshear_status cli_find_shear(const cli_job *job, clshear_scene *scene,
                              const clshear_camera *camera, const int *pixel, float *shear_px)
{
    clshear_film *film = NULL;
    clshear_options options = job->options;
    const int crop[4] = {pixel[0], pixel[0] + 1, pixel[1], pixel[1] + 1};
    memcpy(options.crop, crop, sizeof crop);
    options.spp = options.replicates = 1;
    options.adaptive = options.gain = options.extendable = 0;
    clshear_status status = clshear_render(scene, camera, &options, &film);
    if (status != CLSHEAR_OK) return status;
    *shear_px = *clshear_film_channel(film, "Shear");
    clshear_film_free(film);
    return CLSHEAR_OK;
}
