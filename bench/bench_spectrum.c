/* Power spectra: the device against one thread of C that calls sincosf for every point and
 * frequency, in turn, medians of the ratio. The latter takes a part of the rows and is scaled up.
 *
 * bench_spectrum [POINTS [SETS [RESOLUTION [ROUNDS]]]] */
#define _GNU_SOURCE /* sincosf */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/status.h"

enum {
    MOST_ROUNDS = 51,
    ROWS = 2 /* of one set, that the plain loop takes */
};

static int by_value(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* Seconds for ROWS rows of one set. */
static double plain_s(const clshear_points *points, size_t resolution, float *power)
{
    const double start_s = cs_now_s();
    const float two_pi = 6.2831853f;
    for (int row = 0; row < ROWS; row++)
        for (size_t column = 0; column < resolution; column++) {
            const float x = two_pi * ((float)column - 0.5f * (float)resolution);
            const float y = two_pi * (float)(row + 1);
            float re = 0.0f, im = 0.0f;
            for (size_t i = 0; i < points->count; i++) {
                float sine, cosine;
                sincosf(x * points->values[2 * i] + y * points->values[2 * i + 1], &sine, &cosine);
                re += cosine, im += sine;
            }
            power[(size_t)row * resolution + column] = (re * re + im * im) / (float)points->count;
        }
    return cs_now_s() - start_s;
}

static size_t argument(int argc, char **argv, int index, size_t otherwise)
{
    return argc > index && atoi(argv[index]) > 0 ? (size_t)atoi(argv[index]) : otherwise;
}

int main(int argc, char **argv)
{
    const size_t count = argument(argc, argv, 1, 1024), sets = argument(argc, argv, 2, 100);
    const size_t resolution = argument(argc, argv, 3, 512), wanted = argument(argc, argv, 4, 7);
    const size_t rounds = wanted < MOST_ROUNDS ? wanted : MOST_ROUNDS;
    double device[MOST_ROUNDS], ratio[MOST_ROUNDS];
    clshear_context *context = NULL;
    clshear_points points = {0};
    float *power = malloc(ROWS * resolution * sizeof *power);
    if (power == NULL || clshear_context_create(NULL, &context) != CLSHEAR_OK ||
        clshear_points_draw("mj", count, sets, 0, &points) != CLSHEAR_OK ||
        clshear_points_select(&points, "xu") != CLSHEAR_OK) {
        fprintf(stderr, "bench_spectrum: %s\n", clshear_message(NULL));
        return 1;
    }
    for (size_t round = 0; round <= rounds; round++) { /* the first one compiles */
        clshear_spectrum spectrum = {0};
        const double start_s = cs_now_s();
        if (clshear_spectrum_measure(context, &points, resolution, resolution, &spectrum) !=
            CLSHEAR_OK) {
            fprintf(stderr, "bench_spectrum: %s\n", clshear_message(context));
            return 1;
        }
        const double took_s = cs_now_s() - start_s;
        const double plain =
            plain_s(&points, resolution, power) * (double)(sets * resolution) / ROWS;
        clshear_spectrum_free(&spectrum);
        if (round == 0) continue;
        device[round - 1] = took_s;
        ratio[round - 1] = plain / took_s;
    }
    qsort(device, rounds, sizeof *device, by_value);
    qsort(ratio, rounds, sizeof *ratio, by_value);
    printf(
        "%zu sets of %zu points, %zu x %zu frequencies: %.2f s, %.0f times one thread of sincosf\n",
        sets, count, resolution, resolution, device[rounds / 2], ratio[rounds / 2]);
    clshear_points_free(&points);
    clshear_context_free(context);
    free(power);
    return 0;
}
