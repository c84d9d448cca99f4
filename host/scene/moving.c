/* Surfaces that move while the shutter is open. */
#include <string.h>

#include "base/vec.h"
#include "scene/scene.h"

int cs_scene_moves(const cs_scene *scene)
{
    return scene->positions_to.count > 0;
}

int cs_scene_start_moving(cs_scene *scene)
{
    const size_t before = scene->positions_to.count;
    const size_t missing = scene->positions.count - before;
    float(*places)[3] = cs_array_extend(&scene->positions_to, missing);
    float(*normals)[3] = cs_array_extend(&scene->normals_to, missing);
    if (missing == 0) return 1;
    if (places == NULL || normals == NULL) return 0;
    const cs_vertex *vertices = (const cs_vertex *)scene->vertices.items + before;
    memcpy(places, (const float(*)[3])scene->positions.items + before, missing * sizeof *places);
    for (size_t i = 0; i < missing; i++)
        memcpy(normals[i], vertices[i].normal, sizeof normals[i]);
    return 1;
}

void cs_scene_corner(const cs_scene *scene, size_t triangle, int corner, float time, float *place)
{
    const uint32_t vertex = ((const uint32_t(*)[3])scene->indices.items)[triangle][corner];
    const float *open = ((const float(*)[3])scene->positions.items)[vertex];
    memcpy(place, open, 3 * sizeof *place);
    if (!cs_scene_moves(scene)) return;
    const float *closed = ((const float(*)[3])scene->positions_to.items)[vertex];
    for (int i = 0; i < 3; i++)
        place[i] += time * (closed[i] - open[i]);
}

cs_triangle_step cs_scene_step(const cs_scene *scene, size_t triangle)
{
    cs_triangle_step step = {.padding = {0}};
    float open[3][3], closed[3][3], moved[3][3];
    for (int k = 0; k < 3; k++) {
        cs_scene_corner(scene, triangle, k, 0.0f, open[k]);
        cs_scene_corner(scene, triangle, k, 1.0f, closed[k]);
        cs_vec_subtract(closed[k], open[k], moved[k]);
    }
    memcpy(step.corner, moved[0], sizeof step.corner);
    cs_vec_subtract(moved[1], moved[0], step.edge1);
    cs_vec_subtract(moved[2], moved[0], step.edge2);
    return step;
}
