/* Spheres and quads against closed forms. */
#include "support.h"

#include <math.h>

static const double pi = 3.14159265358979;

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

/* Straight down on the origin from a height of 0.01, so that nothing is in between. */
static clshear_settings *looking_down(int spp, int bounces)
{
    clshear_settings *settings = test_settings(NULL, 4, 4, (uint32_t)spp);
    test_set(settings, CLSHEAR_EYE, "0,0.01,0");
    test_set(settings, CLSHEAR_TARGET, "0,0,0");
    test_set(settings, CLSHEAR_UP, "0,0,-1");
    test_set_number(settings, CLSHEAR_FOV, 0.01);
    test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0);
    test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 1.0);
    test_set_number(settings, CLSHEAR_REPLICATES, 16);
    test_set_number(settings, CLSHEAR_BOUNCES, bounces);
    return settings;
}

/* Mean of the channel R and its standard error, of 240 degrees of freedom. */
static double mean_of(clshear_scene *scene, clshear_settings *settings, double *error)
{
    const test_estimate found = test_mean_of_render(scene, settings, "R");
    *error = found.error;
    return found.mean;
}

/* Irradiance at the origin, facing up, from a polygon of radiance 1 above the horizon (Lambert
 * 1760; Baum, Rushmeier & Winget 1989). */
static double polygon_irradiance(double (*corners)[3], int count)
{
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        const double *a = corners[i], *b = corners[(i + 1) % count];
        const double up = a[2] * b[0] - a[0] * b[2]; /* of the cross product */
        const double cross[3] = {a[1] * b[2] - a[2] * b[1], up, a[0] * b[1] - a[1] * b[0]};
        const double length = sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
        const double along = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        sum += 0.5 * atan2(length, along) * up / length;
    }
    return sum;
}

/* A sphere above the horizon lights with pi L sine^2 cosine, one around the point with pi L. With
 * bounces, what the BSDF draws takes part by its weight. 1e-4 is for the arithmetic in floats. */
static void sphere_over_a_floor(void **state)
{
    static const struct {
        double centre[3], radius;
    } cases[] = {{{0, 3, 0}, 0.01}, {{0, 2, 0}, 1.9}, {{3, 1.5, -1}, 1.0}, {{0.3, 0, 0.2}, 5.0}};
    clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int bounces = 0; bounces < 2; bounces++) {
            const double *c = cases[i].centre, r = cases[i].radius;
            const double square = c[0] * c[0] + c[1] * c[1] + c[2] * c[2];
            const double part = r * r < square ? r * r / square * c[1] / sqrt(square) : 1.0;
            clshear_settings *settings = looking_down(1024, bounces);
            test_set(settings, CLSHEAR_SPHERE, "%g,%g,%g,%g,2,1,1", c[0], c[1], c[2], r);
            double error;
            const double found = mean_of(scene, settings, &error), truth = 0.5 * 2.0 * part;
            print_message("sphere %zu: %.6g of %.6g, error %.2g\n", i, found, truth, error);
            assert_near_estimate(found, truth, error, 240, 8, 1e-4 * truth);
            assert_below(error, 0.01 * truth);
        }
    clshear_scene_free(scene);
}

static void add_quad(clshear_settings *settings, const double *corner, const double *edge1,
                     const double *edge2)
{
    test_set(settings, CLSHEAR_QUAD, "%g,%g,%g,%g,%g,%g,%g,%g,%g,2,1,1", corner[0], corner[1],
             corner[2], edge1[0], edge1[1], edge1[2], edge2[0], edge2[1], edge2[2]);
}

/* A panel lights by Lambert's formula, and its other side not at all. */
static void quad_over_a_floor(void **state)
{
    static const double cases[][9] = {{-1, 1, -1, 2, 0, 0, 0, 0, 2},
                                      {1, 0.2, -2, 0.3, 0.5, 4, 0.5, 2, 0},
                                      {-40, 30, -40, 80, 0, 5, 0, 3, 80}};
    clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int bounces = 0; bounces < 2; bounces++) {
            const double *q = cases[i];
            double corners[4][3], error;
            for (int k = 0; k < 3; k++) {
                corners[0][k] = q[k];
                corners[1][k] = q[k] + q[3 + k];
                corners[2][k] = q[k] + q[3 + k] + q[6 + k];
                corners[3][k] = q[k] + q[6 + k];
            }
            const double truth = 0.5 / pi * fabs(polygon_irradiance(corners, 4)) * 2.0;
            clshear_settings *settings = looking_down(1024, bounces);
            add_quad(settings, q, q + 3, q + 6);
            const double found = mean_of(scene, settings, &error);
            settings = looking_down(64, bounces);
            add_quad(settings, q, q + 6, q + 3);
            double none;
            const double dark = mean_of(scene, settings, &none);
            print_message("quad %zu: %.6g of %.6g, error %.2g; behind %g\n", i, found, truth, error,
                          dark);
            assert_near_estimate(found, truth, error, 240, 6, 1e-4 * truth);
            assert_below(error, 0.02 * truth);
            assert_near(dark, 0.0, 0.0);
        }
    clshear_scene_free(scene);
}

/* The camera sees a sphere of radius 1 from 4 away, and from within; a quad's bright side, and its
 * black one before a bright sky. */
static void camera_sees_shapes(void **state)
{
    clshear_scene *scene = test_floor(*state, 0.01f, 0.5f);
    for (int bounces = 0; bounces < 2; bounces++) {
        clshear_settings *settings = test_settings(NULL, 64, 64, 16);
        test_set(settings, CLSHEAR_EYE, "0,5,4");
        test_set(settings, CLSHEAR_TARGET, "0,5,0");
        test_set_number(settings, CLSHEAR_FOV, 60.0);
        test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0);
        test_set_number(settings, CLSHEAR_BOUNCES, bounces);
        test_set(settings, CLSHEAR_SPHERE, "0,5,0,1,3,2,1");
        clshear_film *film = test_render(scene, settings);
        const float *red = clshear_film_channel(film, "R");
        double sum = 0.0;
        for (int p = 0; p < 64 * 64; p++)
            sum += (double)red[p] / 3.0;
        /* Sine 1/4 of the half angle; the picture's half height is tan 30 degrees. 1 % of the area
         * is 0.3 px of the edge's 82, more than 16 samples a pixel leave. */
        const double radius_px = 32.0 * sqrt(1.0 / 15.0) / tan(pi / 6.0);
        assert_near(sum, pi * radius_px * radius_px, 0.01 * pi * radius_px * radius_px);
        clshear_film_free(film);
        test_set(settings, CLSHEAR_EYE, "0,5,0.5");
        film = test_render(scene, settings);
        for (int p = 0; p < 64 * 64; p++)
            assert_near(clshear_film_channel(film, "G")[p], 2.0, 1e-6);
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
    clshear_scene_free(scene);
}

static double channel_at(const clshear_film *film, const char *name, int pixel)
{
    const float *plane = clshear_film_channel(film, name);
    if (plane == NULL) fail_msg("no channel %s", name);
    return (double)plane[pixel];
}

/* A sphere of radius 1 from 4 away, and a quad beside it from 6: their depths, those of the prepass
 * and those of the samples, where they are, which way they face, and that they reflect nothing. The
 * circle of confusion, as wide as a square of its area, is that of a surface of this depth: a point
 * of depth z moves by (1/z - 1/3.5) 0.1 for the lens's radius, in units of the image at distance 1.
 */
static void channels_know_shapes(void **state)
{
    static const double corner[3] = {1.5, 3, -2}, right[3] = {4, 0, 0}, up[3] = {0, 4, 0};
    clshear_scene *scene = test_floor(*state, 0.01f, 0.5f);
    for (int bounces = 0; bounces < 2; bounces++) {
        clshear_settings *settings = test_settings(NULL, 33, 33, 64);
        test_set(settings, CLSHEAR_EYE, "0,5,4");
        test_set(settings, CLSHEAR_TARGET, "0,5,0");
        test_set_number(settings, CLSHEAR_FOV, 60.0);
        test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.1);
        test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 3.5);
        test_set_number(settings, CLSHEAR_BOUNCES, bounces);
        test_set(settings, CLSHEAR_SPHERE, "0,5,0,1,3,2,1");
        test_set(settings, CLSHEAR_ORACLE, "centre");
        test_set(settings, CLSHEAR_AOV, "albedo,normal,position,depth,coverage,emission");
        add_quad(settings, corner, right, up);
        clshear_film *film = test_render(scene, settings);
        const int middle = 16 * 33 + 16, side = 16 * 33 + 27, sky = 16 * 33 + 2;
        assert_near(channel_at(film, "Z", middle), 3.0, 1e-3);
        assert_near(channel_at(film, "Z", side), 6.0, 1e-3);
        assert_int_equal(isfinite(channel_at(film, "Z", sky)) ? 1 : 0, 0);
        assert_near(channel_at(film, "Depth.Z", middle), 3.0, 0.01);
        assert_near(channel_at(film, "Depth.Z", side), 6.0, 1e-3);
        assert_near(channel_at(film, "P.Z", middle), 1.0, 0.01);
        assert_near(channel_at(film, "P.Z", side), -2.0, 1e-3);
        assert_near(channel_at(film, "N.Z", middle), 1.0, 0.01);
        assert_near(channel_at(film, "N.Z", side), 1.0, 1e-5);
        assert_near(channel_at(film, "Coverage.A", side), 1.0, 0.0);
        assert_near(channel_at(film, "Coverage.A", sky), 0.0, 0.0);
        assert_near(channel_at(film, "Albedo.G", middle), 0.0, 0.0);
        assert_near(channel_at(film, "Emission.G", middle), 2.0, 1e-5);
        const double unit = 33.0 / (2.0 * tan(pi / 6.0)); /* px */
        for (int k = 0; k < 2; k++) {
            const double z = k ? 6.0 : 3.0, moved = 0.1 * (1.0 / z - 1.0 / 3.5) * unit;
            assert_near(channel_at(film, "CoC", k ? side : middle), sqrt(pi) * fabs(moved), 0.005);
            assert_above(fabs(channel_at(film, "Shear", k ? side : middle)), 0.1);
        }
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
    clshear_scene_free(scene);
}

static void quads_have_a_dark_side(void **state)
{
    static const double corner[3] = {-9, -9, 0}, right[3] = {18, 0, 0}, up[3] = {0, 18, 0};
    clshear_scene *scene = test_floor(*state, 0.01f, 0.5f);
    for (int behind = 0; behind < 2; behind++)
        for (int bounces = 0; bounces < 2; bounces++) {
            clshear_settings *settings = looking_down(16, bounces);
            test_set(settings, CLSHEAR_EYE, "0,1,%d", behind ? -2 : 2);
            test_set(settings, CLSHEAR_TARGET, "0,1,0");
            test_set(settings, CLSHEAR_UP, "0,1,0");
            test_set(settings, CLSHEAR_ENVIRONMENT, "7,7,7");
            add_quad(settings, corner, right, up);
            double error;
            assert_near(mean_of(scene, settings, &error), behind ? 0.0 : 2.0, 0.0);
        }
    clshear_scene_free(scene);
}

/* A sphere or a quad between a point light and the floor: its shadow, and beside it none. */
static void shapes_cast_shadows(void **state)
{
    static const double corner[3] = {-1, 1, -1}, a[3] = {2, 0, 0}, b[3] = {0, 0, 2};
    clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
    for (int quad = 0; quad < 2; quad++)
        for (int bounces = 0; bounces < 2; bounces++)
            for (int beside = 0; beside < 2; beside++) {
                clshear_settings *settings = looking_down(16, bounces);
                test_set(settings, CLSHEAR_LIGHT, "%d,3,0,9,9,9", beside ? 12 : 0);
                if (quad)
                    add_quad(settings, corner, b, a); /* shines upwards */
                else
                    test_set(settings, CLSHEAR_SPHERE, "0,1.5,0,1,0,0,0");
                const double square = 9.0 + 144.0;
                const double truth = beside ? 0.5 / pi * 9.0 * 3.0 / (square * sqrt(square)) : 0.0;
                double error;
                assert_near(mean_of(scene, settings, &error), truth, 1e-4 * truth);
            }
    clshear_scene_free(scene);
}

static void wrong_shapes_are_refused(void **state)
{
    clshear_scene *scene = test_floor(*state, 1.0f, 0.5f);
    clshear_light light = {.struct_size = sizeof light, .kind = CLSHEAR_LIGHT_SPHERE};
    test_refused(clshear_scene_add_light(scene, &light), CLSHEAR_BAD_ARGUMENT, "radius");
    light.kind = CLSHEAR_LIGHT_QUAD;
    light.edge1[0] = light.edge2[0] = 1.0f;
    test_refused(clshear_scene_add_light(scene, &light), CLSHEAR_BAD_ARGUMENT, "edges");
    clshear_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_over_a_floor),      cmocka_unit_test(quad_over_a_floor),
        cmocka_unit_test(camera_sees_shapes),       cmocka_unit_test(channels_know_shapes),
        cmocka_unit_test(quads_have_a_dark_side),   cmocka_unit_test(shapes_cast_shadows),
        cmocka_unit_test(wrong_shapes_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
