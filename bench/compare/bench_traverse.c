/* Traversal: the kernel against Embree, with the same rays and threads.
 *
 *   bench_traverse [--mesh box|spheres|terrain] [--triangles N] [--spp N] [--size PX] [--rounds N]
 *                  [--threads N] [--packet W] [--lens R] [--bounce 1] [--json FILE]
 *
 * Camera rays are drawn by the renderer's sampler, sheared and sent through its lens. Shadow rays
 * go from their hits to a point light. Embree traces them one by one, in packets of 8 and 16 and as
 * streams, in scenes of medium and high quality. Rounds are interleaved, Embree then kernel, and
 * the medians of their ratios are printed. Exits with 1 if the hits disagree.
 *
 * With --bounce 1, rays go from the hits in random directions instead of to the light, sorted by
 * octant among 256, and packets of 16 are compared with rays alone in the wide hierarchy and with
 * Embree's single rays: least nanoseconds of processor time a ray over the rounds. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "accel/wide.h"
#include "clshear/device/hash.h"
#include "device/device.h"
#include "kernels/features.h"
#include "measure.h"
#include "view.h"

enum {
    KINDS = 2 * EMBREE_MODES
};

typedef struct bench {
    bench_view view;
    int rounds, packet, bounce;
    const char *json;
    cs_error error;
    cs_device *device;
    cs_buffer *nodes, *triangles, *origins, *directions, *distances, *hits;
    cs_buffer *wide_nodes, *wide_leaves;
    embree_scene *embree[2]; /* medium and high quality */
    float *found[2];         /* distances by Embree, by the kernel */
    int *faces;
} bench;

static void must(bench *state, clshear_status status)
{
    if (status == CLSHEAR_OK) return;
    fprintf(stderr, "bench_traverse: %s\n", state->error.message);
    exit(1);
}

/* Replaces rays with a hit by rays from the hit to the light. The length of the others becomes
 * 0. */
static void make_shadow_rays(bench *state)
{
    ray_planes *rays = &state->view.rays;
    embree_trace(state->embree[1], EMBREE_ONE, 0, rays, state->found[0], state->faces);
    for (size_t i = 0; i < rays->count; i++) {
        int hit = state->faces[i] != CS_NO_HIT;
        for (size_t axis = 0; axis < 3 && hit; axis++) {
            size_t at = axis * rays->count + i;
            float point = rays->origins[at] + 0.9999f * state->found[0][i] * rays->directions[at];
            rays->origins[at] = point;
            rays->directions[at] = state->view.light[axis] - point;
        }
        rays->reach[i] = hit ? 1.0f : -1.0f;
    }
}

static void upload_rays(bench *state)
{
    const ray_planes *rays = &state->view.rays;
    size_t plane = rays->count * sizeof(float);
    must(state, cs_buffer_write(state->origins, 0, 3 * plane, rays->origins, &state->error));
    must(state, cs_buffer_write(state->directions, 0, 3 * plane, rays->directions, &state->error));
}

/* Traces all rays, in packets or alone. */
static void run_kernel(bench *state, int any_hit, int alone)
{
    const ray_planes *rays = &state->view.rays;
    uint32_t count = (uint32_t)rays->count;
    const cs_argument arguments[] = {{.value = &count, .size = sizeof count},
                                     {.value = &any_hit, .size = sizeof any_hit},
                                     {.buffer = state->origins},
                                     {.buffer = state->directions},
                                     {.buffer = state->distances},
                                     {.buffer = state->hits},
                                     {.buffer = alone ? state->wide_nodes : state->nodes},
                                     {.buffer = alone ? state->wide_leaves : state->triangles}};
    must(state, CS_RUN_WITH(state->device, TRACE, alone ? CS_FEATURE_PATHS | CS_FEATURE_WIDE : 0u,
                            rays->count / (size_t)cs_device_packet(state->device), arguments,
                            &state->error));
}

/* Measures the kernel's seconds for all rays. */
static double kernel_s(bench *state, int any_hit)
{
    const ray_planes *rays = &state->view.rays;
    must(state, cs_buffer_write(state->distances, 0, rays->count * sizeof(float), rays->reach,
                                &state->error));
    double start_s = cs_now_s();
    run_kernel(state, any_hit, 0);
    double took_s = cs_now_s() - start_s;
    must(state, cs_buffer_read(state->distances, 0, rays->count * sizeof(float), state->found[1],
                               &state->error));
    return took_s;
}

static double embree_s(bench *state, int kind, int any_hit)
{
    double start_s = cs_now_s();
    embree_trace(state->embree[kind % 2], (embree_mode)(kind / 2), any_hit, &state->view.rays,
                 state->found[0], state->faces);
    return cs_now_s() - start_s;
}

/* Share of rays with distances that differ by more than a part in 10^4. */
static double disagreement(const bench *state)
{
    size_t different = 0;
    for (size_t i = 0; i < state->view.rays.count; i++) {
        float a = state->found[0][i], b = state->found[1][i];
        if (state->view.rays.reach[i] <= 0.0f) continue;
        if (a != b && !(fabsf(a - b) <= 1e-4f * fabsf(a))) different++;
    }
    return (double)different / (double)state->view.rays.count;
}

static size_t rays_with_reach(const ray_planes *rays)
{
    size_t count = 0;
    for (size_t i = 0; i < rays->count; i++)
        count += rays->reach[i] > 0.0f;
    return count;
}

/* Median seconds of each mode of Embree, then of the kernel. */
typedef struct outcome {
    double embree_s[KINDS];
    double kernel_s;
    double wrong; /* share of hits that disagree */
} outcome;

static outcome compare(bench *state, int any_hit)
{
    static double times[KINDS + 1][BENCH_MOST_ROUNDS], ratios[KINDS][BENCH_MOST_ROUNDS];
    const int rounds = state->rounds;
    outcome result;
    kernel_s(state, any_hit); /* compiles */
    for (int round = 0; round < rounds; round++) {
        for (int kind = 0; kind < KINDS; kind++)
            times[kind][round] = embree_s(state, kind, any_hit);
        times[KINDS][round] = kernel_s(state, any_hit);
        for (int kind = 0; kind < KINDS; kind++)
            ratios[kind][round] = times[kind][round] / times[KINDS][round];
    }
    embree_s(state, 1, any_hit);
    result.wrong = disagreement(state);
    const double mrays = 1e-6 * (double)rays_with_reach(&state->view.rays);
    result.kernel_s = bench_median(times[KINDS], rounds);
    printf("| %s | Mrays/s | kernel is faster |\n|---|---|---|\n| kernel | %.1f | 1 |\n",
           any_hit ? "shadow rays" : "camera rays", mrays / result.kernel_s);
    for (int kind = 0; kind < KINDS; kind++) {
        result.embree_s[kind] = bench_median(times[kind], rounds);
        printf("| Embree %s, %s | %.1f | %.2f |\n", embree_mode_name((embree_mode)(kind / 2)),
               kind % 2 ? "high" : "medium", mrays / result.embree_s[kind],
               bench_median(ratios[kind], rounds));
    }
    printf("\n");
    return result;
}

/* Turns shadow rays into rays of random directions on the light's side, sorted by octant in groups
 * of 256 as paths are. */
static void make_bounce_rays(ray_planes *rays)
{
    static float kept[256][6];
    for (size_t group = 0; group + 256 <= rays->count; group += 256) {
        size_t at = 0;
        for (size_t i = 0; i < 256; i++) {
            float side = 0.0f, *ray = kept[i];
            for (size_t axis = 0; axis < 3; axis++) {
                const size_t place = axis * rays->count + group + i;
                const cs_u32 bits = cs_key((cs_u32)(group + i), (cs_u32)axis) >> 8;
                ray[axis] = rays->reach[group + i] > 0.0f ? rays->origins[place] : INFINITY;
                ray[3 + axis] = (float)bits / (float)(1 << 23) - 1.0f;
                side += ray[3 + axis] * rays->directions[place];
            }
            for (size_t axis = 3; axis < 6 && side < 0.0f; axis++)
                ray[axis] = -ray[axis];
        }
        for (int octant = 0; octant < 9; octant++)
            for (size_t i = 0; i < 256; i++) {
                const float *ray = kept[i];
                const int own = (ray[3] < 0.0f) + 2 * (ray[4] < 0.0f) + 4 * (ray[5] < 0.0f);
                if ((isfinite(ray[0]) ? own : 8) != octant) continue;
                for (size_t axis = 0; axis < 3; axis++) {
                    rays->origins[axis * rays->count + group + at] = octant < 8 ? ray[axis] : 0.0f;
                    rays->directions[axis * rays->count + group + at] = ray[3 + axis];
                }
                rays->reach[group + at++] = octant < 8 ? INFINITY : -1.0f;
            }
    }
}

static double processor_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Prints the row of nearest hits or of any hits of bounce rays. */
static void compare_walks(bench *state, int any_hit)
{
    double least_s[3] = {INFINITY, INFINITY, INFINITY};
    const ray_planes *rays = &state->view.rays;
    for (int round = -1; round < state->rounds; round++) /* the first one compiles */
        for (int walk = 0; walk < 3; walk++) {
            must(state, cs_buffer_write(state->distances, 0, rays->count * sizeof(float),
                                        rays->reach, &state->error));
            const double start_s = processor_s();
            if (walk == 2)
                embree_trace(state->embree[0], EMBREE_ONE, any_hit, rays, state->found[0],
                             state->faces);
            else
                run_kernel(state, any_hit, walk);
            if (round >= 0) least_s[walk] = fmin(least_s[walk], processor_s() - start_s);
        }
    const double ns = 1e9 / (double)rays_with_reach(rays);
    printf("| %s | %.1f | %.1f | %.1f |\n", any_hit ? "any hit" : "nearest hit", ns * least_s[0],
           ns * least_s[1], ns * least_s[2]);
}

static void compare_bounces(bench *state)
{
    cs_wide_bvh wide;
    if (cs_device_packet(state->device) < CS_WIDE_LEAST_PACKET) {
        fprintf(stderr, "bench_traverse: --bounce needs packets of %d or more; use --packet\n",
                CS_WIDE_LEAST_PACKET);
        exit(1);
    }
    const cs_flat_bvh *bvh = &state->view.bvh;
    must(state, cs_wide_bvh_make(bvh->nodes.items, bvh->nodes.count, bvh->triangles.items, &wide,
                                 &state->error));
    must(state, cs_buffer_create(state->device, wide.nodes.count * wide.nodes.item_size,
                                 wide.nodes.items, &state->wide_nodes, &state->error));
    must(state, cs_buffer_create(state->device, wide.leaves.count * wide.leaves.item_size,
                                 wide.leaves.items, &state->wide_leaves, &state->error));
    cs_wide_bvh_free(&wide);
    make_shadow_rays(state);
    make_bounce_rays(&state->view.rays);
    upload_rays(state);
    printf("| bounce rays, ns | packets | alone | Embree, single |\n|---|---|---|---|\n");
    compare_walks(state, 0);
    compare_walks(state, 1);
}

static void set_up(bench *state)
{
    cs_error *error = &state->error;
    bench_view *view = &state->view;
    bench_view_open(view);
    must(state, cs_device_open(NULL, view->threads, state->packet, &state->device, error));
    for (int quality = 0; quality < 2; quality++)
        state->embree[quality] = embree_scene_create(&view->scene, quality, view->threads);
    const size_t plane = view->rays.count * sizeof(float);
    const cs_array *nodes = &view->bvh.nodes, *triangles = &view->bvh.triangles;
    must(state, cs_buffer_create(state->device, nodes->count * nodes->item_size, nodes->items,
                                 &state->nodes, error));
    must(state, cs_buffer_create(state->device, triangles->count * triangles->item_size,
                                 triangles->items, &state->triangles, error));
    must(state, cs_buffer_create(state->device, 3 * plane, NULL, &state->origins, error));
    must(state, cs_buffer_create(state->device, 3 * plane, NULL, &state->directions, error));
    must(state, cs_buffer_create(state->device, plane, NULL, &state->distances, error));
    must(state, cs_buffer_create(state->device, plane, NULL, &state->hits, error));
    state->found[0] = bench_allocate(plane);
    state->found[1] = bench_allocate(plane);
    state->faces = bench_allocate(view->rays.count * sizeof(int));
    printf("%s, %zu triangles, built in %.2f s; %zu rays, %d spp, packets of %d, %d threads\n\n",
           view->mesh, cs_scene_triangle_count(&view->scene), view->build_s, view->rays.count,
           view->spp, cs_device_packet(state->device), cs_device_threads(state->device));
}

static void tear_down(bench *state)
{
    cs_buffer *buffers[] = {state->nodes,      state->triangles,  state->origins,
                            state->directions, state->distances,  state->hits,
                            state->wide_nodes, state->wide_leaves};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        cs_buffer_free(buffers[i]);
    for (int i = 0; i < 2; i++) {
        embree_scene_free(state->embree[i]);
        free(state->found[i]);
    }
    free(state->faces);
    cs_device_close(state->device);
    bench_view_close(&state->view);
}

/* Prints the kernel's speed-up for both kinds of rays together: over single rays, and over the best
 * mode for each kind. */
static void report(const bench *state, const outcome *camera, const outcome *shadow)
{
    double single = INFINITY, best_camera = INFINITY, best_shadow = INFINITY;
    for (int kind = 0; kind < KINDS; kind++) {
        if (kind / 2 == EMBREE_ONE)
            single = fmin(single, camera->embree_s[kind] + shadow->embree_s[kind]);
        best_camera = fmin(best_camera, camera->embree_s[kind]);
        best_shadow = fmin(best_shadow, shadow->embree_s[kind]);
    }
    const double kernel = camera->kernel_s + shadow->kernel_s;
    printf("together %.2f times as fast as single rays, %.2f as the best modes (camera %.2f, "
           "shadow %.2f); hits differ on %.4f %% and %.4f %%\n",
           single / kernel, (best_camera + best_shadow) / kernel, best_camera / camera->kernel_s,
           best_shadow / shadow->kernel_s, 100.0 * camera->wrong, 100.0 * shadow->wrong);
    bench_record *record = bench_record_begin(state->json, "traverse");
    bench_record_text(record, "mesh", state->view.mesh);
    bench_record_number(record, "triangles", (double)cs_scene_triangle_count(&state->view.scene));
    bench_record_number(record, "spp", state->view.spp);
    bench_record_number(record, "camera_s", camera->kernel_s);
    bench_record_number(record, "shadow_s", shadow->kernel_s);
    bench_record_number(record, "ratio_single", single / kernel);
    bench_record_number(record, "ratio_best", (best_camera + best_shadow) / kernel);
    bench_record_number(record, "ratio_best_camera", best_camera / camera->kernel_s);
    bench_record_number(record, "ratio_best_shadow", best_shadow / shadow->kernel_s);
    bench_record_end(record);
}

int main(int argc, char **argv)
{
    bench state = {.view = {.mesh = "spheres",
                            .triangles = 250000,
                            .size = 256,
                            .spp = 64,
                            .lens_radius = 0.05,
                            .sampler = CS_SAMPLER_MJ},
                   .rounds = 7};
    bench_view *view = &state.view;
    const bench_flag flags[] = {BENCH_VIEW_FLAGS(view),
                                {.name = "rounds", .number = &state.rounds},
                                {.name = "packet", .number = &state.packet},
                                {.name = "bounce", .number = &state.bounce},
                                {.name = "json", .text = &state.json}};
    bench_read_flags(argc, argv, flags, sizeof flags / sizeof *flags);
    state.rounds = bench_rounds(state.rounds);
    set_up(&state);
    upload_rays(&state);
    if (state.bounce) {
        compare_bounces(&state);
        tear_down(&state);
        return 0;
    }
    outcome camera = compare(&state, 0);
    make_shadow_rays(&state);
    upload_rays(&state);
    outcome shadow = compare(&state, 1);
    report(&state, &camera, &shadow);
    tear_down(&state);
    return camera.wrong > 1e-4 || shadow.wrong > 1e-4;
}
