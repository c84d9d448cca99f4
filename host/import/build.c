#include "import/build.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "import/build_parts.h"
#include "import/colour.h"
#include "import/index_map.h"
#include "import/smooth.h"

/* How far from the origin, in extents of the scene, it is moved there: floats keep 24 bits. */
static const double far_away = 256.0;

/* Whether a corner names what is there: readers see to that, and nothing must rest on it. */
static int is_sound(const cs_model *model, const cs_corner *corner)
{
    return corner->position < model->positions.count &&
           (corner->normal == CS_NO_INDEX || corner->normal < model->normals.count) &&
           (corner->texture == CS_NO_INDEX || corner->texture < model->textures.count);
}

/* Checks the positions that triangles use and finds their bounds. */
static clshear_status find_bounds(const cs_model *model, double bounds[2][3], cs_error *error)
{
    const double(*positions)[3] = model->positions.items;
    const cs_model_triangle *triangles = model->triangles.items;
    for (int axis = 0; axis < 3; axis++) {
        bounds[0][axis] = INFINITY;
        bounds[1][axis] = -INFINITY;
    }
    for (size_t i = 0; i < model->triangles.count; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t place = triangles[i].corner[k].position;
            if (!is_sound(model, &triangles[i].corner[k]))
                return cs_fail(error, CLSHEAR_BAD_FILE, "%s: triangle %zu names what is not there",
                               model->path, i);
            for (int axis = 0; axis < 3; axis++) {
                const double value = positions[place][axis];
                if (!isfinite((float)value))
                    return cs_fail(error, CLSHEAR_BAD_FILE,
                                   "%s: vertex %u is not a finite number; repair the mesh",
                                   model->path, place);
                bounds[0][axis] = fmin(bounds[0][axis], value);
                bounds[1][axis] = fmax(bounds[1][axis], value);
            }
        }
    return CLSHEAR_OK;
}

/* The scene's origin: the middle of what is far from the file's, in whole units. */
static void choose_origin(const cs_model *model, double bounds[2][3], double *origin)
{
    double extent = 0.0, distance = 0.0, middle[3];
    for (int axis = 0; axis < 3; axis++) {
        middle[axis] = 0.5 * (bounds[0][axis] + bounds[1][axis]);
        extent = fmax(extent, bounds[1][axis] - bounds[0][axis]);
        distance = fmax(distance, fabs(middle[axis]));
        origin[axis] = 0.0;
    }
    if (!(distance > far_away * extent) || extent == 0.0) return;
    for (int axis = 0; axis < 3; axis++)
        origin[axis] = extent >= 1.0 ? round(middle[axis]) : middle[axis];
    cs_warn(model->log,
            "%s: lies far from the origin, at %.9g,%.9g,%.9g; moved there to keep its digits "
            "(coordinates in settings stay those of the file)",
            model->path, origin[0], origin[1], origin[2]);
}

/* What a vertex of the scene is made of. */
typedef struct vertex_key {
    uint32_t position;
    uint32_t normal;
    uint32_t texture;
    uint32_t material; /* 0 where there are no texture coordinates */
} vertex_key;

typedef struct emission {
    const cs_model *model;
    cs_scene *scene;
    cs_index_map vertices; /* of vertex_key */
} emission;

/* Texture coordinates repeat; beyond a million turns a float has no fraction left to look up. */
static float usable_coordinate(double value)
{
    return fabs(value) < 1e6 ? (float)value : 0.0f; /* NaN too */
}

/* Three numbers of a file; zeros, unless all are finite. */
static void copy_finite(const float *from, float *to)
{
    if (isfinite(from[0]) && isfinite(from[1]) && isfinite(from[2]))
        memcpy(to, from, 3 * sizeof *to);
}

/* A normal of a file, of length 1; zeros if it has no direction. What differs from 1 by rounding
 * alone stays as it is. A longer one would count for more between its corners, and one that the
 * scale of a node has made very short would count for none. */
static void copy_normal(const float *from, float *to)
{
    float finite[3] = {0.0f};
    double square = 0.0;
    copy_finite(from, finite);
    for (int axis = 0; axis < 3; axis++)
        square += (double)finite[axis] * (double)finite[axis];
    const double scale = square > 0.0 && fabs(square - 1.0) > 1e-5 ? 1.0 / sqrt(square) : 1.0;
    for (int axis = 0; axis < 3; axis++)
        to[axis] = (float)(scale * (double)finite[axis]);
}

static int fill_vertex(const emission *work, const vertex_key *key)
{
    const cs_model *model = work->model;
    cs_scene *scene = work->scene;
    float *position = cs_array_extend(&scene->positions, 1);
    cs_vertex *vertex = cs_array_extend(&scene->vertices, 1);
    cs_colour *colour = model->colours.count > 0 ? cs_array_extend(&scene->colours, 1) : NULL;
    if (position == NULL || vertex == NULL || (model->colours.count > 0 && colour == NULL))
        return 0;
    const double *from = ((const double(*)[3])model->positions.items)[key->position];
    for (int axis = 0; axis < 3; axis++)
        position[axis] = (float)(from[axis] - scene->origin[axis]);
    if (key->normal != CS_NO_INDEX)
        copy_normal(((const float(*)[3])model->normals.items)[key->normal], vertex->normal);
    if (key->texture != CS_NO_INDEX) {
        const cs_material_description *material =
            (const cs_material_description *)model->materials.items + key->material;
        const cs_map *map = cs_material_placing(material);
        const float *st = ((const float(*)[2])model->textures.items)[key->texture];
        const double s = (double)st[0], t = (double)st[1];
        vertex->texture[0] =
            usable_coordinate(map->across[0] * s + map->across[1] * t + map->across[2]);
        vertex->texture[1] = usable_coordinate(map->up[0] * s + map->up[1] * t + map->up[2]);
    }
    if (colour != NULL) {
        const float *opacities = model->opacities.items;
        copy_finite(((const float(*)[3])model->colours.items)[key->position], colour->value);
        colour->alpha = key->position < model->opacities.count ? opacities[key->position] : 1.0f;
    }
    return 1;
}

static int add_vertex(emission *work, const vertex_key *key, uint32_t *index)
{
    const size_t before = work->vertices.keys.count;
    *index = cs_index_map_add(&work->vertices, key);
    if (*index == UINT32_MAX) return 0;
    return *index < before || fill_vertex(work, key);
}

static int add_triangle(emission *work, const cs_model_triangle *triangle, int textured)
{
    cs_scene *scene = work->scene;
    uint32_t corner[3];
    uint8_t flags = textured ? CS_FACE_TEXTURED : 0;
    int smooth = 1;
    for (int k = 0; k < 3; k++) {
        smooth &= triangle->corner[k].normal != CS_NO_INDEX;
        textured &= triangle->corner[k].texture != CS_NO_INDEX;
    }
    if (!textured) flags = 0;
    if (smooth) flags |= CS_FACE_SMOOTH;
    if (work->model->colours.count > 0) flags |= CS_FACE_COLOURED;
    for (int k = 0; k < 3; k++) {
        const vertex_key key = {
            .position = triangle->corner[k].position,
            .normal = smooth ? triangle->corner[k].normal : CS_NO_INDEX,
            .texture = textured ? triangle->corner[k].texture : CS_NO_INDEX,
            .material = textured ? triangle->material : 0,
        };
        if (!add_vertex(work, &key, &corner[k])) return 0;
    }
    const float(*p)[3] = scene->positions.items;
    if (!cs_triangle_has_area(p[corner[0]], p[corner[1]], p[corner[2]])) {
        scene->degenerate++;
        return 1;
    }
    void *indices = cs_array_extend(&scene->indices, 1);
    uint32_t *material = cs_array_extend(&scene->triangle_materials, 1);
    uint8_t *flag = cs_array_extend(&scene->triangle_flags, 1);
    if (indices == NULL || material == NULL || flag == NULL) return 0;
    memcpy(indices, corner, sizeof corner);
    *material = triangle->material;
    *flag = flags;
    return 1;
}

static clshear_status add_triangles(cs_model *model, cs_scene *scene, cs_error *error)
{
    const cs_material *materials = scene->materials.items;
    const cs_model_triangle *triangles = model->triangles.items;
    emission work = {.model = model, .scene = scene};
    size_t *plain = calloc(scene->materials.count, sizeof *plain);
    int good = plain != NULL;
    cs_index_map_init(&work.vertices, sizeof(vertex_key));
    for (size_t i = 0; i < model->triangles.count && good; i++) {
        const int textured = cs_material_is_textured(&materials[triangles[i].material]);
        for (int k = 0; k < 3 && textured; k++)
            if (triangles[i].corner[k].texture == CS_NO_INDEX) {
                plain[triangles[i].material]++;
                break;
            }
        good = add_triangle(&work, &triangles[i], textured);
    }
    if (good) cs_report_plain(model, plain);
    free(plain);
    cs_index_map_free(&work.vertices);
    return good ? CLSHEAR_OK : cs_model_full(model, error);
}

/* What is said of the colours of positions. */
static void report_colours(const cs_model *model)
{
    const float *colours = model->colours.items;
    float most = 0.0f;
    for (size_t i = 0; i < 3 * model->colours.count; i++)
        most = fmaxf(most, colours[i]);
    if (most > 1.0f)
        cs_warn(model->log,
                "%s: its vertices have colours up to %g: above 1 they reflect more light than "
                "arrives; kept",
                model->path, (double)most);
    if (model->has_unused_alpha)
        cs_warn(model->log,
                "%s: the alpha of its vertices is not used; export glTF, whose materials use it",
                model->path);
}

/* Whether the colours are whole numbers up to 255, and some are above 15, as programs write that
 * have bytes, though the format wants them from 0 to 1. */
static int are_bytes(const cs_array *colours)
{
    const float *values = colours->items;
    float most = 0.0f;
    for (size_t i = 0; i < 3 * colours->count; i++) {
        if (values[i] != floorf(values[i]) || values[i] > 255.0f) return 0;
        most = fmaxf(most, values[i]);
    }
    return most > 15.0f;
}

/* One linear colour for each position, white where none was given. */
static clshear_status complete_colours(cs_model *model, cs_error *error)
{
    if (model->colours.count == 0) return CLSHEAR_OK;
    const size_t given = 3 * model->colours.count, all = 3 * model->positions.count;
    if (given < all && cs_model_extend(&model->colours, (all - given) / 3) == NULL)
        return cs_model_full(model, error);
    float *values = model->colours.items;
    for (size_t i = given; i < all; i++)
        values[i] = CS_NO_COLOUR;
    const int bytes = are_bytes(&model->colours);
    for (size_t i = 0; i < 3 * model->colours.count; i++) {
        if (values[i] == CS_NO_COLOUR)
            values[i] = 1.0f;
        else if (bytes)
            values[i] = cs_colour_value((double)values[i] / 255.0, 1);
    }
    report_colours(model);
    return CLSHEAR_OK;
}

clshear_status cs_model_build(cs_model *model, double smooth_degrees, cs_scene *scene,
                              cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    double bounds[2][3];
    CS_TRY(find_bounds(model, bounds, error));
    choose_origin(model, bounds, scene->origin);
    CS_TRY(complete_colours(model, error));
    CS_TRY(cs_model_smooth(model, smooth_degrees, error));
    CS_TRY(cs_build_materials(model, scene, error)); /* checks the numbers of materials */
    CS_TRY(add_triangles(model, scene, error));
    CS_TRY(cs_build_lights(model, (const double(*)[3])bounds, scene, error));
    CS_TRY(cs_build_cameras(model, scene, error));
    if (scene->degenerate > 0)
        cs_warn(model->log, "%s: %zu triangles without area are left out", model->path,
                scene->degenerate);
done:
    return status;
}
