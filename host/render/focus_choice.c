#include "render/focus_choice.h"

#include <math.h>

#include "base/vec.h"
#include "clshear/device/lens.h"
#include "scene/camera.h"
#include "settings/view.h"

static const float blur_at_infinity = 0.03f; /* of the shorter image axis, for a lens not chosen */
static const float sensor_m = 0.024f;        /* short side of a full-frame sensor */

/* Sets the focal distance so that the focal plane goes through a point: distances from the optical
 * axis to the right and down, and depth. */
static clshear_status focus_through(clshear_settings *settings, const float *point, cs_error *error)
{
    cs_view view;
    float slopes[2];
    cs_view_of(settings, NULL, &view);
    cs_focal_slopes(&view, slopes);
    const float distance = point[2] - slopes[0] * point[0] - slopes[1] * point[1];
    if (!(distance > 1e-12f))
        return cs_fail(
            error, CLSHEAR_BAD_ARGUMENT,
            "tilt %g,%g: a plane through what is in focus passes behind the eye; tilt it "
            "less or focus elsewhere",
            (double)view.tilt_deg[0], (double)view.tilt_deg[1]);
    return cs_settings_set_number(settings, CLSHEAR_FOCAL_DISTANCE, (double)distance, error);
}

/* The pinhole camera of the settings, whose focal plane does not matter. */
static clshear_status frame_pinhole(const clshear_scene *scene, const clshear_settings *settings,
                                    cs_camera *camera, cs_error *error)
{
    cs_view view;
    cs_view_of(settings, scene->scene.origin, &view);
    view.lens_radius = 0.0f;
    view.tilt_deg[0] = view.tilt_deg[1] = 0.0f;
    return cs_camera_frame(&view, (int)cs_integer(settings, WIDTH),
                           (int)cs_integer(settings, HEIGHT), camera, error);
}

/* What pixel (x, y) sees, as for focus_through; its depth is infinite if it sees nothing. */
static clshear_status point_at(const clshear_scene *scene, const clshear_settings *settings, int x,
                               int y, float *point, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const int window[4] = {x, x + 1, y, y + 1};
    cs_camera camera;
    cs_depth found;
    CS_TRY(frame_pinhole(scene, settings, &camera, error));
    CS_TRY(cs_accel_depth(scene->accel, NULL, &camera, NULL, window, 0, &found, error));
    const float spread = camera.orthographic ? 1.0f : found.centre / camera.focal_distance;
    point[0] = ((float)x + 0.5f - camera.centre_px[0]) * camera.pixel_width * spread;
    point[1] = ((float)y + 0.5f - camera.centre_px[1]) * camera.pixel_width * spread;
    point[2] = found.centre;
done:
    return status;
}

/* The same, of a pixel that must be there and see something. `name` is what the caller calls it. */
static clshear_status seen_point(const clshear_scene *scene, const clshear_settings *settings,
                                 const char *name, int x, int y, float *point, cs_error *error)
{
    const int width = (int)cs_integer(settings, WIDTH), height = (int)cs_integer(settings, HEIGHT);
    if (x < 0 || y < 0 || x >= width || y >= height)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%s %d,%d is outside the %d x %d image: give X 0 to %d and Y 0 to %d", name,
                       x, y, width, height, width - 1, height - 1);
    const clshear_status status = point_at(scene, settings, x, y, point, error);
    if (status == CLSHEAR_OK && !isfinite(point[2]))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "%s %d,%d sees nothing to focus on; choose another or give a distance", name,
                       x, y);
    return status;
}

clshear_status cs_camera_focus(const clshear_scene *scene, clshear_settings *settings, int x, int y,
                               cs_error *error)
{
    float point[3] = {0.0f, 0.0f, 0.0f};
    const clshear_status status = seen_point(scene, settings, "pixel", x, y, point, error);
    return status == CLSHEAR_OK ? focus_through(settings, point, error) : status;
}

/* A point relative to the scene's origin in coordinates of the camera: right, down, depth. */
static clshear_status see_point(const clshear_scene *scene, const clshear_settings *settings,
                                const float *at, float *point, cs_error *error)
{
    cs_view view;
    cs_camera camera;
    float towards[3], offset[3];
    const clshear_status status = frame_pinhole(scene, settings, &camera, error);
    if (status != CLSHEAR_OK) return status;
    cs_view_of(settings, scene->scene.origin, &view);
    cs_vec_subtract(view.target, view.eye, towards);
    cs_vec_subtract(at, view.eye, offset);
    point[0] = cs_vec_dot(offset, camera.right);
    point[1] = cs_vec_dot(offset, camera.down);
    point[2] = cs_vec_dot(towards, offset) / sqrtf(cs_vec_dot(towards, towards));
    return CLSHEAR_OK;
}

static clshear_status named_point(const clshear_scene *scene, const clshear_settings *settings,
                                  float *point, cs_error *error)
{
    const double *given = cs_numbers(settings, FOCUS_POINT);
    float near[3];
    for (int i = 0; i < 3; i++)
        near[i] = (float)(given[i] - scene->scene.origin[i]);
    const clshear_status status = see_point(scene, settings, near, point, error);
    if (status == CLSHEAR_OK && !(point[2] > 1e-12f))
        return cs_fail(
            error, CLSHEAR_BAD_ARGUMENT,
            "focus-point %g,%g,%g: lies behind the camera; choose a point in the picture", given[0],
            given[1], given[2]);
    return status;
}

/* What the middle pixel sees; if nothing, the point on the optical axis that is as deep as the
 * bounding box's centre, or 1 deep if that lies behind the camera. */
static clshear_status middle_point(const clshear_scene *scene, const clshear_settings *settings,
                                   float *point, cs_error *error)
{
    float centre[3];
    clshear_status status = point_at(scene, settings, (int)cs_integer(settings, WIDTH) / 2,
                                     (int)cs_integer(settings, HEIGHT) / 2, point, error);
    if (status != CLSHEAR_OK || isfinite(point[2])) return status;
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5f * (scene->scene.bounds[0][i] + scene->scene.bounds[1][i]);
    status = see_point(scene, settings, centre, point, error);
    point[0] = point[1] = 0.0f;
    if (status == CLSHEAR_OK && !(point[2] > 0.0f)) point[2] = 1.0f;
    return status;
}

clshear_status cs_choose_focus(const clshear_scene *scene, clshear_settings *settings, float *depth,
                               cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    float point[3] = {0.0f, 0.0f, 0.0f};
    *depth = (float)cs_number(settings, FOCAL_DISTANCE);
    if (cs_is_set(settings, FOCAL_DISTANCE)) return CLSHEAR_OK;
    const double *pixel = cs_numbers(settings, FOCUS_PIXEL);
    if (cs_is_set(settings, FOCUS_PIXEL))
        status =
            seen_point(scene, settings, "focus-pixel", (int)pixel[0], (int)pixel[1], point, error);
    else if (cs_is_set(settings, FOCUS_POINT))
        status = named_point(scene, settings, point, error);
    else
        status = middle_point(scene, settings, point, error);
    if (status != CLSHEAR_OK) return status;
    *depth = point[2];
    return focus_through(settings, point, error);
}

/* Lens radius for a blur of `part` of the shorter image axis, while something at this depth is in
 * focus: in perspective of a point at infinity, as if the focal plane were not tilted; of parallel
 * lines of sight, for which blur has no limit, of the corner of the bounding box that is blurred
 * most. */
static clshear_status radius_of_blur(const clshear_scene *scene, const clshear_settings *settings,
                                     float part, float depth, float *radius, cs_error *error)
{
    cs_view view;
    float slopes[2], most = 0.0f;
    cs_view_of(settings, scene->scene.origin, &view);
    *radius = part * depth * tanf(0.5f * view.fov_deg * (CS_PI / 180.0f));
    if (view.orthographic <= 0.0f) return CLSHEAR_OK;
    cs_focal_slopes(&view, slopes);
    for (int corner = 0; corner < 8; corner++) {
        float at[3], point[3];
        for (int i = 0; i < 3; i++)
            at[i] = scene->scene.bounds[corner >> i & 1][i];
        const clshear_status status = see_point(scene, settings, at, point, error);
        if (status != CLSHEAR_OK) return status;
        const float focus = view.focal_distance + slopes[0] * point[0] + slopes[1] * point[1];
        most = fmaxf(most, fabsf(1.0f - point[2] / focus));
    }
    *radius = part * 0.5f * view.orthographic / fmaxf(most, 1e-6f);
    return CLSHEAR_OK;
}

/* Lens radius of a full-frame camera with an f-number. In perspective, the focal length follows
 * from the field of view. With parallel lines of sight the cone of light at the sensor is 1 /
 * f-number wide, and at the object as much narrower as the picture is smaller than the object. */
static float radius_of_f_stop(const cs_view *view, double f_stop, double unit_m)
{
    const float tangent = tanf(0.5f * view->fov_deg * (CS_PI / 180.0f));
    if (view->orthographic > 0.0f)
        return view->focal_distance * sensor_m /
               (2.0f * (float)f_stop * view->orthographic * (float)unit_m);
    return 0.5f * sensor_m / tangent / (2.0f * (float)f_stop) / (float)unit_m;
}

clshear_status cs_choose_lens(const clshear_scene *scene, clshear_settings *settings, float depth,
                              cs_error *error)
{
    cs_view view;
    float radius, part = blur_at_infinity;
    if (cs_is_set(settings, LENS_RADIUS)) return CLSHEAR_OK;
    cs_view_of(settings, scene->scene.origin, &view);
    if (cs_is_set(settings, F_STOP)) {
        radius = radius_of_f_stop(&view, cs_number(settings, F_STOP), cs_number(settings, UNIT));
        return cs_settings_set_number(settings, CLSHEAR_LENS_RADIUS, (double)radius, error);
    }
    if (cs_is_set(settings, BLUR)) {
        const double width = cs_number(settings, WIDTH), height = cs_number(settings, HEIGHT);
        part = (float)(cs_number(settings, BLUR) / (width < height ? width : height));
    }
    const clshear_status status = radius_of_blur(scene, settings, part, depth, &radius, error);
    return status == CLSHEAR_OK
               ? cs_settings_set_number(settings, CLSHEAR_LENS_RADIUS, (double)radius, error)
               : status;
}
