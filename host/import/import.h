/* Scene files: one door for all formats. */
#ifndef CS_IMPORT_IMPORT_H
#define CS_IMPORT_IMPORT_H

#include "import/readers.h"
#include "import/text.h"

typedef struct cs_import_options {
    double smooth_degrees; /* as cs_model_smooth; below 0: as the file says */
    int is_played;         /* whether the file's animation is; else it stands as the file has it */
    double time_s;         /* of the animation */
} cs_import_options;

/* Reads `path` into an initialised, empty scene, in a process of its own: whatever the file does
 * there ends in a message. What is repaired or left out is reported to `log`. Without the program
 * clshear-import the formats with readers of our own are read in this process. */
clshear_status cs_scene_import(const char *path, const cs_import_options *options, cs_scene *scene,
                               const cs_log *log, cs_error *error);

/* The same in this process. */
clshear_status cs_import_here(const char *path, const cs_import_options *options,
                              const cs_import_modules *modules, cs_scene *scene, const cs_log *log,
                              cs_error *error);

#endif
