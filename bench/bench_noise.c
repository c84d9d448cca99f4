/* Noise of rendered pictures, as a Markdown table.
 *
 *   bench_noise GROUP [GROUP ...]    with GROUP: LABEL BASE FILE [FILE ...] +
 *
 * Several files are renders with different seeds: their variance across seeds is measured. A single
 * file has R > 2 replicates and represents renders with two: its variance is that of the Variance
 * channels times R / 2. Columns: mean over pixels and colours of the variance (MSE); of the
 * variance over the squared mean plus a ten-thousandth of the picture's squared mean (relative
 * MSE); and the 10th, 50th and 90th percentile of the ratio of variances to group BASE. The ratio
 * is taken over tiles of 8 x 8 pixels with a standard error above 0.1 % of their mean. "-" for
 * BASE: no ratio. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "film/film.h"
#include "measure.h"

enum {
    TILE = 8,
    MOST_GROUPS = 32
};

typedef struct group {
    const char *label, *base;
    int width, height;
    double *mean, *variance; /* mean and variance of each pixel, averaged over colours */
} group;

static const char *const colours[3] = {"R", "G", "B"};
static const char *const variances[3] = {"Variance.R", "Variance.G", "Variance.B"};

static void stop(const char *what)
{
    fprintf(stderr, "bench_noise: %s\n", what);
    exit(1);
}

static clshear_film *must_read(const char *path)
{
    clshear_film *film = NULL;
    bench_must(clshear_film_read(path, &film));
    return film;
}

static void reserve(group *g, const clshear_film *film)
{
    clshear_film_info info = {.struct_size = sizeof info};
    clshear_film_describe(film, &info);
    const size_t pixels = (size_t)info.width * (size_t)info.height;
    if (g->mean != NULL) return;
    g->width = info.width;
    g->height = info.height;
    g->mean = calloc(pixels, sizeof *g->mean);
    g->variance = calloc(pixels, sizeof *g->variance);
    if (g->mean == NULL || g->variance == NULL) stop("out of memory");
}

static void read_replicates(group *g, const char *path)
{
    clshear_film *film = must_read(path);
    int replicates = 0;
    reserve(g, film);
    if (!cs_film_int(film, "clshear.replicates", &replicates) || replicates < 3)
        stop("a single file must have 3 replicates or more");
    for (int i = 0; i < g->width * g->height; i++)
        for (int c = 0; c < 3; c++) {
            g->mean[i] += (double)clshear_film_channel(film, colours[c])[i] / 3.0;
            g->variance[i] +=
                (double)clshear_film_channel(film, variances[c])[i] * replicates / 6.0;
        }
    clshear_film_free(film);
}

static void read_seeds(group *g, char **paths, int count)
{
    double *mean = NULL, *m2 = NULL;
    if (count < 2) stop("a group must have 2 files or more, or one with replicates");
    for (int k = 0; k < count; k++) {
        clshear_film *film = must_read(paths[k]);
        reserve(g, film);
        const size_t values = 3 * (size_t)g->width * (size_t)g->height;
        if (mean == NULL) {
            mean = calloc(values, sizeof *mean);
            m2 = calloc(values, sizeof *m2);
        }
        if (mean == NULL || m2 == NULL) stop("out of memory");
        for (size_t i = 0; i < values; i++) {
            const double value = (double)clshear_film_channel(film, colours[i % 3])[i / 3];
            const double delta = value - mean[i];
            mean[i] += delta / (k + 1);
            m2[i] += delta * (value - mean[i]);
        }
        clshear_film_free(film);
    }
    for (size_t i = 0; i < 3 * (size_t)g->width * (size_t)g->height; i++) {
        g->mean[i / 3] += mean[i] / 3.0;
        g->variance[i / 3] += m2[i] / (count - 1) / 3.0;
    }
    free(mean);
    free(m2);
}

static double tile_sum(const group *g, const double *values, int x0, int y0)
{
    double sum = 0.0;
    for (int y = y0; y < y0 + TILE && y < g->height; y++)
        for (int x = x0; x < x0 + TILE && x < g->width; x++)
            sum += values[y * g->width + x];
    return sum;
}

static void print_gains(const group *g, const group *base)
{
    double *gains = malloc((size_t)g->width * (size_t)g->height * sizeof *gains);
    int count = 0;
    if (gains == NULL) stop("out of memory");
    for (int y = 0; y < g->height; y += TILE)
        for (int x = 0; x < g->width; x += TILE) {
            const double before = tile_sum(base, base->variance, x, y);
            const double after = tile_sum(g, g->variance, x, y);
            const double level = tile_sum(base, base->mean, x, y) / (TILE * TILE);
            if (sqrt(before / (TILE * TILE)) <= 1e-3 * level || after <= 0.0) continue;
            gains[count++] = before / after;
        }
    if (count == 0)
        printf(" - | - | - |");
    else
        printf(" %.2f | %.2f | %.2f |", bench_quantile(gains, count, 0.1),
               bench_quantile(gains, count, 0.5), bench_quantile(gains, count, 0.9));
    free(gains);
}

static void print_group(const group *g, const group *groups, int count)
{
    const int pixels = g->width * g->height;
    double mean = 0.0, mse = 0.0, relative = 0.0;
    for (int i = 0; i < pixels; i++)
        mean += g->mean[i] / pixels;
    for (int i = 0; i < pixels; i++) {
        mse += g->variance[i] / pixels;
        relative += g->variance[i] / (g->mean[i] * g->mean[i] + 1e-4 * mean * mean) / pixels;
    }
    printf("| %s | %.2e | %.2e |", g->label, mse, relative);
    for (int k = 0; k < count; k++)
        if (strcmp(groups[k].label, g->base) == 0) {
            print_gains(g, &groups[k]);
            printf("\n");
            return;
        }
    printf(" | | |\n");
}

int main(int argc, char **argv)
{
    group groups[MOST_GROUPS];
    int count = 0;
    for (int i = 1; i < argc; count++) {
        int end = i;
        while (end < argc && strcmp(argv[end], "+") != 0)
            end++;
        if (end - i < 3 || count == MOST_GROUPS) stop("usage: LABEL BASE FILE [FILE ...] + ...");
        groups[count] = (group){.label = argv[i], .base = argv[i + 1]};
        if (end - i == 3)
            read_replicates(&groups[count], argv[i + 2]);
        else
            read_seeds(&groups[count], argv + i + 2, end - i - 2);
        i = end + 1;
    }
    printf("| renders | MSE | relative MSE | gain 10 %% | 50 %% | 90 %% "
           "|\n|---|---|---|---|---|---|\n");
    for (int k = 0; k < count; k++) {
        print_group(&groups[k], groups, count);
    }
    for (int k = 0; k < count; k++)
        free(groups[k].mean), free(groups[k].variance);
    return 0;
}
