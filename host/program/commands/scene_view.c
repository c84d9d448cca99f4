#include "commands/scene_view.h"

#include <stdio.h>

#include "report/failure.h"

static void warn(void *user, const char *line)
{
    const program_options *options = user;
    if (!options->quiet) fprintf(stderr, "clshear: %s\n", line);
}

/* Work that may be lost is told even to those who want to hear nothing. */
static void alarm_user(void *user, const char *line)
{
    (void)user;
    complain(EXIT_FAILED, "%s", line);
}

/* What the settings say before the camera is completed. */
typedef struct given_settings {
    int has_eye;
    int has_target;
    int has_focus;
    int has_focus_pixel;
    int has_lens;
    int has_environment;
} given_settings;

static given_settings given_by(const clshear_settings *settings)
{
    return (given_settings){
        .has_eye = clshear_settings_is_set(settings, CLSHEAR_EYE),
        .has_target = clshear_settings_is_set(settings, CLSHEAR_TARGET),
        .has_focus = clshear_settings_is_set(settings, CLSHEAR_FOCAL_DISTANCE) ||
                     clshear_settings_is_set(settings, CLSHEAR_FOCUS_PIXEL) ||
                     clshear_settings_is_set(settings, CLSHEAR_FOCUS_POINT),
        .has_focus_pixel = clshear_settings_is_set(settings, CLSHEAR_FOCUS_PIXEL),
        .has_lens = clshear_settings_is_set(settings, CLSHEAR_LENS_RADIUS) ||
                    clshear_settings_is_set(settings, CLSHEAR_F_STOP) ||
                    clshear_settings_is_set(settings, CLSHEAR_BLUR),
        .has_environment = clshear_settings_is_set(settings, CLSHEAR_ENVIRONMENT)};
}

/* A setting under the name of its flag. */
typedef struct named_setting {
    clshear_setting setting;
    const char *flag;
} named_setting;

static const named_setting camera_parts[] = {{CLSHEAR_EYE, "eye"},
                                             {CLSHEAR_TARGET, "target"},
                                             {CLSHEAR_UP, "up"},
                                             {CLSHEAR_FOV, "fov"},
                                             {CLSHEAR_ORTHOGRAPHIC, "orthographic"}};
static const named_setting light_parts[] = {
    {CLSHEAR_ENVIRONMENT, "environment"}, {CLSHEAR_SUN, "sun"}, {CLSHEAR_LIGHT, "light"}};

/* What the library chose, as flags that can be copied. */
static void tell_flags(const clshear_settings *settings, const char *words,
                       const named_setting *parts, size_t count)
{
    char text[256];
    fprintf(stderr, "clshear: %s", words);
    for (size_t i = 0; i < count; i++)
        if (clshear_settings_is_set(settings, parts[i].setting) &&
            clshear_settings_get_text(settings, parts[i].setting, text, sizeof text) == CLSHEAR_OK)
            fprintf(stderr, " --%s %s", parts[i].flag, text);
    fprintf(stderr, "\n");
}

/* Tells what the camera has that file and flags left open. */
static void tell_camera(const clshear_settings *settings, const given_settings *given,
                        int has_file_camera)
{
    static const named_setting eye = {CLSHEAR_EYE, "eye"}, target = {CLSHEAR_TARGET, "target"};
    if (!has_file_camera && !given->has_eye)
        tell_flags(settings, "no camera given, the scene is framed:", camera_parts,
                   sizeof camera_parts / sizeof *camera_parts);
    else if (given->has_eye && !given->has_target)
        tell_flags(settings,
                   has_file_camera
                       ? "no target given, the camera looks where the file's camera does:"
                       : "no target given, the camera looks near the middle of the scene:",
                   &target, 1);
    else if (given->has_target && !given->has_eye)
        tell_flags(settings, "no eye given, the camera stands where the file's camera does:", &eye,
                   1);
}

/* Tells what file and flags left open. */
static void tell_choices(const program_options *options, const clshear_scene *scene,
                         const given_settings *given)
{
    const clshear_settings *settings = options->settings;
    clshear_scene_info info = {.struct_size = sizeof info};
    double radius = 0.0, distance = 0.0;
    clshear_scene_describe(scene, &info);
    clshear_settings_get_number(settings, CLSHEAR_LENS_RADIUS, &radius);
    clshear_settings_get_number(settings, CLSHEAR_FOCAL_DISTANCE, &distance);
    if (!given->has_focus && radius > 0.0)
        fprintf(stderr, "clshear: focused on the middle of the picture, --focal-distance %.9g\n",
                distance);
    if (!given->has_lens)
        fprintf(stderr, "clshear: no lens given, a moderate blur: --lens-radius %.9g\n", radius);
    if (given->has_focus_pixel)
        fprintf(stderr, "clshear: the surface at that pixel is in focus: --focal-distance %.9g\n",
                distance);
    tell_camera(settings, given, info.file_camera != 0);
    if (!given->has_environment && clshear_settings_is_set(settings, CLSHEAR_ENVIRONMENT))
        tell_flags(settings, "no light given, a neutral studio:", light_parts,
                   sizeof light_parts / sizeof *light_parts);
}

int scene_view_open(program_options *options, scene_view *view)
{
    const given_settings given = given_by(options->settings);
    clshear_status status = clshear_context_create(options->settings, &view->context);
    if (status != CLSHEAR_OK) return exit_status_of(status);
    clshear_context_set_warning(view->context, warn, options);
    clshear_context_set_alarm(view->context, alarm_user, NULL);
    status = clshear_scene_load(view->context, options->scene, options->settings, &view->scene);
    if (status == CLSHEAR_OK) status = clshear_light_complete(view->scene, options->settings);
    if (status != CLSHEAR_OK) return exit_status_of(status);
    if (!options->quiet) tell_choices(options, view->scene, &given);
    return EXIT_DONE;
}

void scene_view_close(scene_view *view)
{
    clshear_scene_free(view->scene);
    clshear_context_free(view->context);
}

int check_pixel(const program_options *options, const char *flag, const double *pixel)
{
    int64_t width = 0, height = 0;
    clshear_settings_get_integer(options->settings, CLSHEAR_WIDTH, &width);
    clshear_settings_get_integer(options->settings, CLSHEAR_HEIGHT, &height);
    if (pixel[0] < (double)width && pixel[1] < (double)height) return EXIT_DONE;
    return complain(EXIT_USAGE, "--%s %g,%g: is outside the %d x %d image", flag, pixel[0],
                    pixel[1], (int)width, (int)height);
}
