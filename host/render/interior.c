/* Finds rooms. A solid body, a cupboard and a room are all closed. What tells them apart is where
 * the detail is: a body shows it outside, a room holds it inside, as many separate things in sight
 * of somebody who stands there. So triangles are drawn, evenly by number, and those are enclosed
 * from which nearly no ray leaves the scene. In a room they are nearly all, and from one place many
 * separate parts are in sight. What shows its contents through transparent walls is no room. */
#include "render/interior.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec.h"
#include "kernels/scene.h"
#include "scene/parts.h"

enum {
    SAMPLES = 256,   /* triangles drawn */
    DIRECTIONS = 64, /* of rays from a point, all around */
    GRID = 8,        /* places along each side of the floor */
    LEVELS = 3,      /* and in height */
    BEARINGS = 16,   /* level directions of view */
    MOST_PANES = 8,  /* transparent surfaces that a ray passes */
    LEAST_ENCLOSED = SAMPLES * 8 / 10,
    LEAST_PARTS = 48 /* in sight from one place */
};

static const float eye_height = 0.6f;   /* of the height between floor and ceiling */
static const float most_leaving = 0.1f; /* part of the rays from inside: windows */
static const float fov_deg = 60.0f;
static const float shown_cosine = 0.82f; /* within 35 degrees of the line of sight */

typedef struct thing {
    float centre[3]; /* of an enclosed triangle */
    uint32_t part;
} thing;

typedef struct interior {
    const clshear_scene *scene;
    float size; /* diagonal of the bounding box */
    float directions[DIRECTIONS][3];
    int up, across[2]; /* axes */
    thing things[SAMPLES];
    int count;
} interior;

/* Where to stand and in what direction to look. */
typedef struct place {
    float eye[3];
    float ahead[3];
    float height; /* from floor to ceiling */
    int parts;    /* in sight, all around */
    int shown;    /* of them in the picture */
} place;

/* Even directions: a spiral with the golden angle (Swinbank and Purser, "Fibonacci grids", 2006).
 */
static void spread(float directions[DIRECTIONS][3])
{
    const float golden_angle_rad = 2.39996323f;
    for (int i = 0; i < DIRECTIONS; i++) {
        const float z = 1.0f - (2.0f * (float)i + 1.0f) / DIRECTIONS, radius = sqrtf(1.0f - z * z);
        directions[i][0] = radius * cosf(golden_angle_rad * (float)i);
        directions[i][1] = radius * sinf(golden_angle_rad * (float)i);
        directions[i][2] = z;
    }
}

/* The distance of the first surface that is not transparent; infinite if there is none. */
static float distance_of(const interior *in, const float *from, const float *direction, float far)
{
    const cs_scene *scene = &in->scene->scene;
    const cs_material *materials = scene->materials.items;
    const uint32_t *material_of = scene->triangle_materials.items;
    const float step = 1e-4f * in->size / sqrtf(cs_vec_dot(direction, direction));
    float near = step;
    for (int i = 0; i < MOST_PANES; i++) {
        uint32_t triangle = 0;
        const float distance =
            cs_accel_distance(in->scene->accel, from, direction, near, far, 0.0f, &triangle);
        if (!isfinite(distance)) return INFINITY;
        if (!(materials[material_of[triangle]].flags & (CS_MATERIAL_BLEND | CS_MATERIAL_MASK)))
            return distance;
        near = distance + step;
    }
    return near;
}

/* The part of the rays from a point, all around, that leave the scene. */
static float part_leaving(const interior *in, const float *point)
{
    int left = 0;
    for (int i = 0; i < DIRECTIONS; i++)
        left += !isfinite(distance_of(in, point, in->directions[i], INFINITY));
    return (float)left / DIRECTIONS;
}

static int is_enclosed(const interior *in, const float *point)
{
    return part_leaving(in, point) <= most_leaving;
}

static void find_things(interior *in, const uint32_t *parts)
{
    const cs_scene *scene = &in->scene->scene;
    const float(*positions)[3] = scene->positions.items;
    const uint32_t(*triangles)[3] = scene->indices.items;
    for (size_t i = 0; i < SAMPLES; i++) {
        const uint32_t *corners = triangles[i * scene->indices.count / SAMPLES];
        thing *found = &in->things[in->count];
        for (int axis = 0; axis < 3; axis++)
            found->centre[axis] = (positions[corners[0]][axis] + positions[corners[1]][axis] +
                                   positions[corners[2]][axis]) /
                                  3.0f;
        found->part = parts[corners[0]];
        in->count += is_enclosed(in, found->centre);
    }
}

/* The parts of the marked things. */
static int count_parts(const interior *in, const int *marked)
{
    int parts = 0;
    for (int i = 0; i < in->count; i++) {
        int first = marked[i];
        for (int j = 0; j < i && first; j++)
            first = !(marked[j] && in->things[j].part == in->things[i].part);
        parts += first;
    }
    return parts;
}

static void bearing(const interior *in, float index, float *direction)
{
    const float angle_rad = 2.0f * CS_PI * index / BEARINGS;
    direction[in->up] = 0.0f;
    direction[in->across[0]] = cosf(angle_rad);
    direction[in->across[1]] = sinf(angle_rad);
}

/* Whether what is ahead, and to both sides in the picture, is farther than the room is high. */
static int is_open_ahead(const interior *in, const place *at, int index)
{
    int is_open = 1;
    for (int side = -1; side <= 1; side++) {
        float direction[3];
        bearing(in, (float)index + (float)side, direction);
        is_open &= distance_of(in, at->eye, direction, INFINITY) > at->height;
    }
    return is_open;
}

/* Looks for the bearing that shows the most parts. */
static void choose_bearing(const interior *in, const int *in_sight, place *at)
{
    for (int k = 0; k < BEARINGS; k++) {
        int shown[SAMPLES] = {0};
        float ahead[3], towards[3];
        bearing(in, (float)k, ahead);
        if (!is_open_ahead(in, at, k)) continue;
        for (int i = 0; i < in->count; i++) {
            cs_vec_subtract(in->things[i].centre, at->eye, towards);
            const float length = sqrtf(cs_vec_dot(towards, towards));
            shown[i] = in_sight[i] && length > 0.5f * at->height &&
                       cs_vec_dot(towards, ahead) > shown_cosine * length;
        }
        const int parts = count_parts(in, shown);
        if (parts <= at->shown) continue;
        at->shown = parts;
        memcpy(at->ahead, ahead, sizeof ahead);
    }
}

static void look_around(const interior *in, place *at)
{
    int in_sight[SAMPLES] = {0};
    for (int i = 0; i < in->count; i++) {
        float towards[3];
        cs_vec_subtract(in->things[i].centre, at->eye, towards);
        in_sight[i] = !isfinite(distance_of(in, at->eye, towards, 0.999f));
    }
    at->parts = count_parts(in, in_sight);
    if (at->parts >= LEAST_PARTS) choose_bearing(in, in_sight, at);
}

/* Puts the eye at eye height between what is below and above `start`. Returns whether it is inside.
 */
static int stand(const interior *in, const float *start, place *at)
{
    float vertical[3] = {0};
    vertical[in->up] = 1.0f;
    const float above = distance_of(in, start, vertical, INFINITY);
    vertical[in->up] = -1.0f;
    const float below = distance_of(in, start, vertical, INFINITY);
    if (!isfinite(above + below)) return 0;
    at->height = above + below;
    memcpy(at->eye, start, sizeof at->eye);
    at->eye[in->up] += eye_height * at->height - below;
    return is_enclosed(in, at->eye);
}

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return (x > y) - (x < y);
}

/* The range of the things along an axis, without a twentieth at either end: a room may be a small
 * part of what the file has, but it has the detail. */
static void range_of_things(const interior *in, int axis, float *low, float *high)
{
    float along[SAMPLES];
    for (int i = 0; i < in->count; i++)
        along[i] = in->things[i].centre[axis];
    qsort(along, (size_t)in->count, sizeof *along, compare_floats);
    *low = along[in->count / 20];
    *high = along[in->count - 1 - in->count / 20];
}

/* The place that shows the most, of a grid where the things are. */
static place choose_place(const interior *in)
{
    const int axes[3] = {in->across[0], in->across[1], in->up}, counts[3] = {GRID, GRID, LEVELS};
    float low[3], high[3];
    place best = {0};
    for (int i = 0; i < 3; i++)
        range_of_things(in, axes[i], &low[i], &high[i]);
    for (int k = 0; k < GRID * GRID * LEVELS; k++) {
        const int cell[3] = {k % GRID, k / GRID % GRID, k / (GRID * GRID)};
        place at = {0};
        float start[3];
        for (int i = 0; i < 3; i++) {
            const float part = ((float)cell[i] + 0.5f) / (float)counts[i];
            start[axes[i]] = low[i] + part * (high[i] - low[i]);
        }
        if (stand(in, start, &at)) look_around(in, &at);
        if (at.shown > best.shown) best = at;
    }
    return best;
}

/* Fills in all but the things. */
static interior interior_of(const clshear_scene *scene, int z_up)
{
    interior in = {.scene = scene, .up = z_up ? 2 : 1, .across = {0, z_up ? 1 : 2}};
    float extent[3];
    cs_vec_subtract(scene->scene.bounds[1], scene->scene.bounds[0], extent);
    in.size = sqrtf(cs_vec_dot(extent, extent));
    spread(in.directions);
    return in;
}

float cs_interior_distance(const clshear_scene *scene, const float *from, const float *direction)
{
    const interior in = interior_of(scene, 0);
    return distance_of(&in, from, direction, INFINITY);
}

float cs_interior_sky(const clshear_scene *scene, const float *point)
{
    const interior in = interior_of(scene, 0);
    return part_leaving(&in, point);
}

clshear_status cs_interior_view(const clshear_scene *scene, int z_up, int *is_room, cs_view *view,
                                cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_array parts = {.item_size = sizeof(uint32_t)};
    interior in = interior_of(scene, z_up);
    *is_room = 0;
    CS_TRY(cs_scene_parts(&scene->scene, &parts, error));
    find_things(&in, parts.items);
    if (in.count < LEAST_ENCLOSED) goto done;
    const place best = choose_place(&in);
    if (best.shown == 0) goto done;
    *is_room = 1;
    *view = (cs_view){.fov_deg = fov_deg, .lens_radius = -1.0f};
    for (int i = 0; i < 3; i++) {
        view->eye[i] = best.eye[i];
        view->target[i] = best.eye[i] + best.height * best.ahead[i];
        view->up[i] = i == in.up;
    }
done:
    cs_array_free(&parts);
    return status;
}
