/* The insides of a scene. */
#ifndef CS_RENDER_OBJECTS_H
#define CS_RENDER_OBJECTS_H

#include "accel/accel.h"
#include "clshear/clshear.h"
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
    clshear_context *context; /* kept alive by the scene */
    cs_message message;
    cs_scene scene;
    cs_accel *accel;
    cs_device_scene device_scene;
    clshear_scene_info info;
    int is_complete;
};

/* An empty scene; freed by cs_scene_destroy, which accepts NULL. */
clshear_status cs_scene_new(clshear_context *context, clshear_scene **scene, cs_error *error);
void cs_scene_destroy(clshear_scene *scene);

/* Reads a file into an empty scene. */
clshear_status cs_scene_read(clshear_scene *scene, const char *path, cs_error *error);

/* From triangles to something that can be rendered: hierarchy and device buffers. */
clshear_status cs_scene_complete(clshear_scene *scene, cs_error *error);

/* Adds a mesh of one material before the scene is complete. */
clshear_status cs_scene_append(clshear_scene *scene, const clshear_mesh *mesh, cs_error *error);

/* Adds a light, before or after. */
clshear_status cs_scene_light(clshear_scene *scene, const clshear_light *light, cs_error *error);

/* Puts geometry, materials and textures on the device. `bvh` is not needed afterwards. */
clshear_status cs_scene_upload(cs_device_scene *world, cs_device *device, const cs_scene *scene,
                               const cs_flat_bvh *bvh, cs_error *error);

/* Puts the lights there, again after each change; the default light where there is none. */
clshear_status cs_scene_upload_lights(cs_device_scene *world, cs_device *device,
                                      const cs_scene *scene, cs_error *error);
void cs_device_scene_free(cs_device_scene *world);

#endif
