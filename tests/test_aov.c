/* AOVs: the picture keeps its bits, parts of light add up, and means obey closed forms. */
#include "support.h"

#include <math.h>
#include <stdio.h>

enum {
    SIDE = 24
};

static const char *const all_aovs =
    "albedo,normal,position,depth,coverage,emission,direct,indirect";

static clshear_settings *settings_of(test_fixture *made, uint32_t spp, const char *bounces)
{
    clshear_settings *settings = test_settings(made->settings, SIDE, SIDE, spp);
    test_set(settings, CLSHEAR_BOUNCES, "%s", bounces);
    test_set(settings, CLSHEAR_ORACLE, "centre");
    return settings;
}

static void expect_equal(const clshear_film *a, const clshear_film *b, const char *name,
                         double tolerance)
{
    const float *pa = clshear_film_channel(a, name), *pb = clshear_film_channel(b, name);
    assert_non_null(pa);
    assert_non_null(pb);
    for (int i = 0; i < SIDE * SIDE; i++)
        assert_near(pa[i], pb[i], tolerance * (1e-3 + fabs((double)pa[i])));
}

static void expect_sums(const clshear_film *film)
{
    for (int c = 0; c < 3; c++) {
        char names[3][24];
        const char colour[2] = {"RGB"[c], '\0'};
        snprintf(names[0], sizeof names[0], "Emission.%s", colour);
        snprintf(names[1], sizeof names[1], "Direct.%s", colour);
        snprintf(names[2], sizeof names[2], "Indirect.%s", colour);
        for (int i = 0; i < SIDE * SIDE; i++) {
            double sum = 0.0;
            for (int p = 0; p < 3; p++)
                sum += (double)clshear_film_channel(film, names[p])[i];
            const float whole = clshear_film_channel(film, colour)[i];
            assert_near(sum, whole, 1e-5 * (1e-3 + (double)whole));
        }
    }
}

/* With direct light alone and with bounces, evenly and adaptively sampled. */
static void the_picture_stays_and_parts_add_up(void **state)
{
    test_fixture *made = *state;
    static const char *const bounces[] = {"0", "2"};
    for (int b = 0; b < 2; b++) {
        clshear_settings *settings = settings_of(made, 128, bounces[b]);
        if (b == 1) test_set(settings, CLSHEAR_ADAPTIVE, "1");
        clshear_film *plain = test_render(made->scene, settings);
        test_set(settings, CLSHEAR_AOV, "%s", all_aovs);
        clshear_film *film = test_render(made->scene, settings);
        static const char *const same[] = {"R", "G", "B", "Samples", "SampleVariance.G"};
        for (size_t i = 0; i < sizeof same / sizeof *same; i++)
            expect_equal(plain, film, same[i], 0.0);
        expect_sums(film);
        clshear_film_free(plain);
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
}

/* A continued render has the channels of one in one go; another set is refused by name. */
static void extended_equals_whole(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 64, "1");
    test_set(settings, CLSHEAR_EXTENDABLE, "1");
    clshear_film *bare = test_render(made->scene, settings), *film = NULL;
    test_set(settings, CLSHEAR_AOV, "%s", all_aovs);
    clshear_film *first = test_render(made->scene, settings);
    test_set(settings, CLSHEAR_SPP, "128");
    test_refused(clshear_render_extend(made->scene, settings, bare, &film), CLSHEAR_BAD_ARGUMENT,
                 "Albedo.R");
    test_ok(clshear_render_extend(made->scene, settings, first, &film));
    clshear_film *whole = test_render(made->scene, settings);
    static const char *const names[] = {"Albedo.R",   "N.Z",      "P.X",        "Depth.Z",
                                        "Coverage.A", "Direct.G", "Indirect.B", "Emission.R"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        expect_equal(whole, film, names[i], 1e-3);
    clshear_film_free(bare);
    clshear_film_free(first);
    clshear_film_free(film);
    clshear_film_free(whole);
    clshear_settings_free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_picture_stays_and_parts_add_up),
        cmocka_unit_test(extended_equals_whole),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
