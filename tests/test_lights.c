/* Spots, suns and environments against closed forms. */
#include "support.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <sys/stat.h>

#include "clshear/device/hash.h"
#include "image/image_io.h"
#include "kernels/light/lat_long.h"
#include "scene/environment.h"

static const double pi = 3.14159265358979;
static const uint32_t quad[6] = {0, 1, 2, 0, 2, 3};

enum {
    WIDTH = 16,
    HEIGHT = 8
};

static int set_up(void **state)
{
    *state = test_context();
    return 0;
}

static int tear_down(void **state)
{
    clshear_context_free(*state);
    return 0;
}

/* Straight down on (x, 0, 0) from a height of 1, with direct light. */
static clshear_settings *looking_down_at(double x, int spp)
{
    clshear_settings *settings = test_settings(NULL, 4, 4, (uint32_t)spp);
    test_set(settings, CLSHEAR_EYE, "%g,1,0", x);
    test_set(settings, CLSHEAR_TARGET, "%g,0,0", x);
    test_set(settings, CLSHEAR_UP, "0,0,-1");
    test_set_number(settings, CLSHEAR_FOV, 0.01);
    test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0);
    test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 1.0);
    test_set_number(settings, CLSHEAR_REPLICATES, 16);
    test_set_number(settings, CLSHEAR_BOUNCES, 0.0);
    return settings;
}

typedef struct estimate {
    double mean;
    double error; /* standard error; 240 degrees of freedom */
} estimate;

static estimate mean_of(const clshear_film *film)
{
    estimate found = {0.0, 0.0};
    for (int p = 0; p < 16; p++) {
        found.mean += (double)clshear_film_channel(film, "R")[p] / 16.0;
        found.error += (double)clshear_film_channel(film, "Variance.R")[p];
    }
    found.error = sqrt(found.error) / 16.0;
    return found;
}

static estimate render(clshear_scene *scene, clshear_settings *settings)
{
    clshear_film *film = test_render(scene, settings);
    const estimate found = mean_of(film);
    clshear_film_free(film);
    clshear_settings_free(settings);
    return found;
}

/* From height 2, straight down: I cos^3 / h^2 times the falloff that KHR_lights_punctual gives. The
 * picture's width of 2e-4 changes nothing above 1e-3 of the value at the axis. */
static void spot_over_a_floor(void **state)
{
    static const double places[] = {0.0, 0.3, 0.9, 1.1, 1.3, 2.5};
    clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
    const clshear_light light = {.kind = CLSHEAR_LIGHT_SPOT,
                                 .position = {0, 2, 0},
                                 .direction = {0, -3, 0},
                                 .colour = {8, 8, 8},
                                 .inner_deg = 20.0f,
                                 .outer_deg = 35.0f};
    test_add_light(scene, &light);
    const double inner = cos(20.0 * pi / 180.0), outer = cos(35.0 * pi / 180.0);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const double x = places[i], cosine = 2.0 / sqrt(4.0 + x * x);
        double part = (cosine - outer) / (inner - outer);
        part = part < 0.0 ? 0.0 : part > 1.0 ? 1.0 : part;
        const double truth = 0.5 / pi * 8.0 * pow(cosine, 3.0) / 4.0 * part * part;
        const estimate found = render(scene, looking_down_at(x, 64));
        print_message("spot at %.1f: %.5f of %.5f\n", x, found.mean, truth);
        assert_near(found.mean, truth, 1e-3 * 0.32);
    }
    clshear_scene_free(scene);
}

/* A cone of 0.5 degrees fades from its axis on: at half its angle, 3/4 of the root of the light are
 * left. A cone of 40 degrees with an edge of 0.001 is full 0.05 inside it and dark 0.05 outside. */
static void spots_may_be_narrow_or_sharp(void **state)
{
    static const struct {
        float inner_deg, outer_deg;
        double at_deg, part;
    } cases[] = {{0.0f, 0.5f, 0.0, 1.0},
                 {0.0f, 0.5f, 0.25, 0.5625},
                 {39.999f, 40.0f, 39.95, 1.0},
                 {39.999f, 40.0f, 40.05, 0.0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
        const clshear_light light = {.kind = CLSHEAR_LIGHT_SPOT,
                                     .position = {0, 2, 0},
                                     .direction = {0, -3, 0},
                                     .colour = {8, 8, 8},
                                     .inner_deg = cases[i].inner_deg,
                                     .outer_deg = cases[i].outer_deg};
        test_add_light(scene, &light);
        const double angle = cases[i].at_deg * pi / 180.0;
        const double truth = 0.5 / pi * 8.0 * pow(cos(angle), 3.0) / 4.0 * cases[i].part;
        const estimate found = render(scene, looking_down_at(2.0 * tan(angle), 64));
        print_message("spot of %g to %g degrees at %g: %.5f of %.5f\n", (double)light.inner_deg,
                      (double)light.outer_deg, cases[i].at_deg, found.mean, truth);
        assert_near(found.mean, truth, 2e-3 * 0.32);
        clshear_scene_free(scene);
    }
}

/* A floor, and a half plane x < 0 at a height of 10: seen from (0, 0, 0), it hides half of a sun in
 * the zenith. */
static clshear_scene *floor_and_half_plane(clshear_context *context)
{
    static const float floor_y[12] = {-50, 0, -50, 50, 0, -50, 50, 0, 50, -50, 0, 50};
    static const float half[12] = {-50, 10, -50, 0, 10, -50, 0, 10, 50, -50, 10, 50};
    const clshear_mesh meshes[2] = {
        {.positions = floor_y,
         .indices = quad,
         .vertex_count = 4,
         .triangle_count = 2,
         .diffuse = {0.5f, 0.5f, 0.5f}},
        {.positions = half, .indices = quad, .vertex_count = 4, .triangle_count = 2}};
    return test_meshes(context, meshes, 2);
}

/* A sun of radius a whose middle is hidden up to the angle b from the zenith: with s = sin b / sin
 * a the part that is left is that of the unit disk beyond the chord at s, since irradiance is the
 * area of the projected disk: (acos s - s sqrt(1 - s^2)) / pi. 6 standard errors: false alarms
 * 1e-8. */
static void sun_behind_an_edge(void **state)
{
    static const double places[] = {-1.5, -0.5, 0.0, 0.5, 1.5};
    clshear_scene *scene = floor_and_half_plane(*state);
    const clshear_light light = {.kind = CLSHEAR_LIGHT_DIRECTIONAL,
                                 .direction = {0, 2, 0},
                                 .colour = {3, 3, 3},
                                 .diameter_deg = 10.0f};
    test_add_light(scene, &light);
    for (size_t i = 0; i < sizeof places / sizeof *places; i++)
        for (int bounces = 0; bounces < 2; bounces++) {
            const double x = places[i], beyond = -x / sqrt(x * x + 100.0) / sin(5.0 * pi / 180.0);
            const double s = beyond < -1.0 ? -1.0 : beyond > 1.0 ? 1.0 : beyond;
            const double truth = 0.5 / pi * 3.0 * (acos(s) - s * sqrt(1.0 - s * s)) / pi;
            clshear_settings *settings = looking_down_at(x, 1024);
            test_set_number(settings, CLSHEAR_BOUNCES, bounces);
            const estimate found = render(scene, settings);
            print_message("sun at %4.1f: %.5f of %.5f, error %.5f\n", x, found.mean, truth,
                          found.error);
            assert_near(found.mean, truth, 6.0 * found.error + 1e-3 * truth);
        }
    clshear_scene_free(scene);
}

/* In a penumbra, what a sample sees and which part of the sun lights it decide together. The
 * equal-area shear gives these two the four dimensions of `sz` and leaves the place along the fibre
 * to padding. The variance without the shear, which pads the light, is 5.6 times that with it. Both
 * are means over 16 pixels with 240 degrees of freedom: the ratio has a standard error of 13 %, and
 * the limit is 6 of them below (false alarms 1e-9). If the light were padded, it would be near 1.
 */
static void light_is_paired_with_the_fibre(void **state)
{
    clshear_scene *scene = floor_and_half_plane(*state);
    const clshear_light light = {.kind = CLSHEAR_LIGHT_DIRECTIONAL,
                                 .direction = {0, 2, 0},
                                 .colour = {3, 3, 3},
                                 .diameter_deg = 10.0f};
    double error[2];
    test_add_light(scene, &light);
    for (int sheared = 0; sheared < 2; sheared++) {
        clshear_settings *settings = looking_down_at(0.0, 16 * 1024);
        test_set_number(settings, CLSHEAR_FOV, 60.0);
        test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.5);
        test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 3.0);
        test_set(settings, CLSHEAR_SAMPLER, "sz");
        test_set(settings, CLSHEAR_SHEAR, sheared ? "equal-area" : "none");
        test_set(settings, CLSHEAR_ORACLE, "centre");
        error[sheared] = render(scene, settings).error;
    }
    const double ratio = error[0] * error[0] / (error[1] * error[1]);
    print_message("variance without shear over variance with it: %.2f\n", ratio);
    assert_above(ratio, 2.5);
    clshear_scene_free(scene);
}

/* The tilted sun's irradiance falls with the cosine, however large it is, while it is all up. */
static void sun_from_the_side(void **state)
{
    clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
    const clshear_light light = {.kind = CLSHEAR_LIGHT_DIRECTIONAL,
                                 .direction = {3, 4, 0},
                                 .colour = {3, 3, 3},
                                 .diameter_deg = 40.0f};
    test_add_light(scene, &light);
    const estimate found = render(scene, looking_down_at(0.0, 1024));
    assert_near(found.mean, 0.5 / pi * 3.0 * 0.8, 6.0 * found.error + 1e-5);
    assert_below(found.error, 1e-3);
    clshear_scene_free(scene);
}

/* Under an even sky of radiance L a floor shows albedo L, whatever is asked of the paths; the sky
 * itself shows L. */
static void even_environment(void **state)
{
    clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
    for (int bounces = 0; bounces < 3; bounces++) {
        clshear_settings *settings = looking_down_at(0.0, 256);
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
        const estimate sky = render(scene, settings);
        assert_near(sky.mean, 1.0, 1e-6);
    }
    clshear_scene_free(scene);
}

/* A made-up image with a black part, a bright texel, and no symmetry. */
static void fill_image(float *texels)
{
    for (cs_u32 i = 0; i < WIDTH * HEIGHT; i++)
        for (cs_u32 c = 0; c < 3; c++)
            texels[3 * i + c] =
                i % WIDTH < 4 ? 0.0f
                              : (float)(cs_key(c, i) >> 8) * 0x1p-24f * (i == 45 ? 40.0f : 1.0f);
}

static cs_environment made_environment(double rotation_deg)
{
    float texels[3 * WIDTH * HEIGHT];
    cs_error error;
    cs_environment made = {0};
    const cs_environment_view view = {.rotation_deg = rotation_deg, .strength = 1.0};
    fill_image(texels);
    assert_int_equal(cs_environment_make(texels, WIDTH, HEIGHT, &made, &error), CLSHEAR_OK);
    cs_environment_show(&view, &made.light);
    return made;
}

/* The middle of texel (x, y) seen from the origin. */
static void texel_direction(double x, double y, double rotation_deg, float *direction)
{
    const double longitude = ((x + 0.5) / WIDTH - 0.5) * 2.0 * pi - rotation_deg * pi / 180.0;
    const double polar = (y + 0.5) / HEIGHT * pi;
    direction[0] = (float)(sin(polar) * sin(longitude));
    direction[1] = (float)cos(polar);
    direction[2] = (float)(-sin(polar) * cos(longitude));
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
    return cs_lat_long_density(image, x, y);
}

static void texels_are_where_they_should_be(void **state)
{
    static const double turns[] = {0.0, 90.0, -133.0};
    (void)state;
    for (size_t k = 0; k < 3; k++) {
        cs_environment made = made_environment(turns[k]);
        const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            float direction[3], radiance[3];
            texel_direction(i % WIDTH, i / WIDTH, turns[k], direction);
            look(&image, direction, radiance);
            for (int c = 0; c < 3; c++)
                assert_near(radiance[c], image.texels[3 * i + c], 1e-4);
        }
        cs_environment_free(&made);
    }
}

/* Drawn directions have the density that is said of them, and find their own cell again; counts in
 * boxes of the sphere agree with the integral of the density by chi-square; that is 1 over all.
 *
 * 200 000 draws at independent points in 32 x 16 boxes, those that expect fewer than 10 left out.
 * The limit is mean plus 5 standard deviations of chi-square, k + 5 sqrt(2 k), a false alarm of
 * some 1e-6; the seed is fixed. */
static void directions_follow_their_density(void **state)
{
    enum {
        DRAWS = 200000,
        ACROSS = 32,
        DOWN = 16,
        STEPS = 8
    };
    static double expected[ACROSS * DOWN], seen[ACROSS * DOWN];
    cs_environment made = made_environment(37.0);
    const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
    double total = 0.0, square = 0.0;
    int boxes = 0;
    (void)state;
    for (int i = 0; i < ACROSS * DOWN * STEPS * STEPS; i++) {
        const int x = i % (ACROSS * STEPS), y = i / (ACROSS * STEPS);
        float direction[3];
        texel_direction((x + 0.5) * WIDTH / (ACROSS * STEPS) - 0.5,
                        (y + 0.5) * HEIGHT / (DOWN * STEPS) - 0.5, 37.0, direction);
        const double top = cos(pi * y / (DOWN * STEPS)),
                     bottom = cos(pi * (y + 1) / (DOWN * STEPS));
        const double part =
            (double)density_of(&image, direction) * (top - bottom) * 2.0 * pi / (ACROSS * STEPS);
        expected[y / STEPS * ACROSS + x / STEPS] += part * DRAWS;
        total += part;
    }
    assert_near(total, 1.0, 1e-4);
    for (cs_u32 i = 0; i < DRAWS; i++) {
        float direction[3], x, y, drawn_x = (float)(cs_key(1, i) >> 8) * 0x1p-24f;
        float drawn_y = (float)(cs_key(2, i) >> 8) * 0x1p-24f;
        const float density = cs_lat_long_draw(&image, &drawn_x, &drawn_y, direction);
        cs_lat_long_place(&image, direction, &x, &y);
        assert_near(drawn_x, x, 1e-4);
        assert_near(drawn_y, y, 1e-4);
        if (i < 1000) assert_near(density, density_of(&image, direction), 1e-3 * (double)density);
        seen[cs_cell_at(y * DOWN, DOWN) * ACROSS + cs_cell_at(x * ACROSS, ACROSS)] += 1.0;
    }
    for (int i = 0; i < ACROSS * DOWN; i++) {
        if (expected[i] < 10.0) continue;
        square += (seen[i] - expected[i]) * (seen[i] - expected[i]) / expected[i];
        boxes++;
    }
    print_message("chi-square %.1f in %d boxes\n", square, boxes);
    assert_above(boxes, 100);
    assert_below(square, boxes + 5.0 * sqrt(2.0 * boxes));
    cs_environment_free(&made);
}

/* Writes an image of one colour around everything. Its size in the file is always the same. */
static void write_even_image(const char *path, float value)
{
    static float plane[WIDTH * HEIGHT];
    const char *const names[3] = {"R", "G", "B"};
    const float *const list[3] = {plane, plane, plane};
    const cs_picture picture = {.width = WIDTH,
                                .height = HEIGHT,
                                .full_width = WIDTH,
                                .full_height = HEIGHT,
                                .channel_count = 3,
                                .names = names,
                                .planes = list};
    cs_error error;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        plane[i] = value;
    assert_int_equal(cs_image_write(path, &picture, &error), CLSHEAR_OK);
}

static double sky_of(clshear_scene *scene, const char *path, double strength)
{
    clshear_settings *settings = looking_down_at(0.0, 16);
    test_set(settings, CLSHEAR_TARGET, "0,2,0");
    test_set(settings, CLSHEAR_ENVIRONMENT, "%s", path);
    test_set_number(settings, CLSHEAR_ENVIRONMENT_STRENGTH, strength);
    return render(scene, settings).mean;
}

/* A file that is gone is an error, and one that has changed is read again; one that cannot be told
 * from what was read, since its times and its size were put back, is not. */
static void environment_files_are_kept(void **state)
{
    const char *path = test_path("kept.exr");
    struct stat before;
    FILE *file;
    clshear_scene *scene = test_floor(*state, 1.0f, 0.5f);
    write_even_image(path, 0.25f);
    assert_near(sky_of(scene, path, 1.0), 0.25, 1e-6);
    assert_int_equal(stat(path, &before), 0);
    file = fopen(path, "r+");
    assert_non_null(file);
    assert_int_equal(fputs("no image", file) < 0, 0);
    assert_int_equal(fclose(file), 0);
    const struct timespec times[2] = {before.st_atim, before.st_mtim};
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
    assert_near(sky_of(scene, path, 2.0), 0.5, 1e-6);
    write_even_image(path, 0.75f);
    assert_near(sky_of(scene, path, 1.0), 0.75, 1e-6);
    assert_int_equal(remove(path), 0);
    clshear_settings *settings = looking_down_at(0.0, 16);
    clshear_film *film = NULL;
    test_set(settings, CLSHEAR_ENVIRONMENT, "%s", path);
    test_refused(clshear_render(scene, settings, &film), CLSHEAR_BAD_FILE, "kept.exr");
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* The image as a file around a floor: the reflected radiance is albedo / pi times its irradiance,
 * by quadrature, from the light's samples alone and from both ways. */
static void image_around_a_floor(void **state)
{
    enum {
        STEPS = 400
    };
    float texels[3 * WIDTH * HEIGHT];
    static float planes[3][WIDTH * HEIGHT];
    const char *const names[3] = {"R", "G", "B"};
    const float *const list[3] = {planes[0], planes[1], planes[2]};
    const cs_picture picture = {.width = WIDTH,
                                .height = HEIGHT,
                                .full_width = WIDTH,
                                .full_height = HEIGHT,
                                .channel_count = 3,
                                .names = names,
                                .planes = list};
    cs_error error;
    const char *path = test_path("around.exr");
    cs_environment made = made_environment(0.0);
    const cs_lat_long image = cs_lat_long_of(&made.light, made.image.items);
    double irradiance = 0.0;
    fill_image(texels);
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        planes[i % 3][i / 3] = texels[i];
    assert_int_equal(cs_image_write(path, &picture, &error), CLSHEAR_OK);
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
    clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
    for (int bounces = 0; bounces < 3; bounces += 2) {
        clshear_settings *settings = looking_down_at(0.0, 4096);
        test_set(settings, CLSHEAR_ENVIRONMENT, "%s", path);
        test_set_number(settings, CLSHEAR_BOUNCES, bounces);
        const estimate found = render(scene, settings);
        print_message("image: %.5f of %.5f, error %.5f\n", found.mean, 0.5 / pi * irradiance,
                      found.error);
        assert_near(found.mean, 0.5 / pi * irradiance, 6.0 * found.error + 1e-4 * irradiance);
        assert_below(found.error, 0.01 * irradiance);
    }
    clshear_scene_free(scene);
}

static void wrong_lights_are_refused(void **state)
{
    clshear_scene *scene = test_floor(*state, 1.0f, 0.5f);
    clshear_light light = {.struct_size = sizeof light,
                           .kind = CLSHEAR_LIGHT_SPOT,
                           .direction = {0, -1, 0},
                           .inner_deg = 40.0f,
                           .outer_deg = 30.0f};
    test_refused(clshear_scene_add_light(scene, &light), CLSHEAR_BAD_ARGUMENT, "cone");
    light.kind = CLSHEAR_LIGHT_DIRECTIONAL;
    light.diameter_deg = -1.0f;
    test_refused(clshear_scene_add_light(scene, &light), CLSHEAR_BAD_ARGUMENT, "diameter");
    clshear_settings *settings = looking_down_at(0.0, 16);
    clshear_film *film = NULL;
    test_set(settings, CLSHEAR_ENVIRONMENT, "1,2,-3");
    test_refused(clshear_render(scene, settings, &film), CLSHEAR_BAD_ARGUMENT, "environment");
    test_set(settings, CLSHEAR_ENVIRONMENT, "no-such-file.exr");
    test_refused(clshear_render(scene, settings, &film), CLSHEAR_BAD_FILE, "no-such-file");
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* A scene without light gets an environment and a sun from the camera's upper left, and a light in
 * the eye only if that is inside; what is set or has light is left alone. A floor seen from above
 * shows its albedo times the studio's radiance for a surface that the sun meets at its angle. */
static void studio_lights_what_has_no_light(void **state)
{
    clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
    clshear_settings *settings = looking_down_at(0.0, 1024);
    test_ok(clshear_light_complete(scene, settings));
    double sun[7];
    size_t count = 0;
    test_ok(clshear_settings_get_numbers(settings, CLSHEAR_SUN, sun, 7, &count));
    assert_int_equal(count, 7);
    assert_below(sun[0], -0.1); /* left */
    assert_above(sun[1], 0.1);  /* behind the camera, which looks down */
    assert_below(sun[2], -0.1); /* above: up is -Z */
    assert_false(clshear_settings_is_set(settings, CLSHEAR_LIGHT));
    const double cosine = sun[1] / sqrt(sun[0] * sun[0] + sun[1] * sun[1] + sun[2] * sun[2]);
    const estimate found = render(scene, settings);
    assert_near(found.mean, 0.5 * (0.4 + sun[3] / pi * cosine), 6.0 * found.error + 1e-4);
    const estimate same = render(scene, looking_down_at(0.0, 1024));
    assert_near(same.mean, found.mean, 0.0);

    settings = looking_down_at(0.0, 16);
    test_set(settings, CLSHEAR_LIGHT, "0,1,0,1,1,1");
    test_ok(clshear_light_complete(scene, settings));
    assert_false(clshear_settings_is_set(settings, CLSHEAR_SUN));
    assert_false(clshear_settings_is_set(settings, CLSHEAR_ENVIRONMENT));
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* In a closed box there is no sky: the light in the eye. */
static void studio_lights_the_inside(void **state)
{
    static const float corners[24] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                      -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
    static const uint32_t faces[36] = {0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 0, 1, 5, 0, 5, 4,
                                       3, 2, 6, 3, 6, 7, 0, 3, 7, 0, 7, 4, 1, 2, 6, 1, 6, 5};
    const clshear_mesh mesh = {.positions = corners,
                               .indices = faces,
                               .vertex_count = 8,
                               .triangle_count = 12,
                               .diffuse = {0.5f, 0.5f, 0.5f}};
    clshear_scene *scene = test_meshes(*state, &mesh, 1);
    clshear_settings *settings = looking_down_at(0.0, 64);
    test_set(settings, CLSHEAR_EYE, "0,0,0");
    test_set(settings, CLSHEAR_TARGET, "0,-1,0");
    const estimate found = render(scene, settings);
    assert_near(found.mean, 0.5 * 0.6, 1e-3);
    clshear_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spot_over_a_floor),
        cmocka_unit_test(spots_may_be_narrow_or_sharp),
        cmocka_unit_test(sun_behind_an_edge),
        cmocka_unit_test(light_is_paired_with_the_fibre),
        cmocka_unit_test(sun_from_the_side),
        cmocka_unit_test(even_environment),
        cmocka_unit_test(texels_are_where_they_should_be),
        cmocka_unit_test(directions_follow_their_density),
        cmocka_unit_test(image_around_a_floor),
        cmocka_unit_test(environment_files_are_kept),
        cmocka_unit_test(studio_lights_what_has_no_light),
        cmocka_unit_test(studio_lights_the_inside),
        cmocka_unit_test(wrong_lights_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
