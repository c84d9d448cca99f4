/* Renders that go on: the same picture as one that was rendered at once. */
#include "support.h"

#include <math.h>

static clshear_options options_of(const char *sampler, uint32_t spp)
{
    clshear_options options = clshear_options_defaults();
    options.width = 24;
    options.height = 24;
    options.spp = spp;
    options.sampler = sampler;
    options.extendable = 1;
    options.oracle = CLSHEAR_ORACLE_CENTRE; /* a pilot chooses by the samples it may spend */
    return options;
}

static clshear_film *render(test_fixture *made, const clshear_options *options)
{
    clshear_film *film = NULL;
    test_ok(made->context, clshear_render(made->scene, &made->camera, options, &film));
    return film;
}

/* Same up to the order in which float sums are rounded: 1e-4 of the plane's largest value, since
 * variances are differences of means. */
static void expect_same(const clshear_film *a, const clshear_film *b)
{
    const char *name;
    const clshear_film_info info = clshear_film_describe(a);
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

/* From 100 to 300 samples through a file, then to 1024 in memory, for every progressive sampler;
 * counts that are no powers of two, and blocks that are cut in the middle. */
static void extended_equals_whole(void **state)
{
    test_fixture *made = *state;
    clshear_sampler_info info;
    int seen = 0;
    for (size_t s = 0; clshear_sampler_describe(s, &info); s++) {
        if (!info.progressive) continue;
        clshear_options options = options_of(info.name, 100);
        clshear_film *first = render(made, &options), *read = NULL;
        const char *path = test_path("extend.exr");
        test_ok(made->context, clshear_film_write(first, path));
        test_ok(made->context, clshear_film_read(made->context, path, &read));
        options.spp = 300;
        options.extend = read;
        clshear_film *second = render(made, &options);
        options.spp = 1024;
        options.extend = second;
        clshear_film *third = render(made, &options);
        options.extend = NULL;
        clshear_film *whole = render(made, &options);
        assert_true(clshear_film_describe(whole).samples == 24 * 24 * 1024);
        expect_same(whole, third);
        clshear_film_free(first);
        clshear_film_free(read);
        clshear_film_free(second);
        clshear_film_free(third);
        clshear_film_free(whole);
        seen++;
    }
    assert_true(seen >= 5);
}

/* What the pilot chose for the first part stays. */
static void the_choice_of_the_pilot_stays(void **state)
{
    test_fixture *made = *state;
    clshear_options options = options_of("sz", 128);
    options.oracle = CLSHEAR_ORACLE_PILOT;
    clshear_film *first = render(made, &options);
    options.spp = 512;
    options.extend = first;
    clshear_film *second = render(made, &options);
    assert_memory_equal(clshear_film_channel(first, "Shear"), clshear_film_channel(second, "Shear"),
                        24 * 24 * sizeof(float));
    assert_memory_equal(clshear_film_channel(first, "Oracle"),
                        clshear_film_channel(second, "Oracle"), 24 * 24 * sizeof(float));
    assert_true(clshear_film_describe(second).pilot_samples == 0);
    clshear_film_free(first);
    clshear_film_free(second);
}

/* Stops after a few launches. */
static int stop(void *user, const clshear_progress *progress)
{
    (void)progress;
    return ++*(int *)user >= 3;
}

/* An extension that is interrupted has lost nothing of the picture it began with: its counts are
 * true, and its mean is that picture's within what the new samples add. Those are blocks of
 * CS_BLOCK = 16 neighbours, of at most the deviation of n / 16 independent samples. Absolute
 * differences of normal variables have 0.8 of their deviation for a mean, over 576 pixels with a
 * deviation of 0.025: the limit is eight of these away. */
static void an_interrupted_extension_is_whole(void **state)
{
    test_fixture *made = *state;
    clshear_options options = options_of("sz", 4096);
    clshear_film *first = render(made, &options), *second = NULL;
    int calls = 0;
    options.extend = first;
    options.progress = stop;
    options.progress_user = &calls;
    options.spp = 2000000;
    assert_int_equal(clshear_render(made->scene, &made->camera, &options, &second),
                     CLSHEAR_CANCELLED);
    const float *a = clshear_film_channel(first, "G"), *b = clshear_film_channel(second, "G");
    const float *counts = clshear_film_channel(second, "Samples");
    const float *variance = clshear_film_channel(second, "SampleVariance.G");
    double limit = 0.0, off = 0.0;
    for (int i = 0; i < 24 * 24; i++) {
        const double added = (double)counts[i] - 4096.0;
        assert_true(added >= 0.0);
        limit += sqrt(16.0 * (double)variance[i] * added) / (double)counts[i];
        off += fabs((double)a[i] - (double)b[i]);
    }
    assert_true(off <= limit);
    clshear_film_free(first);
    clshear_film_free(second);
}

static int stop_at_once(void *user, const clshear_progress *progress)
{
    (void)user, (void)progress;
    return 1;
}

/* Stopped in the pilot that measures the gain, before a pass has begun: the picture is the old one,
 * but for the rounding of means to float, and says so; the gain is not known. */
static void an_extension_that_never_began_is_whole(void **state)
{
    test_fixture *made = *state;
    clshear_options options = options_of("sz", 256);
    clshear_film *first = render(made, &options), *second = NULL;
    options.extend = first;
    options.gain = 1;
    options.progress = stop_at_once;
    options.spp = 1024;
    assert_int_equal(clshear_render(made->scene, &made->camera, &options, &second),
                     CLSHEAR_CANCELLED);
    const float *a = clshear_film_channel(first, "G"), *b = clshear_film_channel(second, "G");
    for (int i = 0; i < 24 * 24; i++) {
        assert_true(clshear_film_channel(second, "Samples")[i] == 256.0f);
        assert_true(fabsf(a[i] - b[i]) <= 4e-7f * fabsf(a[i]));
    }
    assert_null(clshear_film_channel(second, "Gain"));
    clshear_film_free(first);
    clshear_film_free(second);
}

static void refuse(test_fixture *made, const clshear_options *options, const char *words)
{
    clshear_film *film = NULL;
    assert_int_equal(clshear_render(made->scene, &made->camera, options, &film),
                     CLSHEAR_BAD_ARGUMENT);
    assert_null(film);
    if (strstr(clshear_message(made->context), words) == NULL)
        fail_msg("no \"%s\" in: %s", words, clshear_message(made->context));
}

static void what_does_not_continue_is_refused(void **state)
{
    test_fixture *made = *state;
    clshear_options options = options_of("sobol", 64);
    clshear_film *base = render(made, &options);
    options.sampler = "mj";
    clshear_film *none = NULL;
    assert_int_equal(clshear_render(made->scene, &made->camera, &options, &none),
                     CLSHEAR_BAD_ARGUMENT);
    options.sampler = "sobol";
    options.extendable = 0;
    clshear_film *plain = render(made, &options);
    options.spp = 128;
    options.extend = plain;
    refuse(made, &options, "--extendable");
    options.extend = base;
    options.sampler = "mj";
    refuse(made, &options, "mj cannot extend");
    options.sampler = "halton";
    refuse(made, &options, "another sampler");
    options = options_of("sobol", 128);
    options.extend = base;
    options.seed = 1;
    refuse(made, &options, "another seed");
    options.seed = 0;
    options.shear = CLSHEAR_SHEAR_NONE;
    refuse(made, &options, "another shear");
    options.shear = CLSHEAR_SHEAR_EQUAL_AREA;
    options.spp = 64;
    refuse(made, &options, "64 samples per pixel already");
    options.spp = 128;
    options.crop[1] = options.crop[3] = 8;
    refuse(made, &options, "--crop");
    options.crop[1] = options.crop[3] = 0;
    made->camera.focal_distance += 1.0f;
    refuse(made, &options, "another camera");
    made->camera.focal_distance -= 1.0f;
    clshear_film_free(base);
    clshear_film_free(plain);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(extended_equals_whole),
        cmocka_unit_test(an_interrupted_extension_is_whole),
        cmocka_unit_test(an_extension_that_never_began_is_whole),
        cmocka_unit_test(the_choice_of_the_pilot_stays),
        cmocka_unit_test(what_does_not_continue_is_refused),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
