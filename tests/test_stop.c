/* Renders that rules end: what they promise, and that they are renders like others. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

#include "base/status.h"
#include "film/noise.h"

static clshear_settings *settings_of(test_fixture *made, int size, const char *sampler)
{
    clshear_settings *settings = test_settings(made->settings, size, size, 1);
    clshear_settings_unset(settings, CLSHEAR_SPP);
    test_set(settings, CLSHEAR_SAMPLER, "%s", sampler);
    test_set(settings, CLSHEAR_ORACLE, "centre"); /* a pilot's choice depends on its budget */
    test_set(settings, CLSHEAR_ADAPTIVE, "0");    /* as renders with rules are */
    return settings;
}

/* Compares planes up to the rounding of sums in another order: `part` of the largest value. */
static void expect_same(const clshear_film *a, const clshear_film *b, const char *name, double part)
{
    const clshear_film_info info = test_film_info(a);
    const float *pa = clshear_film_channel(a, name), *pb = clshear_film_channel(b, name);
    double most = 0.0, off = 0.0;
    assert_non_null(pa);
    assert_non_null(pb);
    for (int i = 0; i < info.width * info.height; i++) {
        most = fmax(most, fabs((double)pa[i]));
        off = fmax(off, fabs((double)pa[i] - (double)pb[i]));
    }
    if (off > part * most) fail_msg("%s differs by %g of %g", name, off, most);
}

/* A render that ends with so many samples equals one that was asked for them. */
static void a_stopped_render_is_one_of_as_many_samples(void **state)
{
    test_fixture *made = *state;
    clshear_sampler_info info = {.struct_size = sizeof info};
    int seen = 0;
    for (size_t s = 0; clshear_sampler_describe(s, &info); s++) {
        if (!info.progressive) continue;
        clshear_settings *settings = settings_of(made, 24, info.name);
        test_set(settings, CLSHEAR_NOISE, "0.015");
        test_set(settings, CLSHEAR_AOV, "normal,position");
        clshear_film *stopped = test_render(made->scene, settings);
        const clshear_film_info ended = test_film_info(stopped);
        assert_true(ended.complete);
        assert_string_equal(ended.stopped_by, "noise");
        assert_at_most(ended.noise, 0.015);
        const uint64_t spp = ended.samples / (24 * 24);
        assert_at_least(spp, 64); /* at least two rounds */
        clshear_settings_unset(settings, CLSHEAR_NOISE);
        test_set(settings, CLSHEAR_SPP, "%u", (unsigned)spp);
        clshear_film *plain = test_render(made->scene, settings);
        assert_int_equal(test_film_info(plain).samples, ended.samples);
        assert_int_equal(test_film_info(plain).shadow_rays, ended.shadow_rays);
        for (size_t c = 0; clshear_film_channel_name(plain, c) != NULL; c++)
            expect_same(plain, stopped, clshear_film_channel_name(plain, c), 1e-4);
        expect_same(plain, stopped, "G", 2e-7);
        clshear_film_free(stopped);
        clshear_film_free(plain);
        clshear_settings_free(settings);
        seen++;
    }
    assert_at_least(seen, 5);
}

/* Samplers that cannot grow end after a replicate, and equal a render of as many. */
static void other_samplers_stop_between_replicates(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 24, "mj");
    clshear_film *none = NULL;
    test_set(settings, CLSHEAR_NOISE, "0.02");
    test_refused(clshear_render(made->scene, settings, &none), CLSHEAR_BAD_ARGUMENT,
                 "sampler mj can stop between replicates only");
    test_set(settings, CLSHEAR_REPLICATES, "64");
    test_set(settings, CLSHEAR_SPP, "1024");
    clshear_film *stopped = test_render(made->scene, settings);
    const clshear_film_info ended = test_film_info(stopped);
    const unsigned patterns = (unsigned)(ended.samples / (24 * 24) / 16);
    assert_string_equal(ended.stopped_by, "noise");
    assert_at_least(patterns, 2);
    assert_below(patterns, 64);
    clshear_settings_unset(settings, CLSHEAR_NOISE);
    test_set(settings, CLSHEAR_REPLICATES, "%u", patterns);
    test_set(settings, CLSHEAR_SPP, "%u", patterns * 16);
    clshear_film *plain = test_render(made->scene, settings);
    for (size_t c = 0; clshear_film_channel_name(plain, c) != NULL; c++)
        expect_same(plain, stopped, clshear_film_channel_name(plain, c), 0.0);
    clshear_film_free(stopped);
    clshear_film_free(plain);
    clshear_settings_free(settings);
}

/* What a film differs from another by: the root of the mean square over the mean. */
static double relative_error(const clshear_film *film, const clshear_film *truth)
{
    static const char *const names[3] = {"R", "G", "B"};
    const clshear_film_info info = test_film_info(film);
    double square = 0.0, mean = 0.0;
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < info.width * info.height; i++) {
            const double t = (double)clshear_film_channel(truth, names[c])[i];
            const double d = (double)clshear_film_channel(film, names[c])[i] - t;
            square += d * d;
            mean += t;
        }
    const double count = 3.0 * info.width * info.height;
    return sqrt(square / count) / (mean / count);
}

enum {
    SEEDS = 24
};

/* The promised error is kept, and stopping biases neither the error nor the picture.
 *
 * Over 24 seeds of 24 x 24 pixels there are 13824 pixels with one degree of freedom each for three
 * colours that go together, the noisiest tenth of them with most of the variance: the mean square
 * of the true error has a relative deviation of about sqrt(2 / 1382) = 4 %, and the root 2 %. The
 * promise may be missed by 8 %, four deviations. Grains of 16 samples in a pattern of about 60
 * leave the error up to a third below the promise. The picture's mean has the deviation of the
 * error over sqrt(13824): its difference from the reference, which has 64 times the samples, is
 * below a tenth of the error, or twelve deviations. */
static void the_promised_error_is_kept(void **state)
{
    test_fixture *made = *state;
    static const double promises[] = {0.03, 0.01};
    clshear_settings *settings = settings_of(made, 24, "sz");
    test_set(settings, CLSHEAR_SPP, "16384");
    test_set(settings, CLSHEAR_SEED, "99");
    clshear_film *truth = test_render(made->scene, settings);
    clshear_settings_unset(settings, CLSHEAR_SPP);
    for (size_t p = 0; p < sizeof promises / sizeof *promises; p++) {
        double square = 0.0, mean = 0.0, told = 0.0, true_mean = 0.0, spp = 0.0;
        test_set_number(settings, CLSHEAR_NOISE, promises[p]);
        for (int seed = 0; seed < SEEDS; seed++) {
            test_set_number(settings, CLSHEAR_SEED, seed);
            clshear_film *film = test_render(made->scene, settings);
            const clshear_film_info info = test_film_info(film);
            square += pow(relative_error(film, truth), 2.0) / SEEDS;
            told += info.noise * info.noise / SEEDS;
            spp += (double)info.samples / (24 * 24 * SEEDS);
            for (int i = 0; i < 24 * 24; i++) {
                mean += (double)clshear_film_channel(film, "G")[i] / SEEDS;
                true_mean += (double)clshear_film_channel(truth, "G")[i] / SEEDS;
            }
            clshear_film_free(film);
        }
        const double error = sqrt(square), bias = mean / true_mean - 1.0;
        printf("promised %.4f, true %.4f, told %.4f, bias %.5f, %.0f samples per pixel\n",
               promises[p], error, sqrt(told), bias, spp);
        assert_at_most(error, 1.08 * promises[p]);
        assert_at_least(error, 0.6 * promises[p]);
        assert_at_most(fabs(bias), 0.1 * error);
    }
    clshear_film_free(truth);
    clshear_settings_free(settings);
}

/* Time ends a render within its time, at a whole round: the variance is there. The time is the
 * processor's, of this program: it does not pass while others take turns. */
static void time_ends_a_render(void **state)
{
    test_fixture *made = *state;
    cs_clock = CLOCK_PROCESS_CPUTIME_ID;
    clshear_settings *settings = settings_of(made, 64, "sz");
    test_set(settings, CLSHEAR_TIME, "1.5");
    test_set(settings, CLSHEAR_SPP, "1000000");
    clshear_film *film = test_render(made->scene, settings);
    const clshear_film_info info = test_film_info(film);
    assert_true(info.complete);
    assert_string_equal(info.stopped_by, "time");
    cs_clock = CLOCK_MONOTONIC;
    assert_at_most(info.render_s, 3.0); /* twice */
    assert_at_least(info.samples, 64 * 64 * 64);
    assert_non_null(clshear_film_channel(film, "Variance.G"));
    clshear_film_free(film);
    clshear_settings_free(settings);
}

/* Pixels: the rule judges what a screen shows, so an exposure that clips all ends at once. */
static void pixels_are_judged_as_shown(void **state)
{
    test_fixture *made = *state;
    uint64_t samples[3];
    static const char *const exposures[3] = {"-6", "0", "12"};
    clshear_settings *settings = settings_of(made, 24, "sz");
    test_set(settings, CLSHEAR_NOISE_PIXEL, "0.01");
    for (int i = 0; i < 3; i++) {
        test_set(settings, CLSHEAR_EXPOSURE, "%s", exposures[i]);
        clshear_film *film = test_render(made->scene, settings);
        const clshear_film_info info = test_film_info(film);
        assert_string_equal(info.stopped_by, "noise-pixel");
        assert_at_most(info.noise_pixel, 0.01);
        samples[i] = info.samples;
        clshear_film_free(film);
    }
    assert_below(samples[0], samples[1]);
    assert_below(samples[2], samples[1]);
    clshear_settings_free(settings);
}

/* An adaptive render grows in proportion; the extended one goes on from where it stopped. */
static void adaptive_and_extended_renders_stop(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 24, "sz");
    clshear_film *second = NULL;
    test_set(settings, CLSHEAR_NOISE, "0.02");
    test_set(settings, CLSHEAR_ADAPTIVE, "1");
    clshear_film *film = test_render(made->scene, settings);
    const float *samples = clshear_film_channel(film, "Samples");
    float least = samples[0], most = samples[0];
    for (int i = 0; i < 24 * 24; i++) {
        least = fminf(least, samples[i]);
        most = fmaxf(most, samples[i]);
    }
    assert_string_equal(test_film_info(film).stopped_by, "noise");
    assert_at_least(least, 2.0);
    assert_above(most, 2.0 * (double)least);
    clshear_film_free(film);

    test_set(settings, CLSHEAR_ADAPTIVE, "0");
    test_set(settings, CLSHEAR_EXTENDABLE, "1");
    film = test_render(made->scene, settings);
    test_set(settings, CLSHEAR_NOISE, "0.01");
    test_ok(clshear_render_extend(made->scene, settings, film, &second));
    const clshear_film_info info = test_film_info(second);
    assert_string_equal(info.stopped_by, "noise");
    assert_above(info.samples, test_film_info(film).samples);
    clshear_settings_unset(settings, CLSHEAR_NOISE);
    test_set(settings, CLSHEAR_SPP, "%u", (unsigned)(info.samples / (24 * 24)));
    clshear_film *plain = test_render(made->scene, settings);
    for (size_t c = 0; clshear_film_channel_name(plain, c) != NULL; c++)
        expect_same(plain, second, clshear_film_channel_name(plain, c), 1e-4);
    clshear_film_free(film);
    clshear_film_free(second);
    clshear_film_free(plain);
    clshear_settings_free(settings);
}

static int stop_late(void *user, const clshear_progress *progress)
{
    (void)progress;
    return ++*(int *)user >= 6;
}

/* Stopped in the middle of a round, the film has the samples of all patterns, finished or not. The
 * mean over pixels is within a quarter of the picture's relative error of 3 %, six times its own
 * deviation of 3 % / 24. */
static void an_interrupted_round_is_whole(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 24, "sz");
    clshear_film *plain;
    int calls = 0;
    double mean = 0.0, expected = 0.0;
    test_set(settings, CLSHEAR_NOISE, "0.001");
    clshear_settings_set_progress(settings, stop_late, &calls);
    clshear_film *film = test_render(made->scene, settings);
    assert_int_equal(test_film_info(film).complete, 0);
    clshear_settings_set_progress(settings, NULL, NULL);
    clshear_settings_unset(settings, CLSHEAR_NOISE);
    test_set(settings, CLSHEAR_SPP, "1024");
    plain = test_render(made->scene, settings);
    for (int i = 0; i < 24 * 24; i++) {
        assert_at_least(clshear_film_channel(film, "Samples")[i], 32);
        mean += (double)clshear_film_channel(film, "G")[i];
        expected += (double)clshear_film_channel(plain, "G")[i];
    }
    assert_near(mean / expected, 1.0, 0.0075);
    clshear_film_free(film);
    clshear_film_free(plain);
    clshear_settings_free(settings);
}

/* A variance that floats cannot hold keeps no promise: of the picture, or of the pixels that it is
 * averaged over, 25 of these 36. Where nothing varies, both are kept. */
static void what_is_no_number_is_no_small_noise(void **state)
{
    float mean[36], variance[36] = {0.0f};
    const cs_estimate estimate = {{mean, mean, mean}, {variance, variance, variance}, 6, 6};
    static const float wrong[] = {NAN, INFINITY};
    const cs_tone tone = {.exposure = 0.0f};
    double noise = 7.0;
    (void)state;
    for (int i = 0; i < 36; i++)
        mean[i] = 0.5f;
    assert_true(cs_noise_of_picture(&estimate) == 0.0);
    test_ok(cs_noise_of_pixels(&estimate, &tone, &noise, cs_thread_error()));
    assert_true(noise == 0.0);
    for (int i = 0; i < 2; i++) {
        variance[14] = wrong[i];
        assert_true(cs_noise_of_picture(&estimate) == INFINITY);
        test_ok(cs_noise_of_pixels(&estimate, &tone, &noise, cs_thread_error()));
        assert_true(noise == INFINITY);
    }
}

/* Radiance whose square floats cannot hold is refused. */
static void light_fits_floats(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 4, "sz");
    clshear_film *film = NULL;
    test_set(settings, CLSHEAR_ENVIRONMENT, "1e10,1e10,1e10");
    test_set(settings, CLSHEAR_ENVIRONMENT_STRENGTH, "1e6");
    test_refused(clshear_render(made->scene, settings, &film), CLSHEAR_BAD_ARGUMENT,
                 "environment-strength 1e+06: ");
    clshear_settings_free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_stopped_render_is_one_of_as_many_samples),
        cmocka_unit_test(other_samplers_stop_between_replicates),
        cmocka_unit_test(the_promised_error_is_kept),
        cmocka_unit_test(time_ends_a_render),
        cmocka_unit_test(pixels_are_judged_as_shown),
        cmocka_unit_test(adaptive_and_extended_renders_stop),
        cmocka_unit_test(an_interrupted_round_is_whole),
        cmocka_unit_test(what_is_no_number_is_no_small_noise),
        cmocka_unit_test(light_fits_floats),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
