/* The whole path of a sample (tuple, shear, lens, trace, shadow, accumulate) against the same
 * samples through Embree.
 *
 *   bench_frame [--mesh box|spheres|terrain] [--triangles N] [--spp N] [--size PX] [--rounds N]
 *               [--threads N] [--packet W] [--lens R] [--sampler NAME]
 *               [--aperture disk|square|hexagon] [--filter NAME] [--blur PX] [--json FILE]
 *
 * Embree receives precomputed camera rays in the kernel's order: its time is intersection, shading,
 * occlusion and sums. Drawing and shearing the same tuples, with the kernel's vector code
 * (cs_draw_sum, with a shear of --blur pixels in every pixel), is timed separately. The first ratio
 * leaves its time out, the second adds it to Embree's. The share of tuples and map in the frame is
 * the CPU time of cs_draw_sum over that of the frame, each the least of all rounds; it is printed
 * with the shear and without. Rounds are interleaved, and the medians of their ratios are printed
 * against medium and high quality, with one, 8 or 16 rays or streams at a time. The kernel's time
 * is also compared with cs_trace on the same rays: the rest is the time without traversal. Exits
 * with 1 if the two pictures differ. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/launch.h"
#include "measure.h"
#include "render/objects.h"
#include "view.h"

enum {
    KINDS = 2 * EMBREE_MODES
};

static const float intensity = 2.0f;

typedef struct bench {
    bench_view view;
    int rounds, packet;
    double blur_px; /* shear of the tuples that are drawn alone */
    const char *json, *sampler, *aperture, *filter;
    clshear_context *context;
    clshear_scene *scene;
    clshear_settings *settings;
    embree_scene *embree[2];
    cs_buffer *origins, *directions, *distances, *hits, *sums, *table;
    float *radiance[2]; /* [0]: mean and squares by Embree; [1]: mean by the kernel */
    float *reach;
    int *faces;
} bench;

static double kernel_s(bench *state)
{
    clshear_film *film = bench_render(state->scene, state->settings);
    clshear_film_info info = {.struct_size = sizeof info};
    clshear_film_describe(film, &info);
    memcpy(state->radiance[1], clshear_film_channel(film, "G"),
           (size_t)state->view.size * (size_t)state->view.size * sizeof(float));
    clshear_film_free(film);
    return info.kernel_s;
}

static double embree_s(bench *state, int kind)
{
    const double start_s = cs_now_s();
    embree_frame(state->embree[kind % 2], (embree_mode)(kind / 2), &state->view.rays,
                 (size_t)state->view.spp, state->view.light, intensity, state->radiance[0]);
    return cs_now_s() - start_s;
}

/* Measures drawing and shearing alone, for every pixel. */
static double tuples_s(bench *state, cs_u32 shear_mode)
{
    const bench_view *view = &state->view;
    cs_device *device = state->context->device;
    const cs_u32 pixels = (cs_u32)(view->size * view->size);
    const float shear_px = (float)state->blur_px;
    cs_buffer *rows = NULL;
    cs_launch frame = {.camera = view->frame,
                       .pattern = view->pattern,
                       .pixel_count = pixels,
                       .shear_mode = shear_mode};
    cs_error *error = cs_thread_error();
    bench_must(cs_table_cache_find(&state->context->tables, device, &view->pattern, &rows, error));
    const cs_argument arguments[] = {{.value = &frame, .size = sizeof frame},
                                     {.value = &shear_px, .size = sizeof shear_px},
                                     {.buffer = rows},
                                     {.buffer = state->table},
                                     {.buffer = state->sums}};
    const double start_s = cs_now_s();
    bench_must(CS_RUN(device, DRAW_SUM, pixels, arguments, error));
    const double took_s = cs_now_s() - start_s;
    cs_buffer_free(rows);
    return took_s;
}

/* Measures tracing alone, of the rays in the buffers. */
static double trace_s(bench *state, int any_hit, const float *reach)
{
    cs_device *device = state->context->device;
    cs_error *error = cs_thread_error();
    const cs_u32 count = (cs_u32)state->view.rays.count;
    const cs_argument arguments[] = {{.value = &count, .size = sizeof count},
                                     {.value = &any_hit, .size = sizeof any_hit},
                                     {.buffer = state->origins},
                                     {.buffer = state->directions},
                                     {.buffer = state->distances},
                                     {.buffer = state->hits},
                                     {.buffer = state->scene->device_scene.buffers[0]},
                                     {.buffer = state->scene->device_scene.buffers[1]}};
    bench_must(cs_buffer_write(state->distances, 0, count * sizeof *reach, reach, error));
    const double start_s = cs_now_s();
    bench_must(CS_RUN(device, TRACE, count / (size_t)cs_device_packet(device), arguments, error));
    return cs_now_s() - start_s;
}

static void upload(bench *state, const float *origins, const float *directions)
{
    const size_t size = 3 * state->view.rays.count * sizeof(float);
    cs_error *error = cs_thread_error();
    bench_must(cs_buffer_write(state->origins, 0, size, origins, error));
    bench_must(cs_buffer_write(state->directions, 0, size, directions, error));
}

/* Replaces the camera rays by shadow rays from their hits to the light. */
static void upload_shadow_rays(bench *state)
{
    const ray_planes *rays = &state->view.rays;
    const size_t plane = 3 * rays->count * sizeof(float);
    float *origins = bench_allocate(plane), *directions = bench_allocate(plane);
    float *distances = bench_allocate(rays->count * sizeof(float));
    embree_trace(state->embree[1], EMBREE_ONE, 0, rays, distances, state->faces);
    for (size_t i = 0; i < rays->count; i++) {
        const int hit = state->faces[i] != CS_NO_HIT;
        for (size_t axis = 0; axis < 3; axis++) {
            const size_t at = axis * rays->count + i;
            const float along = hit ? 0.9999f * distances[i] * rays->directions[at] : 0.0f;
            origins[at] = rays->origins[at] + along;
            directions[at] = state->view.light[axis] - origins[at];
        }
        state->reach[i] = hit ? 1.0f : -1.0f;
    }
    upload(state, origins, directions);
    free(origins);
    free(directions);
    free(distances);
}

static void open_scene(bench *state)
{
    const bench_view *view = &state->view;
    const clshear_mesh mesh = {.struct_size = sizeof mesh,
                               .positions = view->scene.positions.items,
                               .indices = view->scene.indices.items,
                               .vertex_count = view->scene.positions.count,
                               .triangle_count = view->scene.indices.count,
                               .diffuse = {0.7f, 0.7f, 0.7f}};
    clshear_light light = {.struct_size = sizeof light,
                           .colour = {intensity, intensity, intensity}};
    memcpy(light.position, view->light, sizeof light.position);
    state->settings = bench_view_settings(view);
    bench_set(state->settings, CLSHEAR_SPP, view->spp);
    bench_set(state->settings, CLSHEAR_REPLICATES, 1);
    bench_set(state->settings, CLSHEAR_ORACLE, CLSHEAR_ORACLE_CENTRE);
    bench_set(state->settings, CLSHEAR_LENS_RAYS, 0);
    bench_set(state->settings, CLSHEAR_SAMPLER, view->sampler);
    bench_set(state->settings, CLSHEAR_THREADS, view->threads);
    if (state->packet > 0) bench_set(state->settings, CLSHEAR_PACKET, state->packet);
    bench_must(clshear_context_create(state->settings, &state->context));
    bench_must(clshear_scene_create(state->context, &state->scene));
    bench_must(clshear_scene_add_mesh(state->scene, &mesh));
    bench_must(clshear_scene_complete(state->scene));
    bench_must(clshear_scene_add_light(state->scene, &light));
    for (int quality = 0; quality < 2; quality++)
        state->embree[quality] = embree_scene_create(&view->scene, quality, view->threads);
}

static void reserve(bench *state)
{
    const size_t plane = state->view.rays.count * sizeof(float);
    const size_t pixels = (size_t)state->view.size * (size_t)state->view.size;
    const cs_array *table = &state->view.optics.table;
    cs_device *device = state->context->device;
    cs_error *error = cs_thread_error();
    bench_must(cs_buffer_create(device, 3 * plane, NULL, &state->origins, error));
    bench_must(cs_buffer_create(device, 3 * plane, NULL, &state->directions, error));
    bench_must(cs_buffer_create(device, plane, NULL, &state->distances, error));
    bench_must(cs_buffer_create(device, plane, NULL, &state->hits, error));
    bench_must(cs_buffer_create(device, pixels * sizeof(float), NULL, &state->sums, error));
    bench_must(
        cs_buffer_create(device, table->count * sizeof(float), table->items, &state->table, error));
    state->radiance[0] = bench_allocate(2 * pixels * sizeof(float));
    state->radiance[1] = bench_allocate(pixels * sizeof(float));
    state->reach = bench_allocate(plane);
    state->faces = bench_allocate(state->view.rays.count * sizeof(int));
}

/* Mean difference of the two pictures over their mean. */
static double difference(const bench *state)
{
    double off = 0.0, all = 0.0;
    const cs_u32 size = (cs_u32)state->view.size;
    for (cs_u32 i = 0; i < size * size; i++) {
        const double a = (double)state->radiance[0][2 * i];
        const double b = (double)state->radiance[1][cs_tiled_pixel(i, size, size)];
        off += fabs(a - b);
        all += a;
    }
    return off / all;
}

typedef struct times {
    double kernel[BENCH_MOST_ROUNDS], tuples[BENCH_MOST_ROUNDS];
    double frame_cpu, tuples_cpu[2]; /* least CPU seconds; unsheared tuples, then sheared ones */
    double trace[2][BENCH_MOST_ROUNDS];
    double embree[KINDS][BENCH_MOST_ROUNDS];
} times;

static void measure_rounds(bench *state, times *t)
{
    const ray_planes *rays = &state->view.rays;
    kernel_s(state); /* compiles the kernel */
    tuples_s(state, CS_SHEAR_EQUAL_AREA);
    t->frame_cpu = t->tuples_cpu[0] = t->tuples_cpu[1] = INFINITY;
    for (int round = 0; round < state->rounds; round++) {
        for (int kind = 0; kind < KINDS; kind++)
            t->embree[kind][round] = embree_s(state, kind);
        const double start = bench_cpu_s();
        t->kernel[round] = kernel_s(state);
        const double drawn = bench_cpu_s();
        t->tuples[round] = tuples_s(state, CS_SHEAR_EQUAL_AREA);
        const double sheared = bench_cpu_s();
        tuples_s(state, CS_SHEAR_NONE);
        t->frame_cpu = fmin(t->frame_cpu, drawn - start);
        t->tuples_cpu[0] = fmin(t->tuples_cpu[0], bench_cpu_s() - sheared);
        t->tuples_cpu[1] = fmin(t->tuples_cpu[1], sheared - drawn);
    }
    upload(state, rays->origins, rays->directions);
    trace_s(state, 0, rays->reach);
    double share[BENCH_MOST_ROUNDS];
    for (int any_hit = 0; any_hit < 2; any_hit++) {
        if (any_hit) upload_shadow_rays(state);
        for (int round = 0; round < state->rounds; round++) {
            t->trace[any_hit][round] =
                trace_s(state, any_hit, any_hit ? state->reach : rays->reach);
            share[round] = t->trace[any_hit][round] / kernel_s(state);
        }
        t->trace[any_hit][0] = bench_median(share, state->rounds);
    }
}

static void report(bench *state, times *t)
{
    const int rounds = state->rounds;
    const double samples = 1e-6 * (double)state->view.rays.count;
    double best[2] = {INFINITY, INFINITY}; /* best time with one ray per call, and with any mode */
    double best_free[2] = {INFINITY, INFINITY};
    bench_record *record = bench_record_begin(state->json, "frame");
    bench_record_text(record, "mesh", state->view.mesh);
    bench_record_number(record, "triangles", (double)cs_scene_triangle_count(&state->view.scene));
    bench_record_number(record, "spp", state->view.spp);
    bench_record_text(record, "sampler", cs_sampler_name(state->view.sampler));
    bench_record_text(record, "aperture", state->aperture);
    bench_record_text(record, "filter", state->filter);
    printf("| Embree | Msamples/s | ratio, tuples for free | ratio, with tuples |\n"
           "|---|---|---|---|\n");
    for (int kind = 0; kind < KINDS; kind++) {
        double free_ratio[BENCH_MOST_ROUNDS], ratio[BENCH_MOST_ROUNDS];
        for (int round = 0; round < rounds; round++) {
            free_ratio[round] = t->embree[kind][round] / t->kernel[round];
            ratio[round] = (t->embree[kind][round] + t->tuples[round]) / t->kernel[round];
        }
        const double without = bench_median(free_ratio, rounds), with = bench_median(ratio, rounds);
        for (int all = kind / 2 == EMBREE_ONE ? 0 : 1; all < 2; all++) {
            best[all] = fmin(best[all], with);
            best_free[all] = fmin(best_free[all], without);
        }
        printf("| %s, %s | %.2f | %.2f | %.2f |\n", embree_mode_name((embree_mode)(kind / 2)),
               kind % 2 ? "high" : "medium", samples / bench_median(t->embree[kind], rounds),
               without, with);
    }
    const double kernel = bench_median(t->kernel, rounds);
    const double tuples = t->tuples_cpu[1] / t->frame_cpu;
    const double traced = t->trace[0][0] + t->trace[1][0];
    printf("kernel %.2f Msamples/s; tuples and map %.1f %% of it (%.1f %% without shear), "
           "traversal %.0f %%, all but traversal %.0f %%\n"
           "ratio %.2f (%.2f with tuples) to single rays, %.2f (%.2f) to Embree's best\n\n",
           samples / kernel, 100.0 * tuples, 100.0 * t->tuples_cpu[0] / t->frame_cpu,
           100.0 * traced, 100.0 * (1.0 - traced), best_free[0], best[0], best_free[1], best[1]);
    bench_record_number(record, "msamples_per_s", samples / kernel);
    bench_record_number(record, "ratio_single_free", best_free[0]);
    bench_record_number(record, "ratio_single", best[0]);
    bench_record_number(record, "ratio_best_free", best_free[1]);
    bench_record_number(record, "ratio_best", best[1]);
    bench_record_number(record, "blur_px", state->blur_px);
    bench_record_number(record, "share_tuples", tuples);
    bench_record_number(record, "share_traversal", traced);
    bench_record_end(record);
}

static void close_all(bench *state)
{
    cs_buffer *buffers[] = {state->origins, state->directions, state->distances,
                            state->hits,    state->sums,       state->table};
    for (size_t i = 0; i < sizeof buffers / sizeof *buffers; i++)
        cs_buffer_free(buffers[i]);
    for (int i = 0; i < 2; i++) {
        embree_scene_free(state->embree[i]);
        free(state->radiance[i]);
    }
    free(state->reach);
    free(state->faces);
    clshear_settings_free(state->settings);
    clshear_scene_free(state->scene);
    clshear_context_free(state->context);
    bench_view_close(&state->view);
}

/* Reads the names of aperture and filter, as settings do; a hexagon is a polygon of six blades. */
static void choose_optics(bench *state)
{
    bench_view *view = &state->view;
    int64_t aperture = 0, filter = 0;
    const int is_hexagon = strcmp(state->aperture, "hexagon") == 0;
    clshear_settings *settings = bench_settings(NULL);
    bench_set_text(settings, CLSHEAR_APERTURE, is_hexagon ? "polygon" : state->aperture);
    bench_set_text(settings, CLSHEAR_FILTER, state->filter);
    bench_must(clshear_settings_get_integer(settings, CLSHEAR_APERTURE, &aperture));
    bench_must(clshear_settings_get_integer(settings, CLSHEAR_FILTER, &filter));
    view->aperture = (clshear_aperture)aperture;
    view->filter = (clshear_filter)filter;
    view->blades = is_hexagon ? 6 : 0;
    clshear_settings_free(settings);
}

int main(int argc, char **argv)
{
    bench state = {.view = {.mesh = "spheres",
                            .triangles = 250000,
                            .size = 256,
                            .spp = 64,
                            .lens_radius = 0.05},
                   .rounds = 5,
                   .blur_px = 3.0,
                   .aperture = "disk",
                   .filter = "box"};
    static times t;
    bench_view *view = &state.view;
    const bench_flag flags[] = {BENCH_VIEW_FLAGS(view),
                                {.name = "rounds", .number = &state.rounds},
                                {.name = "packet", .number = &state.packet},
                                {.name = "sampler", .text = &state.sampler},
                                {.name = "aperture", .text = &state.aperture},
                                {.name = "filter", .text = &state.filter},
                                {.name = "blur", .real = &state.blur_px},
                                {.name = "json", .text = &state.json}};
    bench_read_flags(argc, argv, flags, sizeof flags / sizeof *flags);
    state.rounds = bench_rounds(state.rounds);
    cs_error error;
    if (cs_sampler_find(state.sampler, &view->sampler, &error) != CLSHEAR_OK) {
        fprintf(stderr, "bench_frame: %s\n", error.message);
        return 2;
    }
    choose_optics(&state);
    bench_view_open(view);
    open_scene(&state);
    reserve(&state);
    printf("%s, %zu triangles, %d x %d pixels, %d samples of %s, %s aperture, %s filter, packets "
           "of %d, %d "
           "threads\n\n",
           view->mesh, cs_scene_triangle_count(&view->scene), view->size, view->size, view->spp,
           cs_sampler_name(view->sampler), state.aperture, state.filter,
           cs_device_packet(state.context->device), cs_device_threads(state.context->device));
    measure_rounds(&state, &t);
    report(&state, &t);
    const double off = difference(&state);
    printf("pictures differ by %.1e of their mean\n", off);
    close_all(&state);
    return off > 1e-3;
}
