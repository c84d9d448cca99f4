#include "render/camera_choice.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vec.h"
#include "render/interior.h"
#include "scene/camera.h"
#include "scene/framing.h"
#include "settings/view.h"

static const float blur_at_infinity = 0.03f; /* of the shorter image axis, for a lens not chosen */
static const float half_sensor_m = 0.012f;   /* half the short side of a full-frame sensor */

static float tangent_of_half_fov(const cs_view *view)
{
    return tanf(0.5f * view->fov_deg * (CS_PI / 180.0f));
}

static clshear_status set_one(clshear_settings *settings, clshear_setting setting, float value,
                              cs_error *error)
{
    const double number = (double)value;
    return cs_settings_set(settings, setting, &number, 1, error);
}

static clshear_status set_vector(clshear_settings *settings, clshear_setting setting,
                                 const float *vector, const double *origin, cs_error *error)
{
    double numbers[3];
    for (int axis = 0; axis < 3; axis++)
        numbers[axis] = (double)vector[axis] + origin[axis];
    return cs_settings_set(settings, setting, numbers, 3, error);
}

/* The file's camera that the settings name: the first one if they name none, -1 without any. */
static clshear_status choose_camera(const clshear_scene *scene, const clshear_settings *settings,
                                    int *number, cs_error *error)
{
    const cs_array *cameras = &scene->scene.cameras;
    *number = cameras->count > 0 && !cs_is_set(settings, ORBIT) ? 0 : -1;
    if (!cs_is_set(settings, CAMERA)) return CLSHEAR_OK;
    const char *name = cs_text(settings, CAMERA);
    *number = cs_camera_find(&scene->scene, name);
    if (*number >= 0) return CLSHEAR_OK;
    if (cameras->count == 0)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "camera %.60s: the scene has no cameras", name);
    char names[512] = "";
    for (size_t i = 0; i < cameras->count && i < 8; i++)
        snprintf(names + strlen(names), sizeof names - strlen(names), "%s%zu \"%.40s\"",
                 i > 0 ? ", " : "", i, ((const cs_scene_camera *)cameras->items)[i].name);
    return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "camera %.60s: the scene has %zu: %s", name,
                   cameras->count, names);
}

static int z_is_up(const cs_scene *scene, const clshear_settings *settings)
{
    return cs_is_set(settings, Z_UP) ? cs_integer(settings, Z_UP) != 0 : scene->z_up;
}

/* The camera that frames the scene. The settings may turn it, and say what is up. */
static cs_view frame_scene(const cs_scene *scene, const clshear_settings *settings)
{
    cs_framing framing = cs_framing_default(scene, z_is_up(scene, settings));
    if (cs_is_set(settings, FOV)) framing.fov_deg = (float)cs_number(settings, FOV);
    if (cs_is_set(settings, ORBIT)) {
        framing.azimuth_deg = (float)cs_numbers(settings, ORBIT)[0];
        framing.elevation_deg = (float)cs_numbers(settings, ORBIT)[1];
    }
    return cs_framing_view(scene, &framing, (int)cs_integer(settings, WIDTH),
                           (int)cs_integer(settings, HEIGHT));
}

/* The camera of a scene without one: inside if it is a room, unless the settings place it. */
static clshear_status default_view(const clshear_scene *scene, const clshear_settings *settings,
                                   cs_view *view, cs_error *error)
{
    int is_room = 0;
    const int is_placed = cs_is_set(settings, ORBIT) || cs_is_set(settings, EYE) ||
                          cs_is_set(settings, TARGET) || cs_is_set(settings, UP);
    clshear_status status = CLSHEAR_OK;
    if (!is_placed)
        status = cs_interior_view(scene, z_is_up(&scene->scene, settings), &is_room, view, error);
    if (status != CLSHEAR_OK) return status;
    if (is_room)
        cs_warn(
            &scene->context->log,
            "the scene is taken for a room and seen from inside; "
            "--orbit 35,20 shows it from outside, --z-up sets it upright if it lies on its side");
    else
        *view = frame_scene(&scene->scene, settings);
    return CLSHEAR_OK;
}

clshear_status cs_camera_pose(const clshear_scene *scene, clshear_settings *settings,
                              cs_error *error)
{
    static const double nowhere[3] = {0, 0, 0};
    const double *origin = scene->scene.origin;
    clshear_status status = CLSHEAR_OK;
    int number = -1;
    cs_view view;
    CS_TRY(choose_camera(scene, settings, &number, error));
    if (number < 0)
        CS_TRY(default_view(scene, settings, &view, error));
    else
        view = cs_camera_of_scene(&scene->scene, number, (int)cs_integer(settings, WIDTH),
                                  (int)cs_integer(settings, HEIGHT));
    if (!cs_is_set(settings, EYE))
        CS_TRY(set_vector(settings, CLSHEAR_EYE, view.eye, origin, error));
    if (!cs_is_set(settings, TARGET))
        CS_TRY(set_vector(settings, CLSHEAR_TARGET, view.target, origin, error));
    if (!cs_is_set(settings, UP)) CS_TRY(set_vector(settings, CLSHEAR_UP, view.up, nowhere, error));
    if (!cs_is_set(settings, FOV)) CS_TRY(set_one(settings, CLSHEAR_FOV, view.fov_deg, error));
done:
    return status;
}

/* Depth that pixel (x, y) sees, infinite if it sees nothing. */
static clshear_status depth_at(const clshear_scene *scene, const clshear_settings *settings, int x,
                               int y, float *depth, cs_error *error)
{
    const int width = (int)cs_integer(settings, WIDTH), height = (int)cs_integer(settings, HEIGHT);
    const int window[4] = {x, x + 1, y, y + 1};
    cs_view view;
    cs_camera camera;
    cs_depth found;
    if (x < 0 || y < 0 || x >= width || y >= height)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "pixel %d,%d is outside the %d x %d image", x,
                       y, width, height);
    cs_view_of(settings, scene->scene.origin, &view);
    clshear_status status = cs_camera_frame(&view, width, height, &camera, error);
    if (status == CLSHEAR_OK)
        status = cs_accel_depth(scene->accel, NULL, &camera, NULL, window, 0, &found, error);
    if (status == CLSHEAR_OK) *depth = found.centre;
    return status;
}

clshear_status cs_camera_focus(const clshear_scene *scene, clshear_settings *settings, int x, int y,
                               cs_error *error)
{
    float depth = INFINITY;
    clshear_status status = depth_at(scene, settings, x, y, &depth, error);
    if (status != CLSHEAR_OK) return status;
    if (!isfinite(depth))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "pixel %d,%d sees nothing to focus on; choose another or give a distance", x,
                       y);
    return set_one(settings, CLSHEAR_FOCAL_DISTANCE, depth, error);
}

/* Depth of a point, relative to the scene's origin; 0 or less: behind the camera. */
static float depth_of(const cs_view *view, const float *point)
{
    float towards[3], offset[3];
    cs_vec_subtract(view->target, view->eye, towards);
    cs_vec_subtract(point, view->eye, offset);
    return cs_vec_dot(towards, offset) / sqrtf(cs_vec_dot(towards, towards));
}

/* Depth of the bounding box's centre; 1 if it lies behind the camera. */
static float depth_of_centre(const cs_scene *scene, const cs_view *view)
{
    float centre[3];
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5f * (scene->bounds[0][i] + scene->bounds[1][i]);
    const float depth = depth_of(view, centre);
    return depth > 0.0f ? depth : 1.0f;
}

static clshear_status focus_on_point(const clshear_scene *scene, clshear_settings *settings,
                                     cs_error *error)
{
    const double *given = cs_numbers(settings, FOCUS_POINT);
    const double at[3] = {given[0], given[1], given[2]};
    float point[3];
    cs_view view;
    cs_view_of(settings, scene->scene.origin, &view);
    for (int i = 0; i < 3; i++)
        point[i] = (float)(at[i] - scene->scene.origin[i]);
    const float depth = depth_of(&view, point);
    if (!(depth > 1e-12f))
        return cs_fail(
            error, CLSHEAR_BAD_ARGUMENT,
            "focus-point %g,%g,%g: lies behind the camera; choose a point in the picture", at[0],
            at[1], at[2]);
    return set_one(settings, CLSHEAR_FOCAL_DISTANCE, depth, error);
}

static clshear_status choose_focus(const clshear_scene *scene, clshear_settings *settings,
                                   cs_error *error)
{
    cs_view view;
    float depth = INFINITY;
    if (cs_is_set(settings, FOCAL_DISTANCE)) return CLSHEAR_OK;
    if (cs_is_set(settings, FOCUS_PIXEL)) {
        const double *pixel = cs_numbers(settings, FOCUS_PIXEL);
        return cs_camera_focus(scene, settings, (int)pixel[0], (int)pixel[1], error);
    }
    if (cs_is_set(settings, FOCUS_POINT)) return focus_on_point(scene, settings, error);
    clshear_status status = depth_at(scene, settings, (int)cs_integer(settings, WIDTH) / 2,
                                     (int)cs_integer(settings, HEIGHT) / 2, &depth, error);
    if (status != CLSHEAR_OK) return status;
    cs_view_of(settings, scene->scene.origin, &view);
    if (!isfinite(depth)) depth = depth_of_centre(&scene->scene, &view);
    return set_one(settings, CLSHEAR_FOCAL_DISTANCE, depth, error);
}

static clshear_status choose_lens(const clshear_scene *scene, clshear_settings *settings,
                                  cs_error *error)
{
    cs_view view;
    if (cs_is_set(settings, LENS_RADIUS)) return CLSHEAR_OK;
    cs_view_of(settings, scene->scene.origin, &view);
    float radius =
        0.5f * blur_at_infinity * 2.0f * view.focal_distance * tangent_of_half_fov(&view);
    if (cs_is_set(settings, F_STOP)) {
        const float focal_length_m = half_sensor_m / tangent_of_half_fov(&view);
        radius = focal_length_m / (2.0f * (float)cs_number(settings, F_STOP)) /
                 (float)cs_number(settings, UNIT);
    }
    if (cs_is_set(settings, BLUR)) { /* at infinity the blur is lens width / pixel width */
        const double width = cs_number(settings, WIDTH), height = cs_number(settings, HEIGHT);
        const double shorter_px = width < height ? width : height;
        radius = (float)(cs_number(settings, BLUR) / shorter_px) * view.focal_distance *
                 tangent_of_half_fov(&view);
    }
    return set_one(settings, CLSHEAR_LENS_RADIUS, radius, error);
}

clshear_status cs_camera_complete(const clshear_scene *scene, clshear_settings *settings,
                                  cs_error *error)
{
    clshear_status status = cs_camera_pose(scene, settings, error);
    if (status == CLSHEAR_OK) status = choose_focus(scene, settings, error);
    return status == CLSHEAR_OK ? choose_lens(scene, settings, error) : status;
}
