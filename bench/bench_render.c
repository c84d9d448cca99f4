/* The time of a whole job, by phases.
 *
 *   bench_render [--scene FILE | --mesh box|spheres|terrain --triangles N] [--size PX] [--spp N]
 *                [--replicates R] [--lens R] [--oracle centre|pilot] [--sampler NAME] [--threads N]
 *                [--out FILE] [--rounds N] [--json FILE]
 *
 * The start lasts from main() to the end of the first samples. It includes the compilation of the
 * kernels, or their lookup in the driver's cache (an empty POCL_CACHE_DIR gives a cold start). The
 * render is repeated. The benchmark prints the medians of its phases, and the process's peak
 * memory. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>

#include "measure.h"
#include "meshes.h"
#include "render/objects.h"

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
    double start_s, open_s, load_s, first_s; /* times in seconds, measured from the start of main */
    clshear_context *context;
    clshear_scene *scene;
    clshear_settings *settings;
    double phases[PHASES][BENCH_MOST_ROUNDS];
    double samples, write_s;
} bench;

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
    if (test_make_mesh(state->mesh, state->triangles, &made, &error) != CLSHEAR_OK) exit(1);
    const clshear_mesh mesh = {.struct_size = sizeof mesh,
                               .positions = made.positions.items,
                               .indices = made.indices.items,
                               .vertex_count = made.positions.count,
                               .triangle_count = made.indices.count,
                               .diffuse = {0.7f, 0.7f, 0.7f}};
    state->start_s = cs_now_s(); /* the product does not make meshes */
    bench_must(clshear_scene_create(state->context, &state->scene));
    bench_must(clshear_scene_add_mesh(state->scene, &mesh));
    bench_must(clshear_scene_complete(state->scene));
    cs_scene_free(&made);
}

/* Sets camera, lens and light: from the settings file beside a scene file, or as in the other
 * benchmarks for a mesh. */
static void choose_settings(bench *state)
{
    char path[1024];
    clshear_settings *settings;
    if (state->scene_file != NULL) {
        const char *dot = strrchr(state->scene_file, '.');
        const int stem =
            (int)(dot != NULL ? (size_t)(dot - state->scene_file) : strlen(state->scene_file));
        snprintf(path, sizeof path, "%.*s.flags", stem, state->scene_file);
        settings = bench_settings(path);
        bench_set_text(settings, CLSHEAR_APERTURE, "disk");
    } else {
        settings = bench_settings(NULL);
        bench_set_text(settings, CLSHEAR_EYE, "0.5,0.5,2.2");
        bench_set_text(settings, CLSHEAR_TARGET, "0.5,0.5,0.5");
        bench_set_text(settings, CLSHEAR_UP, "0,1,0");
        bench_set_text(settings, CLSHEAR_FOV, "45");
        bench_set_text(settings, CLSHEAR_FOCAL_DISTANCE, "1.5");
        bench_set_text(settings, CLSHEAR_LENS_RADIUS, "0.05");
        bench_set_text(settings, CLSHEAR_LIGHT, "0.5,0.95,0.5,2,2,2");
    }
    if (state->lens_radius >= 0.0) bench_set(settings, CLSHEAR_LENS_RADIUS, state->lens_radius);
    bench_set(settings, CLSHEAR_WIDTH, state->size);
    bench_set(settings, CLSHEAR_HEIGHT, state->size);
    bench_set(settings, CLSHEAR_SPP, (double)state->spp);
    if (state->replicates > 0) bench_set(settings, CLSHEAR_REPLICATES, (double)state->replicates);
    bench_set(settings, CLSHEAR_THREADS, state->threads);
    bench_set_text(settings, CLSHEAR_SAMPLER, state->sampler);
    bench_set_text(settings, CLSHEAR_ORACLE, state->oracle);
    clshear_settings_set_progress(settings, first_samples, state);
    state->settings = settings;
}

static void open_scene(bench *state)
{
    choose_settings(state);
    bench_must(clshear_context_create(state->settings, &state->context));
    state->open_s = cs_now_s() - state->start_s;
    const double start_s = cs_now_s();
    if (state->scene_file != NULL)
        bench_must(clshear_scene_load(state->context, state->scene_file, NULL, &state->scene));
    else
        make_mesh(state);
    state->load_s = cs_now_s() - (state->scene_file != NULL ? start_s : state->start_s);
}

static void render(bench *state, int round)
{
    clshear_film *film = bench_render(state->scene, state->settings);
    clshear_film_info info = {.struct_size = sizeof info};
    clshear_film_describe(film, &info);
    const double phases[PHASES] = {
        info.prepass_s, info.pilot_s, info.kernel_s,
        fmax(info.render_s - info.prepass_s - info.pilot_s - info.kernel_s, 0.0), info.render_s};
    for (int p = 0; p < PHASES; p++)
        state->phases[p][round] = phases[p];
    state->samples = (double)info.samples;
    const double before_s = cs_now_s();
    if (state->out != NULL) bench_must(clshear_film_write(film, state->out));
    state->write_s = cs_now_s() - before_s;
    clshear_film_free(film);
}

static void report(bench *state)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    clshear_scene_info info = {.struct_size = sizeof info};
    double lens_radius = 0.0;
    clshear_scene_describe(state->scene, &info);
    bench_must(clshear_settings_get_number(state->settings, CLSHEAR_LENS_RADIUS, &lens_radius));
    const double compile_s = fmax(state->load_s - info.load_s - info.build_s, 0.0);
    bench_record *record = bench_record_begin(state->json, "render");
    const struct {
        const char *name;
        double value;
    } rows[] = {{"triangles", (double)info.triangles},
                {"pixels", (double)state->size * state->size},
                {"spp", (double)state->spp},
                {"threads", (double)state->threads},
                {"lens_radius", lens_radius},
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
    state.rounds = bench_rounds(state.rounds);
    open_scene(&state);
    for (int round = 0; round < state.rounds; round++)
        render(&state, round);
    report(&state);
    clshear_settings_free(state.settings);
    clshear_scene_free(state.scene);
    clshear_context_free(state.context);
    return 0;
}
