/* What surrounds a scene: a colour, or an image of longitude and latitude with its tables. */
#ifndef CS_SCENE_ENVIRONMENT_H
#define CS_SCENE_ENVIRONMENT_H

#include "base/array.h"
#include "base/status.h"
#include "kernels/light/list.h"
#include "kernels/scene.h"

typedef struct cs_environment {
    cs_light light; /* CS_LIGHT_ENVIRONMENT */
    cs_array image; /* cs_f32: its buffer, see cs_lat_long_of; empty for a colour */
} cs_environment;

/* How an environment is shown. */
typedef struct cs_environment_view {
    double rotation_deg; /* about the axis that is up, seen from above against the clock */
    double strength;     /* its radiance is multiplied by it */
    int z_up;            /* 1: +Z is up; 0: +Y is */
} cs_environment_view;

/* From "R,G,B", "gradient:R,G,B,R,G,B" (zenith, horizon) or the path of an image. Freed by
 * cs_environment_free. */
clshear_status cs_environment_read(const char *text, cs_environment *environment, cs_error *error);

/* From `width` x `height` texels of three floats, rows from the top. */
clshear_status cs_environment_make(const float *texels, size_t width, size_t height,
                                   cs_environment *environment, cs_error *error);

/* Turns and scales the light of an environment that was read or made. */
void cs_environment_show(const cs_environment_view *view, cs_light *light);
void cs_environment_free(cs_environment *environment);

#endif
