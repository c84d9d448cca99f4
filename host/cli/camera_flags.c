/* The flags of camera and lens. */
#include "cli/camera_flags.h"

#include <string.h>

#include "cli/flags.h"
#include "cli/job.h"

static const char *vector(cli_vector *target, const char *value)
{
    target->given = 1;
    return cli_read_floats(value, 3, target->value) ? NULL : "three numbers, x,y,z";
}

static const char *positive(cli_number *target, const char *value)
{
    target->given = 1;
    return cli_read_floats(value, 1, &target->value) && target->value > 0.0f ? NULL
                                                                             : "a number above 0";
}

const char *cli_store_eye(void *target, const char *value)
{
    cli_job *job = target;
    return vector(&job->eye, value);
}

const char *cli_store_target(void *target, const char *value)
{
    cli_job *job = target;
    return vector(&job->target, value);
}

const char *cli_store_up(void *target, const char *value)
{
    cli_job *job = target;
    return vector(&job->up, value);
}

const char *cli_store_fov(void *target, const char *value)
{
    cli_job *job = target;
    const char *wanted = positive(&job->fov, value);
    return wanted == NULL && job->fov.value < 180.0f ? NULL : "degrees above 0 and below 180";
}

const char *cli_store_lens_radius(void *target, const char *value)
{
    cli_job *job = target;
    job->lens_radius.given = 1;
    job->f_stop.given = 0; /* the last word on a thing counts */
    return cli_read_floats(value, 1, &job->lens_radius.value) && job->lens_radius.value >= 0.0f
               ? NULL
               : "a number, 0 or more";
}

const char *cli_store_focal_distance(void *target, const char *value)
{
    cli_job *job = target;
    job->focus_pixel_given = 0;
    return positive(&job->focal_distance, value);
}

const char *cli_store_f_stop(void *target, const char *value)
{
    cli_job *job = target;
    job->lens_radius.given = 0;
    return positive(&job->f_stop, value);
}

const char *cli_store_unit(void *target, const char *value)
{
    cli_job *job = target;
    return positive(&job->unit_m, value);
}

const char *cli_store_focus_pixel(void *target, const char *value)
{
    cli_job *job = target;
    job->focus_pixel_given = 1;
    job->focal_distance.given = 0;
    return cli_read_ints(value, 2, 0, 65535, job->focus_pixel) ? NULL : "x,y in pixels";
}

const char *cli_store_aperture(void *target, const char *value)
{
    static const char *const shapes[] = {"disk", "square", "polygon"};
    cli_job *job = target;
    job->aperture_file = NULL;
    for (int i = 0; i < 3; i++)
        if (strcmp(value, shapes[i]) == 0) {
            job->aperture = (clshear_aperture)i;
            return NULL;
        }
    job->aperture = CLSHEAR_APERTURE_IMAGE;
    job->aperture_file = value;
    return strpbrk(value, "./") != NULL ? NULL : "disk, square, polygon or an image file";
}

const char *cli_store_blades(void *target, const char *value)
{
    cli_job *job = target;
    job->aperture = CLSHEAR_APERTURE_POLYGON;
    job->aperture_file = NULL;
    return cli_read_ints(value, 1, 3, 32, &job->blades) ? NULL : "a whole number, 3 to 32";
}

const char *cli_store_blade_rotation(void *target, const char *value)
{
    cli_job *job = target;
    return cli_read_floats(value, 1, &job->blade_rotation_deg) ? NULL : "degrees";
}

const char *cli_store_anamorphic(void *target, const char *value)
{
    cli_job *job = target;
    return cli_read_floats(value, 1, &job->anamorphic) && job->anamorphic >= 0.01f &&
                   job->anamorphic <= 100.0f
               ? NULL
               : "a ratio, 0.01 to 100";
}
