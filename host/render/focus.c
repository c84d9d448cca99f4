/* Public camera functions: where to stand, what to focus on, how wide to open. */
#include <math.h>

#include "base/vec.h"
#include "render/handles.h"
#include "scene/camera.h"

static const float blur_at_infinity = 0.03f; /* of the shorter image axis, for a lens not chosen */
static const float half_sensor_m = 0.012f;   /* half the short side of a full-frame sensor */

static float tangent_of_half_fov(const clshear_camera *camera)
{
    return tanf(0.5f * camera->fov_deg * (CS_PI / 180.0f));
}

static clshear_status check_size(int width, int height, cs_error *error)
{
    if (width < 1 || height < 1 || width > 65536 || height > 65536)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "image size %d x %d: each side must be 1 to 65536", width, height);
    return CLSHEAR_OK;
}

clshear_status clshear_scene_camera(const clshear_scene *scene, int width, int height,
                                    clshear_camera *camera)
{
    clshear_status status = check_size(width, height, &scene->context->error);
    if (status == CLSHEAR_OK) *camera = cs_camera_of_scene(&scene->scene, width, height);
    return status;
}

/* Depth that pixel (x, y) sees, infinite if it sees nothing. */
static clshear_status depth_at(const clshear_scene *scene, int width, int height, int x, int y,
                               const clshear_camera *camera, float *depth)
{
    cs_error *error = &scene->context->error;
    cs_camera frame;
    const int window[4] = {x, x + 1, y, y + 1};
    clshear_status status = check_size(width, height, error);
    if (status != CLSHEAR_OK) return status;
    if (x < 0 || y < 0 || x >= width || y >= height)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "pixel %d,%d is outside the %d x %d image", x,
                       y, width, height);
    status = cs_camera_frame(camera, width, height, &frame, error);
    cs_depth found;
    if (status == CLSHEAR_OK)
        status = cs_accel_depth(scene->accel, &frame, NULL, window, 0, &found, error);
    if (status == CLSHEAR_OK) *depth = found.centre;
    return status;
}

clshear_status clshear_camera_focus(const clshear_scene *scene, int width, int height, int x, int y,
                                    clshear_camera *camera)
{
    float depth = INFINITY;
    clshear_status status = depth_at(scene, width, height, x, y, camera, &depth);
    if (status != CLSHEAR_OK) return status;
    if (!isfinite(depth))
        return cs_fail(&scene->context->error, CLSHEAR_BAD_ARGUMENT,
                       "pixel %d,%d sees nothing to focus on; choose another or give a distance", x,
                       y);
    camera->focal_distance = depth;
    return CLSHEAR_OK;
}

/* Depth of the bounding box's centre; 1 if it lies behind the camera. */
static float depth_of_centre(const cs_scene *scene, const clshear_camera *camera)
{
    float towards[3], centre[3];
    cs_vec_subtract(camera->target, camera->eye, towards);
    for (int i = 0; i < 3; i++)
        centre[i] = 0.5f * (scene->bounds[0][i] + scene->bounds[1][i]) - camera->eye[i];
    const float along = cs_vec_dot(towards, centre);
    return along > 0.0f ? along / sqrtf(cs_vec_dot(towards, towards)) : 1.0f;
}

clshear_status clshear_camera_complete(const clshear_scene *scene, int width, int height,
                                       clshear_camera *camera)
{
    if (!(camera->focal_distance > 0.0f)) {
        float depth = INFINITY;
        clshear_status status =
            depth_at(scene, width, height, width / 2, height / 2, camera, &depth);
        if (status != CLSHEAR_OK) return status;
        camera->focal_distance = isfinite(depth) ? depth : depth_of_centre(&scene->scene, camera);
    }
    if (!(camera->lens_radius >= 0.0f))
        camera->lens_radius =
            0.5f * blur_at_infinity * 2.0f * camera->focal_distance * tangent_of_half_fov(camera);
    return CLSHEAR_OK;
}

float clshear_lens_radius(const clshear_camera *camera, float f_stop, float unit_m)
{
    float focal_length_m = half_sensor_m / tangent_of_half_fov(camera);
    return focal_length_m / (2.0f * f_stop) / unit_m;
}
