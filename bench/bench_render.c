/* A whole job, and where its time goes.
 *
 *   bench_render [--scene FILE | --mesh box|spheres|terrain --triangles N] [--size PX] [--spp N]
 *                [--replicates R] [--lens R] [--oracle centre|pilot] [--sampler NAME] [--threads N]
 *                [--out FILE] [--rounds N] [--json FILE]
 *
 * Start: from main() to the first samples' end, kernels compiled or found in the driver's cache
 * (POCL_CACHE_DIR at an empty folder makes it cold). The render is repeated; the medians of its
 * phases are printed, and the process's largest memory. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "measure.h"
#include "meshes.h"
#include "render/handles.h"

enum {
    PREPASS,
    PILOT,
    KERNELS,
    REST,
    RENDER,
    PHASES
};

static const char *const phase_names[PHASES] = {"prepass", "pilot", "kernels", "rest", "render"};

typedef struct bench {
    const char *scene_file, *mesh, *oracle, *sampler, *out, *json;
    size_t triangles, spp, replicates;
    int size, threads, rounds;
    double lens_radius;
    double start_s, open_s, load_s, first_s; /* moments and times since the start of main */
    clshear_context *context;
    clshear_scene *scene;
    clshear_camera camera;
    double phases[PHASES][BENCH_MOST_ROUNDS];
    double samples, write_s;
} bench;

static void must(const bench *state, clshear_status status)
{
    if (status == CLSHEAR_OK) return;
    fprintf(stderr, "bench_render: %s\n", clshear_message(state->context));
    exit(1);
}

static int first_samples(void *user, const clshear_progress *progress)
{
    bench *state = user;
    (void)progress;
    if (!(state->first_s > 0.0)) state->first_s = cs_now_s() - state->start_s;
    return 0;
}

static void make_mesh(bench *state)
{
    cs_scene made;
    cs_error error;
    cs_scene_init(&made);
    if (bench_make_mesh(state->mesh, state->triangles, &made, &error) != CLSHEAR_OK) exit(1);
    const clshear_mesh mesh = {.positions = made.positions.items,
                               .indices = made.indices.items,
                               .vertex_count = made.positions.count,
                               .triangle_count = made.indices.count,
                               .diffuse = {0.7f, 0.7f, 0.7f}};
    const clshear_light light = {.vector = {0.5f, 0.95f, 0.5f}, .colour = {2.0f, 2.0f, 2.0f}};
    state->start_s = cs_now_s(); /* making the mesh is not the product's work */
    must(state, clshear_scene_create(state->context, &mesh, 1, &state->scene));
    must(state, clshear_scene_add_light(state->scene, &light));
    cs_scene_free(&made);
}

/* The Cornell box's own light and camera for a file, those of the other benchmarks for a mesh. */
static void place_camera(bench *state)
{
    const int file = state->scene_file != NULL;
    const clshear_light light = {.vector = {278, 430, -20}, .colour = {230000, 215000, 185000}};
    if (file) {
        must(state, clshear_scene_add_light(state->scene, &light));
        state->camera = (clshear_camera){.eye = {276.4f, 274.4f, 800.0f},
                                         .target = {276.4f, 274.4f, 0.0f},
                                         .up = {0, 1, 0},
                                         .fov_deg = 36.0f,
                                         .focal_distance = 930.0f};
    } else {
        state->camera = (clshear_camera){.eye = {0.5f, 0.5f, 2.2f},
                                         .target = {0.5f, 0.5f, 0.5f},
                                         .up = {0, 1, 0},
                                         .fov_deg = 45.0f,
                                         .focal_distance = 1.5f};
    }
    state->camera.lens_radius = state->lens_radius >= 0.0 ? (float)state->lens_radius
                                : file                    ? 25.0f
                                                          : 0.05f;
}

static void open_scene(bench *state)
{
    const clshear_context_options options = {.threads = state->threads};
    must(state, clshear_context_create(&options, &state->context));
    state->open_s = cs_now_s() - state->start_s;
    const double start_s = cs_now_s();
    if (state->scene_file != NULL)
        must(state, clshear_scene_load(state->context, state->scene_file, &state->scene));
    else
        make_mesh(state);
    state->load_s = cs_now_s() - (state->scene_file != NULL ? start_s : state->start_s);
    place_camera(state);
}

static void render(bench *state, int round)
{
    clshear_film *film = NULL;
    clshear_options options = clshear_options_defaults();
    options.width = options.height = state->size;
    options.spp = (uint32_t)state->spp;
    options.replicates = (uint32_t)state->replicates;
    options.sampler = state->sampler;
    if (strcmp(state->oracle, "centre") == 0) options.oracle = CLSHEAR_ORACLE_CENTRE;
    options.progress = first_samples;
    options.progress_user = state;
    must(state, clshear_render(state->scene, &state->camera, &options, &film));
    const clshear_film_info info = clshear_film_describe(film);
    const double phases[PHASES] = {
        info.prepass_s, info.pilot_s, info.kernel_s,
        fmax(info.render_s - info.prepass_s - info.pilot_s - info.kernel_s, 0.0), info.render_s};
    for (int p = 0; p < PHASES; p++)
        state->phases[p][round] = phases[p];
    state->samples = (double)info.samples;
    const double before_s = cs_now_s();
    if (state->out != NULL) must(state, clshear_film_write(film, state->out));
    state->write_s = cs_now_s() - before_s;
    clshear_film_free(film);
}

static void report(bench *state)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    const clshear_scene_info info = clshear_scene_describe(state->scene);
    const double compile_s = fmax(state->load_s - info.load_s - info.build_s, 0.0);
    bench_record *record = bench_record_begin(state->json, "render");
    const struct {
        const char *name;
        double value;
    } rows[] = {{"triangles", (double)info.triangles},
                {"pixels", (double)state->size * state->size},
                {"spp", (double)state->spp},
                {"threads", (double)state->threads},
                {"lens_radius", (double)state->camera.lens_radius},
                {"open_s", state->open_s},
                {"load_s", info.load_s},
                {"compile_s", compile_s},
                {"build_s", info.build_s},
                {"first_samples_s", state->first_s},
                {"write_s", state->write_s},
                {"memory_mb", (double)usage.ru_maxrss / 1024.0}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        printf("%-16s %12.4g\n", rows[i].name, rows[i].value);
        bench_record_number(record, rows[i].name, rows[i].value);
    }
    for (int p = 0; p < PHASES; p++) {
        const double median_s = bench_median(state->phases[p], state->rounds);
        char name[32];
        snprintf(name, sizeof name, "%s_s", phase_names[p]);
        printf("%-16s %12.4g\n", name, median_s);
        bench_record_number(record, name, median_s);
    }
    const double rate = 1e-6 * state->samples / bench_median(state->phases[KERNELS], state->rounds);
    printf("%-16s %12.4g\n", "msamples_per_s", rate);
    bench_record_number(record, "msamples_per_s", rate);
    bench_record_end(record);
}

int main(int argc, char **argv)
{
    bench state = {.start_s = cs_now_s(),
                   .oracle = "pilot",
                   .mesh = "box",
                   .triangles = 250000,
                   .spp = 64,
                   .size = 256,
                   .rounds = 3,
                   .lens_radius = -1.0};
    const bench_flag flags[] = {{.name = "scene", .text = &state.scene_file},
                                {.name = "mesh", .text = &state.mesh},
                                {.name = "triangles", .count = &state.triangles},
                                {.name = "size", .number = &state.size},
                                {.name = "spp", .count = &state.spp},
                                {.name = "replicates", .count = &state.replicates},
                                {.name = "lens", .real = &state.lens_radius},
                                {.name = "oracle", .text = &state.oracle},
                                {.name = "sampler", .text = &state.sampler},
                                {.name = "threads", .number = &state.threads},
                                {.name = "out", .text = &state.out},
                                {.name = "rounds", .number = &state.rounds},
                                {.name = "json", .text = &state.json}};
    bench_read_flags(argc, argv, flags, sizeof flags / sizeof *flags);
    if (state.rounds < 1 || state.rounds > BENCH_MOST_ROUNDS) state.rounds = 3;
    open_scene(&state);
    for (int round = 0; round < state.rounds; round++)
        render(&state, round);
    report(&state);
    clshear_scene_free(state.scene);
    clshear_context_free(state.context);
    return 0;
}
