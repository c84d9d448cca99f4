/* Renders of one scene of DoF-20: a row of a CSV file for each, with its errors and its CPU time.
 *
 *   bench_dof20 --name NAME --model FILE --settings FILE --reference FILE.exr [--csv FILE]
 *               [--methods NAME,...] [--samples N,...] [--seeds N] [--width PX] [--height PX]
 *               [--reference-samples N] [--picture FILE.exr]
 *
 * The reference is rendered if it is missing: shared out by need, another seed. Rows that the CSV
 * file has are not measured again. With --picture, prints the errors of that picture instead, for
 * rows of other renderers.
 *
 * MSE: mean over pixels and colours of the squared difference from the reference, less the
 * reference's own variance (its Variance channels). Relative MSE: each of them divided by the
 * reference squared plus a ten-thousandth of its mean squared. CPU time is that of the process
 * during the render, of all its threads: prepass and pilots count, reading the scene and compiling
 * do not. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure.h"

typedef struct method {
    const char *name;
    const char *sampler; /* NULL: the default */
    const char *shear;
    int adaptive; /* -1: the default */
} method;

static const method methods[] = {
    {"random", "random", "none", 0},     {"mj", "mj", "none", 0},
    {"sobol", "sobol", "none", 0},       {"sz", "sz", "none", 0},
    {"shared", NULL, "none", 1},         {"even", NULL, "equal-area", 0},
    {"adaptive", NULL, "equal-area", -1}};

enum {
    METHODS = sizeof methods / sizeof *methods,
    REFERENCE_REPLICATES = 4,
    REFERENCE_SEED = 1000003
};

typedef struct bench {
    const char *name, *model, *settings, *reference, *csv, *methods, *samples, *picture;
    int seeds, width, height;
    size_t reference_samples;
    clshear_context *context;
    clshear_scene *scene;
} bench;

typedef struct errors {
    double mean;     /* of the picture */
    double mse;      /* against the reference */
    double relative; /* MSE */
    double variance; /* mean of the Variance channels, 0 without them */
} errors;

static clshear_film_info info_of(const clshear_film *film)
{
    clshear_film_info info = {.struct_size = sizeof info};
    clshear_film_describe(film, &info);
    return info;
}

static double mean_of(const clshear_film *film, size_t pixels)
{
    double sum = 0.0;
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < pixels; i++)
            sum += (double)clshear_film_channel(film, (const char *[]){"R", "G", "B"}[c])[i];
    return sum / (3.0 * (double)pixels);
}

static errors compare(const clshear_film *film, const clshear_film *reference)
{
    static const char *const colours[3] = {"R", "G", "B"};
    static const char *const variances[3] = {"Variance.R", "Variance.G", "Variance.B"};
    const clshear_film_info info = info_of(film), base = info_of(reference);
    if (info.width != base.width || info.height != base.height) {
        fprintf(stderr, "bench_dof20: the picture is %d x %d pixels, the reference %d x %d\n",
                info.width, info.height, base.width, base.height);
        exit(1);
    }
    const size_t pixels = (size_t)info.width * (size_t)info.height;
    const double level = mean_of(reference, pixels), parts = 3.0 * (double)pixels;
    errors found = {.mean = mean_of(film, pixels)};
    for (int c = 0; c < 3; c++) {
        const float *value = clshear_film_channel(film, colours[c]);
        const float *variance = clshear_film_channel(film, variances[c]);
        const float *truth = clshear_film_channel(reference, colours[c]);
        const float *doubt = clshear_film_channel(reference, variances[c]);
        for (size_t i = 0; i < pixels; i++) {
            const double t = (double)truth[i], difference = (double)value[i] - t;
            const double square = difference * difference - (doubt != NULL ? (double)doubt[i] : 0);
            found.mse += square / parts;
            found.relative += square / (t * t + 1e-4 * level * level) / parts;
            if (variance != NULL) found.variance += (double)variance[i] / parts;
        }
    }
    return found;
}

static clshear_settings *settings_of(const bench *b, size_t samples, double seed)
{
    clshear_settings *settings = bench_settings(b->settings);
    bench_set(settings, CLSHEAR_WIDTH, b->width);
    bench_set(settings, CLSHEAR_HEIGHT, b->height);
    bench_set(settings, CLSHEAR_SPP, (double)samples);
    bench_set(settings, CLSHEAR_SEED, seed);
    return settings;
}

static clshear_film *render_with(const bench *b, const method *how, size_t samples, double seed)
{
    clshear_settings *settings = settings_of(b, samples, seed);
    bench_set_text(settings, CLSHEAR_SAMPLER, how->sampler);
    bench_set_text(settings, CLSHEAR_SHEAR, how->shear);
    clshear_settings_unset(settings, CLSHEAR_ADAPTIVE);
    if (how->adaptive >= 0) bench_set(settings, CLSHEAR_ADAPTIVE, how->adaptive);
    clshear_film *film = bench_render(b->scene, settings);
    clshear_settings_free(settings);
    return film;
}

/* The scene is read when it is first needed. */
static void load(bench *b)
{
    if (b->scene != NULL) return;
    clshear_settings *settings = settings_of(b, 1, 0);
    bench_must(clshear_context_create(settings, &b->context));
    bench_must(clshear_scene_load(b->context, b->model, settings, &b->scene));
    clshear_settings_free(settings);
}

static clshear_film *reference_of(bench *b)
{
    clshear_film *film = NULL;
    FILE *file = fopen(b->reference, "rb");
    if (file != NULL) {
        fclose(file);
        bench_must(clshear_film_read(b->reference, &film));
        return film;
    }
    load(b);
    clshear_settings *settings = settings_of(b, b->reference_samples, REFERENCE_SEED);
    bench_set(settings, CLSHEAR_REPLICATES, REFERENCE_REPLICATES);
    bench_set(settings, CLSHEAR_ADAPTIVE, 1); /* the pilot is thrown away: unbiased */
    film = bench_render(b->scene, settings);
    bench_must(clshear_film_write(film, b->reference));
    clshear_settings_free(settings);
    return film;
}

/* Whether the CSV file has a row that begins like this. */
static int has_row(const char *path, const char *start)
{
    char line[512];
    int found = 0;
    FILE *file = fopen(path, "r");
    while (file != NULL && !found && fgets(line, sizeof line, file) != NULL)
        found = strncmp(line, start, strlen(start)) == 0;
    if (file != NULL) fclose(file);
    return found;
}

static FILE *must_append(const char *path)
{
    FILE *file = fopen(path, "a");
    if (file == NULL) {
        perror(path);
        exit(1);
    }
    return file;
}

static void measure(bench *b, const method *how, size_t samples, int seed, clshear_film *reference)
{
    char start[256];
    snprintf(start, sizeof start, "%s,%s,%zu,%d,", b->name, how->name, samples, seed);
    if (has_row(b->csv, start)) return;
    if (b->scene == NULL) {
        load(b);
        for (size_t m = 0; m < METHODS; m++) /* compiles */
            clshear_film_free(render_with(b, &methods[m], 16, 0));
    }
    const double before = bench_cpu_s();
    clshear_film *film = render_with(b, how, samples, seed);
    const double took = bench_cpu_s() - before;
    const errors e = compare(film, reference);
    FILE *file = must_append(b->csv);
    fprintf(file, "%s%.6g,%.6g,%.6g,%.6g,%.6g\n", start, e.mse, e.relative, took, e.variance,
            e.mean);
    fclose(file);
    clshear_film_free(film);
}

/* Whether a list of names separated by commas, or NULL for all, has this one. */
static int is_listed(const char *list, const char *name)
{
    const size_t length = strlen(name);
    while (list != NULL && *list != '\0') {
        const size_t item = strcspn(list, ",");
        if (item == length && strncmp(list, name, length) == 0) return 1;
        list += item + (list[item] == ',');
    }
    return list == NULL;
}

static void measure_all(bench *b, clshear_film *reference)
{
    for (int seed = 1; seed <= b->seeds; seed++)
        for (const char *next = b->samples; next != NULL && *next != '\0';) {
            const size_t samples = strtoul(next, (char **)&next, 10);
            next += *next == ',';
            for (size_t m = 0; m < METHODS; m++)
                if (is_listed(b->methods, methods[m].name))
                    measure(b, &methods[m], samples, seed, reference);
        }
}

int main(int argc, char **argv)
{
    bench b = {.seeds = 1, .width = 120, .height = 90, .reference_samples = 4096};
    const bench_flag flags[] = {{.name = "name", .text = &b.name},
                                {.name = "model", .text = &b.model},
                                {.name = "settings", .text = &b.settings},
                                {.name = "reference", .text = &b.reference},
                                {.name = "csv", .text = &b.csv},
                                {.name = "methods", .text = &b.methods},
                                {.name = "samples", .text = &b.samples},
                                {.name = "seeds", .number = &b.seeds},
                                {.name = "width", .number = &b.width},
                                {.name = "height", .number = &b.height},
                                {.name = "reference-samples", .count = &b.reference_samples},
                                {.name = "picture", .text = &b.picture}};
    bench_read_flags(argc, argv, flags, sizeof flags / sizeof *flags);
    if (b.reference == NULL) {
        fprintf(stderr, "bench_dof20: --reference FILE is needed\n");
        return 2;
    }
    clshear_film *reference = reference_of(&b);
    if (b.picture != NULL) {
        clshear_film *film = NULL;
        bench_must(clshear_film_read(b.picture, &film));
        const errors e = compare(film, reference);
        printf("%.6g,%.6g\n", e.mse, e.relative);
        clshear_film_free(film);
    } else if (b.csv != NULL) {
        measure_all(&b, reference);
    }
    clshear_film_free(reference);
    clshear_scene_free(b.scene);
    clshear_context_free(b.context);
    return 0;
}
