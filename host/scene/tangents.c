#include "scene/tangents.h"

#include <math.h>

#include "base/vec.h"

/* A triangle with a normal map. */
typedef struct mapped_triangle {
    const uint32_t *corner;
    const float *place[3];
    float along[3]; /* which way the texture's first coordinate grows; any length */
    int is_mirrored;
} mapped_triangle;

/* The part of `vector` across the unit vector `normal`, as a unit vector; 0 if there is none. */
static int turn_across(const float *vector, const float *normal, float *across)
{
    const float off = cs_vec_dot(vector, normal);
    for (int axis = 0; axis < 3; axis++)
        across[axis] = vector[axis] - off * normal[axis];
    const float length = sqrtf(cs_vec_dot(across, across));
    for (int axis = 0; axis < 3 && length > 0.0f; axis++)
        across[axis] /= length;
    return length > 0.0f && isfinite(length);
}

/* Whether triangle `index` is smooth and has a normal map and texture coordinates with an area. */
static int is_mapped(const cs_scene *scene, size_t index, mapped_triangle *triangle)
{
    const uint8_t wanted = CS_FACE_SMOOTH | CS_FACE_TEXTURED;
    const uint32_t material = ((const uint32_t *)scene->triangle_materials.items)[index];
    if ((((const uint8_t *)scene->triangle_flags.items)[index] & wanted) != wanted) return 0;
    if (((const cs_material *)scene->materials.items)[material].normal_texture == 0) return 0;
    const cs_vertex *vertices = scene->vertices.items;
    const float *st[3];
    triangle->corner = ((const uint32_t(*)[3])scene->indices.items)[index];
    for (int k = 0; k < 3; k++) {
        triangle->place[k] = ((const float(*)[3])scene->positions.items)[triangle->corner[k]];
        st[k] = vertices[triangle->corner[k]].texture;
    }
    const float s1 = st[1][0] - st[0][0], s2 = st[2][0] - st[0][0];
    const float t1 = st[1][1] - st[0][1], t2 = st[2][1] - st[0][1];
    const float area = s1 * t2 - s2 * t1, sign = area < 0.0f ? -1.0f : 1.0f;
    float first[3], second[3];
    cs_vec_subtract(triangle->place[1], triangle->place[0], first);
    cs_vec_subtract(triangle->place[2], triangle->place[0], second);
    for (int axis = 0; axis < 3; axis++)
        triangle->along[axis] = sign * (t2 * first[axis] - t1 * second[axis]);
    triangle->is_mirrored = area < 0.0f;
    return area != 0.0f;
}

/* Angle of a corner, seen along the unit vector `normal`; 0 where an edge has no length. */
static float angle_at(const mapped_triangle *triangle, int corner, const float *normal)
{
    float edges[2][3], across[2][3];
    for (int i = 0; i < 2; i++) {
        cs_vec_subtract(triangle->place[(corner + 1 + i) % 3], triangle->place[corner], edges[i]);
        if (!turn_across(edges[i], normal, across[i])) return 0.0f;
    }
    return acosf(fmaxf(-1.0f, fminf(1.0f, cs_vec_dot(across[0], across[1]))));
}

/* Adds what a triangle says to its vertices. */
static void add_triangle(const cs_scene *scene, const mapped_triangle *triangle, cs_tangent *all)
{
    const cs_vertex *vertices = scene->vertices.items;
    for (int k = 0; k < 3; k++) {
        const float *given = vertices[triangle->corner[k]].normal;
        const float length = sqrtf(cs_vec_dot(given, given));
        if (!(length > 0.0f)) continue;
        const float normal[3] = {given[0] / length, given[1] / length, given[2] / length};
        float across[3];
        if (!turn_across(triangle->along, normal, across)) continue;
        const float angle = angle_at(triangle, k, normal);
        cs_tangent *sum = &all[2 * (size_t)triangle->corner[k] + (size_t)triangle->is_mirrored];
        for (int axis = 0; axis < 3; axis++)
            sum->value[axis] += angle * across[axis];
    }
}

clshear_status cs_tangents_make(const cs_scene *scene, cs_array *tangents, cs_error *error)
{
    const cs_material *materials = scene->materials.items;
    int wanted = 0;
    for (size_t i = 0; i < scene->materials.count; i++)
        wanted |= materials[i].normal_texture > 0;
    *tangents = (cs_array){.item_size = sizeof(cs_tangent)};
    if (!wanted || scene->vertices.count == 0) return CLSHEAR_OK;
    cs_tangent *all = cs_array_extend(tangents, 2 * scene->vertices.count);
    if (all == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for tangents");
    for (size_t i = 0; i < scene->indices.count; i++) {
        mapped_triangle triangle;
        if (is_mapped(scene, i, &triangle)) add_triangle(scene, &triangle, all);
    }
    for (size_t i = 0; i < tangents->count; i++) {
        const float length = sqrtf(cs_vec_dot(all[i].value, all[i].value));
        for (int axis = 0; axis < 3; axis++)
            all[i].value[axis] = length > 1e-6f ? all[i].value[axis] / length : 0.0f;
    }
    return CLSHEAR_OK;
}
