#include "render/wide_scene.h"

#include <pthread.h>
#include <stdlib.h>

#include "accel/wide.h"
#include "kernels/features.h"
#include "render/objects.h"

enum {
    /* Below, packets are faster even if their rays diverge. Where a packet has 8 lanes, a ray alone
     * takes two steps a node. */
    LEAST_TRIANGLES_OF_8 = 1 << 17,
    LEAST_TRIANGLES = 1 << 13
};

struct cs_wide_scene {
    pthread_mutex_t lock;
    int is_made; /* or found to be impossible, which leaves no buffers */
    cs_buffer *nodes;
    cs_buffer *leaves;
};

cs_wide_scene *cs_wide_scene_new(void)
{
    cs_wide_scene *wide = calloc(1, sizeof *wide);
    if (wide != NULL) pthread_mutex_init(&wide->lock, NULL);
    return wide;
}

void cs_wide_scene_free(cs_wide_scene *wide)
{
    if (wide == NULL) return;
    cs_buffer_free(wide->nodes);
    cs_buffer_free(wide->leaves);
    pthread_mutex_destroy(&wide->lock);
    free(wide);
}

cs_u32 cs_wide_feature(const clshear_scene *scene, cs_u32 features)
{
    const int packet = cs_device_packet(scene->context->device);
    const size_t least = packet < CS_WIDE ? LEAST_TRIANGLES_OF_8 : LEAST_TRIANGLES;
    return (features & CS_FEATURE_PATHS) != 0 && !cs_scene_moves(&scene->scene) &&
                   packet >= CS_WIDE_LEAST_PACKET && cs_scene_triangle_count(&scene->scene) >= least
               ? CS_FEATURE_WIDE
               : 0u;
}

static clshear_status upload(cs_wide_scene *wide, cs_device *device, const cs_wide_bvh *made,
                             cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    CS_TRY(cs_buffer_create(device, made->leaves.count * made->leaves.item_size, made->leaves.items,
                            &wide->leaves, error));
    CS_TRY(cs_buffer_create(device, made->nodes.count * made->nodes.item_size, made->nodes.items,
                            &wide->nodes, error));
done:
    return status;
}

/* Makes it from the binary hierarchy, which only the device keeps. */
static clshear_status make(const clshear_scene *scene, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_buffer *const *buffers = scene->device_scene.buffers;
    cs_array nodes = {.item_size = sizeof(cs_node)};
    cs_array triangles = {.item_size = sizeof(cs_triangle)};
    cs_wide_bvh made = {0};
    CS_REQUIRE(cs_array_extend(&nodes, scene->info.nodes) != NULL &&
                   cs_array_extend(&triangles, scene->info.references) != NULL,
               CLSHEAR_OUT_OF_MEMORY, "out of memory for the wide hierarchy");
    CS_TRY(cs_buffer_read(buffers[CS_SCENE_NODES], 0, nodes.count * nodes.item_size, nodes.items,
                          error));
    CS_TRY(cs_buffer_read(buffers[CS_SCENE_TRIANGLES], 0, triangles.count * triangles.item_size,
                          triangles.items, error));
    CS_TRY(cs_wide_bvh_make(nodes.items, nodes.count, triangles.items, &made, error));
    if (made.nodes.count > 0) CS_TRY(upload(scene->wide, scene->context->device, &made, error));
    scene->wide->is_made = 1;
done:
    cs_array_free(&nodes);
    cs_array_free(&triangles);
    cs_wide_bvh_free(&made);
    return status;
}

clshear_status cs_wide_scene_make(const clshear_scene *scene, cs_u32 *features, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_wide_scene *wide = scene->wide;
    if ((*features & CS_FEATURE_WIDE) == 0) return CLSHEAR_OK;
    pthread_mutex_lock(&wide->lock);
    if (!wide->is_made) {
        cs_buffer_free(wide->leaves); /* what a failure left */
        wide->leaves = NULL;
        status = make(scene, error);
    }
    if (wide->nodes == NULL) *features &= ~(cs_u32)CS_FEATURE_WIDE;
    pthread_mutex_unlock(&wide->lock);
    return status;
}

void cs_wide_scene_buffers(cs_wide_scene *wide, const cs_buffer *buffers[CS_SCENE_BUFFERS])
{
    pthread_mutex_lock(&wide->lock);
    buffers[CS_SCENE_WIDE_NODES] = wide->nodes;
    buffers[CS_SCENE_WIDE_LEAVES] = wide->leaves;
    pthread_mutex_unlock(&wide->lock);
}

size_t cs_wide_scene_bytes(cs_wide_scene *wide)
{
    pthread_mutex_lock(&wide->lock);
    const size_t bytes = cs_buffer_size(wide->nodes) + cs_buffer_size(wide->leaves);
    pthread_mutex_unlock(&wide->lock);
    return bytes;
}

double cs_wide_scene_expected(const clshear_scene *scene, cs_u32 features)
{
    pthread_mutex_lock(&scene->wide->lock);
    const int is_made = scene->wide->is_made;
    pthread_mutex_unlock(&scene->wide->lock);
    return is_made || (features & CS_FEATURE_WIDE) == 0
               ? 0.0
               : cs_wide_bvh_expected(scene->info.references);
}

cs_footprint cs_wide_scene_making(const clshear_scene *scene, cs_u32 features)
{
    const double wide = cs_wide_scene_expected(scene, features);
    const double binary = (double)scene->info.nodes * (double)sizeof(cs_node) +
                          (double)scene->info.references * (double)sizeof(cs_triangle);
    return wide > 0.0 ? (cs_footprint){.host = binary + wide, .device = wide} : (cs_footprint){0};
}
