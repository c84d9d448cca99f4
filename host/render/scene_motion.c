#include "render/scene_motion.h"

#include <math.h>
#include <string.h>
#include <strings.h>

#include "clshear/device/constants.h"
#include "render/camera_choice.h"

int cs_shutter_times(const clshear_settings *settings, double times_s[2])
{
    times_s[0] = times_s[1] = 0.0;
    if (settings == NULL || (!cs_is_set(settings, SHUTTER) && !cs_is_set(settings, FRAME)))
        return 0;
    const double fps = cs_number(settings, FPS);
    const double start_s = cs_is_set(settings, FRAME) ? cs_number(settings, FRAME) / fps : 0.0;
    times_s[0] = start_s;
    times_s[1] = start_s + cs_number(settings, SHUTTER_ANGLE) / 360.0 / fps;
    for (int i = 0; i < 2 && cs_is_set(settings, SHUTTER); i++)
        times_s[i] = start_s + cs_numbers(settings, SHUTTER)[i];
    return 1;
}

/* Where a camera is at the end, from its view in a scene whose origin is moved by `shift`. */
static void join_camera(cs_scene_camera *camera, const cs_view *closing, const double *shift)
{
    for (int axis = 0; axis < 3; axis++) {
        camera->eye_to[axis] = (float)((double)closing->eye[axis] + shift[axis]);
        camera->target_to[axis] = (float)((double)closing->target[axis] + shift[axis]);
        camera->moves |= camera->eye_to[axis] != camera->view.eye[axis] ||
                         camera->target_to[axis] != camera->view.target[axis];
    }
}

/* Takes the places of another scene with the same vertices over as those of the shutter's end. */
static clshear_status join(cs_scene *scene, const cs_scene *closing, const char *path,
                           cs_error *error)
{
    if (closing->positions.count != scene->positions.count ||
        closing->indices.count + closing->degenerate != scene->indices.count + scene->degenerate)
        return cs_fail(error, CLSHEAR_BAD_FILE,
                       "%s: has %zu vertices and %zu triangles, not %zu and %zu as the scene; "
                       "export the same mesh for both",
                       path, closing->positions.count, closing->indices.count + closing->degenerate,
                       scene->positions.count, scene->indices.count + scene->degenerate);
    if (!cs_scene_start_moving(scene))
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    const float(*places)[3] = closing->positions.items;
    const cs_vertex *vertices = closing->vertices.items;
    float(*to)[3] = scene->positions_to.items, (*normals)[3] = scene->normals_to.items;
    double shift[3];
    for (int axis = 0; axis < 3; axis++)
        shift[axis] = closing->origin[axis] - scene->origin[axis];
    for (size_t i = 0; i < scene->positions.count; i++) {
        for (int axis = 0; axis < 3; axis++)
            to[i][axis] = (float)((double)places[i][axis] + shift[axis]);
        memcpy(normals[i], vertices[i].normal, sizeof normals[i]);
    }
    const size_t count = scene->cameras.count < closing->cameras.count ? scene->cameras.count
                                                                       : closing->cameras.count;
    for (size_t i = 0; i < count; i++)
        join_camera((cs_scene_camera *)scene->cameras.items + i,
                    &((const cs_scene_camera *)closing->cameras.items)[i].view, shift);
    return CLSHEAR_OK;
}

/* Forgets a motion that moves nothing. */
static void drop_rest(cs_scene *scene)
{
    const cs_vertex *vertices = scene->vertices.items;
    const float(*open)[3] = scene->positions.items, (*closed)[3] = scene->positions_to.items;
    const float(*normals)[3] = scene->normals_to.items;
    for (size_t i = 0; i < scene->positions_to.count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (open[i][axis] != closed[i][axis] || vertices[i].normal[axis] != normals[i][axis])
                return;
    scene->positions_to.count = scene->normals_to.count = 0;
}

/* Turns about the vertical, +Z or else +Y, through the middle of the bounds, against the clock from
 * above. */
static clshear_status turn(cs_scene *scene, double degrees, int z_up, cs_error *error)
{
    const int across = z_up ? 0 : 2, along = z_up ? 1 : 0;
    const double angle = degrees * (double)CS_PI / 180.0, c = cos(angle), s = sin(angle);
    double middle[3];
    if (!cs_scene_start_moving(scene))
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (int axis = 0; axis < 3; axis++)
        middle[axis] = 0.5 * ((double)scene->bounds[0][axis] + (double)scene->bounds[1][axis]);
    float(*places)[3] = scene->positions_to.items, (*normals)[3] = scene->normals_to.items;
    for (size_t i = 0; i < scene->positions_to.count; i++) {
        const double x = (double)places[i][across] - middle[across];
        const double y = (double)places[i][along] - middle[along];
        const double n = (double)normals[i][across], m = (double)normals[i][along];
        places[i][across] = (float)(middle[across] + c * x - s * y);
        places[i][along] = (float)(middle[along] + s * x + c * y);
        normals[i][across] = (float)(c * n - s * m);
        normals[i][along] = (float)(s * n + c * m);
    }
    return CLSHEAR_OK;
}

static int anything_moves(const cs_scene *scene)
{
    const cs_scene_camera *cameras = scene->cameras.items;
    int moves = cs_scene_moves(scene);
    for (size_t i = 0; i < scene->cameras.count; i++)
        moves |= cameras[i].moves;
    return moves;
}

static int is_animated_format(const char *path)
{
    const char *dot = strrchr(path, '.');
    return dot != NULL && (strcasecmp(dot, ".gltf") == 0 || strcasecmp(dot, ".glb") == 0);
}

clshear_status cs_scene_read_motion(clshear_scene *scene, const char *path,
                                    const cs_import_options *options,
                                    const clshear_settings *settings, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_import_options at_end = *options;
    const cs_log silent = {0};
    double times_s[2];
    cs_scene closing;
    cs_scene_init(&closing);
    at_end.is_played = cs_shutter_times(settings, times_s);
    at_end.time_s = times_s[1];
    const char *file = NULL;
    if (settings != NULL && cs_is_set(settings, TO)) file = cs_text(settings, TO);
    if (file == NULL && times_s[1] != times_s[0] && is_animated_format(path)) file = path;
    if (file != NULL) {
        CS_TRY(cs_scene_import(file, &at_end, &closing, &silent, error));
        CS_TRY(join(&scene->scene, &closing, file, error));
    }
    if (settings != NULL && cs_is_set(settings, TURNTABLE) && cs_number(settings, TURNTABLE) != 0.0)
        CS_TRY(turn(&scene->scene, cs_number(settings, TURNTABLE),
                    cs_z_is_up(&scene->scene, settings), error));
    drop_rest(&scene->scene);
    if (at_end.is_played && !anything_moves(&scene->scene))
        cs_warn(&scene->context->log, "%s: nothing in it moves from %g to %g s", path, times_s[0],
                times_s[1]);
done:
    cs_scene_free(&closing);
    return status;
}
