/* Store functions for the flags of camera and lens; `target` is a cli_job. */
#ifndef CS_CLI_CAMERA_FLAGS_H
#define CS_CLI_CAMERA_FLAGS_H

const char *cli_store_eye(void *target, const char *value);
const char *cli_store_target(void *target, const char *value);
const char *cli_store_up(void *target, const char *value);
const char *cli_store_fov(void *target, const char *value);
const char *cli_store_lens_radius(void *target, const char *value);
const char *cli_store_focal_distance(void *target, const char *value);
const char *cli_store_f_stop(void *target, const char *value);
const char *cli_store_unit(void *target, const char *value);
const char *cli_store_focus_pixel(void *target, const char *value);
const char *cli_store_aperture(void *target, const char *value);
const char *cli_store_blades(void *target, const char *value);
const char *cli_store_blade_rotation(void *target, const char *value);
const char *cli_store_anamorphic(void *target, const char *value);

#endif
