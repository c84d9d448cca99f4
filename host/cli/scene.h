/* What commands that render have in common: a scene with its settings and its camera. */
#ifndef CS_CLI_SCENE_H
#define CS_CLI_SCENE_H

#include "cli/flags.h"
#include "cli/job.h"

enum {
    CLI_MOST_FLAGS = 128
};

/* A command on one scene that takes the flags of rendering and `count` of its own, which come first
 * and hide those of the same name. `flags`: room for CLI_MOST_FLAGS, kept by the caller. */
cli_command cli_scene_command(const char *name, const cli_flag *own, size_t count, cli_flag *flags);

/* Reads the words into `job`, over the settings file of the scene if there is one. `job` and
 * `defaults` are `size` bytes and begin with a cli_job; without a scene, job.scene is NULL. Returns
 * CLI_DONE, CLI_FAILED or CLI_USAGE. */
int cli_parse_scene(const cli_command *command, const void *defaults, size_t size, int argc,
                    char **argv, void *job);

/* Reads the aperture's image, opens the device and the scene, and adds the lights. Warnings go to
 * the standard error stream unless job->quiet. Returns CLI_DONE or CLI_FAILED, with a line printed;
 * what was opened is closed by cli_close_scene in either case. */
int cli_open_scene(cli_job *job, clshear_context **context, clshear_scene **scene);
void cli_close_scene(cli_job *job, clshear_context *context, clshear_scene *scene);

/* The scene's camera with what the flags say. */
clshear_status cli_choose_camera(const cli_job *job, const clshear_scene *scene,
                                 clshear_camera *camera);

/* Whether the image has that pixel: CLI_DONE, or CLI_USAGE with a line printed. */
int cli_check_pixel(const cli_job *job, const char *flag, const int *pixel);

/* The shear in pixels that the oracle has for a pixel of the image; the pilot's is that of the
 * centre's depth. */
clshear_status cli_find_shear(const cli_job *job, clshear_scene *scene,
                              const clshear_camera *camera, const int *pixel, float *shear_px);

/* Tells what the file and the flags left open. */
void cli_tell_choices(const cli_job *job, const clshear_scene *scene, const clshear_camera *camera);

#endif
