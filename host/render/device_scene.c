/* A scene's buffers on the device. */
#include "render/objects.h"

/* What was there stays when there is no room for the new. */
static clshear_status upload(cs_device_scene *world, cs_device *device, cs_scene_buffer which,
                             const cs_array *array, cs_error *error)
{
    const void *items = array->count > 0 ? array->items : NULL;
    cs_buffer *made = NULL;
    clshear_status status =
        cs_buffer_create(device, array->count * array->item_size, items, &made, error);
    if (status != CLSHEAR_OK) return status;
    cs_buffer_free(world->buffers[which]);
    world->buffers[which] = made;
    return CLSHEAR_OK;
}

static int any_face_is_described(const cs_scene *scene)
{
    const uint8_t *flags = scene->triangle_flags.items;
    for (size_t i = 0; i < scene->triangle_flags.count; i++)
        if (flags[i] != 0) return 1;
    return 0;
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
    CS_TRY(upload(world, device, CS_SCENE_TEXTURES, &scene->textures, error));
    CS_TRY(upload(world, device, CS_SCENE_TEXELS, &scene->texels, error));
    world->geometry_bytes = bvh->nodes.count * bvh->nodes.item_size +
                            bvh->triangles.count * bvh->triangles.item_size +
                            faces->count * faces->item_size + vertices->count * vertices->item_size;
done:
    return status;
}

/* The scene's lights, then its emissive triangles as one; the default light where both are none. */
static clshear_status all_lights(const cs_scene *scene, size_t emitters, cs_array *lights,
                                 cs_error *error)
{
    const cs_light *added = scene->lights.items;
    const size_t last = scene->lights.count; /* place of what is not added by the caller */
    cs_light *light = cs_array_extend(lights, last + 1);
    if (light == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    for (size_t i = 0; i < last; i++)
        light[i] = added[i];
    if (emitters > 0)
        light[last] = (cs_light){.kind = CS_LIGHT_TRIANGLES, .count = (cs_u32)emitters};
    else if (last == 0)
        light[last] = cs_scene_default_light(scene);
    else
        lights->count--;
    return CLSHEAR_OK;
}

clshear_status cs_scene_upload_lights(cs_device_scene *world, cs_device *device,
                                      const cs_scene *scene, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array emitters = {.item_size = sizeof(cs_emitter)};
    cs_array lights = {.item_size = sizeof(cs_light)};
    CS_TRY(cs_scene_emitters(scene, &emitters, error));
    CS_TRY(all_lights(scene, emitters.count, &lights, error));
    CS_TRY(upload(world, device, CS_SCENE_LIGHTS, &lights, error));
    world->lights = (uint32_t)lights.count;
    CS_TRY(upload(world, device, CS_SCENE_EMITTERS, &emitters, error));
    world->emitters = (uint32_t)emitters.count;
done:
    cs_array_free(&emitters);
    cs_array_free(&lights);
    return status;
}

void cs_device_scene_free(cs_device_scene *world)
{
    for (int i = 0; i < CS_SCENE_BUFFERS; i++)
        cs_buffer_free(world->buffers[i]);
}

void cs_scene_buffers_of(const clshear_scene *scene, const cs_buffer *lights,
                         const cs_buffer *buffers[CS_SCENE_BUFFERS])
{
    for (int i = 0; i < CS_SCENE_BUFFERS; i++)
        buffers[i] = scene->device_scene.buffers[i];
    buffers[CS_SCENE_LIGHTS] = lights;
}
