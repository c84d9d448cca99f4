#include "render/camera_choice.h"

#include <stdio.h>
#include <string.h>

#include "base/vec.h"
#include "render/focus_choice.h"
#include "render/interior.h"
#include "scene/camera.h"
#include "scene/framing.h"
#include "settings/view.h"

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
    char names[CS_CAMERA_LIST];
    cs_scene_list_cameras(&scene->scene, names);
    return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "camera %.60s: the scene has %zu: %s", name,
                   cameras->count, names);
}

int cs_z_is_up(const cs_scene *scene, const clshear_settings *settings)
{
    return cs_is_set(settings, Z_UP) ? cs_integer(settings, Z_UP) != 0 : scene->z_up;
}

/* The camera that frames the scene. The settings may turn it, and say what is up. */
static cs_view frame_scene(const cs_scene *scene, const clshear_settings *settings)
{
    cs_framing framing = cs_framing_default(scene, cs_z_is_up(scene, settings));
    if (cs_is_set(settings, FOV)) framing.fov_deg = (float)cs_number(settings, FOV);
    framing.orthographic = cs_is_set(settings, ORTHOGRAPHIC);
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
                          cs_is_set(settings, TARGET) || cs_is_set(settings, UP) ||
                          cs_is_set(settings, ORTHOGRAPHIC);
    clshear_status status = CLSHEAR_OK;
    if (!is_placed)
        status =
            cs_interior_view(scene, cs_z_is_up(&scene->scene, settings), &is_room, view, error);
    if (status != CLSHEAR_OK) return status;
    if (is_room)
        cs_warn(
            &scene->context->log,
            "the scene is taken for a room and seen from inside; "
            "--orbit 35,20 shows it from outside, --z-up sets it upright if it lies on its side");
    else
        *view = frame_scene(&scene->scene, settings);
    if (!is_room && !is_placed && !cs_is_set(settings, Z_UP) && scene->scene.up_is_open &&
        cs_framing_stands_on_z(&scene->scene))
        cs_warn(&scene->context->log,
                "the scene stands on z = 0; if it lies on its side, --z-up sets it upright");
    return CLSHEAR_OK;
}

/* Sets how much the camera shows, unless the settings do: what the file's camera does, and of
 * parallel lines of sight as much as the scene needs where none or 0 is asked for. */
static clshear_status choose_extent(const clshear_scene *scene, clshear_settings *settings,
                                    const cs_view *chosen, cs_error *error)
{
    cs_view view;
    if (!cs_is_set(settings, ORTHOGRAPHIC) && chosen->orthographic <= 0.0f)
        return cs_is_set(settings, FOV)
                   ? CLSHEAR_OK
                   : cs_settings_set_number(settings, CLSHEAR_FOV, (double)chosen->fov_deg, error);
    if (cs_is_set(settings, FOV) || cs_number(settings, ORTHOGRAPHIC) > 0.0) return CLSHEAR_OK;
    float width = chosen->orthographic;
    if (width <= 0.0f) {
        cs_view_of(settings, scene->scene.origin, &view);
        width = cs_framing_width(&scene->scene, &view, (int)cs_integer(settings, WIDTH),
                                 (int)cs_integer(settings, HEIGHT));
    }
    return cs_settings_set_number(settings, CLSHEAR_ORTHOGRAPHIC, (double)width, error);
}

/* Where a camera of the file is when the shutter closes, unless the settings place the camera. */
static clshear_status follow_camera(const cs_scene_camera *camera, const double *origin,
                                    clshear_settings *settings, cs_error *error)
{
    double numbers[6];
    if (!camera->moves || cs_is_set(settings, EYE) || cs_is_set(settings, TARGET) ||
        cs_is_set(settings, CAMERA_TO))
        return CLSHEAR_OK;
    for (int axis = 0; axis < 3; axis++) {
        numbers[axis] = (double)camera->eye_to[axis] + origin[axis];
        numbers[3 + axis] = (double)camera->target_to[axis] + origin[axis];
    }
    return cs_settings_set(settings, CLSHEAR_CAMERA_TO, numbers, 6, error);
}

/* What is up in the picture of a camera that the settings place, as far as they do not say it: what
 * the scene holds for up. The up of the view that it replaces would tilt it. */
static void set_upright(const clshear_scene *scene, const clshear_settings *settings, float *up)
{
    float line[3];
    for (int axis = 0; axis < 3; axis++)
        line[axis] = (float)(cs_numbers(settings, TARGET)[axis] - cs_numbers(settings, EYE)[axis]);
    cs_framing_upright(cs_z_is_up(&scene->scene, settings), line, up);
}

/* Moves the target of a camera of the file along its line of sight beside the middle of the scene,
 * where that is in front of it: a camera that stands elsewhere and looks there sees the scene. The
 * file has a direction alone. */
static void move_target_to_scene(const cs_scene *scene, cs_view *view)
{
    float line[3], to_middle[3];
    for (int axis = 0; axis < 3; axis++) {
        line[axis] = view->target[axis] - view->eye[axis];
        to_middle[axis] =
            0.5f * (scene->bounds[0][axis] + scene->bounds[1][axis]) - view->eye[axis];
    }
    const float steps = cs_vec_dot(to_middle, line) / cs_vec_dot(line, line);
    for (int axis = 0; axis < 3 && steps > 0.0f; axis++)
        view->target[axis] = view->eye[axis] + steps * line[axis];
}

clshear_status cs_camera_pose(const clshear_scene *scene, clshear_settings *settings,
                              cs_error *error)
{
    const double *origin = scene->scene.origin;
    clshear_status status = CLSHEAR_OK;
    int number = -1;
    cs_view view;
    const int is_placed = cs_is_set(settings, EYE) || cs_is_set(settings, TARGET);
    CS_TRY(choose_camera(scene, settings, &number, error));
    if (number < 0)
        CS_TRY(default_view(scene, settings, &view, error));
    else
        view = cs_camera_of_scene(&scene->scene, number, (int)cs_integer(settings, WIDTH),
                                  (int)cs_integer(settings, HEIGHT));
    if (number >= 0)
        CS_TRY(follow_camera((const cs_scene_camera *)scene->scene.cameras.items + number, origin,
                             settings, error));
    if (number >= 0 && cs_is_set(settings, EYE)) move_target_to_scene(&scene->scene, &view);
    if (!cs_is_set(settings, EYE))
        CS_TRY(set_vector(settings, CLSHEAR_EYE, view.eye, origin, error));
    if (!cs_is_set(settings, TARGET))
        CS_TRY(set_vector(settings, CLSHEAR_TARGET, view.target, origin, error));
    if (is_placed) set_upright(scene, settings, view.up);
    if (!cs_is_set(settings, UP))
        CS_TRY(set_vector(settings, CLSHEAR_UP, view.up, (const double[3]){0.0}, error));
    CS_TRY(choose_extent(scene, settings, &view, error));
done:
    return status;
}

clshear_status cs_camera_complete(const clshear_scene *scene, clshear_settings *settings,
                                  cs_error *error)
{
    clshear_status status = cs_camera_pose(scene, settings, error);
    float depth = 0.0f;
    if (status == CLSHEAR_OK) status = cs_choose_focus(scene, settings, &depth, error);
    return status == CLSHEAR_OK ? cs_choose_lens(scene, settings, depth, error) : status;
}
