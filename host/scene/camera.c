#include "scene/camera.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec.h"
#include "optics/optics.h"
#include "scene/framing.h"

static const float degrees = CS_PI / 180.0f;

/* The angle along the shorter axis: for upright pictures the horizontal one. */
static float shorter_fov_deg(float vertical_deg, float aspect)
{
    if (aspect >= 1.0f) return vertical_deg;
    return 2.0f * atanf(tanf(0.5f * vertical_deg * degrees) * aspect) / degrees;
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
    camera.fov_deg = shorter_fov_deg(camera.fov_deg, (float)width / (float)height);
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

clshear_status cs_camera_frame(const cs_view *camera, int width, int height, cs_camera *frame,
                               cs_error *error)
{
    float up[3];
    *frame = (cs_camera){0};
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
    if (!(camera->fov_deg > 0.0f && camera->fov_deg < 180.0f))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "field of view %g degrees: must be above 0 and below 180",
                       (double)camera->fov_deg);
    const int shorter = width < height ? width : height;
    const float radius = camera->lens_radius > 0.0f ? camera->lens_radius : 0.0f;
    frame->focal_distance = camera->focal_distance > 0.0f ? camera->focal_distance : 1.0f;
    frame->pixel_width =
        2.0f * frame->focal_distance * tanf(0.5f * camera->fov_deg * degrees) / (float)shorter;
    frame->aperture_width = radius * cs_optics_unit(camera);
    frame->centre_px[0] = 0.5f * (float)width;
    frame->centre_px[1] = 0.5f * (float)height;
    return CLSHEAR_OK;
}
