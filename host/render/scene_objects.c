/* Scenes: read or given, with their hierarchy on the device. */
#if defined(__GLIBC__) || defined(__linux__)
#include <malloc.h>
#endif
#include <stdlib.h>
#include <string.h>

#include "context/self_test.h"
#include "import/import.h"
#include "render/objects.h"
#include "render/scene_motion.h"
#include "settings/settings.h"

clshear_status cs_scene_new(clshear_context *context, clshear_scene **result, cs_error *error)
{
    clshear_scene *scene = calloc(1, sizeof *scene);
    if (scene == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    scene->wide = cs_wide_scene_new();
    if (scene->wide == NULL) {
        free(scene);
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    }
    scene->context = cs_context_retain(context);
    cs_message_init(&scene->message);
    cs_scene_init(&scene->scene);
    *result = scene;
    return CLSHEAR_OK;
}

void cs_scene_destroy(clshear_scene *scene)
{
    if (scene == NULL) return;
    cs_device_scene_free(&scene->device_scene);
    cs_wide_scene_free(scene->wide);
    cs_accel_free(scene->accel);
    cs_scene_free(&scene->scene);
    cs_read_settings_free(&scene->read_settings);
    cs_message_destroy(&scene->message);
    cs_context_release(scene->context);
    free(scene);
}

clshear_status cs_scene_read(clshear_scene *scene, const char *path,
                             const clshear_settings *settings, cs_error *error)
{
    const double start_s = cs_now_s();
    cs_import_options options = {.smooth_degrees = -1.0};
    if (settings != NULL && cs_is_set(settings, SMOOTH))
        options.smooth_degrees = cs_number(settings, SMOOTH);
    double times_s[2];
    options.is_played = cs_shutter_times(settings, times_s);
    options.time_s = times_s[0];
    if (settings != NULL && times_s[1] < times_s[0])
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                       "shutter %g,%g: closes before it opens; give the earlier time first",
                       cs_numbers(settings, SHUTTER)[0], cs_numbers(settings, SHUTTER)[1]);
    clshear_status status =
        cs_scene_import(path, &options, &scene->scene, &scene->context->log, error);
    if (status == CLSHEAR_OK) status = cs_scene_read_motion(scene, path, &options, settings, error);
    if (status == CLSHEAR_OK)
        status = cs_read_settings_keep(&scene->read_settings, settings, error);
#ifdef __GLIBC__
    malloc_trim(0); /* importing takes several times what it leaves */
#endif
    scene->info.load_s = cs_now_s() - start_s;
    return status;
}

clshear_status cs_scene_append(clshear_scene *scene, const clshear_mesh *mesh, cs_error *error)
{
    cs_scene *into = &scene->scene;
    if (scene->is_complete)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "mesh: the scene is complete already");
    if (mesh->triangle_count > 0 && (mesh->positions == NULL || mesh->indices == NULL))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "mesh: positions or indices are NULL");
    if (!cs_is_colour(mesh->diffuse) || !cs_is_colour(mesh->emission))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "mesh: diffuse and emission must be 0 to 1e15");
    if (mesh->material > into->materials.count)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "mesh: there is no material %u",
                       mesh->material);
    const size_t materials = into->materials.count;
    uint32_t number = mesh->material;
    if (number == 0) {
        cs_material *material = cs_array_extend(&into->materials, 1);
        if (material == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
        material->texture = CS_NO_TEXTURE;
        memcpy(material->diffuse, mesh->diffuse, sizeof material->diffuse);
        memcpy(material->emission, mesh->emission, sizeof material->emission);
        number = (uint32_t)into->materials.count;
    }
    const clshear_status status = cs_scene_add_mesh(into, mesh, number - 1, "mesh", error);
    if (status != CLSHEAR_OK) into->materials.count = materials;
    return status == CLSHEAR_BAD_FILE ? CLSHEAR_BAD_ARGUMENT : status; /* there is no file */
}

clshear_status cs_scene_complete(clshear_scene *scene, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    clshear_context *context = scene->context;
    clshear_scene_info *info = &scene->info;
    cs_flat_bvh bvh = {0};
    CS_TRY(cs_self_test(context, error));
    const double compiled_s = cs_now_s();
    CS_TRY(cs_accel_create(&scene->scene, context->threads, &scene->accel, error));
    CS_TRY(cs_accel_build_bvh(scene->accel, &bvh, error));
    CS_TRY(cs_scene_upload_emitters(&scene->device_scene, context->device, &scene->scene, &bvh,
                                    error));
    CS_TRY(cs_scene_upload(&scene->device_scene, context->device, &scene->scene, &bvh, error));
    info->triangles = cs_scene_triangle_count(&scene->scene);
    info->degenerate = scene->scene.degenerate;
    info->nodes = bvh.nodes.count;
    info->references = bvh.triangles.count;
    info->device_bytes = scene->device_scene.geometry_bytes;
    info->file_camera = scene->scene.cameras.count > 0;
    info->build_s = cs_now_s() - compiled_s;
    scene->is_complete = 1;
done:
    cs_flat_bvh_free(&bvh);
    return status;
}

clshear_status cs_scene_light(clshear_scene *scene, const clshear_light *light, cs_error *error)
{
    clshear_light moved = *light; /* lights are given in coordinates of the file */
    for (int axis = 0; axis < 3; axis++)
        moved.position[axis] = (float)((double)light->position[axis] - scene->scene.origin[axis]);
    return cs_scene_add_light(&scene->scene, &moved, error);
}
