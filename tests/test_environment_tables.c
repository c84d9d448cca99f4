/* The tables that directions to an environment's image are drawn by: for each way that a surface
 * may face. */
#include "support.h"

#include <math.h>

#include "base/vec.h"
#include "clshear/device/hash.h"
#include "kernels/light/lat_long.h"
#include "scene/environment.h"
#include "scene/scene.h"

static const double pi = 3.14159265358979;

enum {
    MOST_TEXELS = 96 * 40
};

/* Sizes of images: blocks of one cell each, of several, and one block for all. */
static const size_t sizes[][2] = {{32, 16}, {96, 40}, {15, 7}};

static float unit(cs_u32 key, cs_u32 index)
{
    return (float)(cs_key(key, index) >> 8) * 0x1p-24f;
}

/* An image of random texels, of which a quarter is black and one is as bright as all others
 * together. */
static cs_environment made_environment(const size_t size[2])
{
    static float texels[3 * MOST_TEXELS];
    const cs_environment_view view = {.rotation_deg = 37.0, .strength = 1.0};
    const size_t count = size[0] * size[1];
    cs_environment made = {0};
    cs_error error;
    for (cs_u32 i = 0; i < count; i++)
        for (cs_u32 c = 0; c < 3; c++)
            texels[3 * i + c] = i % size[0] < size[0] / 4 ? 0.0f : unit(c, i);
    for (size_t c = 0; c < 3; c++)
        texels[3 * (count / 3 + size[0] / 2) + c] = (float)count / 2.0f;
    assert_int_equal(cs_environment_make(texels, size[0], size[1], &made, &error), CLSHEAR_OK);
    cs_environment_show(&view, &made.light);
    return made;
}

/* A direction that is uniform on the sphere. */
static void draw_direction(cs_u32 key, cs_u32 index, float *direction)
{
    const double up = 1.0 - 2.0 * (double)unit(key, 2 * index);
    const double angle = 2.0 * pi * (double)unit(key, 2 * index + 1), outward = sqrt(1.0 - up * up);
    direction[0] = (float)(outward * cos(angle));
    direction[1] = (float)up;
    direction[2] = (float)(outward * sin(angle));
}

static double dot(const float *a, const float *b)
{
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

static double luminance_towards(const cs_lat_long *image, const float *direction, float *x,
                                float *y)
{
    float radiance[3];
    cs_lat_long_place(image, direction, x, y);
    cs_lat_long_radiance(image, *x, *y, radiance);
    return cs_luminance_double((double)radiance[0], (double)radiance[1], (double)radiance[2]);
}

/* All ways to face occur, and normals that face one way are near each other: a square of the map is
 * some 0.5 rad across, from corner to corner, where it is longest. */
static void ways_to_face(void **state)
{
    static float first[CS_FACING_ANY][3];
    static int seen[CS_FACING_ANY];
    cs_environment made = made_environment(sizes[0]);
    const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
    int ways = 0;
    (void)state;
    for (cs_u32 i = 0; i < 50000; i++) {
        float normal[3];
        draw_direction(1, i, normal);
        const int facing = cs_lat_long_facing(&image, normal);
        assert_in_range(facing, 0, CS_FACING_ANY - 1);
        if (!seen[facing]) memcpy(first[facing], normal, sizeof normal);
        ways += !seen[facing];
        seen[facing] = 1;
        assert_above(dot(first[facing], normal), cos(0.6));
    }
    assert_int_equal(ways, CS_FACING_ANY);
    cs_environment_free(&made);
}

/* Wherever light falls on a surface, the density for its side is at least 0.24 times the cosine and
 * the density by the light alone: a block's weight is at least 0.25 times its light times the
 * cosine to any of its directions, and all weights together are at most 0.75 + 0.25 * 1.17 times
 * all light.
 */
static void no_lit_direction_is_left_out(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
        cs_environment made = made_environment(sizes[k]);
        const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
        double least = 1e30;
        assert_above(image.cells_x, 0);
        for (cs_u32 i = 0; i < 300000; i++) {
            float normal[3], direction[3], x, y;
            draw_direction(3, i, normal);
            draw_direction(4, i, direction);
            const double cosine = dot(normal, direction);
            if (!(cosine > 1e-4) || !(luminance_towards(&image, direction, &x, &y) > 0.0)) continue;
            const int facing = cs_lat_long_facing(&image, normal);
            const double any = (double)cs_lat_long_density(&image, CS_FACING_ANY, x, y);
            assert_above(any, 0.0);
            least = fmin(least, (double)cs_lat_long_density(&image, facing, x, y) / (any * cosine));
        }
        print_message("%zu x %zu: at least %.3f\n", sizes[k][0], sizes[k][1], least);
        assert_above(least, 0.24);
        cs_environment_free(&made);
    }
}

enum {
    DRAWS = 200000,
    ACROSS = 32, /* boxes of the image */
    DOWN = 16,
    BOXES = ACROSS * DOWN,
    STEPS = 15 /* midpoints of a box, each way */
};

/* How many of the drawn directions each box is to have, by the density. */
static void expect_in_boxes(const cs_lat_long *image, int facing, double *expected)
{
    double total = 0.0;
    for (int i = 0; i < BOXES * STEPS * STEPS; i++) {
        const int column = i % (ACROSS * STEPS), row = i / (ACROSS * STEPS);
        const float x = ((float)column + 0.5f) / (ACROSS * STEPS);
        const float y = ((float)row + 0.5f) / (DOWN * STEPS);
        const double part =
            (cos(pi * row / (DOWN * STEPS)) - cos(pi * (row + 1) / (DOWN * STEPS))) * 2.0 * pi /
            (ACROSS * STEPS);
        const double chance = (double)cs_lat_long_density(image, facing, x, y) * part;
        expected[row / STEPS * ACROSS + column / STEPS] += chance * DRAWS;
        total += chance;
    }
    assert_near(total, 1.0, 1e-3);
}

/* Counts of drawn directions in boxes of the image agree with the integral of their density, by
 * chi-square, whatever way the surface faces. Boxes that expect fewer than 10 are left out. The
 * midpoints are as many in each of 96 x 40 cells: boxes have 3 of them across and 5/2 down.
 *
 * The limit is mean plus 5 standard deviations of chi-square, k + 5 sqrt(2 k), a false alarm of
 * some 1e-6 for each of the ten; the seeds are fixed. */
static void directions_follow_their_density(void **state)
{
    static const int facings[] = {0, 37, 100, 255, CS_FACING_ANY};
    (void)state;
    for (size_t k = 0; k < 2; k++) {
        cs_environment made = made_environment(sizes[k]);
        const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
        for (cs_u32 f = 0; f < sizeof facings / sizeof *facings; f++) {
            double expected[BOXES] = {0.0}, seen[BOXES] = {0.0}, square = 0.0;
            int boxes = 0;
            expect_in_boxes(&image, facings[f], expected);
            for (cs_u32 i = 0; i < DRAWS; i++) {
                float direction[3], x = unit(5 + f, i), y = unit(50 + f, i);
                const float density = cs_lat_long_draw(&image, facings[f], &x, &y, direction);
                if (i < 1000)
                    assert_near(density, cs_lat_long_density(&image, facings[f], x, y),
                                1e-3 * (double)density);
                seen[cs_cell_at(y * DOWN, DOWN) * ACROSS + cs_cell_at(x * ACROSS, ACROSS)] += 1.0;
            }
            for (int i = 0; i < BOXES; i++) {
                if (expected[i] < 10.0) continue;
                square += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
                boxes++;
            }
            print_message("facing %d: chi-square %.1f in %d boxes\n", facings[f], square, boxes);
            assert_above(boxes, 50);
            assert_below(square, boxes + 5.0 * sqrt(2.0 * boxes));
        }
        cs_environment_free(&made);
    }
}

/* Mean and second moment, over normals and draws, of what a diffuse surface makes of a direction:
 * luminance times cosine over density. is_any: by the light alone. */
static void moments(const cs_lat_long *image, int is_any, double *mean, double *second)
{
    enum {
        NORMALS = 500,
        OF_EACH = 400
    };
    *mean = *second = 0.0;
    for (cs_u32 n = 0; n < NORMALS; n++) {
        float normal[3];
        draw_direction(6, n, normal);
        const int facing = is_any ? CS_FACING_ANY : cs_lat_long_facing(image, normal);
        for (cs_u32 i = 0; i < OF_EACH; i++) {
            float direction[3], x = unit(7, n * OF_EACH + i), y = unit(8, n * OF_EACH + i);
            const double density = (double)cs_lat_long_draw(image, facing, &x, &y, direction);
            const double cosine = fmax(dot(normal, direction), 0.0);
            const double value = luminance_towards(image, direction, &x, &y) * cosine / density;
            *mean += value / (NORMALS * OF_EACH);
            *second += value * value / (NORMALS * OF_EACH);
        }
    }
}

/* Directions by the side that a surface shows have the same mean as those by the light alone, and
 * less than 0.8 times their second moment. Means of 200 000 values whose deviation is about the
 * mean itself have 0.4 % each: they differ by less than 3 %, a false alarm of some 1e-6; the seeds
 * are fixed. */
static void tables_serve_the_side(void **state)
{
    (void)state;
    for (size_t k = 0; k < 2; k++) {
        double by_side[2], by_light[2];
        cs_environment made = made_environment(sizes[k]);
        const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
        moments(&image, 0, &by_side[0], &by_side[1]);
        moments(&image, 1, &by_light[0], &by_light[1]);
        print_message("mean %.4g %.4g, second moment %.4g %.4g\n", by_side[0], by_light[0],
                      by_side[1], by_light[1]);
        assert_near(by_side[0], by_light[0], 0.03 * by_light[0]);
        assert_below(by_side[1], 0.8 * by_light[1]);
        cs_environment_free(&made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ways_to_face),
        cmocka_unit_test(no_lit_direction_is_left_out),
        cmocka_unit_test(directions_follow_their_density),
        cmocka_unit_test(tables_serve_the_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
