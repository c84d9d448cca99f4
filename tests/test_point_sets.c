/* The pools of planar sets behind `poisson` and `ccvt`: realisations, independence of the pairs,
 * and their files. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

#include "clshear/analysis.h"
#include "clshear/device/sampler/sampler.h"

enum {
    POINTS = 64,
    SETS = 64,
    FRESH_POOLS = 16,
    REACH = 6,                                                /* highest frequency along an axis */
    FREQUENCIES = (2 * REACH + 1) * (REACH + 1) - (REACH + 1) /* half of the plane, without 0 */
};

static const double pi = 3.14159265358979323846;

static double power_at(const float *points, int a, int b)
{
    double re = 0.0, im = 0.0;
    for (int i = 0; i < POINTS; i++) {
        const double phase = 2.0 * pi * (a * (double)points[2 * i] + b * (double)points[2 * i + 1]);
        re += cos(phase);
        im += sin(phase);
    }
    return (re * re + im * im) / POINTS;
}

/* Powers at half of the frequencies up to REACH; the other half mirrors them. */
static void periodogram(const float *points, double *power)
{
    for (int b = 0; b <= REACH; b++)
        for (int a = b == 0 ? 1 : -REACH; a <= REACH; a++)
            *power++ = power_at(points, a, b);
}

/* Every set of a pool once, by the words of its table: a set's power does not depend on shifts. */
static void add_pool(const cs_pattern *pattern, double *sum, double *squares)
{
    cs_error error;
    cs_array rows = {0};
    const size_t stride = (size_t)pattern->blocks * CS_BLOCK;
    double power[FREQUENCIES];
    float points[2 * POINTS];
    assert_int_equal(cs_pattern_parts(pattern), SETS);
    assert_int_equal(cs_sample_table_make(pattern, CS_ORDER_SEQUENCE, &rows, &error), CLSHEAR_OK);
    for (size_t set = 0; set < SETS; set++) {
        const cs_u32 *x = (const cs_u32 *)rows.items + 2 * set * stride;
        for (int i = 0; i < POINTS; i++) {
            points[2 * i] = (float)x[i] * 0x1p-32f;
            points[2 * i + 1] = (float)x[stride + (size_t)i] * 0x1p-32f;
        }
        periodogram(points, power);
        for (int k = 0; k < FREQUENCIES; k++) {
            sum[k] += power[k];
            squares[k] += power[k] * power[k];
        }
    }
    cs_array_free(&rows);
}

/* The mean periodogram of the kept pool differs from that of 16 fresh ones by as much as 64 and
 * 1024 independent sets let expect: the mean over K = 84 frequencies of the squared difference over
 * its variance is 1, with a standard deviation below sqrt(2.2 / K) = 0.16, powers being about
 * exponentially distributed. 1.9 is 5.6 of them. With one set for all seeds it is about 60. */
static void the_interval_over_seeds_holds_the_expected_spectrum(void **state)
{
    static double kept[FREQUENCIES], fresh[FREQUENCIES], squares[FREQUENCIES], unused[FREQUENCIES];
    double sum = 0.0;
    (void)state;
    cs_pattern pattern = cs_pattern_of(CS_SAMPLER_POISSON, 0, POINTS);
    add_pool(&pattern, kept, unused);
    for (cs_u32 seed = 0; seed < FRESH_POOLS; seed++) {
        cs_pattern_refresh(&pattern, seed);
        add_pool(&pattern, fresh, squares);
    }
    const double many = (double)FRESH_POOLS * SETS;
    for (int k = 0; k < FREQUENCIES; k++) {
        const double mean = fresh[k] / many, variance = squares[k] / many - mean * mean;
        sum += pow(kept[k] / SETS - mean, 2) / (variance / SETS + variance / many);
    }
    assert_below(sum / FREQUENCIES, 1.9);
    assert_above(sum / FREQUENCIES, 0.4);
}

/* No pattern has the same set in two of its slots, and all sets are used. */
static void slots_have_different_sets(void **state)
{
    const cs_pattern pattern = cs_pattern_of(CS_SAMPLER_CCVT, 0, POINTS);
    int used[CS_SLOT_COUNT][SETS] = {{0}};
    (void)state;
    for (cs_u32 pixel = 0; pixel < 4000; pixel++) {
        const cs_u32 key = cs_pattern_key(1, pixel, 0);
        cs_u32 set[CS_SLOT_COUNT];
        for (cs_u32 slot = 0; slot < CS_SLOT_COUNT; slot++) {
            set[slot] = cs_set_word(&pattern, key, slot) / 2u;
            assert_below(set[slot], SETS);
            used[slot][set[slot]]++;
            for (cs_u32 other = 0; other < slot; other++)
                assert_int_not_equal(set[slot], set[other]);
        }
    }
    for (int slot = 0; slot < CS_SLOT_COUNT; slot++)
        for (int set = 0; set < SETS; set++)
            assert_above(used[slot][set], 20); /* 62.5 expected; 20 is 5 standard deviations off */
}

/* Across 2000 patterns the powers of the film's and of the lens's set are uncorrelated, within 5
 * standard errors of 0.022 plus what a pool of 64 leaves, about 1 / 64. One set for both would give
 * 1. */
static void film_and_lens_are_independent(void **state)
{
    enum {
        PATTERNS = 2000
    };
    clshear_points *film = NULL, *lens = NULL;
    (void)state;
    test_ok(clshear_points_draw("poisson", POINTS, PATTERNS, 5, &film));
    test_ok(clshear_points_draw("poisson", POINTS, PATTERNS, 5, &lens));
    test_ok(clshear_points_select(film, "xy"));
    test_ok(clshear_points_select(lens, "uv"));
    double m1 = 0.0, m2 = 0.0, s11 = 0.0, s22 = 0.0, s12 = 0.0;
    for (int p = 0; p < PATTERNS; p++) {
        const double a = power_at(clshear_points_values(film) + 2 * POINTS * p, 3, 2);
        const double b = power_at(clshear_points_values(lens) + 2 * POINTS * p, 3, 2);
        m1 += a / PATTERNS, m2 += b / PATTERNS;
        s11 += a * a / PATTERNS, s22 += b * b / PATTERNS, s12 += a * b / PATTERNS;
    }
    const double correlation = (s12 - m1 * m2) / sqrt((s11 - m1 * m1) * (s22 - m2 * m2));
    assert_below(fabs(correlation), 0.13);
    clshear_points_free(film);
    clshear_points_free(lens);
}

enum {
    VALUES = 100 * 5 * CS_DIMENSIONS
};

/* A hundred patterns of five points; of `fresh` sets if asked for. */
static void draw_values(uint32_t seed, int fresh, float *values)
{
    clshear_points *points = NULL;
    test_ok(fresh ? clshear_points_draw_fresh("ccvt", 5, 100, seed, &points)
                  : clshear_points_draw("ccvt", 5, 100, seed, &points));
    memcpy(values, clshear_points_values(points), VALUES * sizeof *values);
    clshear_points_free(points);
}

static const char folder[] = SCRATCH "/cache-of-sets";
static const char file[] = SCRATCH "/cache-of-sets/clshear/point-sets/ccvt-5-7";

static void write_over(const char *mode, long place, const char *text)
{
    FILE *stream = fopen(file, mode);
    assert_non_null(stream);
    fseek(stream, place, SEEK_SET);
    fputs(text, stream);
    fclose(stream);
}

static long size_of_file(void)
{
    struct stat about;
    return stat(file, &about) == 0 ? (long)about.st_size : -1;
}

/* Sets are kept as files. One that is cut short, changed or longer is made again; without a folder
 * to write in, everything works. */
static void broken_files_are_made_again(void **state)
{
    const long size = 4 * (5 + 2 * 5);
    float first[VALUES], again[VALUES];
    (void)state;
    remove(file);
    setenv("XDG_CACHE_HOME", folder, 1);
    draw_values(1, 0, first);
    assert_int_equal(size_of_file(), size);
    for (int harm = 0; harm < 4; harm++) {
        if (harm == 0) write_over("wb", 0, "");
        if (harm == 1) write_over("wb", 0, "half of a he");
        if (harm == 2) write_over("r+b", size - 6, "?");
        if (harm == 3) write_over("ab", 0, "more");
        draw_values(1, 0, again);
        assert_memory_equal(first, again, sizeof first);
        assert_int_equal(size_of_file(), size);
    }
    setenv("XDG_CACHE_HOME", "/proc/no/such/place", 1);
    draw_values(1, 0, again);
    assert_memory_equal(first, again, sizeof first);
    unsetenv("XDG_CACHE_HOME");
}

static void fresh_sets_belong_to_their_seed(void **state)
{
    float kept[VALUES], one[VALUES], again[VALUES], other[VALUES];
    (void)state;
    draw_values(1, 0, kept);
    draw_values(1, 1, one);
    draw_values(1, 1, again);
    draw_values(2, 1, other);
    assert_memory_equal(one, again, sizeof one);
    assert_memory_not_equal(one, kept, sizeof one);
    assert_memory_not_equal(one, other, sizeof one);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_interval_over_seeds_holds_the_expected_spectrum),
        cmocka_unit_test(slots_have_different_sets),
        cmocka_unit_test(film_and_lens_are_independent),
        cmocka_unit_test(broken_files_are_made_again),
        cmocka_unit_test(fresh_sets_belong_to_their_seed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
