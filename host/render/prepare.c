/* Scenes: read or given, with their hierarchy on the device. */
#include <stdlib.h>
#include <string.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "render/handles.h"
#include "render/pass.h"
#include "scene/import.h"

/* From triangles to something that can be rendered. Uses up clock time since `start_s`. */
static clshear_status prepare(clshear_scene *scene, double start_s, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    clshear_context *context = scene->context;
    clshear_scene_info *info = &scene->info;
    cs_flat_bvh bvh = {0};
    const double loaded_s = cs_now_s();
    CS_TRY(cs_pass_warm_up(context->device, error));
    const double compiled_s = cs_now_s();
    CS_TRY(cs_accel_create(&scene->scene, context->threads, &scene->accel, error));
    CS_TRY(cs_accel_build_bvh(scene->accel, &bvh, error));
    CS_TRY(cs_scene_upload(&scene->world, context->device, &scene->scene, &bvh, error));
    CS_TRY(cs_scene_upload_lights(&scene->world, context->device, &scene->scene, error));
    info->triangles = cs_scene_triangle_count(&scene->scene);
    info->degenerate = scene->scene.degenerate;
    info->nodes = bvh.nodes.count;
    info->references = bvh.triangles.count;
    info->device_bytes = scene->world.geometry_bytes;
    info->file_camera = scene->scene.has_camera;
    info->load_s = loaded_s - start_s;
    info->build_s = cs_now_s() - compiled_s;
done:
    cs_flat_bvh_free(&bvh);
    return status;
}

/* Importing takes several times the memory that it leaves in use. */
static void give_back_memory(void)
{
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

static clshear_scene *new_scene(clshear_context *context)
{
    clshear_scene *scene = calloc(1, sizeof *scene);
    if (scene == NULL) return NULL;
    scene->context = context;
    cs_scene_init(&scene->scene);
    return scene;
}

clshear_status clshear_scene_load(clshear_context *context, const char *path,
                                  clshear_scene **result)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = &context->error;
    const double start_s = cs_now_s();
    clshear_scene *scene = new_scene(context);
    CS_REQUIRE(scene != NULL, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    CS_TRY(cs_scene_import(path, &scene->scene, &context->log, error));
    give_back_memory();
    CS_TRY(prepare(scene, start_s, error));
    *result = scene;
    scene = NULL;
done:
    clshear_scene_free(scene);
    return status;
}

static clshear_status add_mesh(cs_scene *scene, const clshear_mesh *mesh, cs_error *error)
{
    if (!cs_is_colour(mesh->diffuse) || !cs_is_colour(mesh->emission))
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "mesh: diffuse and emission must be 0 to 1e15");
    cs_material *look = cs_array_extend(&scene->materials, 1);
    if (look == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    look->texture = CS_NO_TEXTURE;
    memcpy(look->diffuse, mesh->diffuse, sizeof look->diffuse);
    memcpy(look->emission, mesh->emission, sizeof look->emission);
    return cs_scene_add_mesh(scene, mesh, NULL, (uint32_t)(scene->materials.count - 1), "mesh",
                             error);
}

clshear_status clshear_scene_create(clshear_context *context, const clshear_mesh *meshes,
                                    size_t count, clshear_scene **result)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = &context->error;
    const double start_s = cs_now_s();
    clshear_scene *scene = new_scene(context);
    CS_REQUIRE(scene != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t i = 0; i < count; i++)
        CS_TRY(add_mesh(&scene->scene, &meshes[i], error));
    CS_TRY(cs_scene_finish(&scene->scene, "mesh", error));
    CS_TRY(prepare(scene, start_s, error));
    *result = scene;
    scene = NULL;
done:
    clshear_scene_free(scene);
    return status == CLSHEAR_BAD_FILE ? CLSHEAR_BAD_ARGUMENT : status; /* there is no file */
}

clshear_status clshear_scene_add_light(clshear_scene *scene, const clshear_light *light)
{
    cs_error *error = &scene->context->error;
    clshear_status status = cs_scene_add_light(&scene->scene, light, error);
    if (status != CLSHEAR_OK) return status;
    return cs_scene_upload_lights(&scene->world, scene->context->device, &scene->scene, error);
}

clshear_scene_info clshear_scene_describe(const clshear_scene *scene)
{
    clshear_scene_info info = scene->info;
    info.lights = scene->scene.lights.count;
    info.emitters = scene->world.emitters;
    return info;
}

void clshear_scene_free(clshear_scene *scene)
{
    if (scene == NULL) return;
    cs_device_scene_free(&scene->world);
    cs_accel_free(scene->accel);
    cs_scene_free(&scene->scene);
    free(scene);
}
