/* The flattened hierarchy and its traversal, against Embree. */
#include "support.h"

#include <math.h>

#include "accel/accel.h"
#include "accel/wide.h"
#include "base/vec.h"
#include "clshear/device/hash.h"
#include "device/device.h"
#include "kernels/features.h"
#include "meshes.h"

enum {
    RAYS = 1 << 16
};

static cs_error error;

typedef struct fixture {
    cs_scene scene;
    cs_accel *accel;
    cs_flat_bvh bvh;
    cs_wide_bvh wide;
} fixture;

/* What walks: packets of up to 16 rays, or each ray by itself. */
enum {
    ALONE = 32 /* added to the width of packets whose rays walk alone */
};

static void build(fixture *made, const char *mesh, size_t triangles)
{
    memset(made, 0, sizeof *made);
    cs_scene_init(&made->scene);
    assert_int_equal(test_make_mesh(mesh, triangles, &made->scene, &error), CLSHEAR_OK);
    assert_int_equal(cs_accel_create(&made->scene, 0, &made->accel, &error), CLSHEAR_OK);
    assert_int_equal(cs_accel_build_bvh(made->accel, &made->bvh, &error), CLSHEAR_OK);
    assert_int_equal(cs_wide_bvh_make(made->bvh.nodes.items, made->bvh.nodes.count,
                                      made->bvh.triangles.items, &made->wide, &error),
                     CLSHEAR_OK);
}

static void destroy(fixture *made)
{
    cs_flat_bvh_free(&made->bvh);
    cs_wide_bvh_free(&made->wide);
    cs_accel_free(made->accel);
    cs_scene_free(&made->scene);
}

/* Traces RAYS rays (3 planes of origins, 3 of directions) with the kernel, in packets of `width`
 * or, with ALONE added, alone. `distances` holds the length of each ray, and receives the distance
 * of its hit, or a negative number if something blocks it. */
static void trace_device(const fixture *made, int width, int any_hit, const float *rays,
                         float *distances)
{
    cs_device *device = NULL;
    cs_buffer *buffers[6] = {0};
    const uint32_t count = RAYS;
    const size_t plane = RAYS * sizeof(float);
    const int alone = width > ALONE, packet = alone ? width - ALONE : width;
    const cs_u32 features = alone ? CS_FEATURE_PATHS | CS_FEATURE_WIDE : 0u;
    const cs_array *nodes = alone ? &made->wide.nodes : &made->bvh.nodes;
    const cs_array *leaves = alone ? &made->wide.leaves : &made->bvh.triangles;
    assert_int_equal(cs_device_open(NULL, 0, packet, &device, &error), CLSHEAR_OK);
    const void *sources[6] = {rays, rays + 3 * RAYS, distances, NULL, nodes->items, leaves->items};
    const size_t sizes[6] = {3 * plane,
                             3 * plane,
                             plane,
                             plane,
                             nodes->count * nodes->item_size,
                             leaves->count * leaves->item_size};
    cs_argument arguments[8] = {{.value = &count, .size = 4}, {.value = &any_hit, .size = 4}};
    for (int i = 0; i < 6; i++) {
        assert_int_equal(cs_buffer_create(device, sizes[i], sources[i], &buffers[i], &error),
                         CLSHEAR_OK);
        arguments[2 + i].buffer = buffers[i];
    }
    assert_int_equal(CS_RUN_WITH(device, TRACE, features, RAYS / (size_t)packet, arguments, &error),
                     CLSHEAR_OK);
    assert_int_equal(cs_buffer_read(buffers[2], 0, plane, distances, &error), CLSHEAR_OK);
    for (int i = 0; i < 6; i++)
        cs_buffer_free(buffers[i]);
    cs_device_close(device);
}

/* Distance of the nearest hit, from a test of every triangle in double precision. */
static double nearest_by_hand(const cs_scene *scene, const double *o, const double *d)
{
    const uint32_t(*indices)[3] = scene->indices.items;
    const float(*positions)[3] = scene->positions.items;
    double nearest = INFINITY;
    for (size_t i = 0; i < scene->indices.count; i++) {
        const float *first = positions[indices[i][0]];
        double e1[3], e2[3], n[3], c[3], q[3];
        cs_vec_subtract_double(positions[indices[i][1]], first, e1);
        cs_vec_subtract_double(positions[indices[i][2]], first, e2);
        for (int axis = 0; axis < 3; axis++)
            c[axis] = (double)first[axis] - o[axis];
        cs_vec_cross_double(e1, e2, n);
        cs_vec_cross_double(c, d, q);
        const double along = cs_vec_dot_double(n, d);
        const double u = cs_vec_dot_double(q, e2) / along;
        const double w = -cs_vec_dot_double(q, e1) / along;
        const double t = cs_vec_dot_double(n, c) / along;
        if (u >= 0 && w >= 0 && u + w <= 1 && t > 0 && t < nearest) nearest = t;
    }
    return nearest;
}

static void make_random_rays(float *rays, float reach, float *distances)
{
    for (cs_u32 i = 0; i < RAYS; i++) {
        for (cs_u32 axis = 0; axis < 3; axis++) {
            rays[axis * RAYS + i] = (cs_f32)(cs_key(i, axis) >> 8) * (1.0f / 16777216.0f);
            rays[(3 + axis) * RAYS + i] =
                (cs_f32)(cs_key(i, 3 + axis) >> 8) * (2.0f / 16777216.0f) - 1.0f;
        }
        distances[i] = reach;
    }
}

/* All packet widths and rays alone, closest hit and any hit, against a test of every triangle. Rays
 * within rounding of an edge may differ: 1 in 10 000 is allowed. */
static void hits_equal_brute_force(void **state)
{
    (void)state;
    const int widths[] = {1, 4, 8, 16, ALONE + 8, ALONE + 16};
    float *rays = malloc(6 * RAYS * sizeof *rays), *found = malloc(RAYS * sizeof *found);
    fixture made;
    build(&made, "box", 0);
    double *truth = malloc(RAYS * sizeof *truth);
    make_random_rays(rays, INFINITY, found);
    for (cs_u32 i = 0; i < RAYS; i++) {
        double o[3], d[3];
        for (cs_u32 axis = 0; axis < 3; axis++) {
            o[axis] = (double)rays[axis * RAYS + i];
            d[axis] = (double)rays[(3 + axis) * RAYS + i];
        }
        truth[i] = nearest_by_hand(&made.scene, o, d);
    }
    for (int w = 0; w < 5; w++) {
        cs_u32 wrong = 0, blocked_wrong = 0;
        make_random_rays(rays, INFINITY, found);
        trace_device(&made, widths[w], 0, rays, found);
        for (cs_u32 i = 0; i < RAYS; i++)
            wrong += isfinite(truth[i]) ? !(fabs(found[i] - truth[i]) < 1e-4 * (truth[i] + 0.01))
                                        : isfinite(found[i]);
        make_random_rays(rays, 0.4f, found);
        trace_device(&made, widths[w], 1, rays, found);
        for (cs_u32 i = 0; i < RAYS; i++)
            blocked_wrong += (found[i] < 0.0f) != (truth[i] < (double)0.4f);
        assert_at_most(wrong, RAYS / 10000);
        assert_at_most(blocked_wrong, RAYS / 10000);
    }
    destroy(&made);
    free(rays);
    free(found);
    free(truth);
}

/* Rays through the middles of 256 x 256 pixels. */
static void make_camera_rays(const cs_camera *camera, float *rays)
{
    for (cs_u32 i = 0; i < RAYS; i++) {
        const float direction[3] = {((cs_f32)(i % 256) + 0.5f - 128.0f) * camera->pixel_width,
                                    -((cs_f32)(i / 256) + 0.5f - 128.0f) * camera->pixel_width,
                                    -1.0f};
        for (cs_u32 axis = 0; axis < 3; axis++) {
            rays[axis * RAYS + i] = camera->eye[axis];
            rays[(3 + axis) * RAYS + i] = direction[axis];
        }
    }
}

/* Camera rays of a pinhole picture of many triangles: the kernel's distance equals Embree's depth,
 * except for rays that graze an edge. */
static void hits_equal_embree(void **state)
{
    (void)state;
    const char *const meshes[] = {"spheres", "terrain"};
    const cs_camera camera = {.eye = {0.5f, 0.5f, 2.2f},
                              .right = {1, 0, 0},
                              .down = {0, -1, 0},
                              .forward = {0, 0, -1},
                              .focal_distance = 1.0f,
                              .pixel_width = 0.8f / 256.0f,
                              .centre_px = {128, 128}};
    const int window[4] = {0, 256, 0, 256};
    float *rays = malloc(6 * RAYS * sizeof *rays);
    cs_depth *depth = malloc(RAYS * sizeof *depth);
    float *found = malloc(RAYS * sizeof *found);
    for (int k = 0; k < 2; k++) {
        fixture made;
        cs_u32 wrong = 0, seen = 0;
        build(&made, meshes[k], 60000);
        assert_int_equal(cs_accel_depth(made.accel, NULL, &camera, NULL, window, 0, depth, &error),
                         CLSHEAR_OK);
        make_camera_rays(&camera, rays);
        for (cs_u32 i = 0; i < RAYS; i++)
            found[i] = INFINITY;
        trace_device(&made, 8, 0, rays, found);
        for (cs_u32 i = 0; i < RAYS; i++) {
            seen += isfinite(depth[i].centre);
            wrong += found[i] != depth[i].centre &&
                     !(fabsf(found[i] - depth[i].centre) < 1e-4f * depth[i].centre);
        }
        assert_above(seen, RAYS / 2);
        assert_at_most(wrong, RAYS / 10000);
        assert_below(made.bvh.depth, CS_STACK);
        destroy(&made);
    }
    free(rays);
    free(depth);
    free(found);
}

/* Checks that every triangle is in a leaf, every node is reached once, and children lie inside
 * their boxes. */
static cs_u32 check_subtree(const cs_flat_bvh *bvh, cs_u32 reference, const float (*box)[2],
                            unsigned char *seen)
{
    const cs_node *nodes = bvh->nodes.items;
    const cs_triangle *triangles = bvh->triangles.items;
    if (reference & CS_LEAF) {
        cs_u32 first = reference & ((1u << CS_LEAF_SHIFT) - 1u),
               last = first + (reference >> 27 & 7u);
        for (cs_u32 i = first; i <= last; i++)
            seen[triangles[i].face] = 1;
        return 0;
    }
    cs_u32 count = 1;
    for (int side = 0; side < 2; side++) {
        const float(*inner)[2] = nodes[reference].bounds[side];
        for (int axis = 0; axis < 3 && box != NULL; axis++)
            assert_true(inner[axis][0] >= box[axis][0] - 1e-5f &&
                        inner[axis][1] <= box[axis][1] + 1e-5f);
        count += check_subtree(bvh, nodes[reference].child[side], inner, seen);
    }
    return count;
}

static void hierarchy_is_complete(void **state)
{
    (void)state;
    fixture made;
    build(&made, "spheres", 20000);
    unsigned char *seen = calloc(made.scene.indices.count, 1);
    cs_u32 count = check_subtree(&made.bvh, 0, NULL, seen);
    assert_int_equal(count, made.bvh.nodes.count);
    for (size_t i = 0; i < made.scene.indices.count; i++)
        assert_true(seen[i]);
    free(seen);
    destroy(&made);
}

/* Rays alone in many triangles find what packets find, nearest hit and any hit. Both compute
 * distances alike, so that only boxes could make a difference, and they hold their triangles
 * whatever is rounded: 1 in 10 000 is allowed, as against other walks. */
static void alone_as_in_packets(void **state)
{
    (void)state;
    const char *const meshes[] = {"spheres", "terrain"};
    const float reaches[] = {INFINITY, 0.3f};
    float *rays = malloc(6 * RAYS * sizeof *rays), *packets = malloc(RAYS * sizeof *packets);
    float *alone = malloc(RAYS * sizeof *alone);
    for (int k = 0; k < 2; k++) {
        const int width = k == 0 ? 8 : 16;
        fixture made;
        build(&made, meshes[k], 60000);
        for (int any_hit = 0; any_hit < 2; any_hit++) {
            cs_u32 different = 0, met = 0;
            make_random_rays(rays, reaches[any_hit], packets);
            trace_device(&made, width, any_hit, rays, packets);
            make_random_rays(rays, reaches[any_hit], alone);
            trace_device(&made, ALONE + width, any_hit, rays, alone);
            for (cs_u32 i = 0; i < RAYS; i++) {
                different += alone[i] != packets[i];
                met += packets[i] != reaches[any_hit];
            }
            assert_above(met, RAYS / 20);
            assert_at_most(different, RAYS / 10000);
        }
        destroy(&made);
    }
    free(rays);
    free(packets);
    free(alone);
}

/* A box of the wide hierarchy and those around it. */
typedef struct box_chain {
    const struct box_chain *outer;
    double box[3][2];
} box_chain;

/* Whether place `i` of a leaf is a triangle. */
static int is_in_leaf(const cs_wide_leaf *leaf, cs_u32 i, const cs_triangle *triangle)
{
    int same = 1;
    for (int axis = 0; axis < 3; axis++)
        same &= leaf->corner[axis][i] == triangle->corner[axis] &&
                leaf->edge1[axis][i] == triangle->edge1[axis] &&
                leaf->edge2[axis][i] == triangle->edge2[axis];
    return same;
}

static void check_wide_leaf(const fixture *made, const cs_wide_leaf *leaf, const box_chain *inner,
                            unsigned char *seen)
{
    const cs_triangle *triangles = made->bvh.triangles.items;
    for (cs_u32 i = 0; i < CS_WIDE_LEAF; i++) {
        const cs_triangle *triangle = triangles + leaf->first + i;
        if (leaf->first + i >= made->bvh.triangles.count || !is_in_leaf(leaf, i, triangle)) {
            assert_true(i > 0 && is_in_leaf(leaf, i, triangle - 1)); /* the last one, repeated */
            break;
        }
        for (const box_chain *at = inner; at != NULL; at = at->outer)
            for (int axis = 0; axis < 3; axis++) {
                const double a = (double)triangle->corner[axis];
                const double b = a + (double)triangle->edge1[axis];
                const double c = a + (double)triangle->edge2[axis];
                assert_true(fmin(a, fmin(b, c)) > at->box[axis][0] - 1e-6);
                assert_true(fmax(a, fmax(b, c)) < at->box[axis][1] + 1e-6);
            }
        seen[triangle->face] = 1;
    }
}

static void check_wide_node(const fixture *made, cs_u32 index, const box_chain *outer,
                            unsigned char *seen)
{
    const cs_wide_node *node = (const cs_wide_node *)made->wide.nodes.items + index;
    for (int octant = 0; octant < 8; octant++) {
        cs_u32 pushed = 0;
        for (int i = 0; i < CS_WIDE; i++)
            pushed |= 1u << (node->order[octant][i & 1] >> (i >> 1) * 4 & 15u);
        assert_int_equal(pushed, 0xffff);
    }
    for (int i = 0; i < CS_WIDE && node->child[i] != 0; i++) {
        box_chain inner = {.outer = outer};
        for (int axis = 0; axis < 3; axis++)
            for (int end = 0; end < 2; end++) {
                const cs_u32 byte = node->planes[axis][end][i / 4] >> i % 4 * 8 & 255u;
                inner.box[axis][end] = (double)node->low[axis] + (double)node->step[axis] * byte;
            }
        if (node->child[i] & CS_LEAF)
            check_wide_leaf(made,
                            (const cs_wide_leaf *)made->wide.leaves.items +
                                (node->child[i] & ~(cs_u32)CS_LEAF),
                            &inner, seen);
        else
            check_wide_node(made, node->child[i], &inner, seen);
    }
}

/* Every triangle is in a leaf of the wide hierarchy, and in the boxes of all that is above it;
 * every octant has an order of all children. */
static void wide_hierarchy_is_complete(void **state)
{
    (void)state;
    fixture made;
    build(&made, "spheres", 60000); /* more than have spatial splits */
    assert_above(made.wide.nodes.count, 1);
    unsigned char *seen = calloc(made.scene.indices.count, 1);
    check_wide_node(&made, 0, NULL, seen);
    for (size_t i = 0; i < made.scene.indices.count; i++)
        assert_true(seen[i]);
    free(seen);
    destroy(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hits_equal_brute_force),     cmocka_unit_test(hits_equal_embree),
        cmocka_unit_test(hierarchy_is_complete),      cmocka_unit_test(alone_as_in_packets),
        cmocka_unit_test(wide_hierarchy_is_complete),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
