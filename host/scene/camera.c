#include "scene/camera.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec.h"
#include "optics/optics.h"
#include "scene/framing.h"

static const float degrees = CS_PI / 180.0f;

/* Sets what the shorter image axis shows, for upright pictures the horizontal one, from what the
 * vertical axis shows. */
static void show_along_shorter(cs_view *view, float aspect)
{
    if (aspect >= 1.0f) return;
    view->fov_deg = 2.0f * atanf(tanf(0.5f * view->fov_deg * degrees) * aspect) / degrees;
    view->orthographic *= aspect;
}

int cs_camera_find(const cs_scene *scene, const char *name)
{
    const cs_scene_camera *cameras = scene->cameras.items;
    char *end;
    for (size_t i = 0; i < scene->cameras.count; i++)
        if (strncmp(cameras[i].name, name, CS_CAMERA_NAME - 1) == 0) return (int)i;
    const unsigned long number = strtoul(name, &end, 10);
    if (name[0] < '0' || name[0] > '9' || *end != '\0' || number >= scene->cameras.count) return -1;
    return (int)number;
}

cs_view cs_camera_of_scene(const cs_scene *scene, int number, int width, int height)
{
    if (number < 0) {
        const cs_framing framing = cs_framing_default(scene, scene->z_up);
        return cs_framing_view(scene, &framing, width, height);
    }
    cs_view camera = ((const cs_scene_camera *)scene->cameras.items)[number].view;
    camera.lens_radius = -1.0f;
    camera.focal_distance = 0.0f;
    camera.aperture = CLSHEAR_APERTURE_DISK;
    show_along_shorter(&camera, (float)width / (float)height);
    return camera;
}

static int normalise(float *v)
{
    float length = sqrtf(cs_vec_dot(v, v));
    if (!(length > 0.0f) || !isfinite(length)) return 0;
    for (int i = 0; i < 3; i++)
        v[i] /= length;
    return 1;
}

void cs_focal_slopes(const cs_view *view, float *slopes)
{
    slopes[0] = tanf(view->tilt_deg[0] * degrees);
    slopes[1] = -tanf(view->tilt_deg[1] * degrees) / cosf(view->tilt_deg[0] * degrees);
}

/* The lines of sight: position, directions, and what pixels measure. */
static clshear_status frame_sight(const cs_view *camera, int shorter, cs_camera *frame,
                                  cs_error *error)
{
    float up[3];
    memcpy(up, camera->up, sizeof up);
    for (int i = 0; i < 3; i++) {
        frame->eye[i] = camera->eye[i];
        frame->forward[i] = camera->target[i] - camera->eye[i];
        if (!(fabsf(camera->eye[i]) <= 1e12f && fabsf(camera->target[i]) <= 1e12f &&
              fabsf(up[i]) <= 1e12f))
            return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                           "camera: coordinates of eye, target and up must be -1e12 to 1e12");
    }
    if (!normalise(frame->forward))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "camera: eye and target are the same point");
    cs_vec_cross(frame->forward, up, frame->right);
    if (!normalise(up) || !normalise(frame->right))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "camera: up is parallel to the line of sight");
    cs_vec_cross(frame->forward, frame->right, frame->down);
    frame->focal_distance = camera->focal_distance > 0.0f ? camera->focal_distance : 1.0f;
    frame->orthographic = camera->orthographic > 0.0f;
    if (!frame->orthographic && !(camera->fov_deg > 0.0f && camera->fov_deg < 180.0f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "field of view %g degrees: must be above 0 and below 180",
                       (double)camera->fov_deg);
    frame->pixel_width = (frame->orthographic ? camera->orthographic
                                              : 2.0f * frame->focal_distance *
                                                    tanf(0.5f * camera->fov_deg * degrees)) /
                         (float)shorter;
    return CLSHEAR_OK;
}

/* Parallel lines of sight must meet the focal plane in front of the lenses, which need not be so
 * for spreading ones. */
static clshear_status check_rise(const cs_view *view, const cs_camera *frame, cs_error *error)
{
    const float reach =
        fabsf(frame->rise[0]) * frame->centre_px[0] + fabsf(frame->rise[1]) * frame->centre_px[1];
    if (!frame->orthographic || reach < 0.99f) return CLSHEAR_OK;
    return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                   "tilt %g,%g: at focal distance %g the focal plane meets the lens within the "
                   "picture; tilt it less or take the eye farther away",
                   (double)view->tilt_deg[0], (double)view->tilt_deg[1],
                   (double)frame->focal_distance);
}

clshear_status cs_camera_frame(const cs_view *camera, int width, int height, cs_camera *frame,
                               cs_error *error)
{
    *frame = (cs_camera){0};
    clshear_status status = frame_sight(camera, width < height ? width : height, frame, error);
    if (status != CLSHEAR_OK) return status;
    const float radius = camera->lens_radius > 0.0f ? camera->lens_radius : 0.0f;
    float slopes[2];
    frame->aperture_width = radius * cs_optics_unit(camera);
    frame->centre_px[0] = 0.5f * (float)width;
    frame->centre_px[1] = 0.5f * (float)height;
    cs_focal_slopes(camera, slopes);
    for (int k = 0; k < 2; k++)
        frame->rise[k] = slopes[k] * frame->pixel_width / frame->focal_distance;
    return check_rise(camera, frame, error);
}
