/* The insides of a scene. */
#ifndef CS_RENDER_OBJECTS_H
#define CS_RENDER_OBJECTS_H

#include "accel/accel.h"
#include "clshear/clshear.h"
#include "context/context.h"
#include "render/read_settings.h"
#include "render/wide_scene.h"
#include "scene/scene.h"

/* A scene on the device. */
typedef struct cs_device_scene {
    cs_buffer *buffers[CS_SCENE_BUFFERS]; /* in the order of kernels' arguments; NULL for what each
                                           * render has of its own */
    uint32_t emitters;                    /* emissive triangles */
    uint32_t even_emitters;               /* of them: those whose radiance does not vary */
    double emitted_power;                 /* of the even ones: area times luminance */
    double emitted_light;                 /* by all, a unit of the scene's area: luminance */
    cs_material_needs needs;
    size_t geometry_bytes;
} cs_device_scene;

struct clshear_scene {
    clshear_context *context; /* kept alive by the scene */
    cs_message message;
    cs_scene scene;
    cs_read_settings read_settings;
    cs_accel *accel;
    cs_device_scene device_scene;
    cs_wide_scene *wide;
    clshear_scene_info info;
    int is_complete;
};

/* An empty scene; freed by cs_scene_destroy, which accepts NULL. */
clshear_status cs_scene_new(clshear_context *context, clshear_scene **scene, cs_error *error);
void cs_scene_destroy(clshear_scene *scene);

/* Reads a file into an empty scene. `settings` may be NULL. */
clshear_status cs_scene_read(clshear_scene *scene, const char *path,
                             const clshear_settings *settings, cs_error *error);

/* From triangles to something that can be rendered: hierarchy and device buffers. */
clshear_status cs_scene_complete(clshear_scene *scene, cs_error *error);

/* Adds a mesh of one material before the scene is complete. */
clshear_status cs_scene_append(clshear_scene *scene, const clshear_mesh *mesh, cs_error *error);

/* Adds a light, before or after. */
clshear_status cs_scene_light(clshear_scene *scene, const clshear_light *light, cs_error *error);

/* A row of the list of buffers as an initialiser of a cs_argument. `buffers`, a name where the list
 * is expanded, is that of an array of buffers. */
#define CS_SCENE_ARGUMENT(identifier, name, type) {.buffer = buffers[CS_SCENE_##identifier]},

/* Puts geometry, materials and textures on the device. `bvh` is not needed afterwards. */
clshear_status cs_scene_upload(cs_device_scene *world, cs_device *device, const cs_scene *scene,
                               const cs_flat_bvh *bvh, cs_error *error);

/* Puts the emissive triangles there, and numbers them in `bvh`, which comes after it. */
clshear_status cs_scene_upload_emitters(cs_device_scene *world, cs_device *device,
                                        const cs_scene *scene, cs_flat_bvh *bvh, cs_error *error);
void cs_device_scene_free(cs_device_scene *world);

#endif
