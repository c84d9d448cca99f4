#include "import/transfer.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

void cs_scene_arrays(cs_scene *scene, cs_array *arrays[CS_SCENE_ARRAYS])
{
    cs_array *all[CS_SCENE_ARRAYS] = {&scene->positions,
                                      &scene->vertices,
                                      &scene->colours,
                                      &scene->indices,
                                      &scene->triangle_materials,
                                      &scene->triangle_flags,
                                      &scene->materials,
                                      &scene->textures,
                                      &scene->texels,
                                      &scene->lights,
                                      &scene->cameras};
    memcpy(arrays, all, sizeof all);
}

static int send_bytes(int pipe, const void *bytes, size_t size)
{
    const char *at = bytes;
    while (size > 0) {
        const ssize_t sent = write(pipe, at, size < 1 << 20 ? size : 1 << 20);
        if (sent < 0 && errno == EINTR) continue;
        if (sent <= 0) return 0;
        at += sent;
        size -= (size_t)sent;
    }
    return 1;
}

int cs_send_record(int pipe, uint32_t tag, uint32_t item_size, const void *bytes, size_t size)
{
    const cs_record record = {tag, item_size, size};
    return send_bytes(pipe, &record, sizeof record) && send_bytes(pipe, bytes, size);
}

int cs_send_scene(int pipe, cs_scene *scene)
{
    cs_scene_frame frame;
    cs_array *arrays[CS_SCENE_ARRAYS];
    memset(&frame, 0, sizeof frame);
    memcpy(frame.origin, scene->origin, sizeof frame.origin);
    memcpy(frame.bounds, scene->bounds, sizeof frame.bounds);
    frame.degenerate = scene->degenerate;
    frame.z_up = (uint64_t)scene->z_up;
    if (!cs_send_record(pipe, CS_RECORD_FRAME, 0, &frame, sizeof frame)) return 0;
    cs_scene_arrays(scene, arrays);
    for (int i = 0; i < CS_SCENE_ARRAYS; i++)
        if (!cs_send_record(pipe, CS_RECORD_ARRAY, (uint32_t)arrays[i]->item_size, arrays[i]->items,
                            arrays[i]->count * arrays[i]->item_size))
            return 0;
    return cs_send_record(pipe, CS_RECORD_END, 0, NULL, 0);
}

/* ----- Checks ----- */

static int counts_agree(const cs_scene *scene)
{
    const size_t vertices = scene->positions.count, triangles = scene->indices.count;
    return scene->vertices.count == vertices &&
           (scene->colours.count == 0 || scene->colours.count == vertices) &&
           scene->triangle_materials.count == triangles &&
           scene->triangle_flags.count == triangles && triangles > 0 && triangles < 1u << 27;
}

static int positions_are_finite(const cs_scene *scene)
{
    const float *values = scene->positions.items;
    int good = 1;
    for (size_t i = 0; i < 3 * scene->positions.count; i++)
        good &= isfinite(values[i]) != 0;
    return good;
}

static int triangles_are_sound(const cs_scene *scene)
{
    const uint32_t(*indices)[3] = scene->indices.items;
    const uint32_t *numbers = scene->triangle_materials.items;
    const uint8_t *flags = scene->triangle_flags.items;
    const cs_material *materials = scene->materials.items;
    for (size_t i = 0; i < scene->indices.count; i++) {
        for (int k = 0; k < 3; k++)
            if (indices[i][k] >= scene->positions.count) return 0;
        if (numbers[i] >= scene->materials.count) return 0;
        if ((flags[i] & CS_FACE_TEXTURED) && materials[numbers[i]].texture < 0) return 0;
        if ((flags[i] & CS_FACE_COLOURED) && scene->colours.count == 0) return 0;
    }
    return 1;
}

static int textures_are_sound(const cs_scene *scene)
{
    const cs_material *materials = scene->materials.items;
    const cs_texture *textures = scene->textures.items;
    for (size_t i = 0; i < scene->materials.count; i++)
        if (materials[i].texture != CS_NO_TEXTURE &&
            (materials[i].texture < 0 || (size_t)materials[i].texture >= scene->textures.count))
            return 0;
    for (size_t i = 0; i < scene->textures.count; i++) {
        const uint64_t size = (uint64_t)textures[i].width * textures[i].height;
        if (size == 0 || textures[i].first > scene->texels.count ||
            size > scene->texels.count - textures[i].first)
            return 0;
    }
    return 1;
}

int cs_scene_is_sound(cs_scene *scene)
{
    const cs_light *lights = scene->lights.items;
    cs_scene_camera *cameras = scene->cameras.items;
    for (size_t i = 0; i < scene->lights.count; i++)
        if (lights[i].kind == CS_LIGHT_TRIANGLES || lights[i].count != 0) return 0;
    for (size_t i = 0; i < scene->cameras.count; i++) {
        cameras[i].name[CS_CAMERA_NAME - 1] = '\0';
        cameras[i].view.image = NULL;
    }
    return counts_agree(scene) && positions_are_finite(scene) && triangles_are_sound(scene) &&
           textures_are_sound(scene);
}
