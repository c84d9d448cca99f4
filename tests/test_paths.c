/* Light by way of several surfaces, against closed forms. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/integrands.h"
#include "kernels/scene.h"

static const uint32_t quad[6] = {0, 1, 2, 0, 2, 3};

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

/* The cube from -1 to 1, each face a mesh with the same albedo and emission. */
static clshear_scene *closed_cube(clshear_context *context, float albedo, float emission)
{
    static float positions[6][12];
    clshear_mesh meshes[6];
    for (int f = 0; f < 6; f++) {
        const int axis = f / 2, next = (axis + 1) % 3, last = (axis + 2) % 3;
        for (int k = 0; k < 4; k++) {
            positions[f][3 * k + axis] = f % 2 == 0 ? -1.0f : 1.0f;
            positions[f][3 * k + next] = k == 0 || k == 3 ? -1.0f : 1.0f;
            positions[f][3 * k + last] = k < 2 ? -1.0f : 1.0f;
        }
        meshes[f] = (clshear_mesh){.positions = positions[f],
                                   .indices = quad,
                                   .vertex_count = 4,
                                   .triangle_count = 2,
                                   .diffuse = {albedo, 0.5f * albedo, 0.0f},
                                   .emission = {emission, emission, emission}};
    }
    return test_meshes(context, meshes, 6);
}

/* A view of a few pixels along -Z from `eye`. */
static clshear_settings *settings_at(const char *eye, const char *target, double fov_deg, int spp,
                                     int bounces)
{
    clshear_settings *settings = test_settings(NULL, 4, 4, (uint32_t)spp);
    test_set(settings, CLSHEAR_EYE, "%s", eye);
    test_set(settings, CLSHEAR_TARGET, "%s", target);
    test_set(settings, CLSHEAR_UP, "0,0.1,1");
    test_set_number(settings, CLSHEAR_FOV, fov_deg);
    test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0);
    test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 1.0);
    test_set_number(settings, CLSHEAR_REPLICATES, 16);
    test_set_number(settings, CLSHEAR_BOUNCES, bounces);
    return settings;
}

/* In a closed space whose walls emit E and reflect rho everywhere, every path finds the same: after
 * n bounces E (1 + rho + ... + rho^(n+1)), and E / (1 - rho) in the end. Sixteen pixels with 16
 * replicates each: 240 degrees of freedom, so 5 standard errors are a false alarm of 1e-6; 1e-4
 * is allowed for light that rounding loses at the edges. From the third surface on there is
 * roulette, which must not change the mean. */
static void light_in_a_closed_cube(void **state)
{
    static const int bounces[] = {0, 1, 2, 5, 64};
    clshear_scene *scene = closed_cube(*state, 0.8f, 0.5f);
    for (size_t i = 0; i < sizeof bounces / sizeof *bounces; i++) {
        const char *const channels[] = {"R", "G", "B"};
        clshear_settings *settings = settings_at("0.1,0.2,0.3", "0,0.4,-1", 60.0, 1024, bounces[i]);
        clshear_film *film = test_render(scene, settings);
        for (int c = 0; c < 3; c++) {
            const double rho = c == 0 ? 0.8 : c == 1 ? 0.4 : 0.0;
            const double truth = 0.5 * (1.0 - pow(rho, bounces[i] + 2)) / (1.0 - rho);
            const test_estimate found = test_mean(film, channels[c]);
            print_message("%2d bounces, %s: %.5f of %.5f, error %.5f\n", bounces[i], channels[c],
                          found.mean, truth, found.error);
            assert_near(found.mean, truth, 5.0 * found.error + 1e-4 * truth);
            assert_below(found.error, 0.03 * truth); /* else the test says little */
        }
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
    clshear_scene_free(scene);
}

/* Paths from single points find what those of a picture find, on average: they draw all numbers but
 * the points' own. A point light, since those have a fixed place on area lights. 5 standard errors
 * of 4096 points and 4096 samples: false alarms 1e-6. */
static void points_have_all_paths(void **state)
{
    enum {
        POINTS = 4096
    };
    static float points[POINTS][4], found[POINTS][3];
    double sum = 0.0, square = 0.0;
    const clshear_light light = {
        .kind = CLSHEAR_LIGHT_POINT, .position = {0.2f, -0.1f, 0.4f}, .colour = {1, 1, 1}};
    clshear_scene *scene = closed_cube(*state, 0.8f, 0.0f);
    test_add_light(scene, &light);
    clshear_settings *settings = settings_at("0.1,0.2,0.3", "0,0.4,-1", 60.0, POINTS, 3);
    for (int i = 0; i < POINTS; i++) {
        points[i][0] = ((float)(i % 64) + 0.5f) / 64.0f;
        points[i][1] = ((float)(i / 64) + 0.5f) / 64.0f;
    }
    test_ok(clshear_radiance(scene, settings, 1, 2, points[0], POINTS, found[0]));
    for (int i = 0; i < POINTS; i++) {
        sum += (double)found[i][0] / POINTS;
        square += (double)found[i][0] * (double)found[i][0] / POINTS;
    }
    clshear_film *film = test_render(scene, settings);
    const double picture = (double)clshear_film_channel(film, "R")[2 * 4 + 1];
    const double error = sqrt((square - sum * sum) / POINTS +
                              (double)clshear_film_channel(film, "Variance.R")[2 * 4 + 1]);
    print_message("points %.5f, picture %.5f, error %.5f\n", sum, picture, error);
    assert_near(sum, picture, 5.0 * error);
    assert_below(error, 0.03 * picture);
    clshear_film_free(film);
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* A floor, and 2 above it a square panel of side 2 that shines and reflects nothing. */
static clshear_scene *floor_and_panel(clshear_context *context)
{
    static const float floor_y[12] = {-50, 0, -50, 50, 0, -50, 50, 0, 50, -50, 0, 50};
    static const float panel[12] = {-1, 2, -1, 1, 2, -1, 1, 2, 1, -1, 2, 1};
    const clshear_mesh meshes[2] = {{.positions = floor_y,
                                     .indices = quad,
                                     .vertex_count = 4,
                                     .triangle_count = 2,
                                     .diffuse = {0.5f, 0.5f, 0.5f}},
                                    {.positions = panel,
                                     .indices = quad,
                                     .vertex_count = 4,
                                     .triangle_count = 2,
                                     .emission = {3.0f, 3.0f, 3.0f}}};
    return test_meshes(context, meshes, 2);
}

/* Both ways to find the panel, weighted, and its own samples alone have the mean that the form
 * factor gives (Howell, catalogue C-11); nothing else can be found. 5 standard errors as above, and
 * 1e-3 for the pixels' extent. */
static void both_ways_to_find_a_light_agree(void **state)
{
    clshear_scene *scene = floor_and_panel(*state);
    const double x = 0.5, root = sqrt(1.0 + x * x); /* half side over height, both ways */
    const double truth = 0.5 * 3.0 * 4.0 / (2.0 * acos(-1.0)) * 2.0 * x / root * atan(x / root);
    const test_estimate one =
        test_mean_of_render(scene, settings_at("4,0.5,0", "0,0,0", 0.2, 1024, 0), "R");
    const test_estimate both =
        test_mean_of_render(scene, settings_at("4,0.5,0", "0,0,0", 0.2, 1024, 1), "R");
    print_message("light alone %.5f, both %.5f of %.5f\n", one.mean, both.mean, truth);
    assert_near(one.mean, truth, 5.0 * one.error + 1e-3 * truth);
    assert_near(both.mean, truth, 5.0 * both.error + 1e-3 * truth);
    assert_near(one.mean, both.mean, 5.0 * hypot(one.error, both.error));
    clshear_scene_free(scene);
}

/* The limit holds for bounces only, and can only darken. Emission of 0.5 and direct light of 0.4
 * stay whole; eight bounces add 1e-3 at most to each way to find light, of which there are two. */
static void clamping_darkens(void **state)
{
    clshear_scene *scene = closed_cube(*state, 0.8f, 0.5f);
    double before = 0.5;
    for (int i = 0; i < 3; i++) {
        clshear_settings *settings = settings_at("0.1,0.2,0.3", "0,0.4,-1", 60.0, 256, 8);
        if (i < 2) test_set_number(settings, CLSHEAR_CLAMP, i == 0 ? 1e-3 : 0.1);
        const test_estimate found = test_mean_of_render(scene, settings, "R");
        assert_above(found.mean, before);
        if (i == 0) assert_near(found.mean, 0.9 + 8e-3, 1e-2);
        before = found.mean;
    }
    clshear_scene_free(scene);
}

/* Threads, and so the cut into launches, do not change a bit; other samplers have the same mean. */
static void samplers_agree(void **state)
{
    static const char *const names[] = {"random", "mj",    "oa",     "halton",
                                        "sobol",  "rank1", "poisson"};
    clshear_scene *scene = closed_cube(*state, 0.8f, 0.5f);
    const double truth = 0.5 * (1.0 - pow(0.8, 7)) / 0.2;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        clshear_settings *settings = settings_at("0.1,0.2,0.3", "0,0.4,-1", 60.0, 1024, 5);
        test_set(settings, CLSHEAR_SAMPLER, "%s", names[i]);
        const test_estimate found = test_mean_of_render(scene, settings, "R");
        print_message("%-8s %.5f of %.5f, error %.5f\n", names[i], found.mean, truth, found.error);
        assert_near(found.mean, truth, 5.0 * found.error + 1e-4 * truth);
    }
    clshear_scene_free(scene);
}

/* What a sample sees and where its path goes on decide together what it finds: here a wall at a
 * right angle to the floor, under a point light. The equal-area shear gives these two the four
 * dimensions of `sz` and leaves the place on the lens to padding; without the shear the direction
 * is padded. The variance without it is 20 times that with it, 1.4 times if the direction were
 * padded always. Both are means over 16 pixels with 240 degrees of freedom, so that the ratio has a
 * standard error of 13 %: the limit is 6 of them from either (false alarms below 1e-8). */
static void first_bounce_is_paired_with_the_fibre(void **state)
{
    static const float floor_z[12] = {-50, -50, 0, 50, -50, 0, 50, 50, 0, -50, 50, 0};
    static const float wall[12] = {0, -50, 0, 0, -50, 50, 0, 50, 50, 0, 50, 0};
    clshear_mesh meshes[2] = {{.positions = floor_z,
                               .indices = quad,
                               .vertex_count = 4,
                               .triangle_count = 2,
                               .diffuse = {0.5f, 0.5f, 0.5f}},
                              {.positions = wall,
                               .indices = quad,
                               .vertex_count = 4,
                               .triangle_count = 2,
                               .diffuse = {0.9f, 0.9f, 0.9f}}};
    const clshear_light light = {
        .kind = CLSHEAR_LIGHT_POINT, .position = {4, 0, 4}, .colour = {30, 30, 30}};
    clshear_scene *scene = test_meshes(*state, meshes, 2);
    test_add_light(scene, &light);
    double error[2];
    for (int sheared = 0; sheared < 2; sheared++) {
        clshear_settings *settings = settings_at("6,0.5,4", "2,0.3,0", 40.0, 16 * 1024, 1);
        test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.3);
        test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 3.0);
        test_set(settings, CLSHEAR_SAMPLER, "sz");
        test_set(settings, CLSHEAR_SHEAR, sheared ? "equal-area" : "none");
        test_set(settings, CLSHEAR_ORACLE, "centre");
        error[sheared] = test_mean_of_render(scene, settings, "R").error;
    }
    const double ratio = error[0] * error[0] / (error[1] * error[1]);
    print_message("variance without shear over variance with it: %.2f\n", ratio);
    assert_above(ratio, 4.0);
    clshear_scene_free(scene);
}

/* Ripples of 18 432 triangles, in the neutral studio: enough for rays to walk alone. */
static clshear_scene *ripples(clshear_context *context)
{
    enum {
        SIDE = 96
    };
    static float positions[(SIDE + 1) * (SIDE + 1)][3];
    static uint32_t indices[SIDE * SIDE][2][3];
    for (uint32_t i = 0; i <= SIDE; i++)
        for (uint32_t k = 0; k <= SIDE; k++) {
            float *at = positions[i * (SIDE + 1) + k];
            at[0] = (float)i / (SIDE / 2) - 1.0f;
            at[1] = (float)k / (SIDE / 2) - 1.0f;
            at[2] = 0.2f * sinf(9.0f * at[0]) * cosf(7.0f * at[1]);
        }
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t corner = i / SIDE * (SIDE + 1) + i % SIDE;
        const uint32_t both[2][3] = {{corner, corner + 1, corner + SIDE + 2},
                                     {corner, corner + SIDE + 2, corner + SIDE + 1}};
        memcpy(indices[i], both, sizeof both);
    }
    const clshear_mesh mesh = {.positions = positions[0],
                               .indices = indices[0][0],
                               .vertex_count = (SIDE + 1) * (SIDE + 1),
                               .triangle_count = 2 * SIDE * SIDE,
                               .diffuse = {0.8f, 0.5f, 0.2f}};
    return test_meshes(context, &mesh, 1);
}

static clshear_scene *bright_cube(clshear_context *context)
{
    return closed_cube(context, 0.8f, 0.5f);
}

static clshear_film *film_by_packets(clshear_scene *(*make)(clshear_context *), int packet,
                                     const char *eye)
{
    clshear_context *context = NULL;
    clshear_settings *own = test_settings(NULL, 4, 4, 600);
    test_set_number(own, CLSHEAR_PACKET, packet);
    test_ok(clshear_context_create(own, &context));
    clshear_scene *scene = make(context);
    clshear_settings *settings = settings_at(eye, "0,0.4,-1", 60.0, 600, 5);
    test_set_number(settings, CLSHEAR_REPLICATES, 2);
    clshear_film *film = test_render(scene, settings);
    clshear_settings_free(settings);
    clshear_settings_free(own);
    clshear_scene_free(scene);
    clshear_context_free(context);
    return film;
}

/* Rounding may send single paths of 600 elsewhere, of which each is 0.2 % of a pixel. */
static void assert_same_pixels(const clshear_film *film, const clshear_film *expected)
{
    for (int p = 0; p < 16; p++) {
        const double value = (double)clshear_film_channel(expected, "R")[p];
        assert_above(value, 0.01);
        assert_near(clshear_film_channel(film, "R")[p], value, 0.01 * value);
    }
}

/* Which paths are followed together, and in which lanes, does not change what they find: one by
 * one, and sorted into packets, of patterns of 300, which are one whole pool and part of a second.
 */
static void sorting_changes_nothing(void **state)
{
    static const int packets[] = {4, 16};
    (void)state;
    clshear_film *alone = film_by_packets(bright_cube, 1, "0.1,0.2,0.3");
    for (size_t i = 0; i < sizeof packets / sizeof *packets; i++) {
        clshear_film *sorted = film_by_packets(bright_cube, packets[i], "0.1,0.2,0.3");
        assert_same_pixels(sorted, alone);
        clshear_film_free(sorted);
    }
    clshear_film_free(alone);
}

/* Nor do the pixels whose paths are followed together: sixteen with patterns of 32, whose pools are
 * of eight of them, and each pixel alone. */
static void pools_change_nothing(void **state)
{
    static const char *const samplers[] = {"sobol", "sz", "mj"}; /* the last knows no pools */
    clshear_scene *scene = closed_cube(*state, 0.8f, 0.5f);
    for (size_t i = 0; i < sizeof samplers / sizeof *samplers; i++) {
        clshear_settings *settings = settings_at("0.1,0.2,0.3", "0,0.4,-1", 60.0, 64, 5);
        test_set_number(settings, CLSHEAR_REPLICATES, 2);
        test_set_number(settings, CLSHEAR_ADAPTIVE, 0);
        test_set(settings, CLSHEAR_SAMPLER, "%s", samplers[i]);
        clshear_film *whole = test_render(scene, settings);
        for (int pixel = 0; pixel < 16; pixel++) {
            test_set(settings, CLSHEAR_CROP, "%d,%d,%d,%d", pixel % 4, pixel % 4 + 1, pixel / 4,
                     pixel / 4 + 1);
            clshear_film *alone = test_render(scene, settings);
            assert_memory_equal(clshear_film_channel(whole, "R") + pixel,
                                clshear_film_channel(alone, "R"), sizeof(float));
            assert_memory_equal(clshear_film_channel(whole, "Variance.G") + pixel,
                                clshear_film_channel(alone, "Variance.G"), sizeof(float));
            clshear_film_free(alone);
        }
        clshear_film_free(whole);
        clshear_settings_free(settings);
    }
    clshear_scene_free(scene);
}

/* Neither does it which hierarchy they walk: with packets of 16, rays among many triangles walk the
 * wide one. */
static void wide_walk_changes_nothing(void **state)
{
    (void)state;
    clshear_film *together = film_by_packets(ripples, 8, "0.2,-0.9,1.5");
    clshear_film *alone = film_by_packets(ripples, CS_WIDE, "0.2,-0.9,1.5");
    assert_same_pixels(alone, together);
    clshear_film_free(together);
    clshear_film_free(alone);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_in_a_closed_cube),
        cmocka_unit_test(points_have_all_paths),
        cmocka_unit_test(both_ways_to_find_a_light_agree),
        cmocka_unit_test(clamping_darkens),
        cmocka_unit_test(samplers_agree),
        cmocka_unit_test(first_bounce_is_paired_with_the_fibre),
        cmocka_unit_test(sorting_changes_nothing),
        cmocka_unit_test(pools_change_nothing),
        cmocka_unit_test(wide_walk_changes_nothing),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
