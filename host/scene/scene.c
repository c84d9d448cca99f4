#include "scene/scene.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/vec.h"

void cs_scene_init(cs_scene *scene)
{
    memset(scene, 0, sizeof *scene);
    scene->positions.item_size = 3 * sizeof(float);
    scene->positions_to.item_size = 3 * sizeof(float);
    scene->normals_to.item_size = 3 * sizeof(float);
    scene->vertices.item_size = sizeof(cs_vertex);
    scene->indices.item_size = 3 * sizeof(uint32_t);
    scene->triangle_materials.item_size = sizeof(uint32_t);
    scene->triangle_flags.item_size = sizeof(uint8_t);
    scene->materials.item_size = sizeof(cs_material);
    scene->textures.item_size = sizeof(cs_texture);
    scene->texels.item_size = 4 * sizeof(uint16_t);
    scene->colours.item_size = sizeof(cs_colour);
    scene->cameras.item_size = sizeof(cs_scene_camera);
    scene->lights.item_size = sizeof(cs_light);
}

void cs_scene_free(cs_scene *scene)
{
    cs_array_free(&scene->positions);
    cs_array_free(&scene->positions_to);
    cs_array_free(&scene->normals_to);
    cs_array_free(&scene->vertices);
    cs_array_free(&scene->indices);
    cs_array_free(&scene->triangle_materials);
    cs_array_free(&scene->triangle_flags);
    cs_array_free(&scene->materials);
    cs_array_free(&scene->textures);
    cs_array_free(&scene->texels);
    cs_array_free(&scene->colours);
    cs_array_free(&scene->cameras);
    cs_array_free(&scene->lights);
}

size_t cs_scene_triangle_count(const cs_scene *scene)
{
    return scene->indices.count;
}

/* Where the vertices that were added last are when the shutter closes. */
static clshear_status add_places_to(cs_scene *scene, const clshear_mesh *mesh, const char *name,
                                    cs_error *error)
{
    if (!cs_scene_moves(scene) && mesh->positions_to == NULL) return CLSHEAR_OK;
    if (!cs_scene_start_moving(scene))
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", name);
    const size_t first = 3 * (scene->positions.count - mesh->vertex_count);
    const size_t size = 3 * mesh->vertex_count * sizeof(float);
    if (mesh->positions_to == NULL) return CLSHEAR_OK;
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        if (!isfinite(mesh->positions_to[i]))
            return cs_fail(error, CLSHEAR_BAD_FILE,
                           "%s: vertex %zu moves to what is not a finite number; repair the mesh",
                           name, i / 3);
    memcpy((float *)scene->positions_to.items + first, mesh->positions_to, size);
    if (mesh->normals_to != NULL)
        memcpy((float *)scene->normals_to.items + first, mesh->normals_to, size);
    return CLSHEAR_OK;
}

static clshear_status add_vertices(cs_scene *scene, const clshear_mesh *mesh, const char *name,
                                   cs_error *error)
{
    for (size_t i = 0; i < 3 * mesh->vertex_count; i++)
        if (!isfinite(mesh->positions[i]))
            return cs_fail(error, CLSHEAR_BAD_FILE,
                           "%s: vertex %zu is not a finite number; repair the mesh", name, i / 3);
    float(*positions)[3] = cs_array_extend(&scene->positions, mesh->vertex_count);
    cs_vertex *vertices = cs_array_extend(&scene->vertices, mesh->vertex_count);
    if (positions == NULL || vertices == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", name);
    memcpy(positions, mesh->positions, mesh->vertex_count * sizeof *positions);
    for (size_t i = 0; i < mesh->vertex_count; i++) {
        if (mesh->normals != NULL)
            memcpy(vertices[i].normal, mesh->normals + 3 * i, sizeof vertices[i].normal);
    }
    return add_places_to(scene, mesh, name, error);
}

/* Whether the three corners span an area: more than a ten-millionth of the square of their edges,
 * and neither too small nor too large for the square of a float's cross product. */
int cs_triangle_has_area(const float *a, const float *b, const float *c)
{
    double e1[3], e2[3], normal[3];
    cs_vec_subtract_double(b, a, e1);
    cs_vec_subtract_double(c, a, e2);
    cs_vec_cross_double(e1, e2, normal);
    const double square = cs_vec_dot_double(normal, normal);
    const double first = cs_vec_dot_double(e1, e1), second = cs_vec_dot_double(e2, e2);
    return square > 1e-14 * first * second && square > 1e-37 && square < 1e37;
}

static clshear_status check_indices(const clshear_mesh *mesh, const char *name, cs_error *error)
{
    for (size_t i = 0; i < mesh->triangle_count; i++)
        for (int k = 0; k < 3; k++)
            if (mesh->indices[3 * i + (size_t)k] >= mesh->vertex_count)
                return cs_fail(
                    error, CLSHEAR_BAD_FILE,
                    "%s: triangle %zu names vertex %u, but there are %zu; repair the mesh", name, i,
                    mesh->indices[3 * i + (size_t)k], mesh->vertex_count);
    return CLSHEAR_OK;
}

/* Appends the triangles with an area, whose corners are counted from `first_vertex`. */
static clshear_status add_triangles(cs_scene *scene, const clshear_mesh *mesh, size_t first_vertex,
                                    uint32_t material, uint8_t flag, const char *name,
                                    cs_error *error)
{
    const size_t first = scene->indices.count;
    uint32_t(*indices)[3] = cs_array_extend(&scene->indices, mesh->triangle_count);
    uint32_t *materials = cs_array_extend(&scene->triangle_materials, mesh->triangle_count);
    uint8_t *flags = cs_array_extend(&scene->triangle_flags, mesh->triangle_count);
    size_t kept = 0;
    if (indices == NULL || materials == NULL || flags == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", name);
    for (size_t i = 0; i < mesh->triangle_count; i++) {
        const uint32_t *corner = mesh->indices + 3 * i;
        const float *p = mesh->positions;
        if (!cs_triangle_has_area(p + 3 * corner[0], p + 3 * corner[1], p + 3 * corner[2]))
            continue;
        for (int k = 0; k < 3; k++)
            indices[kept][k] = (uint32_t)first_vertex + corner[k];
        materials[kept] = material;
        flags[kept] = flag;
        kept++;
    }
    scene->degenerate += mesh->triangle_count - kept;
    scene->indices.count = first + kept;
    scene->triangle_materials.count = first + kept;
    scene->triangle_flags.count = first + kept;
    return CLSHEAR_OK;
}

clshear_status cs_scene_add_mesh(cs_scene *scene, const clshear_mesh *mesh, uint32_t material,
                                 const char *name, cs_error *error)
{
    const size_t vertices = scene->positions.count, triangles = scene->indices.count;
    const int moving = cs_scene_moves(scene);
    const uint8_t flag = mesh->normals != NULL ? CS_FACE_SMOOTH : 0;
    if (mesh->triangle_count == 0) return CLSHEAR_OK;
    clshear_status status = check_indices(mesh, name, error);
    if (status == CLSHEAR_OK) status = add_vertices(scene, mesh, name, error);
    if (status == CLSHEAR_OK)
        status = add_triangles(scene, mesh, vertices, material, flag, name, error);
    if (status == CLSHEAR_OK) return status;
    scene->positions.count = scene->vertices.count = vertices; /* nothing of it stays */
    if (scene->positions_to.count > vertices) {
        scene->positions_to.count = moving ? vertices : 0;
        scene->normals_to.count = scene->positions_to.count;
    }
    scene->indices.count = scene->triangle_materials.count = triangles;
    scene->triangle_flags.count = triangles;
    return status;
}

clshear_status cs_scene_finish(cs_scene *scene, const char *name, cs_error *error)
{
    const uint32_t(*indices)[3] = scene->indices.items;
    const float(*positions)[3] = scene->positions.items;
    if (scene->indices.count == 0)
        return cs_fail(error, CLSHEAR_BAD_FILE,
                       "%s: no triangles in it (%zu without area, or with edges that are not 1e-9 "
                       "to 1e9 long; scale them)",
                       name, scene->degenerate);
    for (int axis = 0; axis < 3; axis++) {
        scene->bounds[0][axis] = INFINITY;
        scene->bounds[1][axis] = -INFINITY;
    }
    for (size_t i = 0; i < scene->indices.count; i++)
        for (int k = 0; k < 3; k++)
            for (int axis = 0; axis < 3; axis++) {
                float value = positions[indices[i][k]][axis];
                scene->bounds[0][axis] = fminf(scene->bounds[0][axis], value);
                scene->bounds[1][axis] = fmaxf(scene->bounds[1][axis], value);
            }
    return CLSHEAR_OK;
}

void cs_scene_list_cameras(const cs_scene *scene, char names[CS_CAMERA_LIST])
{
    const cs_scene_camera *cameras = scene->cameras.items;
    const size_t count = scene->cameras.count;
    size_t used = 0;
    names[0] = '\0';
    for (size_t i = 0; i < count && i < 8; i++)
        used += (size_t)snprintf(names + used, CS_CAMERA_LIST - used, "%s%zu \"%.40s\"",
                                 i > 0 ? ", " : "", i, cameras[i].name);
    if (count > 8) snprintf(names + used, CS_CAMERA_LIST - used, ", ...");
}
