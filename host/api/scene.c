/* Public functions of scenes and cameras. */
#include "api/arguments.h"
#include "render/camera_choice.h"
#include "render/focus_choice.h"
#include "render/objects.h"
#include "render/studio.h"
#include "settings/settings.h"

clshear_status clshear_scene_load(clshear_context *context, const char *path,
                                  const clshear_settings *settings, clshear_scene **result)
{
    CS_PLAIN_FLOATS;
    clshear_status status = CLSHEAR_OK;
    cs_error *error = cs_thread_error();
    clshear_scene *scene = NULL;
    CS_NEEDS(context);
    CS_NEEDS_NAME(path);
    CS_NEEDS(result);
    CS_TRY(cs_scene_new(context, &scene, error));
    CS_TRY(cs_scene_read(scene, path, settings, error));
    CS_TRY(cs_scene_complete(scene, error));
    *result = scene;
    scene = NULL;
done:
    cs_scene_destroy(scene);
    return cs_message_keep(&context->message, status);
}

clshear_status clshear_scene_create(clshear_context *context, clshear_scene **scene)
{
    CS_NEEDS(context);
    CS_NEEDS(scene);
    return cs_message_keep(&context->message, cs_scene_new(context, scene, cs_thread_error()));
}

clshear_status clshear_scene_add_mesh(clshear_scene *scene, const clshear_mesh *mesh)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_TAKE(clshear_mesh, copy, mesh);
    return cs_message_keep(&scene->message, cs_scene_append(scene, &copy, cs_thread_error()));
}

void clshear_material_init(clshear_material *material)
{
    clshear_material defaults;
    cs_standard_defaults(&defaults);
    cs_struct_out(material, &defaults, sizeof defaults);
}

clshear_status clshear_scene_add_material(clshear_scene *scene, const clshear_material *material,
                                          uint32_t *number)
{
    CS_PLAIN_FLOATS;
    clshear_status status = CLSHEAR_OK;
    CS_NEEDS(scene);
    CS_NEEDS(number);
    CS_TAKE(clshear_material, copy, material);
    if (scene->is_complete)
        status = cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,
                         "material: the scene is complete already");
    if (status == CLSHEAR_OK)
        status = cs_scene_add_standard(&scene->scene, &copy, number, cs_thread_error());
    return cs_message_keep(&scene->message, status);
}

clshear_status clshear_scene_complete(clshear_scene *scene)
{
    CS_PLAIN_FLOATS;
    cs_error *error = cs_thread_error();
    CS_NEEDS(scene);
    clshear_status status = CLSHEAR_OK;
    CS_REQUIRE(!scene->is_complete, CLSHEAR_BAD_ARGUMENT, "the scene is complete already");
    CS_TRY(cs_scene_finish(&scene->scene, "scene", error));
    CS_TRY(cs_scene_complete(scene, error));
done:
    if (status == CLSHEAR_BAD_FILE) status = CLSHEAR_BAD_ARGUMENT; /* no file is involved */
    return cs_message_keep(&scene->message, status);
}

clshear_status clshear_scene_add_light(clshear_scene *scene, const clshear_light *light)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_TAKE(clshear_light, copy, light);
    return cs_message_keep(&scene->message, cs_scene_light(scene, &copy, cs_thread_error()));
}

void clshear_scene_describe(const clshear_scene *scene, clshear_scene_info *info)
{
    if (scene == NULL) return;
    clshear_scene_info described = scene->info;
    described.lights = scene->scene.lights.count;
    described.emitters = scene->device_scene.emitters;
    described.device_bytes += cs_wide_scene_bytes(scene->wide);
    for (int axis = 0; axis < 3; axis++) {
        const double origin = scene->scene.origin[axis];
        described.low[axis] = (double)scene->scene.bounds[0][axis] + origin;
        described.high[axis] = (double)scene->scene.bounds[1][axis] + origin;
    }
    cs_struct_out(info, &described, sizeof described);
}

const char *clshear_scene_camera(const clshear_scene *scene, size_t index)
{
    if (scene == NULL) return NULL;
    const cs_scene_camera *cameras = scene->scene.cameras.items;
    return index < scene->scene.cameras.count ? cameras[index].name : NULL;
}

const char *clshear_scene_message(const clshear_scene *scene)
{
    return scene != NULL ? cs_message_text(&scene->message) : "";
}

void clshear_scene_free(clshear_scene *scene)
{
    cs_scene_destroy(scene);
}

/* Fails unless the scene is complete. */
static clshear_status check_complete(const clshear_scene *scene)
{
    if (scene->is_complete) return CLSHEAR_OK;
    return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT,
                   "the scene is not complete: call clshear_scene_complete first");
}

clshear_status clshear_camera_complete(const clshear_scene *scene, clshear_settings *settings)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(settings);
    clshear_status status = check_complete(scene);
    if (status == CLSHEAR_OK) status = cs_camera_complete(scene, settings, cs_thread_error());
    return cs_message_keep(&scene->message, status);
}

clshear_status clshear_light_complete(const clshear_scene *scene, clshear_settings *settings)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(settings);
    cs_error *error = cs_thread_error();
    clshear_status status = check_complete(scene);
    if (status == CLSHEAR_OK) status = cs_camera_complete(scene, settings, error);
    if (status == CLSHEAR_OK) status = cs_studio_complete(scene, settings, error);
    return cs_message_keep(&scene->message, status);
}

clshear_status clshear_camera_focus(const clshear_scene *scene, clshear_settings *settings, int x,
                                    int y)
{
    CS_PLAIN_FLOATS;
    CS_NEEDS(scene);
    CS_NEEDS(settings);
    cs_error *error = cs_thread_error();
    clshear_status status = check_complete(scene);
    if (status == CLSHEAR_OK) status = cs_camera_pose(scene, settings, error);
    if (status == CLSHEAR_OK) status = cs_camera_focus(scene, settings, x, y, error);
    return cs_message_keep(&scene->message, status);
}
