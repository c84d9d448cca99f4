/* The insides of the public handles of the rendering half. */
#ifndef CS_RENDER_HANDLES_H
#define CS_RENDER_HANDLES_H

#include "accel/accel.h"
#include "context/context.h"
#include "scene/scene.h"

/* The scene's buffers on the device, in the order of the kernel's arguments. */
typedef enum cs_scene_buffer {
    CS_SCENE_NODES,
    CS_SCENE_TRIANGLES,
    CS_SCENE_FACES,
    CS_SCENE_VERTICES,
    CS_SCENE_MATERIALS,
    CS_SCENE_TEXTURES,
    CS_SCENE_TEXELS,
    CS_SCENE_LIGHTS,
    CS_SCENE_EMITTERS,
    CS_SCENE_BUFFERS
} cs_scene_buffer;

typedef struct cs_device_scene {
    cs_buffer *buffers[CS_SCENE_BUFFERS];
    uint32_t lights;
    uint32_t emitters;
    size_t geometry_bytes;
} cs_device_scene;

struct clshear_scene {
    clshear_context *context;
    cs_scene scene;
    cs_accel *accel;
    cs_device_scene world;
    clshear_scene_info info;
};

/* Puts geometry, materials and textures on the device. `bvh` is not needed afterwards. */
clshear_status cs_scene_upload(cs_device_scene *world, cs_device *device, const cs_scene *scene,
                               const cs_flat_bvh *bvh, cs_error *error);

/* Puts the lights there, again after each change; the default light where there is none. */
clshear_status cs_scene_upload_lights(cs_device_scene *world, cs_device *device,
                                      const cs_scene *scene, cs_error *error);
void cs_device_scene_free(cs_device_scene *world);

#endif
