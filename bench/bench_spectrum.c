/* Power spectra: the device against one thread of C that calls sincosf for every point and
 * frequency. They run in turn, and medians of the ratio are printed. The C code computes a part of
 * the rows, and its time is scaled up.
 *
 *   bench_spectrum [--points N] [--sets N] [--resolution N] [--rounds N] */
#define _GNU_SOURCE /* sincosf */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/status.h"
#include "clshear/analysis.h"
#include "measure.h"

enum {
    ROWS = 2 /* rows of one set in the plain loop */
};

/* Measures the seconds for ROWS rows of one set. */
static double plain_s(const clshear_points *points, size_t resolution, float *power)
{
    const double start_s = cs_now_s();
    const float *values = clshear_points_values(points);
    const size_t count = clshear_points_count(points);
    const float two_pi = 6.2831853f;
    for (int row = 0; row < ROWS; row++)
        for (size_t column = 0; column < resolution; column++) {
            const float x = two_pi * ((float)column - 0.5f * (float)resolution);
            const float y = two_pi * (float)(row + 1);
            float re = 0.0f, im = 0.0f;
            for (size_t i = 0; i < count; i++) {
                float sine, cosine;
                sincosf(x * values[2 * i] + y * values[2 * i + 1], &sine, &cosine);
                re += cosine;
                im += sine;
            }
            power[(size_t)row * resolution + column] = (re * re + im * im) / (float)count;
        }
    return cs_now_s() - start_s;
}

int main(int argc, char **argv)
{
    size_t count = 1024, sets = 100, resolution = 512;
    int rounds = 7;
    const bench_flag flags[] = {{.name = "points", .count = &count},
                                {.name = "sets", .count = &sets},
                                {.name = "resolution", .count = &resolution},
                                {.name = "rounds", .number = &rounds}};
    double device[BENCH_MOST_ROUNDS], ratio[BENCH_MOST_ROUNDS];
    clshear_context *context = NULL;
    clshear_points *points = NULL;
    bench_read_flags(argc, argv, flags, sizeof flags / sizeof *flags);
    rounds = bench_rounds(rounds);
    float *power = malloc(ROWS * resolution * sizeof *power);
    if (power == NULL) return 1;
    bench_must(clshear_context_create(NULL, &context));
    bench_must(clshear_points_draw("mj", count, sets, 0, &points));
    bench_must(clshear_points_select(points, "xu"));
    for (int round = -1; round < rounds; round++) { /* the first round compiles */
        clshear_spectrum *spectrum = NULL;
        const double start_s = cs_now_s();
        bench_must(clshear_spectrum_measure(context, points, resolution, resolution, &spectrum));
        const double took_s = cs_now_s() - start_s;
        const double plain =
            plain_s(points, resolution, power) * (double)(sets * resolution) / ROWS;
        clshear_spectrum_free(spectrum);
        if (round < 0) continue;
        device[round] = took_s;
        ratio[round] = plain / took_s;
    }
    printf(
        "%zu sets of %zu points, %zu x %zu frequencies: %.2f s, %.0f times one thread of sincosf\n",
        sets, count, resolution, resolution, bench_median(device, rounds),
        bench_median(ratio, rounds));
    clshear_points_free(points);
    clshear_context_free(context);
    free(power);
    return 0;
}
