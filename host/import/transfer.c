#include "import/transfer.h"

#include <errno.h>
#include <float.h>
#include <string.h>
#include <unistd.h>

#include "kernels/bsdf/list.h"

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
                                      &scene->cameras,
                                      &scene->positions_to,
                                      &scene->normals_to};
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
    frame.up_is_open = (uint64_t)scene->up_is_open;
    if (!cs_send_record(pipe, CS_RECORD_FRAME, 0, &frame, sizeof frame)) return 0;
    cs_scene_arrays(scene, arrays);
    for (int i = 0; i < CS_SCENE_ARRAYS; i++)
        if (!cs_send_record(pipe, CS_RECORD_ARRAY, (uint32_t)arrays[i]->item_size, arrays[i]->items,
                            arrays[i]->count * arrays[i]->item_size))
            return 0;
    return cs_send_record(pipe, CS_RECORD_END, 0, NULL, 0);
}

/* ----- Checks ----- */

/* What a reader lets pass of a coordinate of a texture, and of the scale of a normal map. */
static const float most_coordinate = 1e6f, most_normal_scale = 1e6f;

static int counts_agree(const cs_scene *scene)
{
    const size_t vertices = scene->positions.count, triangles = scene->indices.count;
    return scene->vertices.count == vertices &&
           (scene->colours.count == 0 || scene->colours.count == vertices) &&
           (scene->positions_to.count == 0 || scene->positions_to.count == vertices) &&
           scene->normals_to.count == scene->positions_to.count &&
           scene->triangle_materials.count == triangles &&
           scene->triangle_flags.count == triangles && triangles > 0 && triangles < 1u << 27;
}

static int are_within(const float *values, size_t count, float least, float most)
{
    int good = 1;
    for (size_t i = 0; i < count; i++)
        good &= values[i] >= least && values[i] <= most; /* not of NaN */
    return good;
}

/* Positions, normals, coordinates of textures and colours. */
static int vertices_are_sound(const cs_scene *scene)
{
    const cs_vertex *vertices = scene->vertices.items;
    int good =
        are_within(scene->positions.items, 3 * scene->positions.count, -FLT_MAX, FLT_MAX) &&
        are_within(scene->colours.items, 4 * scene->colours.count, -FLT_MAX, FLT_MAX) &&
        are_within(scene->positions_to.items, 3 * scene->positions_to.count, -FLT_MAX, FLT_MAX) &&
        are_within(scene->normals_to.items, 3 * scene->normals_to.count, -FLT_MAX, FLT_MAX);
    for (size_t i = 0; i < scene->vertices.count; i++)
        good &= are_within(vertices[i].normal, 3, -FLT_MAX, FLT_MAX) &&
                are_within(vertices[i].texture, 2, -most_coordinate, most_coordinate);
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
        if ((flags[i] & CS_FACE_TEXTURED) && !cs_material_is_textured(&materials[numbers[i]]))
            return 0;
        if ((flags[i] & CS_FACE_COLOURED) && scene->colours.count == 0) return 0;
        if (flags[i] & ~(CS_FACE_SMOOTH | CS_FACE_TEXTURED | CS_FACE_COLOURED)) return 0;
    }
    return 1;
}

static int material_is_sound(const cs_material *m, size_t textures)
{
    const cs_u32 flags = CS_MATERIAL_BLEND | CS_MATERIAL_MASK | CS_MATERIAL_UNLIT;
    return m->texture >= CS_NO_TEXTURE && (m->texture < 0 || (size_t)m->texture < textures) &&
           m->facets_texture <= textures && m->normal_texture <= textures &&
           m->emission_texture <= textures && m->bsdf < CS_BSDF_ALL && (m->flags & ~flags) == 0 &&
           cs_is_colour(m->diffuse) && cs_is_colour(m->emission) &&
           are_within(m->parameters, CS_PARAMETER_INDEX, 0.0f, 1.0f) &&
           are_within(m->parameters + CS_PARAMETER_INDEX,
                      CS_MATERIAL_PARAMETERS - CS_PARAMETER_INDEX, 0.0f, FLT_MAX) &&
           are_within(&m->alpha, 1, 0.0f, 1.0f) && are_within(&m->cutoff, 1, 0.0f, FLT_MAX) &&
           are_within(&m->normal_scale, 1, -most_normal_scale, most_normal_scale);
}

static int materials_are_sound(const cs_scene *scene)
{
    const cs_material *materials = scene->materials.items;
    for (size_t i = 0; i < scene->materials.count; i++)
        if (!material_is_sound(&materials[i], scene->textures.count)) return 0;
    return 1;
}

static int textures_are_sound(const cs_scene *scene)
{
    const cs_texture *textures = scene->textures.items;
    for (size_t i = 0; i < scene->textures.count; i++) {
        const uint64_t size = (uint64_t)textures[i].width * textures[i].height;
        const cs_u32 wraps = textures[i].lookup & ~(cs_u32)CS_TEXTURE_NEAREST;
        const cs_u32 across = wraps & CS_TEXTURE_WRAP_MASK, up = wraps >> CS_TEXTURE_WRAP_BITS;
        if (size == 0 || textures[i].first > scene->texels.count ||
            size > scene->texels.count - textures[i].first || across > CS_TEXTURE_MIRROR ||
            up > CS_TEXTURE_MIRROR)
            return 0;
    }
    return 1;
}

static int lights_are_sound(const cs_scene *scene)
{
    const cs_light *lights = scene->lights.items;
    for (size_t i = 0; i < scene->lights.count; i++) {
        const cs_light *one = &lights[i];
        if (one->kind != CS_LIGHT_POINT && one->kind != CS_LIGHT_DIRECTIONAL &&
            one->kind != CS_LIGHT_SPOT)
            return 0;
        if (one->count != 0 || !cs_is_colour(one->colour) ||
            !are_within(one->position, 3, -FLT_MAX, FLT_MAX) ||
            !are_within(one->axis, 3, -FLT_MAX, FLT_MAX) ||
            !are_within(one->parameters, sizeof one->parameters / sizeof *one->parameters, -FLT_MAX,
                        FLT_MAX))
            return 0;
    }
    return 1;
}

static int cameras_are_sound(cs_scene *scene)
{
    cs_scene_camera *cameras = scene->cameras.items;
    int good = 1;
    for (size_t i = 0; i < scene->cameras.count; i++) {
        cs_view *view = &cameras[i].view;
        cameras[i].name[CS_CAMERA_NAME - 1] = '\0';
        view->image = NULL;
        good &= are_within(view->eye, 3, -FLT_MAX, FLT_MAX) &&
                are_within(view->target, 3, -FLT_MAX, FLT_MAX) &&
                are_within(view->up, 3, -FLT_MAX, FLT_MAX) &&
                are_within(&view->fov_deg, 1, 0.0f, 180.0f) &&
                are_within(&view->orthographic, 1, 0.0f, FLT_MAX);
    }
    return good;
}

int cs_scene_is_sound(cs_scene *scene)
{
    return counts_agree(scene) && vertices_are_sound(scene) && triangles_are_sound(scene) &&
           materials_are_sound(scene) && textures_are_sound(scene) && lights_are_sound(scene) &&
           cameras_are_sound(scene);
}
