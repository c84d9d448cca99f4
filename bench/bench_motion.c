/* Prints a Markdown table of variances, with and without the shear of lens and time. The scene is a
 * Cornell box with a checkered wall, whose camera moves while the shutter is open.
 *
 *   bench_motion [--scene FILE] [--aperture KIND] [--lens-radius R] [--move-x X] [--move-y Y]
 *                [--least N] [--most N] [--seeds K] [--oracle RULE] [--size PX]
 *
 * Crops all over a picture of PX x PX pixels, focus 900. Columns: variance of the mean of one
 * pattern of N samples, averaged over the colours of the darker 95 % of the pixels (the others lie
 * next to the light); for N = --least and fourfold up to --most (64 to 1024); and its slope. Below:
 * the gain of the sheared `sobol` over `mj` and over the best unsheared sampler, mean and standard
 * error over K seeds with 8 patterns a pixel each. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "film/film.h"
#include "measure.h"

enum {
    CROP = 20, /* pixels along the side of a crop */
    ACROSS = 5,
    CROPS = ACROSS * ACROSS,
    PIXELS = CROPS * CROP * CROP,
    PATTERNS = 8,
    MOST_SEEDS = 32,
    MOST_SIZES = 5,
    WAYS = 6,
    UNSHEARED = 3, /* the first ways */
    DEFAULT = 5    /* the way of a render without flags */
};

static const char *const ways[WAYS][2] = {{"mj", "none"},       {"sz", "none"},
                                          {"sobol", "none"},    {"mj", "equal-area"},
                                          {"sz", "equal-area"}, {"sobol", "equal-area"}};

/* Mean over colours in each pixel, summed over renders; the variances of one render. */
typedef struct pixels {
    double mean[PIXELS];
    double variance[PIXELS];
} pixels;

static int descending(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? 1 : x > y ? -1 : 0;
}

/* Above this mean a pixel is among the brightest twentieth. */
static double limit_of(const pixels *p)
{
    double sorted[PIXELS];
    memcpy(sorted, p->mean, sizeof sorted);
    qsort(sorted, PIXELS, sizeof *sorted, descending);
    return sorted[PIXELS / 20];
}

static void render_crop(clshear_scene *scene, clshear_settings *settings, int crop, int size,
                        pixels *p, double *speed)
{
    const int x = (2 * (crop % ACROSS) + 1) * size / (2 * ACROSS) - CROP / 2;
    const int y = (2 * (crop / ACROSS) + 1) * size / (2 * ACROSS) - CROP / 2;
    const double window[4] = {x, x + CROP, y, y + CROP};
    static const char *const names[6] = {"R", "G", "B", "Variance.R", "Variance.G", "Variance.B"};
    bench_must(clshear_settings_set_numbers(settings, CLSHEAR_CROP, window, 4));
    clshear_film *film = bench_render(scene, settings);
    for (int i = 0; i < CROP * CROP; i++) {
        const int at = crop * CROP * CROP + i;
        p->variance[at] = 0.0;
        for (int c = 0; c < 3; c++) {
            p->mean[at] += (double)clshear_film_channel(film, names[c])[i] / 3.0;
            p->variance[at] += (double)clshear_film_channel(film, names[c + 3])[i] * PATTERNS / 3.0;
        }
        speed[at] = hypot((double)clshear_film_channel(film, "Velocity.X")[i],
                          (double)clshear_film_channel(film, "Velocity.Y")[i]);
    }
    clshear_film_free(film);
}

/* Variance of the mean of one pattern, averaged over pixels: squared radiance, by way of sampling,
 * number of samples and seed; and the speed of each pixel, pixels while the shutter is open. */
typedef struct table {
    double variance[WAYS][MOST_SIZES][MOST_SEEDS];
    double speed_px[PIXELS];
    int least; /* samples of the first size; each has four times as many as the one before it */
    int sizes;
    int seeds;
} table;

static double samples_of(const table *t, int index)
{
    return t->least * pow(4.0, index);
}

/* Fills the table. A pixel is left out by its mean over all renders so far, so the first render
 * runs twice, and only its second run counts. */
static void measure(clshear_scene *scene, clshear_settings *settings, int size, table *t)
{
    static pixels p;
    for (int round = -1; round < t->sizes * t->seeds * WAYS; round++) {
        const int number = round < 0 ? 0 : round;
        const int way = number % WAYS, seed = number / WAYS % t->seeds;
        const int index = number / WAYS / t->seeds;
        bench_set_text(settings, CLSHEAR_SAMPLER, ways[way][0]);
        bench_set_text(settings, CLSHEAR_SHEAR, ways[way][1]);
        bench_set(settings, CLSHEAR_SEED, 100.0 + seed);
        bench_set(settings, CLSHEAR_SPP, PATTERNS * samples_of(t, index));
        for (int crop = 0; crop < CROPS; crop++)
            render_crop(scene, settings, crop, size, &p, t->speed_px);
        const double limit = limit_of(&p);
        double sum = 0.0, count = 0.0;
        for (int i = 0; i < PIXELS; i++)
            if (p.mean[i] <= limit) sum += p.variance[i], count += 1.0;
        t->variance[way][index][seed] = sum / count;
    }
}

static double mean_of(const double *values, int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++)
        sum += values[i] / count;
    return sum;
}

static void print_gain(const table *t, int index, int base)
{
    double gains[MOST_SEEDS], square = 0.0;
    for (int k = 0; k < t->seeds; k++)
        gains[k] = t->variance[base][index][k] / t->variance[DEFAULT][index][k];
    const double mean = mean_of(gains, t->seeds);
    for (int k = 0; k < t->seeds; k++)
        square += (gains[k] - mean) * (gains[k] - mean);
    printf(" %.2f ± %.2f |", mean, sqrt(square / (t->seeds - 1) / t->seeds));
}

static void print(const table *t)
{
    printf("| |");
    for (int i = 0; i < t->sizes; i++)
        printf(" N = %.0f |", samples_of(t, i));
    printf(" slope |\n|---|");
    for (int i = 0; i <= t->sizes; i++)
        printf("---|");
    for (int way = 0; way < WAYS; way++) {
        printf("\n| `%s`, %s |", ways[way][0], way < UNSHEARED ? "unsheared" : "sheared");
        for (int i = 0; i < t->sizes; i++)
            printf(" %.2e |", mean_of(t->variance[way][i], t->seeds));
        printf(" %.2f |", log(mean_of(t->variance[way][t->sizes - 1], t->seeds) /
                              mean_of(t->variance[way][0], t->seeds)) /
                              (log(4.0) * (t->sizes > 1 ? t->sizes - 1 : 1)));
    }
    printf("\n| gain of sheared `sobol` over `mj` |");
    for (int i = 0; i < t->sizes; i++)
        print_gain(t, i, 0);
    printf(" |\n| over the best unsheared |");
    for (int i = 0; i < t->sizes; i++) {
        int best = 0;
        for (int way = 1; way < UNSHEARED; way++)
            if (mean_of(t->variance[way][i], t->seeds) < mean_of(t->variance[best][i], t->seeds))
                best = way;
        print_gain(t, i, best);
    }
    printf(" |\n");
}

int main(int argc, char **argv)
{
    const char *path = "scenes/cornell.obj", *aperture = "square", *oracle = NULL;
    double radius = 30.0, move[2] = {11.0, 5.5};
    int least = 64, most = 1024, seeds = 6, size = 512;
    const bench_flag flags[] = {
        {"scene", &path, NULL, NULL, NULL},     {"aperture", &aperture, NULL, NULL, NULL},
        {"oracle", &oracle, NULL, NULL, NULL},  {"lens-radius", NULL, NULL, NULL, &radius},
        {"move-x", NULL, NULL, NULL, &move[0]}, {"move-y", NULL, NULL, NULL, &move[1]},
        {"most", NULL, NULL, &most, NULL},      {"seeds", NULL, NULL, &seeds, NULL},
        {"size", NULL, NULL, &size, NULL},      {"least", NULL, NULL, &least, NULL}};
    static table t;
    clshear_context *context = NULL;
    clshear_scene *scene = NULL;
    bench_read_flags(argc, argv, flags, sizeof flags / sizeof *flags);
    t.seeds = seeds < 2 ? 2 : seeds > MOST_SEEDS ? MOST_SEEDS : seeds;
    t.least = least < 1 ? 1 : least;
    for (int n = t.least; n <= most && t.sizes < MOST_SIZES; n *= 4)
        t.sizes++;
    if (t.sizes == 0 || size < ACROSS * CROP) {
        fprintf(stderr, "bench_motion: --most must be --least or more, --size %d or more\n",
                ACROSS * CROP);
        return 2;
    }
    clshear_settings *settings = bench_settings("scenes/cornell.flags");
    const double to[6] = {276.4 + move[0], 274.4 + move[1], 800.0,
                          276.4 + move[0], 274.4 + move[1], 0.0};
    bench_set_text(settings, CLSHEAR_APERTURE, aperture);
    bench_set_text(settings, CLSHEAR_ORACLE, oracle);
    bench_set(settings, CLSHEAR_LENS_RADIUS, radius);
    bench_set(settings, CLSHEAR_FOCAL_DISTANCE, 900.0);
    bench_set(settings, CLSHEAR_WIDTH, size);
    bench_set(settings, CLSHEAR_HEIGHT, size);
    bench_set(settings, CLSHEAR_REPLICATES, PATTERNS);
    bench_must(clshear_settings_set_numbers(settings, CLSHEAR_CAMERA_TO, to, 6));
    bench_must(clshear_context_create(NULL, &context));
    bench_must(clshear_scene_load(context, path, settings, &scene));
    measure(scene, settings, size, &t);
    printf("%s, lens radius %g; motion of the median pixel: %.1f px\n\n", aperture, radius,
           bench_median(t.speed_px, PIXELS));
    print(&t);
    clshear_settings_free(settings);
    clshear_scene_free(scene);
    clshear_context_free(context);
    return 0;
}
