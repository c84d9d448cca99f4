/* The binary hierarchy: Embree's rtcBuildBVH builds it, and this file flattens it for the
 * device. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel/embree.h"
#include "base/vec.h"

enum {
    LEAF_SIZE = 2, /* a packet tests two triangles at the cost of a node */
    /* Largest scene with spatial splits, in triangles: they help long triangles, but take ten times
     * as long as the rest of the build. */
    MOST_SPLIT = 1 << 14,
    MAX_DEPTH = CS_STACK - 2
};

/* A node of the tree that Embree builds. Leaves have no children. */
typedef struct build_node {
    struct build_node *child[2];
    struct RTCBounds bounds[2];
    uint32_t triangles[CS_MAX_LEAF];
    uint32_t count;
} build_node;

static void *allocate_node(RTCThreadLocalAllocator allocator)
{
    build_node *node = rtcThreadLocalAlloc(allocator, sizeof *node, 16);
    memset(node, 0, sizeof *node);
    return node;
}

static void *create_node(RTCThreadLocalAllocator allocator, unsigned children, void *user)
{
    (void)children, (void)user;
    return allocate_node(allocator);
}

static void set_children(void *node, void **children, unsigned count, void *user)
{
    (void)user;
    for (unsigned i = 0; i < count; i++)
        ((build_node *)node)->child[i] = children[i];
}

static void set_bounds(void *node, const struct RTCBounds **bounds, unsigned count, void *user)
{
    (void)user;
    for (unsigned i = 0; i < count; i++)
        ((build_node *)node)->bounds[i] = *bounds[i];
}

static void *create_leaf(RTCThreadLocalAllocator allocator,
                         const struct RTCBuildPrimitive *primitives, size_t count, void *user)
{
    (void)user;
    build_node *node = allocate_node(allocator);
    node->count = (uint32_t)count;
    for (size_t i = 0; i < count; i++)
        node->triangles[i] = primitives[i].primID;
    return node;
}

static const float *corner_of(const cs_scene *scene, uint32_t triangle, int corner)
{
    const uint32_t(*indices)[3] = scene->indices.items;
    const float(*positions)[3] = scene->positions.items;
    return positions[indices[triangle][corner]];
}

static void grow(struct RTCBounds *box, const float *point)
{
    box->lower_x = fminf(box->lower_x, point[0]);
    box->lower_y = fminf(box->lower_y, point[1]);
    box->lower_z = fminf(box->lower_z, point[2]);
    box->upper_x = fmaxf(box->upper_x, point[0]);
    box->upper_y = fmaxf(box->upper_y, point[1]);
    box->upper_z = fmaxf(box->upper_z, point[2]);
}

static struct RTCBounds empty_box(void)
{
    return (struct RTCBounds){.lower_x = INFINITY,
                              .lower_y = INFINITY,
                              .lower_z = INFINITY,
                              .upper_x = -INFINITY,
                              .upper_y = -INFINITY,
                              .upper_z = -INFINITY};
}

static void intersect_boxes(struct RTCBounds *box, const struct RTCBuildPrimitive *limit)
{
    box->lower_x = fmaxf(box->lower_x, limit->lower_x);
    box->lower_y = fmaxf(box->lower_y, limit->lower_y);
    box->lower_z = fmaxf(box->lower_z, limit->lower_z);
    box->upper_x = fminf(box->upper_x, limit->upper_x);
    box->upper_y = fminf(box->upper_y, limit->upper_y);
    box->upper_z = fminf(box->upper_z, limit->upper_z);
}

/* Computes the bounds of a triangle's parts on both sides of an axis-aligned plane. */
static void split_triangle(const struct RTCBuildPrimitive *primitive, unsigned axis, float plane,
                           struct RTCBounds *left, struct RTCBounds *right, void *user)
{
    const cs_scene *scene = user;
    *left = empty_box();
    *right = empty_box();
    for (int i = 0; i < 3; i++) {
        const float *a = corner_of(scene, primitive->primID, i);
        const float *b = corner_of(scene, primitive->primID, (i + 1) % 3);
        if (a[axis] <= plane) grow(left, a);
        if (a[axis] >= plane) grow(right, a);
        if ((a[axis] < plane) == (b[axis] < plane) || a[axis] == b[axis]) continue;
        float share = (plane - a[axis]) / (b[axis] - a[axis]);
        float crossing[3];
        for (int k = 0; k < 3; k++)
            crossing[k] = a[k] + share * (b[k] - a[k]);
        crossing[axis] = plane;
        grow(left, crossing);
        grow(right, crossing);
    }
    intersect_boxes(left, primitive);
    intersect_boxes(right, primitive);
}

static void describe_primitives(const cs_scene *scene, struct RTCBuildPrimitive *primitives)
{
    for (uint32_t i = 0; i < scene->indices.count; i++) {
        struct RTCBounds box = empty_box();
        for (int k = 0; k < 3; k++) {
            float place[3];
            cs_scene_corner(scene, i, k, 0.5f, place);
            grow(&box, place);
        }
        primitives[i] = (struct RTCBuildPrimitive){.lower_x = box.lower_x,
                                                   .lower_y = box.lower_y,
                                                   .lower_z = box.lower_z,
                                                   .upper_x = box.upper_x,
                                                   .upper_y = box.upper_y,
                                                   .upper_z = box.upper_z,
                                                   .primID = i};
    }
}

/* Copies a triangle into leaf order. */
static void flatten_triangle(const cs_scene *scene, uint32_t index, cs_triangle *triangle)
{
    const float *a = corner_of(scene, index, 0);
    const float *b = corner_of(scene, index, 1);
    const float *c = corner_of(scene, index, 2);
    memcpy(triangle->corner, a, sizeof triangle->corner);
    cs_vec_subtract(b, a, triangle->edge1);
    cs_vec_subtract(c, a, triangle->edge2);
    cs_vec_cross(triangle->edge1, triangle->edge2, triangle->normal);
    triangle->face = index;
    triangle->material = ((const uint32_t *)scene->triangle_materials.items)[index];
    triangle->flags = ((const uint8_t *)scene->triangle_flags.items)[index];
}

/* Copies a box and enlarges it a little, so that the slab test's rounding cannot lose a hit on a
 * face. */
static void flatten_box(const struct RTCBounds *box, float (*flat)[2])
{
    const float low[3] = {box->lower_x, box->lower_y, box->lower_z};
    const float high[3] = {box->upper_x, box->upper_y, box->upper_z};
    for (int axis = 0; axis < 3; axis++) {
        float margin = 5e-7f * fmaxf(fabsf(low[axis]), fabsf(high[axis]));
        flat[axis][0] = low[axis] - margin;
        flat[axis][1] = high[axis] + margin;
    }
}

/* The axis with the largest distance between the centres of the two boxes. */
static unsigned separating_axis(const float (*first)[2], const float (*second)[2], int *ascending)
{
    unsigned best = 0;
    float best_distance = -1.0f;
    for (unsigned axis = 0; axis < 3; axis++) {
        float distance = second[axis][0] + second[axis][1] - first[axis][0] - first[axis][1];
        if (fabsf(distance) <= best_distance) continue;
        best_distance = fabsf(distance);
        best = axis;
        *ascending = distance >= 0.0f;
    }
    return best;
}

typedef struct flattening {
    const cs_scene *scene;
    cs_flat_bvh *bvh;
    int failed; /* 1 when out of memory, or if the tree is too deep */
} flattening;

/* Appends the subtree and returns its reference. */
static uint32_t flatten(flattening *work, const build_node *node, int depth)
{
    cs_flat_bvh *bvh = work->bvh;
    if (depth > bvh->depth) bvh->depth = depth;
    if (node->count > 0) {
        size_t first = bvh->triangles.count;
        cs_triangle *triangles = cs_array_extend(&bvh->triangles, node->count);
        if (triangles == NULL) work->failed = 1;
        for (uint32_t i = 0; i < node->count && !work->failed; i++)
            flatten_triangle(work->scene, node->triangles[i], &triangles[i]);
        return (uint32_t)CS_LEAF | (node->count - 1) << CS_LEAF_SHIFT | (uint32_t)first;
    }
    size_t index = bvh->nodes.count;
    if (cs_array_extend(&bvh->nodes, 1) == NULL || depth >= MAX_DEPTH) work->failed = 1;
    if (work->failed) return 0;
    cs_node flat = {0};
    int ascending = 1;
    flatten_box(&node->bounds[0], flat.bounds[0]);
    flatten_box(&node->bounds[1], flat.bounds[1]);
    flat.axis = separating_axis((const float(*)[2])flat.bounds[0],
                                (const float(*)[2])flat.bounds[1], &ascending);
    for (int side = 0; side < 2; side++) {
        int source = ascending ? side : 1 - side;
        flatten_box(&node->bounds[source], flat.bounds[side]);
        flat.child[side] = flatten(work, node->child[source], depth + 1);
    }
    ((cs_node *)bvh->nodes.items)[index] = flat;
    return (uint32_t)index;
}

/* Makes a root with an empty second child, for scenes of a single leaf. */
static build_node wrap_leaf(build_node *leaf, const struct RTCBuildPrimitive *primitives)
{
    static build_node nothing;
    build_node root = {.child = {leaf, &nothing}};
    root.bounds[0] = empty_box();
    for (uint32_t i = 0; i < leaf->count; i++) {
        grow(&root.bounds[0], &primitives[i].lower_x);
        grow(&root.bounds[0], &primitives[i].upper_x);
    }
    return root;
}

static clshear_status flatten_tree(const cs_scene *scene, build_node *root,
                                   const struct RTCBuildPrimitive *primitives, cs_flat_bvh *bvh,
                                   cs_error *error)
{
    flattening work = {scene, bvh, 0};
    bvh->nodes.item_size = sizeof(cs_node);
    bvh->triangles.item_size = sizeof(cs_triangle);
    if (root->count > 0) {
        build_node wrapped = wrap_leaf(root, primitives);
        cs_node *flat = cs_array_extend(&bvh->nodes, 1);
        if (flat == NULL) {
            work.failed = 1;
        } else {
            flatten_box(&wrapped.bounds[0], flat->bounds[0]);
            for (int axis = 0; axis < 3; axis++) {
                flat->bounds[1][axis][0] = 1e30f;
                flat->bounds[1][axis][1] = -1e30f;
            }
            uint32_t leaf = flatten(&work, root, 1);
            ((cs_node *)bvh->nodes.items)->child[0] = leaf;
            ((cs_node *)bvh->nodes.items)->child[1] = leaf;
        }
    } else {
        flatten(&work, root, 0);
    }
    if (bvh->depth >= MAX_DEPTH)
        return cs_fail(error, CLSHEAR_BAD_FILE,
                       "the hierarchy is deeper than %d levels: the mesh has too many triangles in "
                       "one place",
                       MAX_DEPTH);
    if (work.failed)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for the hierarchy");
    cs_array_trim(&bvh->nodes);
    cs_array_trim(&bvh->triangles);
    return CLSHEAR_OK;
}

void cs_flat_bvh_free(cs_flat_bvh *bvh)
{
    cs_array_free(&bvh->nodes);
    cs_array_free(&bvh->triangles);
    cs_array_free(&bvh->node_steps);
    cs_array_free(&bvh->triangle_steps);
}

clshear_status cs_accel_build_bvh(const cs_accel *accel, cs_flat_bvh *bvh, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const cs_scene *scene = accel->scene;
    const size_t count = scene->indices.count;
    const int split = count <= MOST_SPLIT && !cs_scene_moves(scene);
    const size_t capacity = split ? 2 * count + 64 : count;
    RTCBVH builder = rtcNewBVH(accel->device);
    struct RTCBuildPrimitive *primitives = aligned_alloc(32, capacity * sizeof *primitives);
    CS_REQUIRE(builder != NULL && primitives != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for the hierarchy of %zu triangles", count);
    CS_REQUIRE(capacity < 1u << CS_LEAF_SHIFT, CLSHEAR_BAD_FILE,
               "%zu triangles are too many for one scene; there must be fewer than %u", count,
               1u << CS_LEAF_SHIFT);
    describe_primitives(scene, primitives);
    struct RTCBuildArguments arguments = rtcDefaultBuildArguments();
    arguments.byteSize = sizeof arguments;
    arguments.buildQuality = split ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM;
    arguments.maxBranchingFactor = 2;
    arguments.maxDepth = MAX_DEPTH;
    arguments.sahBlockSize = 1;
    arguments.minLeafSize = 1;
    arguments.maxLeafSize = LEAF_SIZE;
    arguments.bvh = builder;
    arguments.primitives = primitives;
    arguments.primitiveCount = count;
    arguments.primitiveArrayCapacity = capacity;
    arguments.createNode = create_node;
    arguments.setNodeChildren = set_children;
    arguments.setNodeBounds = set_bounds;
    arguments.createLeaf = create_leaf;
    arguments.splitPrimitive = split_triangle;
    arguments.userPtr = (void *)(uintptr_t)scene;
    build_node *root = rtcBuildBVH(&arguments);
    CS_REQUIRE(root != NULL, CLSHEAR_OUT_OF_MEMORY, "Embree cannot build the hierarchy");
    CS_TRY(flatten_tree(scene, root, primitives, bvh, error));
    if (cs_scene_moves(scene)) CS_TRY(cs_flat_bvh_refit(scene, bvh, error));
done:
    free(primitives);
    if (builder != NULL) rtcReleaseBVH(builder);
    if (status != CLSHEAR_OK) cs_flat_bvh_free(bvh);
    return status;
}
