/* What commands that look at a scene have in common. */
#ifndef CS_PROGRAM_COMMANDS_SCENE_VIEW_H
#define CS_PROGRAM_COMMANDS_SCENE_VIEW_H

#include "options/options.h"

typedef struct scene_view {
    clshear_context *context;
    clshear_scene *scene;
} scene_view;

/* Opens device and scene, chooses what the settings leave open, and says what was chosen. `view`:
 * zeros at first; closed by scene_view_close in any case. Returns EXIT_DONE, or EXIT_FAILED with a
 * line printed. */
int scene_view_open(program_options *options, scene_view *view);
void scene_view_close(scene_view *view);

/* Whether the image has that pixel: EXIT_DONE, or EXIT_USAGE with a line printed. */
int check_pixel(const program_options *options, const char *flag, const double *pixel);

#endif
