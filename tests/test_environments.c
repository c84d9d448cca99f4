/* Environments: even, and images around a scene, against closed forms and quadrature. */
#include "support.h"

#include <math.h>

#include "clshear/device/hash.h"
#include "kernels/light/lat_long.h"
#include "scene/environment.h"

static const double pi = 3.14159265358979;

enum {
    WIDTH = 16,
    HEIGHT = 8
};

static test_estimate mean_of_render(clshear_scene *scene, clshear_settings *settings)
{
    return test_mean_of_render(scene, settings, "R");
}

/* Under an even sky of radiance L a floor shows albedo L, whatever is asked of the paths; the sky
 * itself shows L. */
static void even_environment(void **state)
{
    clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
    for (int bounces = 0; bounces < 3; bounces++) {
        clshear_settings *settings = test_looking_down(0.0, 256);
        test_set(settings, CLSHEAR_ENVIRONMENT, "2,1,0.5");
        test_set_number(settings, CLSHEAR_ENVIRONMENT_STRENGTH, 0.5);
        test_set_number(settings, CLSHEAR_BOUNCES, bounces);
        clshear_film *film = test_render(scene, settings);
        for (int p = 0; p < 16; p++) {
            assert_near(clshear_film_channel(film, "R")[p], 0.5, 1e-5);
            assert_near(clshear_film_channel(film, "G")[p], 0.25, 1e-5);
        }
        clshear_film_free(film);
        test_set(settings, CLSHEAR_TARGET, "0,2,0");
        const test_estimate sky = mean_of_render(scene, settings);
        assert_near(sky.mean, 1.0, 1e-6);
    }
    clshear_scene_free(scene);
}

/* A made-up image with a black part, a texel that may be brighter than all others, and no symmetry.
 */
static void fill_image(float brightest, float *texels)
{
    for (cs_u32 i = 0; i < WIDTH * HEIGHT; i++)
        for (cs_u32 c = 0; c < 3; c++)
            texels[3 * i + c] = i % WIDTH < 4 ? 0.0f
                                              : (float)(cs_key(c, i) >> 8) * 0x1p-24f *
                                                    (i == 45 ? brightest : 1.0f);
}

static cs_environment made_environment(float brightest, double rotation_deg, int z_up)
{
    float texels[3 * WIDTH * HEIGHT];
    cs_error error;
    cs_environment made = {0};
    const cs_environment_view view = {.rotation_deg = rotation_deg, .strength = 1.0, .z_up = z_up};
    fill_image(brightest, texels);
    assert_int_equal(cs_environment_make(texels, WIDTH, HEIGHT, &made, &error), CLSHEAR_OK);
    cs_environment_show(&view, &made.light);
    return made;
}

/* The middle of texel (x, y) seen from the origin. */
static void texel_direction(double x, double y, double rotation_deg, int z_up, float *direction)
{
    const double longitude = ((x + 0.5) / WIDTH - 0.5) * 2.0 * pi - rotation_deg * pi / 180.0;
    const double polar = (y + 0.5) / HEIGHT * pi;
    direction[0] = (float)(sin(polar) * sin(longitude));
    direction[z_up ? 2 : 1] = (float)cos(polar);
    direction[z_up ? 1 : 2] = (float)((z_up ? 1.0 : -1.0) * sin(polar) * cos(longitude));
}

static void look(const cs_lat_long *image, const float *direction, float *radiance)
{
    float x, y;
    cs_lat_long_place(image, direction, &x, &y);
    cs_lat_long_radiance(image, x, y, radiance);
}

static float density_of(const cs_lat_long *image, const float *direction)
{
    float x, y;
    cs_lat_long_place(image, direction, &x, &y);
    return cs_lat_long_density(image, 0, x, y);
}

static void texels_are_where_they_should_be(void **state)
{
    static const double turns[] = {0.0, 90.0, -133.0};
    (void)state;
    for (size_t k = 0; k < 6; k++) {
        const int z_up = k >= 3;
        cs_environment made = made_environment(40.0f, turns[k % 3], z_up);
        const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            float direction[3], radiance[3];
            texel_direction(i % WIDTH, i / WIDTH, turns[k % 3], z_up, direction);
            look(&image, direction, radiance);
            for (int c = 0; c < 3; c++)
                assert_near(radiance[c], image.texels[3 * i + c], 1e-4);
        }
        cs_environment_free(&made);
    }
}

enum {
    DRAWS = 200000,
    ACROSS = 32, /* boxes of the sphere */
    DOWN = 16,
    BOXES = ACROSS * DOWN,
    STEPS = 8 /* midpoints of a box, each way */
};

/* How many of the drawn directions each box is to have, by the density; returns their part of all.
 */
static double expect_in_boxes(const cs_lat_long *image, double *expected)
{
    double total = 0.0;
    for (int i = 0; i < BOXES * STEPS * STEPS; i++) {
        const int x = i % (ACROSS * STEPS), y = i / (ACROSS * STEPS);
        float direction[3];
        texel_direction((x + 0.5) * WIDTH / (ACROSS * STEPS) - 0.5,
                        (y + 0.5) * HEIGHT / (DOWN * STEPS) - 0.5, 37.0, image->z_up, direction);
        const double top = cos(pi * y / (DOWN * STEPS)),
                     bottom = cos(pi * (y + 1) / (DOWN * STEPS));
        const double part =
            (double)density_of(image, direction) * (top - bottom) * 2.0 * pi / (ACROSS * STEPS);
        expected[y / STEPS * ACROSS + x / STEPS] += part * DRAWS;
        total += part;
    }
    return total;
}

/* How many each box has; a direction has the density that is said of it, and finds its place. */
static void count_in_boxes(const cs_lat_long *image, double *seen)
{
    for (cs_u32 i = 0; i < DRAWS; i++) {
        float direction[3], x, y, drawn_x = (float)(cs_key(1, i) >> 8) * 0x1p-24f;
        float drawn_y = (float)(cs_key(2, i) >> 8) * 0x1p-24f;
        const float density = cs_lat_long_draw(image, 0, &drawn_x, &drawn_y, direction);
        cs_lat_long_place(image, direction, &x, &y);
        assert_near(drawn_x, x, 1e-4);
        assert_near(drawn_y, y, 1e-4);
        if (i < 1000) assert_near(density, density_of(image, direction), 1e-3 * (double)density);
        seen[cs_cell_at(y * DOWN, DOWN) * ACROSS + cs_cell_at(x * ACROSS, ACROSS)] += 1.0;
    }
}

/* Counts in boxes of the sphere agree with the integral of the density by chi-square; that is 1
 * over all.
 *
 * 200 000 draws at independent points in 32 x 16 boxes, those that expect fewer than 10 left out.
 * The limit is mean plus 5 standard deviations of chi-square, k + 5 sqrt(2 k), a false alarm of
 * some 1e-6; the seed is fixed. */
static void expect_density(int z_up)
{
    double expected[BOXES] = {0.0}, seen[BOXES] = {0.0};
    cs_environment made = made_environment(40.0f, 37.0, z_up);
    const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
    double square = 0.0;
    int boxes = 0;
    assert_near(expect_in_boxes(&image, expected), 1.0, 1e-4);
    count_in_boxes(&image, seen);
    for (int i = 0; i < BOXES; i++) {
        if (expected[i] < 10.0) continue;
        square += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
        boxes++;
    }
    print_message("chi-square %.1f in %d boxes\n", square, boxes);
    assert_above(boxes, 100);
    assert_below(square, boxes + 5.0 * sqrt(2.0 * boxes));
    cs_environment_free(&made);
}

static void directions_follow_their_density(void **state)
{
    (void)state;
    expect_density(0);
    expect_density(1);
}

/* Where +Z is up, so is the zenith; +Y is the horizon then. */
static void sky_stands_on_what_is_up(void **state)
{
    static const char *const ways[] = {"0,2,0", "0,1,1"};
    clshear_scene *scene = test_floor(*state, 1.0f, 0.5f);
    for (int i = 0; i < 4; i++) {
        const int z_up = i / 2, looks_at_z = i % 2;
        clshear_settings *settings = test_looking_down(0.0, 16);
        test_set(settings, CLSHEAR_TARGET, "%s", ways[looks_at_z]);
        test_set(settings, CLSHEAR_UP, "1,0,0");
        test_set(settings, CLSHEAR_ENVIRONMENT, "gradient:1,1,1,0.25,0.25,0.25");
        test_set_number(settings, CLSHEAR_Z_UP, z_up);
        assert_near(mean_of_render(scene, settings).mean, z_up == looks_at_z ? 1.0 : 0.25, 0.01);
    }
    clshear_scene_free(scene);
}

/* Mean, over ways that a surface can face, of the second moments that radiance times cosine by
 * density has: directions by the cosine, and by luminance. */
static void second_moments(const cs_lat_long *image, double *by_cosine, double *by_luminance)
{
    enum {
        ACROSS = 64,
        DOWN = 32,
        FACINGS = 500
    };
    static float direction[ACROSS * DOWN][3];
    static double luminance[ACROSS * DOWN], part[ACROSS * DOWN]; /* sr */
    double whole = 0.0;
    *by_cosine = *by_luminance = 0.0;
    for (int i = 0; i < ACROSS * DOWN; i++) {
        float radiance[3];
        const double x = i % ACROSS + 0.5, y = i / ACROSS + 0.5;
        texel_direction(x * WIDTH / ACROSS - 0.5, y * HEIGHT / DOWN - 0.5, 0.0, 0, direction[i]);
        look(image, direction[i], radiance);
        luminance[i] = 0.2126 * (double)radiance[0] + 0.7152 * (double)radiance[1] +
                       0.0722 * (double)radiance[2];
        part[i] = 2.0 * pi / ACROSS * (pi / DOWN) * sin(pi * y / DOWN);
        whole += luminance[i] * part[i];
    }
    for (cs_u32 f = 0; f < FACINGS; f++) {
        const double up = 2.0 * (f + 0.5) / FACINGS - 1.0, turn = 2.399963 * f; /* golden angle */
        const double facing[3] = {sqrt(1.0 - up * up) * cos(turn), up,
                                  sqrt(1.0 - up * up) * sin(turn)};
        for (int i = 0; i < ACROSS * DOWN; i++) {
            double cosine = 0.0;
            for (int k = 0; k < 3; k++)
                cosine += facing[k] * (double)direction[i][k];
            if (cosine <= 0.0) continue;
            *by_cosine += pi * luminance[i] * luminance[i] * cosine * part[i] / FACINGS;
            *by_luminance += whole * luminance[i] * cosine * cosine * part[i] / FACINGS;
        }
    }
}

/* An image has cells where directions by luminance have the lower second moment, and none where
 * those of a diffuse surface do. Both occur; none is within a tenth of the other, so that the
 * quadrature's error does not decide. */
static void cells_are_for_uneven_images(void **state)
{
    static const float brightest[] = {1.0f, 3.0f, 6.0f, 20.0f, 40.0f};
    int with = 0;
    (void)state;
    for (size_t i = 0; i < sizeof brightest / sizeof *brightest; i++) {
        cs_environment made = made_environment(brightest[i], 0.0, 0);
        const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
        double by_cosine, by_luminance;
        second_moments(&image, &by_cosine, &by_luminance);
        print_message("brightest %g: %.3g by cosine, %.3g by luminance, %u cells across\n",
                      (double)brightest[i], by_cosine, by_luminance, image.cells_x);
        assert_above(fabs(log(by_cosine / by_luminance)), 0.1);
        assert_int_equal(image.cells_x == 0, by_cosine < by_luminance);
        with += image.cells_x > 0;
        cs_environment_free(&made);
    }
    assert_in_range(with, 1, sizeof brightest / sizeof *brightest - 1);
}

/* The image as a file around a floor: the reflected radiance is albedo / pi times its irradiance,
 * by quadrature, from the light's samples alone and from both ways. brightest: of fill_image. */
static void image_lights_a_floor(clshear_context *context, float brightest)
{
    enum {
        STEPS = 400
    };
    float texels[3 * WIDTH * HEIGHT];
    const char *path = test_path("around.exr");
    cs_environment made = made_environment(brightest, 0.0, 0);
    const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
    double irradiance = 0.0;
    fill_image(brightest, texels);
    test_colours(path, WIDTH, HEIGHT, texels);
    for (int i = 0; i < STEPS * STEPS;
         i++) { /* uniform in the square of the sine: cosine-weighted */
        const double s = (i / STEPS + 0.5) / STEPS, a = (i % STEPS + 0.5) / STEPS * 2.0 * pi;
        const float direction[3] = {(float)(sqrt(s) * cos(a)), (float)sqrt(1.0 - s),
                                    (float)(sqrt(s) * sin(a))};
        float radiance[3];
        look(&image, direction, radiance);
        irradiance += pi * (double)radiance[0] / (STEPS * STEPS);
    }
    cs_environment_free(&made);
    clshear_scene *scene = test_floor(context, 100.0f, 0.5f);
    for (int bounces = 0; bounces < 3; bounces += 2) {
        clshear_settings *settings = test_looking_down(0.0, 4096);
        test_set(settings, CLSHEAR_ENVIRONMENT, "%s", path);
        test_set_number(settings, CLSHEAR_BOUNCES, bounces);
        const test_estimate found = mean_of_render(scene, settings);
        print_message("image: %.5f of %.5f, error %.5f\n", found.mean, 0.5 / pi * irradiance,
                      found.error);
        assert_near_estimate(found.mean, 0.5 / pi * irradiance, found.error, 240, 4,
                             1e-4 * irradiance); /* of the quadrature */
        assert_below(found.error, 0.01 * irradiance);
    }
    clshear_scene_free(scene);
}

/* With cells, and without. */
static void image_around_a_floor(void **state)
{
    image_lights_a_floor(*state, 40.0f);
    image_lights_a_floor(*state, 1.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(even_environment),
        cmocka_unit_test(texels_are_where_they_should_be),
        cmocka_unit_test(directions_follow_their_density),
        cmocka_unit_test(sky_stands_on_what_is_up),
        cmocka_unit_test(cells_are_for_uneven_images),
        cmocka_unit_test(image_around_a_floor),
    };
    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
