/* Bounds that move: boxes of the triangles where the shutter opens and where it closes. Between
 * these corners move linearly, and so do the boxes, which therefore hold them at every time. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel/embree.h"

enum {
    ENDS = 2 /* of the shutter */
};

/* Boxes where the shutter opens and where it closes: axis, low and high. */
typedef struct moving_box {
    float at[ENDS][3][2];
} moving_box;

static moving_box empty_box(void)
{
    moving_box box;
    for (int end = 0; end < ENDS; end++)
        for (int axis = 0; axis < 3; axis++) {
            box.at[end][axis][0] = INFINITY;
            box.at[end][axis][1] = -INFINITY;
        }
    return box;
}

static void grow(float (*box)[2], const float *low, const float *high)
{
    for (int axis = 0; axis < 3; axis++) {
        box[axis][0] = fminf(box[axis][0], low[axis]);
        box[axis][1] = fmaxf(box[axis][1], high[axis]);
    }
}

static moving_box box_of_leaf(const cs_scene *scene, const cs_triangle *triangles, uint32_t leaf)
{
    const uint32_t first = leaf & ((1u << CS_LEAF_SHIFT) - 1u);
    const uint32_t last = first + (leaf >> CS_LEAF_SHIFT & 7u);
    moving_box box = empty_box();
    for (uint32_t i = first; i <= last; i++)
        for (int k = 0; k < 3; k++)
            for (int end = 0; end < ENDS; end++) {
                float place[3];
                cs_scene_corner(scene, triangles[i].face, k, (float)end, place);
                grow(box.at[end], place, place);
            }
    return box;
}

/* Puts a box into a node, a little larger, so that rounding cannot lose a hit on a face. */
static void store(const moving_box *box, float (*bounds)[2], float (*steps)[2])
{
    for (int axis = 0; axis < 3; axis++)
        for (int side = 0; side < 2; side++) {
            float size = 0.0f;
            for (int end = 0; end < ENDS; end++)
                size =
                    fmaxf(size, fmaxf(fabsf(box->at[end][axis][0]), fabsf(box->at[end][axis][1])));
            const float margin = side == 0 ? -1e-6f * size : 1e-6f * size;
            bounds[axis][side] = box->at[0][axis][side] + margin;
            steps[axis][side] = box->at[1][axis][side] - box->at[0][axis][side];
        }
}

/* Children come after their parents: from the last node to the first all are known. */
static void refit_nodes(const cs_scene *scene, cs_flat_bvh *bvh, moving_box *boxes)
{
    cs_node *nodes = bvh->nodes.items;
    cs_node_step *steps = bvh->node_steps.items;
    for (size_t i = bvh->nodes.count; i-- > 0;) {
        boxes[i] = empty_box();
        for (int side = 0; side < 2; side++) {
            const uint32_t child = nodes[i].child[side];
            const moving_box box =
                child & CS_LEAF ? box_of_leaf(scene, bvh->triangles.items, child) : boxes[child];
            store(&box, nodes[i].bounds[side], steps[i].bounds[side]);
            for (int end = 0; end < ENDS; end++) {
                float low[3], high[3];
                for (int axis = 0; axis < 3; axis++) {
                    low[axis] = box.at[end][axis][0];
                    high[axis] = box.at[end][axis][1];
                }
                grow(boxes[i].at[end], low, high);
            }
        }
    }
}

clshear_status cs_flat_bvh_refit(const cs_scene *scene, cs_flat_bvh *bvh, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    moving_box *boxes = malloc(bvh->nodes.count * sizeof *boxes);
    bvh->node_steps.item_size = sizeof(cs_node_step);
    bvh->triangle_steps.item_size = sizeof(cs_triangle_step);
    void *nodes = cs_array_extend(&bvh->node_steps, bvh->nodes.count);
    cs_triangle_step *triangles = cs_array_extend(&bvh->triangle_steps, bvh->triangles.count);
    CS_REQUIRE(boxes != NULL && nodes != NULL && triangles != NULL, CLSHEAR_OUT_OF_MEMORY,
               "out of memory for the hierarchy");
    refit_nodes(scene, bvh, boxes);
    for (size_t i = 0; i < bvh->triangles.count; i++)
        triangles[i] = cs_scene_step(scene, ((const cs_triangle *)bvh->triangles.items)[i].face);
done:
    free(boxes);
    return status;
}
