/* The insides of the public handles of the rendering half. */
#ifndef CS_RENDER_HANDLES_H
#define CS_RENDER_HANDLES_H

#include "accel/accel.h"
#include "context/context.h"
#include "scene/scene.h"

/* A scene on the device. */
typedef struct cs_device_scene {
    cs_buffer *buffers[CS_SCENE_BUFFERS]; /* in the order of kernels' arguments */
    uint32_t lights;                      /* all emissive triangles together are one */
    uint32_t emitters;                    /* emissive triangles */
    size_t geometry_bytes;
} cs_device_scene;

struct clshear_scene {
    clshear_context *context;
    cs_scene scene;
    cs_accel *accel;
    cs_device_scene world;
    clshear_scene_info info;
};

/* A row of the list of buffers as an initialiser of a cs_argument. `buffers`, a name where the list
 * is expanded, is that of a cs_device_scene. */
#define CS_SCENE_ARGUMENT(identifier, name, type) {.buffer = buffers[CS_SCENE_##identifier]},

/* Puts geometry, materials and textures on the device. `bvh` is not needed afterwards. */
clshear_status cs_scene_upload(cs_device_scene *world, cs_device *device, const cs_scene *scene,
                               const cs_flat_bvh *bvh, cs_error *error);

/* Puts the lights there, again after each change; the default light where there is none. */
clshear_status cs_scene_upload_lights(cs_device_scene *world, cs_device *device,
                                      const cs_scene *scene, cs_error *error);
void cs_device_scene_free(cs_device_scene *world);

#endif
