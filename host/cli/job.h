/* What the command line asks for. */
#ifndef CS_CLI_JOB_H
#define CS_CLI_JOB_H

#include "clshear/clshear.h"

enum {
    CLI_MAX_OUTPUTS = 16,
    CLI_MAX_LIGHTS = 64
};

enum {
    CLI_DONE = 0,
    CLI_FAILED = 1,
    CLI_USAGE = 2,
    CLI_INTERRUPTED = 130
};

/* A value that was or was not given. */
typedef struct cli_vector {
    int given;
    float value[3];
} cli_vector;

typedef struct cli_number {
    int given;
    float value;
} cli_number;

typedef struct cli_job {
    const char *scene;
    const char *settings; /* NULL: the file beside the scene, if there is one */
    const char *extend;   /* a picture to go on with */
    const char *gain;     /* picture of the gain; NULL: not asked for */
    const char *outputs[CLI_MAX_OUTPUTS];
    int output_count;
    clshear_context_options context;
    clshear_options options;
    cli_vector eye, target, up;
    cli_number fov, lens_radius, focal_distance, f_stop, unit_m;
    int focus_pixel_given;
    int focus_pixel[2];
    clshear_aperture aperture;
    const char *aperture_file; /* of an image aperture, else NULL */
    clshear_aperture_image aperture_image;
    int blades;
    float blade_rotation_deg, anamorphic;
    clshear_light lights[CLI_MAX_LIGHTS];
    int light_count;
    int quiet, stats, help, version, list_devices, list_samplers;
} cli_job;

#endif
