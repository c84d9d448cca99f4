/* The insides of the public handles of the rendering half. */
#ifndef CS_RENDER_HANDLES_H
#define CS_RENDER_HANDLES_H

#include "accel/accel.h"
#include "context/context.h"
#include "scene/scene.h"

/* The scene's buffers on the device, in the order of the kernel's arguments. */
typedef enum cs_world_buffer {
    CS_WORLD_NODES,
    CS_WORLD_TRIANGLES,
    CS_WORLD_FACES,
    CS_WORLD_VERTICES,
    CS_WORLD_MATERIALS,
    CS_WORLD_TEXTURES,
    CS_WORLD_TEXELS,
    CS_WORLD_LIGHTS,
    CS_WORLD_EMITTERS,
    CS_WORLD_BUFFERS
} cs_world_buffer;

typedef struct cs_device_world {
    cs_buffer *buffers[CS_WORLD_BUFFERS];
    uint32_t lights;
    uint32_t emitters;
    size_t geometry_bytes;
} cs_device_world;

struct clshear_scene {
    clshear_context *context;
    cs_scene scene;
    cs_accel *accel;
    cs_device_world world;
    clshear_scene_info info;
};

/* Puts geometry, materials and textures on the device. `bvh` is not needed afterwards. */
clshear_status cs_world_upload(cs_device_world *world, cs_device *device, const cs_scene *scene,
                               const cs_flat_bvh *bvh, cs_error *error);

/* Puts the lights there, again after each change; the default light where there is none. */
clshear_status cs_world_upload_lights(cs_device_world *world, cs_device *device,
                                      const cs_scene *scene, cs_error *error);
void cs_world_free(cs_device_world *world);

#endif
