/* The sky between two colours, and environments that hold no numbers. */
#include "support.h"

#include <math.h>

#include "scene/environment.h"

static const char *const sky = "gradient:4,1,0,1,2,3";

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

/* From above the origin towards a point; `up` is not along that. */
static clshear_film *look_at(clshear_scene *scene, const char *target, const char *up, int bounces)
{
    clshear_settings *settings = test_settings(NULL, 4, 4, 1024);
    test_set(settings, CLSHEAR_EYE, "0,1,0");
    test_set(settings, CLSHEAR_TARGET, "%s", target);
    test_set(settings, CLSHEAR_UP, "%s", up);
    test_set_number(settings, CLSHEAR_FOV, 0.01);
    test_set_number(settings, CLSHEAR_LENS_RADIUS, 0.0);
    test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, 1.0);
    test_set_number(settings, CLSHEAR_REPLICATES, 16);
    test_set_number(settings, CLSHEAR_BOUNCES, bounces);
    test_set(settings, CLSHEAR_ENVIRONMENT, "%s", sky);
    clshear_film *film = test_render(scene, settings);
    clshear_settings_free(settings);
    return film;
}

/* The zenith, the horizon, the ground, and 30 degrees up, half way. 256 rows leave 1e-4 of the
 * difference of the colours at the bends, 0.02 at the horizon itself. */
static void camera_sees_it(void **state)
{
    static const struct {
        const char *target, *up;
        float colour[3];
    } cases[] = {{"0,2,0", "0,0,-1", {4, 1, 0}},
                 {"1,-1,0", "0,1,0", {1, 2, 3}},
                 {"5,1,1", "0,1,0", {1, 2, 3}},
                 {"0,2,1.7320508", "0,1,0", {2.5f, 1.5f, 1.5f}}};
    clshear_scene *scene = test_floor(*state, 1e-4f, 0.5f);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        clshear_film *film = look_at(scene, cases[i].target, cases[i].up, 0);
        for (int c = 0; c < 3; c++) {
            const char name[2] = {"RGB"[c], '\0'};
            assert_near(clshear_film_channel(film, name)[5], cases[i].colour[c], 0.03);
        }
        clshear_film_free(film);
    }
    clshear_scene_free(scene);
}

/* With horizon h and zenith z a floor sees pi (h + 2/3 (z - h)). 6 standard errors of 16 pixels,
 * false alarms 1e-8; 1e-3 for the rows. */
static void lights_a_floor(void **state)
{
    static const double truth[3] = {0.5 * 3.0, 0.5 * 4.0 / 3.0, 0.5 * 1.0};
    clshear_scene *scene = test_floor(*state, 100.0f, 0.5f);
    for (int bounces = 0; bounces < 2; bounces++) {
        clshear_film *film = look_at(scene, "0,0,0", "0,0,-1", bounces);
        for (int c = 0; c < 3; c++) {
            const char mean[2] = {"RGB"[c], '\0'};
            const char variance[11] = {'V', 'a', 'r', 'i', 'a', 'n', 'c', 'e', '.', "RGB"[c], '\0'};
            double sum = 0.0, square = 0.0;
            for (int p = 0; p < 16; p++) {
                sum += (double)clshear_film_channel(film, mean)[p] / 16.0;
                square += (double)clshear_film_channel(film, variance)[p] / 256.0;
            }
            print_message("%s: %.5f of %.5f, error %.2g\n", mean, sum, truth[c], sqrt(square));
            assert_near(sum, truth[c], 6.0 * sqrt(square) + 1e-3);
        }
        clshear_film_free(film);
    }
    clshear_scene_free(scene);
}

static void wrong_ones_are_refused(void **state)
{
    static const char *const wrong[] = {"gradient:1,1,1,-1,1,1", "gradient:1,1,1", "gradient:"};
    clshear_scene *scene = test_floor(*state, 1.0f, 0.5f);
    clshear_settings *settings = test_settings(NULL, 4, 4, 16);
    clshear_film *film = NULL;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        test_set(settings, CLSHEAR_ENVIRONMENT, "%s", wrong[i]);
        test_refused(clshear_render(scene, settings, &film),
                     i == 0 ? CLSHEAR_BAD_ARGUMENT : CLSHEAR_BAD_FILE, "environment");
    }
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* What is no number shines as little as what is black, and changes nothing else. */
static void no_number_is_black(void **state)
{
    float texels[2][12] = {{4, 4, 4, 0, 0, 0, 1, 1, 1, 1, 1, 1}};
    cs_environment made[2];
    cs_error error;
    (void)state;
    memset(made, 0, sizeof made);
    memcpy(texels[1], texels[0], sizeof texels[0]);
    texels[1][3] = NAN;
    for (int i = 0; i < 2; i++)
        assert_int_equal(cs_environment_make(texels[i], 4, 1, &made[i], &error), CLSHEAR_OK);
    assert_int_equal(made[0].image.count, made[1].image.count);
    assert_memory_equal(made[0].image.items, made[1].image.items,
                        made[0].image.count * made[0].image.item_size);
    cs_environment_free(&made[0]);
    cs_environment_free(&made[1]);
    texels[1][0] = INFINITY; /* a sun in halves */
    assert_int_equal(cs_environment_make(texels[1], 4, 1, &made[1], &error), CLSHEAR_OK);
    assert_true(*(const float *)made[1].image.items == 65504.0f);
    cs_environment_free(&made[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_number_is_black),
        cmocka_unit_test(camera_sees_it),
        cmocka_unit_test(lights_a_floor),
        cmocka_unit_test(wrong_ones_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
