/* A scene's buffers on the device. */
#include "kernels/bsdf/bsdf.h"
#include "render/objects.h"
#include "scene/albedo.h"
#include "scene/emitters.h"
#include "scene/tangents.h"

static clshear_status upload(cs_device_scene *world, cs_device *device, cs_scene_buffer which,
                             const cs_array *array, cs_error *error)
{
    const void *items = array->count > 0 ? array->items : NULL;
    return cs_buffer_create(device, array->count * array->item_size, items, &world->buffers[which],
                            error);
}

static int any_face_is_described(const cs_scene *scene)
{
    const uint8_t *flags = scene->triangle_flags.items;
    for (size_t i = 0; i < scene->triangle_flags.count; i++)
        if (flags[i] != 0) return 1;
    return 0;
}

/* How normals move; nothing where they do not. */
static clshear_status upload_normal_steps(cs_device_scene *world, cs_device *device,
                                          const cs_scene *scene, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array steps = {.item_size = sizeof(cs_normal_step)};
    const float(*closed)[3] = scene->normals_to.items;
    const cs_vertex *open = scene->vertices.items;
    cs_normal_step *made = cs_array_extend(&steps, scene->normals_to.count);
    CS_REQUIRE(made != NULL || scene->normals_to.count == 0, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for moving normals");
    for (size_t i = 0; i < scene->normals_to.count; i++)
        for (int axis = 0; axis < 3; axis++)
            made[i].normal[axis] = closed[i][axis] - open[i].normal[axis];
    CS_TRY(upload(world, device, CS_SCENE_NORMAL_STEPS, &steps, error));
done:
    cs_array_free(&steps);
    return status;
}

/* How emitters move; nothing where they do not. */
static clshear_status upload_emitter_steps(cs_device_scene *world, cs_device *device,
                                           const cs_scene *scene, const cs_array *table,
                                           cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array steps = {.item_size = sizeof(cs_triangle_step)};
    const size_t count = cs_scene_moves(scene) ? table->count : 0;
    cs_triangle_step *step = cs_array_extend(&steps, count);
    CS_REQUIRE(count == 0 || step != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for moving lights");
    for (size_t i = 0; i < count; i++)
        step[i] = cs_scene_step(scene, ((const cs_emitter *)table->items)[i].face);
    CS_TRY(upload(world, device, CS_SCENE_EMITTER_STEPS, &steps, error));
done:
    cs_array_free(&steps);
    return status;
}

/* What normal maps need. */
static clshear_status upload_tangents(cs_device_scene *world, cs_device *device,
                                      const cs_scene *scene, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array tangents = {.item_size = sizeof(cs_tangent)};
    CS_TRY(cs_tangents_make(scene, &tangents, error));
    CS_TRY(upload(world, device, CS_SCENE_TANGENTS, &tangents, error));
    world->geometry_bytes += tangents.count * tangents.item_size;
done:
    cs_array_free(&tangents);
    return status;
}

clshear_status cs_scene_upload(cs_device_scene *world, cs_device *device, const cs_scene *scene,
                               const cs_flat_bvh *bvh, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_array nothing = {.item_size = 4};
    const int described = any_face_is_described(scene);
    const cs_array *faces = described ? &scene->indices : &nothing;
    const cs_array *vertices = described ? &scene->vertices : &nothing;
    CS_TRY(upload(world, device, CS_SCENE_NODES, &bvh->nodes, error));
    CS_TRY(upload(world, device, CS_SCENE_TRIANGLES, &bvh->triangles, error));
    CS_TRY(upload(world, device, CS_SCENE_FACES, faces, error));
    CS_TRY(upload(world, device, CS_SCENE_VERTICES, vertices, error));
    CS_TRY(upload(world, device, CS_SCENE_COLOURS, &scene->colours, error));
    CS_TRY(upload(world, device, CS_SCENE_MATERIALS, &scene->materials, error));
    world->needs = cs_scene_material_needs(scene);
    if (world->needs.features & CS_FEATURE_MATERIALS)
        CS_TRY(cs_buffer_create(device, CS_ALBEDO_FLOATS * sizeof(float), cs_albedo_table,
                                &world->buffers[CS_SCENE_ALBEDOS], error));
    CS_TRY(upload(world, device, CS_SCENE_NODE_STEPS, &bvh->node_steps, error));
    CS_TRY(upload(world, device, CS_SCENE_TRIANGLE_STEPS, &bvh->triangle_steps, error));
    if (described) CS_TRY(upload_normal_steps(world, device, scene, error));
    CS_TRY(upload(world, device, CS_SCENE_TEXTURES, &scene->textures, error));
    CS_TRY(upload(world, device, CS_SCENE_TEXELS, &scene->texels, error));
    world->geometry_bytes = bvh->nodes.count * bvh->nodes.item_size +
                            bvh->triangles.count * bvh->triangles.item_size +
                            faces->count * faces->item_size + vertices->count * vertices->item_size;
    CS_TRY(upload_tangents(world, device, scene, error));
done:
    return status;
}

clshear_status cs_scene_upload_emitters(cs_device_scene *world, cs_device *device,
                                        const cs_scene *scene, cs_flat_bvh *bvh, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_emitters emitters = {0};
    CS_TRY(cs_emitters_make(scene, &emitters, error));
    CS_TRY(upload(world, device, CS_SCENE_EMITTERS, &emitters.table, error));
    CS_TRY(upload(world, device, CS_SCENE_EMITTER_NODES, &emitters.nodes, error));
    CS_TRY(upload_emitter_steps(world, device, scene, &emitters.table, error));
    cs_emitters_number(&emitters, bvh->triangles.items, bvh->triangles.count);
    world->emitters = (uint32_t)emitters.table.count;
    world->even_emitters = emitters.even;
    world->emitted_power = emitters.power;
    world->emitted_light = emitters.light;
done:
    cs_emitters_free(&emitters);
    return status;
}

void cs_device_scene_free(cs_device_scene *world)
{
    for (int i = 0; i < CS_SCENE_BUFFERS; i++)
        cs_buffer_free(world->buffers[i]);
}
