#include "import/smooth.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/pi.h"
#include "base/vec.h"
#include "import/index_map.h"

enum {
    MOST_NEIGHBOURS = 512 /* triangles around a point that are compared with each other */
};

static const double degrees_in_radians = CS_PI_DOUBLE / 180.0;

/* A corner of a triangle without normals: which place it is at, what it adds to the mean. */
typedef struct part {
    uint32_t place; /* number of its vertex in the file; by angle, of the position among different
                       ones */
    float normal[3];
    float weight; /* the angle */
} part;

typedef struct smoothing {
    cs_model *model;
    part *parts;         /* three for each triangle */
    uint32_t *first;     /* of each place, in `order`; one more at the end */
    uint32_t *order;     /* corners, sorted by place */
    cs_index_map places; /* positions */
    cs_index_map kinds;  /* (place, group), or normals: what gets a normal of its own */
} smoothing;

static int lacks_normals(const cs_model_triangle *triangle)
{
    for (int k = 0; k < 3; k++)
        if (triangle->corner[k].normal == CS_NO_INDEX) return 1;
    return 0;
}

static double angle_between(const double *a, const double *b)
{
    const double length = sqrt(cs_vec_dot_double(a, a) * cs_vec_dot_double(b, b));
    if (!(length > 0.0)) return 0.0;
    return acos(fmax(-1.0, fmin(1.0, cs_vec_dot_double(a, b) / length)));
}

/* Normal and angles of a triangle. */
static void describe(const cs_model *model, const cs_model_triangle *triangle, part *parts)
{
    const double(*positions)[3] = model->positions.items;
    double edge[3][3], normal[3];
    for (int k = 0; k < 3; k++) {
        const double *from = positions[triangle->corner[k].position];
        const double *to = positions[triangle->corner[(k + 1) % 3].position];
        for (int i = 0; i < 3; i++)
            edge[k][i] = to[i] - from[i];
    }
    cs_vec_cross_double(edge[0], edge[1], normal);
    const double length = sqrt(cs_vec_dot_double(normal, normal));
    for (int k = 0; k < 3; k++) {
        const double *in = edge[(k + 2) % 3];
        const double back[3] = {-in[0], -in[1], -in[2]};
        parts[k].weight = length > 0.0 ? (float)angle_between(edge[k], back) : 0.0f;
        for (int i = 0; i < 3; i++)
            parts[k].normal[i] = length > 0.0 ? (float)(normal[i] / length) : 0.0f;
    }
}

/* Number of a vertex's position among the different ones; UINT32_MAX without memory. */
static uint32_t number_of_position(smoothing *work, uint32_t vertex)
{
    const double *position = ((const double(*)[3])work->model->positions.items)[vertex];
    double key[3];
    for (int axis = 0; axis < 3; axis++) /* + 0: -0 is 0 */
        key[axis] = position[axis] + 0.0;
    return cs_index_map_add(&work->places, key);
}

/* Finds the place of every corner, and its normal and angle; 0 without memory. In a group, only
 * triangles that share a vertex of the file are smooth across it, as in Blender: the two sides of a
 * leaf that lie on each other would leave each other without a direction. */
static int find_places(smoothing *work, int by_angle)
{
    const cs_model *model = work->model;
    const cs_model_triangle *triangles = model->triangles.items;
    for (size_t i = 0; i < model->triangles.count; i++) {
        part *parts = work->parts + 3 * i;
        for (int k = 0; k < 3; k++) {
            const uint32_t vertex = triangles[i].corner[k].position;
            parts[k].place = by_angle ? number_of_position(work, vertex) : vertex;
            if (parts[k].place == UINT32_MAX) return 0;
        }
        describe(model, &triangles[i], parts);
    }
    return 1;
}

/* Whether a corner gets a normal here. */
static int takes_part(const smoothing *work, size_t corner, int by_angle)
{
    const cs_model_triangle *triangle =
        (const cs_model_triangle *)work->model->triangles.items + corner / 3;
    return triangle->corner[corner % 3].normal == CS_NO_INDEX && (by_angle || triangle->group != 0);
}

/* Makes a sum the model's normal number `index`; 0 if it has no direction. */
static int put_normal(const double *sum, float *normal)
{
    const double length = sqrt(cs_vec_dot_double(sum, sum));
    for (int i = 0; i < 3; i++)
        normal[i] = length > 0.0 ? (float)(sum[i] / length) : 0.0f;
    return length > 0.0;
}

static uint32_t *normal_of(const smoothing *work, size_t corner)
{
    cs_model_triangle *triangle = (cs_model_triangle *)work->model->triangles.items + corner / 3;
    return &triangle->corner[corner % 3].normal;
}

/* ----- By groups ----- */

static int number_in_group(smoothing *work, size_t corner, uint32_t *number)
{
    const cs_model_triangle *triangles = work->model->triangles.items;
    const uint32_t key[2] = {work->parts[corner].place, triangles[corner / 3].group};
    *number = cs_index_map_add(&work->kinds, key);
    return *number != UINT32_MAX;
}

static int smooth_groups(smoothing *work)
{
    const size_t corners = 3 * work->model->triangles.count, before = work->model->normals.count;
    cs_array sums = {.item_size = 3 * sizeof(double)};
    uint32_t number;
    int good = 1;
    for (size_t i = 0; i < corners && good; i++) {
        if (!takes_part(work, i, 0)) continue;
        good = number_in_group(work, i, &number);
        if (good && number == sums.count) good = cs_array_extend(&sums, 1) != NULL;
        double(*all)[3] = sums.items;
        good = good && all != NULL;
        for (int axis = 0; axis < 3 && good; axis++)
            all[number][axis] +=
                (double)work->parts[i].weight * (double)work->parts[i].normal[axis];
    }
    float(*normals)[3] = good ? cs_model_extend(&work->model->normals, sums.count) : NULL;
    good = normals != NULL;
    for (size_t i = 0; i < sums.count && good; i++)
        put_normal(((double(*)[3])sums.items)[i], normals[i]);
    for (size_t i = 0; i < corners && good; i++) {
        if (!takes_part(work, i, 0)) continue;
        number_in_group(work, i, &number); /* is there */
        *normal_of(work, i) = (uint32_t)before + number;
    }
    cs_array_free(&sums);
    return good;
}

/* ----- By angle ----- */

/* Corners by place, as a counting sort does it. */
static int sort_by_place(smoothing *work)
{
    const size_t corners = 3 * work->model->triangles.count, places = work->places.keys.count;
    work->first = calloc(places + 2, sizeof *work->first);
    work->order = malloc((corners + 1) * sizeof *work->order);
    if (work->first == NULL || work->order == NULL) return 0;
    for (size_t i = 0; i < corners; i++)
        work->first[work->parts[i].place + 2]++;
    for (size_t p = 2; p < places + 2; p++)
        work->first[p] += work->first[p - 1];
    for (size_t i = 0; i < corners; i++)
        work->order[work->first[work->parts[i].place + 1]++] = (uint32_t)i;
    return 1;
}

static void sum_around(const smoothing *work, size_t corner, float cosine, double *sum)
{
    const part *own = &work->parts[corner];
    const uint32_t first = work->first[own->place], last = work->first[own->place + 1];
    sum[0] = sum[1] = sum[2] = 0.0;
    for (uint32_t i = first; i < last && last - first <= MOST_NEIGHBOURS; i++) {
        const part *other = &work->parts[work->order[i]];
        const int together = cs_vec_dot(own->normal, other->normal) >= cosine;
        for (int axis = 0; axis < 3 && together; axis++)
            sum[axis] += (double)other->weight * (double)other->normal[axis];
    }
}

static int smooth_by_angle(smoothing *work, double degrees)
{
    const size_t corners = 3 * work->model->triangles.count, before = work->model->normals.count;
    const float cosine = (float)cos(degrees * degrees_in_radians) - 1e-6f;
    if (!sort_by_place(work)) return 0;
    for (size_t i = 0; i < corners; i++) {
        double sum[3];
        float normal[3];
        if (!takes_part(work, i, 1)) continue;
        sum_around(work, i, cosine, sum);
        if (!put_normal(sum, normal)) continue;
        const uint32_t number = cs_index_map_add(&work->kinds, normal);
        if (number == UINT32_MAX) return 0;
        *normal_of(work, i) = (uint32_t)before + number;
    }
    const cs_array *kinds = &work->kinds.keys;
    void *normals = cs_model_extend(&work->model->normals, kinds->count);
    if (normals == NULL) return 0;
    if (kinds->count > 0) memcpy(normals, kinds->items, kinds->count * kinds->item_size);
    return 1;
}

static int is_needed(const cs_model *model, int by_angle)
{
    const cs_model_triangle *triangles = model->triangles.items;
    for (size_t i = 0; i < model->triangles.count; i++)
        if (lacks_normals(&triangles[i]) && (by_angle || triangles[i].group != 0)) return 1;
    return 0;
}

clshear_status cs_model_smooth(cs_model *model, double degrees, cs_error *error)
{
    const int by_angle = degrees >= 0.0;
    if (!is_needed(model, by_angle)) return CLSHEAR_OK;
    smoothing work = {.model = model};
    cs_index_map_init(&work.places, 3 * sizeof(double));
    cs_index_map_init(&work.kinds, by_angle ? 3 * sizeof(float) : 2 * sizeof(uint32_t));
    work.parts = malloc(3 * model->triangles.count * sizeof *work.parts);
    const int good = work.parts != NULL && find_places(&work, by_angle) &&
                     (by_angle ? smooth_by_angle(&work, degrees) : smooth_groups(&work));
    free(work.parts);
    free(work.first);
    free(work.order);
    cs_index_map_free(&work.places);
    cs_index_map_free(&work.kinds);
    return good ? CLSHEAR_OK : cs_model_full(model, error);
}
