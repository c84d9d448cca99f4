/* Cost of drawing and shearing: tuples per CPU second of every sampler, alone and as a share of
 * the Cornell box's frame. Both are measured in turn over several rounds; medians are printed.
 *
 *   bench_sample [--scene FILE] [--spp N] [--rounds N] [--sampler NAME] */
#include <stdio.h>
#include <string.h>

#include "kernels/launch.h"
#include "measure.h"
#include "optics/optics.h"
#include "optics/shear_mode.h"
#include "pattern/pattern.h"
#include "render/objects.h"
#include "settings/view.h"

enum {
    SIDE = 128
};

typedef struct bench {
    clshear_context *context;
    clshear_scene *scene;
    clshear_settings *settings;
    int spp, rounds;
    const char *scene_file, *sampler;
} bench;

/* Measures the CPU seconds of drawing alone. */
static double draw_s(const bench *state, const cs_pattern *pattern, const cs_buffer *rows,
                     const cs_buffer *sums)
{
    cs_error *error = cs_thread_error();
    const float shear = 3.0f;
    int64_t shear_kind = 0;
    cs_view view;
    bench_must(clshear_settings_get_integer(state->settings, CLSHEAR_SHEAR, &shear_kind));
    cs_view_of(state->settings, NULL, &view);
    cs_launch frame = {.pattern = *pattern,
                       .pixel_count = SIDE * SIDE,
                       .shear_mode = cs_shear_mode((clshear_shear)shear_kind)};
    cs_optics_tables optics = {0};
    cs_buffer *table = NULL;
    bench_must(cs_optics_make(&view, CLSHEAR_FILTER_BOX, 0.0f, &optics, error));
    bench_must(cs_buffer_create(state->context->device, optics.table.count * sizeof(float),
                                optics.table.items, &table, error));
    frame.camera.optics = optics.optics;
    const cs_argument arguments[] = {{.value = &frame, .size = sizeof frame},
                                     {.value = &shear, .size = sizeof shear},
                                     {.buffer = rows},
                                     {.buffer = table},
                                     {.buffer = sums}};
    const double start_s = bench_cpu_s();
    bench_must(CS_RUN(state->context->device, DRAW_SUM, SIDE * SIDE, arguments, error));
    const double took_s = bench_cpu_s() - start_s;
    cs_buffer_free(table);
    cs_optics_free(&optics);
    return took_s;
}

static double frame_s(const bench *state)
{
    const double start_s = bench_cpu_s();
    clshear_film_free(bench_render(state->scene, state->settings));
    return bench_cpu_s() - start_s;
}

static void measure_sampler(bench *state, cs_u32 sampler)
{
    const int rounds = state->rounds;
    cs_error *error = cs_thread_error();
    double draw[BENCH_MOST_ROUNDS], share[BENCH_MOST_ROUNDS];
    cs_buffer *rows = NULL, *sums = NULL;
    cs_device *device = state->context->device;
    const cs_u32 count = cs_sampler_count(sampler, (cs_u32)state->spp);
    const cs_pattern pattern = cs_pattern_of(sampler, 0, count);
    bench_set(state->settings, CLSHEAR_SAMPLER, sampler);
    bench_must(cs_table_cache_find(&state->context->tables, device, &pattern, &rows, error));
    bench_must(cs_buffer_create(device, SIDE * SIDE * sizeof(float), NULL, &sums, error));
    for (int round = -1; round < rounds; round++) { /* the first round warms up */
        const double alone = draw_s(state, &pattern, rows, sums), all = frame_s(state);
        if (round < 0) continue;
        draw[round] = alone;
        share[round] = alone / all;
    }
    printf("| %s | %u | %.1f | %.1f %% |\n", cs_sampler_name(sampler), count,
           1e-6 * SIDE * SIDE * count / bench_median(draw, rounds),
           100.0 * bench_median(share, rounds));
    fflush(stdout);
    cs_buffer_free(rows);
    cs_buffer_free(sums);
}

static void open_scene(bench *state)
{
    state->settings = bench_settings("scenes/cornell.flags");
    bench_set(state->settings, CLSHEAR_WIDTH, SIDE);
    bench_set(state->settings, CLSHEAR_HEIGHT, SIDE);
    bench_set(state->settings, CLSHEAR_SPP, state->spp);
    bench_set(state->settings, CLSHEAR_REPLICATES, 1);
    bench_must(clshear_context_create(NULL, &state->context));
    bench_must(clshear_scene_load(state->context, state->scene_file, NULL, &state->scene));
}

int main(int argc, char **argv)
{
    static const clshear_aperture apertures[] = {CLSHEAR_APERTURE_SQUARE, CLSHEAR_APERTURE_DISK};
    static const clshear_shear shears[] = {CLSHEAR_SHEAR_NONE, CLSHEAR_SHEAR_EQUAL_AREA};
    bench state = {.scene_file = "scenes/cornell.obj", .spp = 1024, .rounds = 7};
    const bench_flag flags[] = {{.name = "scene", .text = &state.scene_file},
                                {.name = "spp", .number = &state.spp},
                                {.name = "rounds", .number = &state.rounds},
                                {.name = "sampler", .text = &state.sampler}};
    bench_read_flags(argc, argv, flags, sizeof flags / sizeof *flags);
    state.rounds = bench_rounds(state.rounds);
    open_scene(&state);
    for (int a = 0; a < 2; a++)
        for (int s = 0; s < 2; s++) {
            bench_set(state.settings, CLSHEAR_APERTURE, apertures[a]);
            bench_set(state.settings, CLSHEAR_SHEAR, shears[s]);
            printf("\n%s aperture, shear %s\n\n| sampler | N | M tuples per CPU s | of the frame |\n"
                   "|---|---|---|---|\n",
                   a == 0 ? "square" : "disk", s == 0 ? "none" : "equal-area");
            for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++)
                if (state.sampler == NULL || strcmp(state.sampler, cs_sampler_name(sampler)) == 0)
                    measure_sampler(&state, sampler);
        }
    clshear_settings_free(state.settings);
    clshear_scene_free(state.scene);
    clshear_context_free(state.context);
    return 0;
}
