/* Spots, suns and the studio against closed forms. */
#include "support.h"

#include <math.h>
#include <stdio.h>

static const double pi = 3.14159265358979;
static const uint32_t quad[6] = {0, 1, 2, 0, 2, 3};

static test_estimate mean_of_render(clshear_scene *scene, clshear_settings *settings)
{
    return test_mean_of_render(scene, settings, "R");
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
        const test_estimate found = mean_of_render(scene, test_looking_down(x, 64));
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
        const test_estimate found = mean_of_render(scene, test_looking_down(2.0 * tan(angle), 64));
        print_message("spot of %g to %g degrees at %g: %.5f of %.5f\n", (double)light.inner_deg,
                      (double)light.outer_deg, cases[i].at_deg, found.mean, truth);
        assert_near(found.mean, truth, 2e-3 * 0.32);
        clshear_scene_free(scene);
    }
}

/* A floor, and a half plane x < 0 at a height of 10: seen from (0, 0, 0), it hides half of a sun in
 * the zenith. albedo: of the half plane. A triangle below the floor, which nothing sees, has
 * radiance `below`. */
static clshear_scene *floor_and_half_plane(clshear_context *context, float albedo, float below)
{
    static const float hidden[9] = {0, -5, 0, 1, -5, 0, 0, -5, 1};
    static const float floor_y[12] = {-50, 0, -50, 50, 0, -50, 50, 0, 50, -50, 0, 50};
    static const float half[12] = {-50, 10, -50, 0, 10, -50, 0, 10, 50, -50, 10, 50};
    const clshear_mesh meshes[3] = {{.positions = floor_y,
                                     .indices = quad,
                                     .vertex_count = 4,
                                     .triangle_count = 2,
                                     .diffuse = {0.5f, 0.5f, 0.5f}},
                                    {.positions = half,
                                     .indices = quad,
                                     .vertex_count = 4,
                                     .triangle_count = 2,
                                     .diffuse = {albedo, albedo, albedo}},
                                    {.positions = hidden,
                                     .indices = quad,
                                     .vertex_count = 3,
                                     .triangle_count = 1,
                                     .emission = {below, below, below}}};
    return test_meshes(context, meshes, 3);
}

/* A sun of radius a whose middle is hidden up to the angle b from the zenith: with s = sin b / sin
 * a the part that is left is that of the unit disk beyond the chord at s, since irradiance is the
 * area of the projected disk: (acos s - s sqrt(1 - s^2)) / pi. 6 standard errors: false alarms
 * 1e-8. */
static void sun_behind_an_edge(void **state)
{
    static const double places[] = {-1.5, -0.5, 0.0, 0.5, 1.5};
    clshear_scene *scene = floor_and_half_plane(*state, 0.0f, 0.0f);
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
            clshear_settings *settings = test_looking_down(x, 1024);
            test_set_number(settings, CLSHEAR_BOUNCES, bounces);
            const test_estimate found = mean_of_render(scene, settings);
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
    clshear_scene *scene = floor_and_half_plane(*state, 0.0f, 0.0f);
    const clshear_light light = {.kind = CLSHEAR_LIGHT_DIRECTIONAL,
                                 .direction = {0, 2, 0},
                                 .colour = {3, 3, 3},
                                 .diameter_deg = 10.0f};
    double error[2];
    test_add_light(scene, &light);
    for (int sheared = 0; sheared < 2; sheared++) {
        clshear_settings *settings = test_looking_down(0.0, 16 * 1024);
        test_set_number(settings, CLSHEAR_FOV, 60.0);
        test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.5);
        test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 3.0);
        test_set(settings, CLSHEAR_SAMPLER, "sz");
        test_set(settings, CLSHEAR_SHEAR, sheared ? "equal-area" : "none");
        test_set(settings, CLSHEAR_ORACLE, "centre");
        error[sheared] = mean_of_render(scene, settings).error;
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
    const test_estimate found = mean_of_render(scene, test_looking_down(0.0, 1024));
    assert_near(found.mean, 0.5 / pi * 3.0 * 0.8, 6.0 * found.error + 1e-5);
    assert_below(found.error, 1e-3);
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
    clshear_settings *settings = test_looking_down(0.0, 16);
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
    clshear_settings *settings = test_looking_down(0.0, 1024);
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
    const test_estimate found = mean_of_render(scene, settings);
    assert_near(found.mean, 0.5 * (0.4 + sun[3] / pi * cosine), 6.0 * found.error + 1e-4);
    const test_estimate same = mean_of_render(scene, test_looking_down(0.0, 1024));
    assert_near(same.mean, found.mean, 0.0);

    settings = test_looking_down(0.0, 16);
    test_set(settings, CLSHEAR_LIGHT, "0,1,0,1,1,1");
    test_ok(clshear_light_complete(scene, settings));
    assert_false(clshear_settings_is_set(settings, CLSHEAR_SUN));
    assert_false(clshear_settings_is_set(settings, CLSHEAR_ENVIRONMENT));
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* A camera among things in the open, within their bounding box, has the sky's light: one in the eye
 * would burn what is near it. */
static void studio_leaves_the_open_to_the_sky(void **state)
{
    static const float corners[27] = {-9, 0, -9, 9, 0,  -9, 9,  0,  9, -9, 0, 9,    8, 0,
                                      8,  8, 9,  8, -8, 0,  -8, -8, 9, -8, 8, 0.5f, 8};
    static const uint32_t faces[12] = {0, 1, 2, 0, 2, 3, 4, 5, 8, 6, 7, 0};
    const clshear_mesh mesh = {.positions = corners,
                               .indices = faces,
                               .vertex_count = 9,
                               .triangle_count = 4,
                               .diffuse = {0.5f, 0.5f, 0.5f}};
    clshear_scene *scene = test_meshes(*state, &mesh, 1);
    clshear_settings *settings = test_looking_down(0.0, 64);
    test_set(settings, CLSHEAR_EYE, "0,0.5,0");
    test_set(settings, CLSHEAR_TARGET, "0,0,0");
    test_ok(clshear_light_complete(scene, settings));
    assert_true(clshear_settings_is_set(settings, CLSHEAR_SUN));
    assert_false(clshear_settings_is_set(settings, CLSHEAR_LIGHT));
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
    clshear_settings *settings = test_looking_down(0.0, 64);
    test_set(settings, CLSHEAR_EYE, "0,0,0");
    test_set(settings, CLSHEAR_TARGET, "0,-1,0");
    const test_estimate found = mean_of_render(scene, settings);
    assert_near(found.mean, 0.5 * 0.6, 1e-3);
    clshear_scene_free(scene);
}

/* Where no surface shines, the light that a path's last ray ends at is known before it is traced.
 * An emissive triangle below the floor, which nothing sees, lets such rays be traced as others are:
 * the same samples find the same, but for rounding. */
static void last_rays_are_like_others(void **state)
{
    for (int k = 0; k < 4; k++) {
        const int bounces = 1 + k % 2;
        test_estimate found[2];
        for (int shines = 0; shines < 2; shines++) {
            clshear_scene *scene = floor_and_half_plane(*state, 0.8f, (float)shines);
            clshear_settings *settings = test_looking_down(0.0, 1024);
            test_set_number(settings, CLSHEAR_FOV, 60.0);
            test_set_number(settings, CLSHEAR_BOUNCES, bounces);
            test_set_number(settings, CLSHEAR_ADAPTIVE, 0);
            test_set_number(settings, CLSHEAR_CLAMP, k < 2 ? 0.0 : 0.05);
            test_set(settings, CLSHEAR_SUN, "0.3,2,0,3,3,3,30");
            test_set(settings, CLSHEAR_SPHERE, "1,2,1,1,2,2,2");
            test_set(settings, CLSHEAR_QUAD, "-4,1,-4,0,0,8,2,0,0,2,2,2");
            test_set(settings, CLSHEAR_ENVIRONMENT, "gradient:0.5,0.5,0.5,1,1,1");
            found[shines] = mean_of_render(scene, settings);
            clshear_scene_free(scene);
        }
        print_message("%d bounces: %.6f and %.6f, errors %.6f and %.6f\n", bounces, found[0].mean,
                      found[1].mean, found[0].error, found[1].error);
        assert_above(found[0].error, 1e-5 * found[0].mean);
        assert_near(found[0].mean, found[1].mean, 1e-5 * found[0].mean);
        assert_near(found[0].error, found[1].error, 1e-3 * found[0].error);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spot_over_a_floor),
        cmocka_unit_test(spots_may_be_narrow_or_sharp),
        cmocka_unit_test(sun_behind_an_edge),
        cmocka_unit_test(light_is_paired_with_the_fibre),
        cmocka_unit_test(sun_from_the_side),
        cmocka_unit_test(studio_lights_what_has_no_light),
        cmocka_unit_test(studio_lights_the_inside),
        cmocka_unit_test(studio_leaves_the_open_to_the_sky),
        cmocka_unit_test(wrong_lights_are_refused),
        cmocka_unit_test(last_rays_are_like_others),
    };
    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
