/* The wide hierarchy: nodes of the binary one, collapsed so that a walk costs least, and their
 * planes as bytes (Ylitie, Karras & Laine 2017, sections 3.1 and 3.2). */
#include "accel/wide.h"

#include <math.h>
#include <string.h>

/* What a ray that meets a box pays for its node and for its triangles, in any unit. */
#define NODE_COST 1.0f
#define LEAF_COST 1.0f

/* Triangles of a leaf and children of a node, on average over models: 2.9 to 3.1 and 11 to 13. */
#define MEAN_TRIANGLES 2.9
#define MEAN_CHILDREN 12.0

/* A part of the binary hierarchy that becomes a child. */
typedef struct part {
    cs_u32 reference; /* of the binary hierarchy */
    cs_f32 box[3][2]; /* axis, low and high */
} part;

/* How the cheapest forests below a binary node are made: of 2 to CS_WIDE trees in all, the number
 * that its child 0 has, or 0 where a single one costs less. */
typedef struct choice {
    uint8_t of_first[CS_WIDE + 1];
    uint8_t is_leaf; /* whether the single one is a leaf */
} choice;

typedef struct widening {
    const cs_node *nodes;
    const cs_triangle *triangles;
    cs_wide_bvh *wide;
    choice *choices; /* of each binary node */
    size_t stack;    /* entries that a walk needs at most */
    int failed;      /* 1 when out of memory */
} widening;

/* The cheapest forests below a reference, and its triangles. */
typedef struct forests {
    float cost[CS_WIDE + 1]; /* of up to so many trees, from 1 on */
    cs_u32 triangles;
} forests;

static int is_leaf(cs_u32 reference)
{
    return (reference & (cs_u32)CS_LEAF) != 0;
}

/* The first of the consecutive triangles below a reference, and their number. */
static cs_u32 find_triangles(const widening *work, cs_u32 reference, cs_u32 *count)
{
    if (is_leaf(reference)) {
        *count = (reference >> CS_LEAF_SHIFT & 7u) + 1u;
        return reference & ((1u << CS_LEAF_SHIFT) - 1u);
    }
    cs_u32 others;
    const cs_u32 *child = work->nodes[reference].child;
    const cs_u32 first[2] = {find_triangles(work, child[0], count),
                             find_triangles(work, child[1], &others)};
    *count += others;
    return first[0] < first[1] ? first[0] : first[1];
}

/* Half of a box's surface: rays meet it in proportion. */
static float surface(const cs_f32 (*box)[2])
{
    const float x = box[0][1] - box[0][0], y = box[1][1] - box[1][0], z = box[2][1] - box[2][0];
    return x * y + y * z + z * x;
}

/* The cheapest split of `count` trees among both children; `first` gets child 0's. */
static float split_trees(const forests *below, int count, uint8_t *first)
{
    float least = INFINITY;
    for (int k = 1; k < count; k++) {
        const float cost = below[0].cost[k] + below[1].cost[count - k];
        if (cost >= least) continue;
        least = cost;
        *first = (uint8_t)k;
    }
    return least;
}

/* Finds the cheapest forests below a reference whose box is `box`. */
static void choose(widening *work, cs_u32 reference, const cs_f32 (*box)[2], forests *found)
{
    const float area = surface(box);
    if (is_leaf(reference)) {
        found->triangles = (reference >> CS_LEAF_SHIFT & 7u) + 1u;
        for (int i = 1; i <= CS_WIDE; i++)
            found->cost[i] = LEAF_COST * area;
        return;
    }
    forests below[2];
    choice *made = work->choices + reference;
    const cs_node *node = work->nodes + reference;
    for (int side = 0; side < 2; side++)
        choose(work, node->child[side], node->bounds[side], &below[side]);
    found->triangles = below[0].triangles + below[1].triangles;
    for (int i = 2; i <= CS_WIDE; i++)
        found->cost[i] = split_trees(below, i, &made->of_first[i]);
    found->cost[1] = found->cost[CS_WIDE] + NODE_COST * area;
    if (found->triangles <= CS_WIDE_LEAF && LEAF_COST * area <= found->cost[1]) {
        found->cost[1] = LEAF_COST * area;
        made->is_leaf = 1;
    }
    for (int i = 2; i <= CS_WIDE; i++) {
        if (found->cost[i] <= found->cost[1]) continue;
        found->cost[i] = found->cost[1];
        made->of_first[i] = 0;
    }
}

/* Collects the forest of `trees` trees below a node; returns their number so far. Their order is
 * that of the binary hierarchy. */
static int collect(const widening *work, cs_u32 node, int trees, part *parts, int count)
{
    const int first = work->choices[node].of_first[trees];
    for (int side = 0; side < 2; side++) {
        const cs_u32 child = work->nodes[node].child[side];
        const int share = side == 0 ? first : trees - first;
        if (share > 1 && !is_leaf(child) && work->choices[child].of_first[share] > 0) {
            count = collect(work, child, share, parts, count);
            continue;
        }
        parts[count].reference = child;
        memcpy(parts[count].box, work->nodes[node].bounds[side], sizeof parts[count].box);
        count++;
    }
    return count;
}

/* Appends the slots of the parts below `node` to `order`, near ones first for rays of an octant. */
static int order_parts(const widening *work, cs_u32 node, int octant, const part *parts, int count,
                       int *order, int ordered)
{
    for (int i = 0; i < 2; i++) {
        const int side = i ^ (octant >> work->nodes[node].axis & 1);
        const cs_u32 child = work->nodes[node].child[side];
        int slot = 0;
        while (slot < count && parts[slot].reference != child)
            slot++;
        if (slot < count)
            order[ordered++] = slot;
        else
            ordered = order_parts(work, child, octant, parts, count, order, ordered);
    }
    return ordered;
}

/* Writes the slots of all octants, far ones first. */
static void write_orders(const widening *work, cs_u32 node, const part *parts, int count,
                         cs_wide_node *wide)
{
    for (int octant = 0; octant < 8; octant++) {
        int order[CS_WIDE];
        order_parts(work, node, octant, parts, count, order, 0);
        for (int i = count; i < CS_WIDE; i++)
            order[i] = i;
        for (int i = 0; i < CS_WIDE; i++) {
            const cs_u32 slot = (cs_u32)order[CS_WIDE - 1 - i];
            wide->order[octant][i & 1] |= slot << (i >> 1) * 4;
        }
    }
}

/* Writes boxes as bytes of the box around them, all a little larger: they hold the exact ones
 * whatever the walk rounds. */
static void write_boxes(const part *parts, int count, cs_wide_node *wide)
{
    for (int axis = 0; axis < 3; axis++) {
        float low = INFINITY, high = -INFINITY;
        for (int i = 0; i < count; i++) {
            low = fminf(low, parts[i].box[axis][0]);
            high = fmaxf(high, parts[i].box[axis][1]);
        }
        const float margin = 1e-6f * (high - low) + 1e-7f * fmaxf(fabsf(low), fabsf(high)) + 1e-30f;
        const float step = (high - low + 2.0f * margin) / 255.0f * 1.000001f;
        wide->low[axis] = low - margin;
        wide->step[axis] = step;
        for (int i = 0; i < CS_WIDE; i++) {
            cs_u32 bytes[2] = {255u, 0u};
            if (i < count) {
                const float from = (parts[i].box[axis][0] - margin - wide->low[axis]) / step;
                const float to = (parts[i].box[axis][1] + margin - wide->low[axis]) / step;
                bytes[0] = (cs_u32)fmaxf(floorf(from), 0.0f);
                bytes[1] = (cs_u32)fminf(ceilf(to), 255.0f);
            }
            for (int end = 0; end < 2; end++)
                wide->planes[axis][end][i / 4] |= bytes[end] << i % 4 * 8;
        }
    }
}

/* Appends a leaf of the triangles below a reference; returns its own. */
static cs_u32 write_leaf(widening *work, cs_u32 reference)
{
    cs_u32 count;
    const cs_u32 first = find_triangles(work, reference, &count);
    const size_t index = work->wide->leaves.count;
    cs_wide_leaf *leaf = cs_array_extend(&work->wide->leaves, 1);
    if (leaf == NULL) {
        work->failed = 1;
        return 0;
    }
    leaf->first = first;
    for (cs_u32 i = 0; i < CS_WIDE_LEAF; i++) {
        const cs_triangle *triangle = work->triangles + first + (i < count ? i : count - 1);
        for (int axis = 0; axis < 3; axis++) {
            leaf->corner[axis][i] = triangle->corner[axis];
            leaf->edge1[axis][i] = triangle->edge1[axis];
            leaf->edge2[axis][i] = triangle->edge2[axis];
        }
    }
    return (cs_u32)CS_LEAF | (cs_u32)index;
}

static void write_node(widening *work, size_t index, cs_u32 node, size_t waiting);

/* The reference of a part: a node that is made, or a leaf. waiting: entries of the stack while it
 * is walked. */
static cs_u32 write_part(widening *work, const part *of, size_t waiting)
{
    if (is_leaf(of->reference) || work->choices[of->reference].is_leaf)
        return write_leaf(work, of->reference);
    const size_t index = work->wide->nodes.count;
    if (cs_array_extend(&work->wide->nodes, 1) == NULL) work->failed = 1;
    if (!work->failed) write_node(work, index, of->reference, waiting);
    return (cs_u32)index;
}

static void write_node(widening *work, size_t index, cs_u32 node, size_t waiting)
{
    part parts[CS_WIDE];
    cs_wide_node made = {0};
    const int count = collect(work, node, CS_WIDE, parts, 0);
    waiting += (size_t)count - 1;
    /* The walk writes a whole node's worth at once, above its end. */
    if (waiting + CS_WIDE + 1 > work->stack) work->stack = waiting + CS_WIDE + 1;
    write_boxes(parts, count, &made);
    write_orders(work, node, parts, count, &made);
    for (int i = 0; i < count; i++)
        made.child[i] = write_part(work, &parts[i], waiting);
    if (!work->failed) ((cs_wide_node *)work->wide->nodes.items)[index] = made;
}

void cs_wide_bvh_free(cs_wide_bvh *wide)
{
    cs_array_free(&wide->nodes);
    cs_array_free(&wide->leaves);
}

clshear_status cs_wide_bvh_make(const cs_node *nodes, size_t count, const cs_triangle *triangles,
                                cs_wide_bvh *wide, cs_error *error)
{
    static const cs_f32 anything[3][2];
    clshear_status status = CLSHEAR_OK;
    cs_array choices = {.item_size = sizeof(choice)};
    forests all;
    *wide = (cs_wide_bvh){.nodes = {.item_size = sizeof(cs_wide_node)},
                          .leaves = {.item_size = sizeof(cs_wide_leaf)}};
    CS_REQUIRE(cs_array_extend(&choices, count) != NULL && cs_array_extend(&wide->nodes, 1) != NULL,
               CLSHEAR_OUT_OF_MEMORY, "out of memory for the wide hierarchy");
    widening work = {
        .nodes = nodes, .triangles = triangles, .wide = wide, .choices = choices.items};
    choose(&work, 0, anything, &all);
    if (!work.choices[0].is_leaf) write_node(&work, 0, 0, 0);
    CS_REQUIRE(!work.failed, CLSHEAR_OUT_OF_MEMORY, "out of memory for the wide hierarchy");
    if (work.choices[0].is_leaf || work.stack > CS_WIDE_STACK) cs_wide_bvh_free(wide);
    cs_array_trim(&wide->nodes);
    cs_array_trim(&wide->leaves);
done:
    cs_array_free(&choices);
    if (status != CLSHEAR_OK) cs_wide_bvh_free(wide);
    return status;
}

double cs_wide_bvh_expected(size_t triangles)
{
    const double leaves = (double)triangles / MEAN_TRIANGLES;
    return leaves * (double)sizeof(cs_wide_leaf) +
           leaves / (MEAN_CHILDREN - 1.0) * (double)sizeof(cs_wide_node);
}
