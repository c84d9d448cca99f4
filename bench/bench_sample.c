/* What drawing and shearing costs: tuples per second of every sampler, alone and as a share of the
 * Cornell box's frame. Both are measured in turn, several rounds; medians are printed.
 *
 * bench_sample [SCENE [SAMPLES [ROUNDS [SAMPLER]]]] */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "kernels/launch.h"
#include "optics/optics.h"
#include "optics/shear_mode.h"
#include "pattern/pattern.h"
#include "render/handles.h"

enum {
    SIDE = 128,
    MOST_ROUNDS = 51
};

typedef struct bench {
    clshear_context *context;
    clshear_scene *scene;
    clshear_camera camera;
    clshear_options options;
} bench;

static void must(const bench *state, clshear_status status)
{
    if (status == CLSHEAR_OK) return;
    fprintf(stderr, "bench_sample: %s\n",
            clshear_message(state->context != NULL ? state->context : NULL));
    exit(1);
}

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

static double median(double *values, int count)
{
    qsort(values, (size_t)count, sizeof *values, by_value);
    return values[count / 2];
}

/* Seconds that drawing takes without anything else. */
static double draw_s(const bench *state, const cs_pattern *pattern, const cs_buffer *rows,
                     const cs_buffer *sums)
{
    cs_error error;
    const float shear = 3.0f;
    cs_launch frame = {.pattern = *pattern,
                       .pixel_count = SIDE * SIDE,
                       .shear_mode = cs_shear_mode(state->options.shear)};
    cs_optics_tables optics = {0};
    cs_buffer *table = NULL;
    must(state, cs_optics_make(&state->camera, state->options.filter, 0.0f, &optics, &error));
    must(state, cs_buffer_create(state->context->device, optics.table.count * sizeof(float),
                                 optics.table.items, &table, &error));
    frame.camera.optics = optics.optics;
    const cs_argument arguments[] = {{.value = &frame, .size = sizeof frame},
                                     {.value = &shear, .size = sizeof shear},
                                     {.buffer = rows},
                                     {.buffer = table},
                                     {.buffer = sums}};
    const double start_s = cs_now_s();
    must(state, CS_RUN(state->context->device, DRAW_SUM, SIDE * SIDE, arguments, &error));
    const double took_s = cs_now_s() - start_s;
    cs_buffer_free(table);
    cs_optics_free(&optics);
    return took_s;
}

static double frame_s(const bench *state)
{
    clshear_film *film = NULL;
    must(state, clshear_render(state->scene, &state->camera, &state->options, &film));
    const double took_s = clshear_film_describe(film).kernel_s;
    clshear_film_free(film);
    return took_s;
}

static void measure(bench *state, cs_u32 sampler, int rounds)
{
    cs_error error;
    double draw[MOST_ROUNDS], share[MOST_ROUNDS];
    const cs_buffer *rows = NULL;
    cs_buffer *sums = NULL;
    cs_device *device = state->context->device;
    const cs_u32 count = cs_sampler_count(sampler, state->options.spp);
    const cs_pattern pattern = cs_pattern_of(sampler, 0, count);
    state->options.sampler = cs_sampler_name(sampler);
    must(state, cs_table_cache_find(&state->context->tables, device, &pattern, &rows, &error));
    must(state, cs_buffer_create(device, SIDE * SIDE * sizeof(float), NULL, &sums, &error));
    for (int round = -1; round < rounds; round++) { /* the first one warms up */
        const double alone = draw_s(state, &pattern, rows, sums), all = frame_s(state);
        if (round < 0) continue;
        draw[round] = alone;
        share[round] = alone / all;
    }
    printf("| %s | %u | %.1f | %.1f %% |\n", cs_sampler_name(sampler), count,
           1e-6 * SIDE * SIDE * count / median(draw, rounds), 100.0 * median(share, rounds));
    fflush(stdout);
    cs_buffer_free(sums);
}

int main(int argc, char **argv)
{
    bench state = {.options = clshear_options_defaults()};
    const int rounds =
        argc > 3 && atoi(argv[3]) > 0 && atoi(argv[3]) < MOST_ROUNDS ? atoi(argv[3]) : 7;
    const clshear_light light = {.vector = {278, 430, -20}, .colour = {230000, 215000, 185000}};
    state.camera = (clshear_camera){.eye = {276.4f, 274.4f, 800},
                                    .target = {276.4f, 274.4f, 0},
                                    .up = {0, 1, 0},
                                    .fov_deg = 36.0f,
                                    .lens_radius = 25.0f,
                                    .focal_distance = 930.0f};
    state.options.width = state.options.height = SIDE;
    state.options.spp = argc > 2 && atoi(argv[2]) > 0 ? (cs_u32)atoi(argv[2]) : 1024;
    state.options.replicates = 1;
    must(&state, clshear_context_create(NULL, &state.context));
    must(&state, clshear_scene_load(state.context, argc > 1 ? argv[1] : "scenes/cornell.obj",
                                    &state.scene));
    must(&state, clshear_scene_add_light(state.scene, &light));
    for (int disk = 0; disk < 2; disk++) {
        state.camera.aperture = disk ? CLSHEAR_APERTURE_DISK : CLSHEAR_APERTURE_SQUARE;
        for (int shear = 0; shear <= CLSHEAR_SHEAR_EQUAL_AREA; shear += CLSHEAR_SHEAR_EQUAL_AREA) {
            state.options.shear = (clshear_shear)shear;
            printf("\n%s aperture, shear %s\n\n| sampler | N | M tuples/s | of the frame |\n"
                   "|---|---|---|---|\n",
                   disk ? "disk" : "square", shear ? "equal-area" : "none");
            for (cs_u32 sampler = 0; sampler < CS_SAMPLER_COUNT; sampler++)
                if (argc < 5 || strcmp(argv[4], cs_sampler_name(sampler)) == 0)
                    measure(&state, sampler, rounds);
        }
    }
    clshear_scene_free(state.scene);
    clshear_context_free(state.context);
    return 0;
}
