#include "scene/camera.h"

#include <assimp/camera.h>
#include <assimp/cimport.h>
#include <math.h>
#include <string.h>

#include "base/vec.h"
#include "optics/optics.h"
#include "scene/node.h"

static const float default_fov_deg = 40.0f;
static const float degrees = CS_PI / 180.0f;

static int is_gltf(const struct aiScene *file)
{
    const struct aiMetadata *data = file->mMetaData;
    for (unsigned i = 0; data != NULL && i < data->mNumProperties; i++)
        if (strcmp(data->mKeys[i].data, "SourceAsset_Format") == 0)
            return strstr(((const struct aiString *)data->mValues[i].mData)->data, "glTF") != NULL;
    return 0;
}

/* Vertical field of view, radians. Assimp 5.2 multiplies glTF's vertical angle by the aspect ratio
 * and calls that the horizontal one. */
static float vertical_fov(const struct aiCamera *source, int gltf)
{
    float aspect = source->mAspect > 0.0f ? source->mAspect : 1.0f;
    if (gltf) return source->mHorizontalFOV / aspect;
    return 2.0f * atanf(tanf(0.5f * source->mHorizontalFOV) / aspect);
}

int cs_camera_import(cs_scene *scene, const struct aiScene *file)
{
    const struct aiCamera *source = file->mCameras[0];
    cs_view *camera = &scene->camera;
    const struct aiMatrix4x4 matrix = cs_node_matrix(file, source->mName.data);
    struct aiVector3D eye = source->mPosition, target = source->mLookAt, up = source->mUp, origin;
    /* A glTF camera is at the origin of its node; Assimp 5.2 repeats the node's translation here.
     */
    if (is_gltf(file)) eye = (struct aiVector3D){0, 0, 0};
    aiVector3Add(&target, &eye);
    aiVector3Add(&up, &eye);
    aiTransformVecByMatrix4(&eye, &matrix);
    aiTransformVecByMatrix4(&target, &matrix);
    aiTransformVecByMatrix4(&up, &matrix);
    origin = eye;
    aiVector3Subtract(&up, &origin);
    memcpy(camera->eye, &eye.x, sizeof camera->eye);
    memcpy(camera->target, &target.x, sizeof camera->target);
    memcpy(camera->up, &up.x, sizeof camera->up);
    camera->fov_deg = vertical_fov(source, is_gltf(file)) / degrees;
    scene->has_camera = camera->fov_deg > 0.0f && camera->fov_deg < 180.0f;
    return scene->has_camera;
}

/* The angle along the shorter axis: for upright pictures the horizontal one. */
static float shorter_fov_deg(float vertical_deg, float aspect)
{
    if (aspect >= 1.0f) return vertical_deg;
    return 2.0f * atanf(tanf(0.5f * vertical_deg * degrees) * aspect) / degrees;
}

cs_view cs_camera_of_scene(const cs_scene *scene, int width, int height)
{
    cs_view camera = scene->camera;
    const float aspect = (float)width / (float)height;
    camera.lens_radius = -1.0f;
    camera.focal_distance = 0.0f;
    camera.aperture = CLSHEAR_APERTURE_DISK;
    if (scene->has_camera) {
        camera.fov_deg = shorter_fov_deg(camera.fov_deg, aspect);
        return camera;
    }
    float half[3];
    for (int axis = 0; axis < 3; axis++) {
        float low = scene->bounds[0][axis], high = scene->bounds[1][axis];
        half[axis] = 0.5f * (high - low);
        camera.target[axis] = 0.5f * (low + high);
        camera.eye[axis] = camera.target[axis];
        camera.up[axis] = axis == 1 ? 1.0f : 0.0f;
    }
    /* The front face of the box fills the picture but for a margin. */
    float tangent = tanf(0.5f * default_fov_deg * degrees);
    float wide = aspect > 1.0f ? aspect : 1.0f, tall = aspect < 1.0f ? 1.0f / aspect : 1.0f;
    float reach = fmaxf(half[0] / wide, half[1] / tall) / tangent * 1.05f;
    camera.fov_deg = default_fov_deg;
    camera.eye[2] += half[2] + fmaxf(reach, 1e-3f * half[2]);
    /* A floor seen from its own height is a line. */
    if (half[1] < 0.1f * fmaxf(half[0], half[2]))
        camera.eye[1] += 0.6f * (camera.eye[2] - camera.target[2]);
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
