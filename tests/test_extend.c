/* Continued renders: they equal a render in one go. */
#include "support.h"

#include <math.h>

#include "clshear/analysis.h"

static clshear_settings *settings_of(test_fixture *made, const char *sampler, uint32_t spp)
{
    clshear_settings *settings = test_settings(made->settings, 24, 24, spp);
    test_set(settings, CLSHEAR_SAMPLER, "%s", sampler);
    test_set(settings, CLSHEAR_EXTENDABLE, "1");
    test_set(settings, CLSHEAR_ORACLE, "centre"); /* a pilot's choice depends on its budget */
    return settings;
}

static clshear_film *extend(test_fixture *made, clshear_settings *settings, uint32_t spp,
                            const clshear_film *base)
{
    clshear_film *film = NULL;
    test_set(settings, CLSHEAR_SPP, "%u", spp);
    test_ok(clshear_render_extend(made->scene, settings, base, &film));
    return film;
}

/* Compares films up to the rounding of float sums in another order: 1e-4 of the plane's largest
 * value, because variances are differences of means. */
static void expect_same(const clshear_film *a, const clshear_film *b)
{
    const char *name;
    const clshear_film_info info = test_film_info(a);
    for (size_t c = 0; (name = clshear_film_channel_name(a, c)) != NULL; c++) {
        const float *pa = clshear_film_channel(a, name), *pb = clshear_film_channel(b, name);
        double most = 0.0, off = 0.0;
        assert_non_null(pb);
        for (int i = 0; i < info.width * info.height; i++) {
            most = fmax(most, fabs((double)pa[i]));
            off = fmax(off, fabs((double)pa[i] - (double)pb[i]));
        }
        if (off > 1e-4 * most) fail_msg("%s differs by %g of %g", name, off, most);
    }
}

/* From 100 to 300 samples through a file, then to 1024 in memory, for every progressive sampler.
 * The counts are not powers of two, and blocks are cut in the middle. */
static void extended_equals_whole(void **state)
{
    test_fixture *made = *state;
    clshear_sampler_info info = {.struct_size = sizeof info};
    int seen = 0;
    for (size_t s = 0; clshear_sampler_describe(s, &info); s++) {
        if (!info.progressive) continue;
        clshear_settings *settings = settings_of(made, info.name, 100);
        clshear_film *first = test_render(made->scene, settings), *read = NULL;
        const char *path = test_path("extend.exr");
        test_ok(clshear_film_write(first, path));
        test_ok(clshear_film_read(path, &read));
        clshear_film *second = extend(made, settings, 300, read);
        clshear_film *third = extend(made, settings, 1024, second);
        clshear_film *whole = test_render(made->scene, settings);
        assert_int_equal(test_film_info(whole).samples, 24 * 24 * 1024);
        expect_same(whole, third);
        clshear_film_free(first);
        clshear_film_free(read);
        clshear_film_free(second);
        clshear_film_free(third);
        clshear_film_free(whole);
        clshear_settings_free(settings);
        seen++;
    }
    assert_at_least(seen, 5);
}

/* A continued render keeps the pilot's choice. */
static void the_choice_of_the_pilot_stays(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, "sz", 128);
    test_set(settings, CLSHEAR_ORACLE, "pilot");
    clshear_film *first = test_render(made->scene, settings);
    clshear_film *second = extend(made, settings, 512, first);
    assert_memory_equal(clshear_film_channel(first, "Shear"), clshear_film_channel(second, "Shear"),
                        24 * 24 * sizeof(float));
    assert_memory_equal(clshear_film_channel(first, "Oracle"),
                        clshear_film_channel(second, "Oracle"), 24 * 24 * sizeof(float));
    assert_int_equal(test_film_info(second).pilot_samples, 0);
    clshear_film_free(first);
    clshear_film_free(second);
    clshear_settings_free(settings);
}

/* Stops the render after a few launches. */
static int stop(void *user, const clshear_progress *progress)
{
    (void)progress;
    return ++*(int *)user >= 3;
}

/* An interrupted continuation loses nothing of its base: its sample counts are correct, and its
 * mean equals the base's within the noise of the new samples. New samples come in blocks of
 * CS_BLOCK = 16 neighbours, with at most the deviation of n / 16 independent samples. The mean
 * absolute difference of normal variables is 0.8 of their deviation, over 576 pixels with a
 * deviation of 0.025: the limit is eight of these away. */
static void an_interrupted_extension_is_whole(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, "sz", 4096);
    clshear_film *first = test_render(made->scene, settings);
    int calls = 0;
    clshear_settings_set_progress(settings, stop, &calls);
    clshear_film *second = extend(made, settings, 2000000, first);
    assert_int_equal(test_film_info(second).complete, 0);
    const float *a = clshear_film_channel(first, "G"), *b = clshear_film_channel(second, "G");
    const float *counts = clshear_film_channel(second, "Samples");
    const float *variance = clshear_film_channel(second, "SampleVariance.G");
    double limit = 0.0, off = 0.0;
    for (int i = 0; i < 24 * 24; i++) {
        const double added = (double)counts[i] - 4096.0;
        assert_at_least(added, 0.0);
        limit += sqrt(16.0 * (double)variance[i] * added) / (double)counts[i];
        off += fabs((double)a[i] - (double)b[i]);
    }
    assert_at_most(off, limit);
    clshear_film_free(first);
    clshear_film_free(second);
    clshear_settings_free(settings);
}

/* An even environment of 4 x 2 texels, as a file. */
static const char *environment_of(float radiance)
{
    static const char *const names[3] = {"R", "G", "B"};
    const char *path = test_path("sky.exr");
    float texels[8];
    for (int i = 0; i < 8; i++)
        texels[i] = radiance;
    const float *const planes[3] = {texels, texels, texels};
    test_ok(clshear_image_write(path, 4, 2, 3, names, planes));
    return path;
}

/* A file that has the same name and another picture is another environment. */
static void another_environment_is_refused(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, "sz", 64);
    clshear_film *more = NULL;
    test_set(settings, CLSHEAR_ENVIRONMENT, "%s", environment_of(1.0f));
    clshear_film *film = test_render(made->scene, settings);
    test_set(settings, CLSHEAR_SPP, "128");
    environment_of(2.0f);
    test_refused(clshear_render_extend(made->scene, settings, film, &more), CLSHEAR_BAD_ARGUMENT,
                 "another environment image");
    environment_of(1.0f);
    test_ok(clshear_render_extend(made->scene, settings, film, &more));
    clshear_film_free(more);
    clshear_film_free(film);
    clshear_settings_free(settings);
}

static int stop_at_once(void *user, const clshear_progress *progress)
{
    (void)user, (void)progress;
    return 1;
}

/* A continuation that stops in the gain's pilot, before any pass, returns the old picture up to the
 * rounding of means to float. The film is marked incomplete and its gain is unknown. */
static void an_extension_that_never_began_is_whole(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, "sz", 256);
    clshear_film *first = test_render(made->scene, settings);
    test_set(settings, CLSHEAR_GAIN, "1");
    clshear_settings_set_progress(settings, stop_at_once, NULL);
    clshear_film *second = extend(made, settings, 1024, first);
    assert_int_equal(test_film_info(second).complete, 0);
    const float *a = clshear_film_channel(first, "G"), *b = clshear_film_channel(second, "G");
    for (int i = 0; i < 24 * 24; i++) {
        assert_near(clshear_film_channel(second, "Samples")[i], 256.0f, 0);
        assert_near(a[i], b[i], 4e-7f * fabsf(a[i]));
    }
    assert_null(clshear_film_channel(second, "Gain"));
    clshear_film_free(first);
    clshear_film_free(second);
    clshear_settings_free(settings);
}

/* Expects a refusal to continue `base` with one setting changed. */
static void refuse_continuation(test_fixture *made, const clshear_film *base,
                                const clshear_settings *settings, clshear_setting changed,
                                const char *value, const char *words)
{
    clshear_settings *other = NULL;
    clshear_film *film = NULL;
    test_ok(clshear_settings_copy(settings, &other));
    test_set(other, changed, "%s", value);
    test_refused(clshear_render_extend(made->scene, other, base, &film), CLSHEAR_BAD_ARGUMENT,
                 words);
    assert_null(film);
    clshear_settings_free(other);
}

static void mismatched_bases_are_refused(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, "sobol", 64);
    clshear_film *base = test_render(made->scene, settings), *none = NULL;
    test_set(settings, CLSHEAR_SAMPLER, "mj");
    test_refused(clshear_render(made->scene, settings, &none), CLSHEAR_BAD_ARGUMENT, "mj");
    test_set(settings, CLSHEAR_SAMPLER, "sobol");
    test_set(settings, CLSHEAR_EXTENDABLE, "0");
    clshear_film *plain = test_render(made->scene, settings);
    test_set(settings, CLSHEAR_SPP, "128");
    refuse_continuation(made, plain, settings, CLSHEAR_SPP, "128", "extendable");
    refuse_continuation(made, base, settings, CLSHEAR_SAMPLER, "mj", "mj cannot extend");
    test_set(settings, CLSHEAR_EXTENDABLE, "1");
    refuse_continuation(made, base, settings, CLSHEAR_SAMPLER, "halton", "another sampler");
    refuse_continuation(made, base, settings, CLSHEAR_SEED, "1", "another seed");
    refuse_continuation(made, base, settings, CLSHEAR_SHEAR, "none", "another shear");
    refuse_continuation(made, base, settings, CLSHEAR_SPP, "64", "64 samples per pixel already");
    refuse_continuation(made, base, settings, CLSHEAR_CROP, "0,8,0,8", "crop");
    refuse_continuation(made, base, settings, CLSHEAR_FOCAL_DISTANCE, "931",
                        "another focal-distance");
    clshear_film_free(base);
    clshear_film_free(plain);
    clshear_settings_free(settings);
}

/* A picture with a number that no render writes is refused by pixel and channel. */
static void damaged_bases_are_refused(void **state)
{
    test_fixture *made = *state;
    static const struct {
        const char *channel;
        float value;
        const char *words;
    } cases[] = {{"Oracle", NAN, "pixel 5,1 has nan in channel Oracle"},
                 {"Oracle", -1.0f, "pixel 5,1 has -1 in channel Oracle"},
                 {"Oracle", 0.5f, "pixel 5,1 has 0.5 in channel Oracle"},
                 {"Oracle", 8.0f, "pixel 5,1 has 8 in channel Oracle"},
                 {"Shear", INFINITY, "pixel 5,1 has inf in channel Shear"},
                 {"G", NAN, "in channel G"},
                 {"SampleVariance.B", NAN, "in channel SampleVariance.B"},
                 {"Pattern1.R", NAN, "in channel Pattern1.R"}};
    clshear_settings *settings = settings_of(made, "sz", 32);
    clshear_film *base = test_render(made->scene, settings), *film = NULL;
    test_set(settings, CLSHEAR_SPP, "64");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        float *plane = (float *)(uintptr_t)clshear_film_channel(base, cases[i].channel);
        const float kept = plane[24 + 5];
        plane[24 + 5] = cases[i].value;
        test_refused(clshear_render_extend(made->scene, settings, base, &film),
                     CLSHEAR_BAD_ARGUMENT, cases[i].words);
        plane[24 + 5] = kept;
    }
    test_ok(clshear_render_extend(made->scene, settings, base, &film));
    clshear_film_free(film);
    clshear_film_free(base);
    clshear_settings_free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(extended_equals_whole),
        cmocka_unit_test(an_interrupted_extension_is_whole),
        cmocka_unit_test(an_extension_that_never_began_is_whole),
        cmocka_unit_test(the_choice_of_the_pilot_stays),
        cmocka_unit_test(mismatched_bases_are_refused),
        cmocka_unit_test(another_environment_is_refused),
        cmocka_unit_test(damaged_bases_are_refused),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
