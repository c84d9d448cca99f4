/* Traversal: the kernel against Embree, with the same rays and threads.
 *
 *   bench_traverse [--mesh box|spheres|terrain] [--triangles N] [--spp N] [--size PX] [--rounds N]
 *                  [--threads N] [--packet W] [--lens R] [--json FILE]
 *
 * Camera rays are drawn by the renderer's sampler, sheared and sent through its lens. Shadow rays
 * go from their hits to a point light. Embree traces them one by one, in packets of 8 and 16 and as
 * streams, in scenes of medium and high quality. Rounds are interleaved, Embree then kernel, and
 * the medians of their ratios are printed. Exits with 1 if the hits disagree. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "device/device.h"
#include "measure.h"
#include "view.h"

enum {
    KINDS = 2 * EMBREE_MODES
};

typedef struct bench {
    bench_view view;
    int rounds, packet;
    const char *json;
    cs_error error;
    cs_device *device;
    cs_buffer *nodes, *triangles, *origins, *directions, *distances, *hits;
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

/* Measures the kernel's seconds for all rays. */
static double kernel_s(bench *state, int any_hit)
{
    const ray_planes *rays = &state->view.rays;
    uint32_t count = (uint32_t)rays->count;
    const cs_argument arguments[] = {{.value = &count, .size = sizeof count},
                                     {.value = &any_hit, .size = sizeof any_hit},
                                     {.buffer = state->origins},
                                     {.buffer = state->directions},
                                     {.buffer = state->distances},
                                     {.buffer = state->hits},
                                     {.buffer = state->nodes},
                                     {.buffer = state->triangles}};
    must(state, cs_buffer_write(state->distances, 0, rays->count * sizeof(float), rays->reach,
                                &state->error));
    double start_s = cs_now_s();
    must(state, CS_RUN(state->device, TRACE, rays->count / (size_t)cs_device_packet(state->device),
                       arguments, &state->error));
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
    cs_buffer *buffers[] = {state->nodes,      state->triangles, state->origins,
                            state->directions, state->distances, state->hits};
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
                                {.name = "json", .text = &state.json}};
    bench_read_flags(argc, argv, flags, sizeof flags / sizeof *flags);
    state.rounds = bench_rounds(state.rounds);
    set_up(&state);
    upload_rays(&state);
    outcome camera = compare(&state, 0);
    make_shadow_rays(&state);
    upload_rays(&state);
    outcome shadow = compare(&state, 1);
    report(&state, &camera, &shadow);
    tear_down(&state);
    return camera.wrong > 1e-4 || shadow.wrong > 1e-4;
}
