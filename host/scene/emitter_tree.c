/* The tree of emitters, built from the root by the orientation heuristic of Conty Estevez & Kulla
 * 2018 (sections 4.1 to 4.4), with cones of triangles that shine on both sides. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/vec.h"
#include "scene/emitters.h"

enum {
    BUCKETS = 12
};

/* What bounds the light of some triangles. */
typedef struct bound {
    double low[3];
    double high[3];
    double axis[3]; /* unit */
    double angle;   /* half angle of the cone of normals, 0 to pi/2 */
    double power;
    size_t count;
} bound;

typedef struct item {
    bound bound;
    double middle[3];
    uint32_t emitter;
} item;

typedef struct builder {
    item *items;
    cs_emitter_node *nodes;
    cs_emitter *table;
    uint32_t used; /* nodes */
} builder;

static const double right_angle = 1.57079632679490;

/* A triangle at part `time` of its step; NULL: at rest. */
static bound bound_at(const cs_emitter *emitter, const cs_triangle_step *step, double time)
{
    static const cs_triangle_step rest = {.padding = {0}};
    const cs_triangle_step *by = step != NULL ? step : &rest;
    bound made = {.count = 1, .power = (double)emitter->area * (double)emitter->luminance};
    double e1[3], e2[3];
    for (int i = 0; i < 3; i++) {
        const double a = (double)emitter->corner[i] + time * (double)by->corner[i];
        e1[i] = (double)emitter->edge1[i] + time * (double)by->edge1[i];
        e2[i] = (double)emitter->edge2[i] + time * (double)by->edge2[i];
        made.low[i] = a + fmin(0.0, fmin(e1[i], e2[i]));
        made.high[i] = a + fmax(0.0, fmax(e1[i], e2[i]));
    }
    cs_vec_cross_double(e1, e2, made.axis);
    const double length = sqrt(cs_vec_dot_double(made.axis, made.axis));
    for (int i = 0; i < 3; i++)
        made.axis[i] /= length > 0.0 ? length : 1.0;
    return made;
}

/* Makes the cone hold another one or its opposite. */
static void join_cone(bound *to, const bound *from)
{
    const bound *wide = to->angle >= from->angle ? to : from, *narrow = wide == to ? from : to;
    double cosine = cs_vec_dot_double(wide->axis, narrow->axis), side[3];
    const double sign = cosine < 0.0 ? -1.0 : 1.0;
    const double apart = acos(fmin(fabs(cosine), 1.0));
    const double angle = 0.5 * (wide->angle + apart + narrow->angle), turn = angle - wide->angle;
    double axis[3];
    memcpy(axis, wide->axis, sizeof axis);
    if (apart + narrow->angle <= wide->angle) {
        to->angle = wide->angle;
    } else {
        to->angle = fmin(angle, right_angle);
        for (int i = 0; i < 3; i++)
            side[i] = sign * narrow->axis[i] - fabs(cosine) * axis[i];
        const double length = sqrt(cs_vec_dot_double(side, side));
        for (int i = 0; i < 3 && length > 0.0; i++)
            axis[i] = cos(turn) * axis[i] + sin(turn) * side[i] / length;
    }
    memcpy(to->axis, axis, sizeof axis);
}

static void join(bound *to, const bound *from)
{
    if (to->count == 0) {
        *to = *from;
        return;
    }
    for (int i = 0; i < 3; i++) {
        to->low[i] = fmin(to->low[i], from->low[i]);
        to->high[i] = fmax(to->high[i], from->high[i]);
    }
    join_cone(to, from);
    to->power += from->power;
    to->count += from->count;
}

/* A triangle at all times: places are between their ends, and normals nearly so. */
static bound bound_of(const cs_emitter *emitter, const cs_triangle_step *step)
{
    bound all = bound_at(emitter, step, 0.0);
    for (int half = 1; half <= 2 && step != NULL; half++) {
        const bound later = bound_at(emitter, step, 0.5 * half);
        join(&all, &later);
    }
    all.power = (double)emitter->area * (double)emitter->luminance;
    all.count = 1;
    return all;
}

/* Power times the measure of the directions that it shines to, times the surface of the box. */
static double cost_of(const bound *b)
{
    const double sine = sin(b->angle), end = fmin(b->angle + right_angle, 2.0 * right_angle);
    double side[3], square = 0.0;
    for (int i = 0; i < 3; i++) {
        side[i] = b->high[i] - b->low[i];
        square += side[i] * side[i];
    }
    const double area = 2.0 * (side[0] * side[1] + side[1] * side[2] + side[2] * side[0]);
    const double cone = 4.0 * right_angle * (1.0 - cos(b->angle)) +
                        right_angle * (2.0 * end * sine - cos(b->angle - 2.0 * end) -
                                       2.0 * b->angle * sine + cos(b->angle));
    return b->power * cone * (area + 1e-9 * square);
}

static int bucket_of(const item *one, int axis, const double *low, const double *high)
{
    const double part = (one->middle[axis] - low[axis]) / (high[axis] - low[axis]);
    const int bucket = (int)(part * BUCKETS);
    return bucket < 0 ? 0 : bucket >= BUCKETS ? BUCKETS - 1 : bucket;
}

/* Cost of the best of the cuts between buckets across an axis, of which `cut` becomes the number of
 * buckets below it. */
static double best_cut(const item *items, size_t count, int axis, const double *low,
                       const double *high, int *cut)
{
    bound buckets[BUCKETS] = {0}, above[BUCKETS], below = {0};
    double best = INFINITY;
    for (size_t i = 0; i < count; i++)
        join(&buckets[bucket_of(&items[i], axis, low, high)], &items[i].bound);
    above[BUCKETS - 1] = buckets[BUCKETS - 1];
    for (int b = BUCKETS - 2; b > 0; b--) {
        above[b] = above[b + 1];
        if (buckets[b].count > 0) join(&above[b], &buckets[b]);
    }
    for (int b = 0; b + 1 < BUCKETS; b++) {
        if (buckets[b].count > 0) join(&below, &buckets[b]);
        if (below.count == 0 || above[b + 1].count == 0) continue;
        const double cost = cost_of(&below) + cost_of(&above[b + 1]);
        if (cost < best) {
            best = cost;
            *cut = b + 1;
        }
    }
    return best;
}

/* Sorts the items into two parts, neither empty; returns the size of the first. */
static size_t divide(item *items, size_t count)
{
    double low[3], high[3], widest = 0.0, best = INFINITY;
    int axis = -1, cut = 0;
    memcpy(low, items[0].middle, sizeof low);
    memcpy(high, low, sizeof high);
    for (size_t i = 1; i < count; i++)
        for (int a = 0; a < 3; a++) {
            low[a] = fmin(low[a], items[i].middle[a]);
            high[a] = fmax(high[a], items[i].middle[a]);
        }
    for (int a = 0; a < 3; a++)
        widest = fmax(widest, high[a] - low[a]);
    for (int a = 0; a < 3; a++) {
        int its_cut = 0;
        if (!(high[a] - low[a] > 0.0)) continue;
        /* Thin slices make long boxes. */
        const double cost =
            best_cut(items, count, a, low, high, &its_cut) * widest / (high[a] - low[a]);
        if (cost < best) {
            best = cost;
            axis = a;
            cut = its_cut;
        }
    }
    if (axis < 0) return count / 2; /* all in one place */
    size_t first = 0;
    for (size_t i = 0; i < count; i++)
        if (bucket_of(&items[i], axis, low, high) < cut) {
            const item moved = items[i];
            items[i] = items[first];
            items[first++] = moved;
        }
    return first;
}

/* Rounds so that nothing is left out. */
static void write_node(const bound *b, cs_emitter_node *node)
{
    double square = 0.0;
    for (int i = 0; i < 3; i++) {
        const double half = 0.5 * (b->high[i] - b->low[i]);
        node->centre[i] = (float)(0.5 * (b->high[i] + b->low[i]));
        node->axis[i] = (float)b->axis[i];
        square += half * half;
    }
    node->radius = (float)(sqrt(square) * (1.0 + 1e-6));
    node->cosine = (float)fmax(cos(b->angle) - 1e-6, 0.0);
    node->power = (float)b->power;
}

/* Makes node `at` of some items, and all below it. */
static void build(builder *work, item *items, size_t count, uint32_t at)
{
    bound all = {0};
    for (size_t i = 0; i < count; i++)
        join(&all, &items[i].bound);
    write_node(&all, &work->nodes[at]);
    if (count == 1) {
        work->nodes[at].child = (cs_u32)CS_LEAF | items[0].emitter;
        work->table[items[0].emitter].node = at;
        return;
    }
    const uint32_t child = work->used;
    const size_t first = divide(items, count);
    work->used += 2;
    work->nodes[at].child = child;
    work->nodes[child].parent = work->nodes[child + 1].parent = at;
    build(work, items, first, child);
    build(work, items + first, count - first, child + 1);
}

clshear_status cs_emitter_tree_build(const cs_scene *scene, cs_array *table, cs_array *nodes,
                                     cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    builder work = {.table = table->items, .used = CS_EMITTER_ROOT + 1};
    nodes->item_size = sizeof(cs_emitter_node);
    work.items = malloc(table->count * sizeof *work.items);
    work.nodes = cs_array_extend(nodes, 2 * table->count);
    CS_REQUIRE(work.items != NULL && work.nodes != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for %zu emissive triangles", table->count);
    for (size_t i = 0; i < table->count; i++) {
        item *one = &work.items[i];
        cs_triangle_step step;
        const int moves = scene != NULL && cs_scene_moves(scene);
        if (moves) step = cs_scene_step(scene, work.table[i].face);
        one->bound = bound_of(&work.table[i], moves ? &step : NULL);
        one->emitter = (uint32_t)i;
        for (int a = 0; a < 3; a++)
            one->middle[a] = 0.5 * (one->bound.low[a] + one->bound.high[a]);
    }
    build(&work, work.items, table->count, CS_EMITTER_ROOT);
done:
    free(work.items);
    return status;
}
