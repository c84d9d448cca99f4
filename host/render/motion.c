#include "render/motion.h"

#include <math.h>
#include <stdlib.h>

#include "clshear/device/lens.h"
#include "oracle/oracle.h"
#include "scene/camera.h"

/* Difference of two depths, as a part of them, below which they are those of one surface. */
#define SAME_DEPTH 0.01f

/* Eye and target of the settings for the end of the shutter; `view` where they are not set. */
static cs_view closing_view(const cs_job *job, const cs_view *view)
{
    const double *origin = job->scene->scene.origin;
    cs_view closing = *view;
    if (!cs_is_set(&job->settings, CAMERA_TO)) return closing;
    const double *given = cs_numbers(&job->settings, CAMERA_TO);
    for (int i = 0; i < 3; i++) {
        closing.eye[i] = (float)(given[i] - origin[i]);
        closing.target[i] = (float)(given[3 + i] - origin[i]);
    }
    return closing;
}

/* The view at `time`, 0 to 1, between two. */
static cs_view view_between(const cs_view *open, const cs_view *closed, float time)
{
    cs_view view = *open;
    for (int i = 0; i < 3; i++) {
        view.eye[i] += time * (closed->eye[i] - open->eye[i]);
        view.target[i] += time * (closed->target[i] - open->target[i]);
        view.up[i] += time * (closed->up[i] - open->up[i]);
    }
    return view;
}

static cs_camera_motion motion_between(const cs_view *open, const cs_view *closed)
{
    cs_camera_motion motion;
    for (int i = 0; i < 3; i++) {
        motion.eye_step[i] = closed->eye[i] - open->eye[i];
        motion.sight[i] = open->target[i] - open->eye[i];
        motion.sight_step[i] = closed->target[i] - closed->eye[i] - motion.sight[i];
        motion.up[i] = open->up[i];
        motion.up_step[i] = closed->up[i] - open->up[i];
    }
    return motion;
}

static int differ(const cs_view *open, const cs_view *closed)
{
    int different = 0;
    for (int i = 0; i < 3; i++)
        different |= open->eye[i] != closed->eye[i] || open->target[i] != closed->target[i] ||
                     open->up[i] != closed->up[i];
    return different;
}

cs_shutter cs_motion_shutter(const cs_job *job)
{
    const double *ramps = cs_numbers(&job->settings, SHUTTER_RAMPS);
    return (cs_shutter){(cs_f32)ramps[0], (cs_f32)ramps[1]};
}

clshear_status cs_motion_begin(cs_job *job, const cs_view *view, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_shutter shutter = cs_motion_shutter(job);
    CS_REQUIRE(shutter.opening + shutter.closing <= 1.0f, CLSHEAR_BAD_ARGUMENT,
               "shutter ramps %g,%g: must be 1 together at most", (double)shutter.opening,
               (double)shutter.closing);
    cs_shutter_cameras *cameras = &job->cameras;
    const cs_view closing = closing_view(job, view);
    const cs_view middle = view_between(view, &closing, 0.5f);
    cameras->open = job->camera;
    CS_TRY(cs_camera_frame(&middle, job->width, job->height, &cameras->middle, error));
    CS_TRY(cs_camera_frame(&closing, job->width, job->height, &cameras->closed, error));
    cameras->middle.optics = job->camera.optics;
    cameras->closed.optics = job->camera.optics;
    job->motion = motion_between(view, &closing);
    const int scene_moves = cs_scene_moves(&job->scene->scene);
    job->moves = scene_moves || differ(view, &closing);
    if (job->moves) job->features |= CS_FEATURE_MOTION;
    if (scene_moves) job->features |= CS_FEATURE_MOVING;
done:
    return status;
}

clshear_status cs_motion_find(cs_job *job, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    if (!job->moves) return CLSHEAR_OK;
    job->velocities_px = malloc(job->pixel_count * sizeof *job->velocities_px);
    CS_REQUIRE(job->velocities_px != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
               job->pixel_count);
    cs_accel_velocity(job->scene->accel, &job->cameras, job->window, job->velocities_px);
done:
    return status;
}

/* The velocity of what a pixel sees at `depth`, along the ray through its centre in the middle of
 * the shutter, as if it were at rest. */
static cs_velocity velocity_at_rest(const cs_job *job, size_t index, cs_f32 depth)
{
    const size_t width = (size_t)(job->window[1] - job->window[0]);
    const size_t row = index / width, column = index - row * width;
    const cs_f32 x = (cs_f32)job->window[0] + (cs_f32)column + 0.5f;
    const cs_f32 y = (cs_f32)job->window[2] + (cs_f32)row + 0.5f;
    const cs_ray ray = cs_lens_ray(job->cameras.middle, x, y, 0.0f, 0.0f);
    float point[3];
    for (int i = 0; i < 3; i++)
        point[i] = ray.origin[i] + depth * ray.direction[i];
    return cs_oracle_velocity(&job->cameras.open, &job->cameras.closed, point, point);
}

/* The velocity that goes with a rule's shear. The nearest and the farthest surface of a pixel are
 * taken for that of the centre if they are as deep, and to be at rest otherwise. */
static cs_velocity velocity_of_rule(const cs_job *job, size_t index, cs_rule rule)
{
    const cs_velocity none = {0.0f, 0.0f};
    const cs_depth *depth = &job->depth[index];
    const cs_f32 seen = rule == CS_RULE_FAR ? depth->far : depth->near;
    if (!cs_rule_has_velocity(rule)) return none;
    if ((rule != CS_RULE_NEAR && rule != CS_RULE_FAR && rule != CS_RULE_FRONT) || !isfinite(seen) ||
        seen <= 0.0f || fabsf(seen - depth->centre) < SAME_DEPTH * seen)
        return job->velocities_px[index];
    return velocity_at_rest(job, index, seen);
}

/* While the shutter is open, as it is in the middle of a trapezoid, so much of the motion comes
 * with a part of the exposure. */
cs_velocity cs_motion_exposed(const cs_job *job, cs_velocity velocity)
{
    const cs_shutter shutter = cs_motion_shutter(job);
    const cs_f32 whole = 1.0f - 0.5f * (shutter.opening + shutter.closing);
    velocity.x *= whole;
    velocity.y *= whole;
    return velocity;
}

clshear_status cs_motion_upload(const cs_job *job, const uint8_t *rules, cs_buffer **buffer,
                                cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_velocity *used = NULL;
    if (!job->moves) return CLSHEAR_OK;
    used = calloc(job->pixel_count, sizeof *used);
    CS_REQUIRE(used != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for %zu pixels",
               job->pixel_count);
    for (size_t i = 0; i < job->pixel_count; i++)
        used[i] = cs_motion_exposed(job, velocity_of_rule(job, i, (cs_rule)rules[i]));
    CS_TRY(cs_buffer_create(job->scene->context->device, job->pixel_count * sizeof *used, used,
                            buffer, error));
done:
    free(used);
    return status;
}

clshear_status cs_motion_resolve(const cs_job *job, clshear_film *film, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    if (job->velocities_px == NULL) return CLSHEAR_OK;
    float *x = cs_film_add_channel(film, "Velocity.X");
    float *y = cs_film_add_channel(film, "Velocity.Y");
    CS_REQUIRE(x != NULL && y != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for the film");
    for (size_t i = 0; i < job->pixel_count; i++) {
        x[i] = job->velocities_px[i].x;
        y[i] = job->velocities_px[i].y;
    }
done:
    return status;
}
