/* Guarantees of a render, on the Cornell box. */
#include "support.h"

#include <math.h>

#include "context/context.h"
#include "kernels/pixel.h"

enum {
    SIZE = 48,
    PIXELS = SIZE * SIZE
};

/* Opens the Cornell box on a context of its own. */
static void open_scene(test_fixture *made, int threads, int packet)
{
    clshear_settings *settings = test_cornell_settings();
    if (threads > 0) test_set(settings, CLSHEAR_THREADS, "%d", threads);
    if (packet > 0) test_set(settings, CLSHEAR_PACKET, "%d", packet);
    test_ok(clshear_context_create(settings, &made->context));
    made->scene = test_cornell(made->context);
    made->settings = settings;
}

static void close_scene(test_fixture *made)
{
    clshear_settings_free(made->settings);
    clshear_scene_free(made->scene);
    clshear_context_free(made->context);
}

static clshear_settings *small(test_fixture *made, uint32_t spp, uint32_t replicates)
{
    clshear_settings *settings = test_settings(made->settings, SIZE, SIZE, spp);
    if (replicates > 0) test_set(settings, CLSHEAR_REPLICATES, "%u", replicates);
    return settings;
}

/* Renders and frees the settings. */
static clshear_film *render_once(test_fixture *made, clshear_settings *settings)
{
    clshear_film *film = test_render(made->scene, settings);
    clshear_settings_free(settings);
    return film;
}

static int same_bits(const clshear_film *a, const clshear_film *b)
{
    for (size_t i = 0; clshear_film_channel_name(a, i) != NULL; i++) {
        const char *name = clshear_film_channel_name(a, i);
        const float *other = clshear_film_channel(b, name);
        if (other == NULL) return 0;
        if (memcmp(clshear_film_channel(a, name), other, PIXELS * sizeof(float)) != 0) return 0;
    }
    return 1;
}

static void one_seed_gives_one_image(void **state)
{
    test_fixture *made = *state, alone;
    clshear_settings *settings = small(made, 200, 2);
    clshear_film *first = test_render(made->scene, settings);
    clshear_film *second = test_render(made->scene, settings);
    open_scene(&alone, 1, 0);
    clshear_film *third = test_render(alone.scene, settings);
    assert_true(same_bits(first, second));
    assert_true(same_bits(first, third));
    test_set(settings, CLSHEAR_SEED, "1");
    clshear_film *other = render_once(made, settings);
    assert_false(same_bits(first, other));
    clshear_film_free(first);
    clshear_film_free(second);
    clshear_film_free(third);
    clshear_film_free(other);
    close_scene(&alone);
}

/* Large images store their pixels in several buffers: here six buffers of 8 rows each. */
static void pages_do_not_change_a_bit(void **state)
{
    test_fixture *made = *state;
    const size_t before = made->context->page_bytes;
    clshear_film *films[2][3], *parts[2];
    for (int paged = 0; paged < 2; paged++) {
        made->context->page_bytes = paged ? 8 * SIZE * sizeof(cs_pixel) : before;
        clshear_settings *settings = small(made, 128, 2);
        films[paged][0] = test_render(made->scene, settings);
        test_set(settings, CLSHEAR_ADAPTIVE, "1");
        films[paged][1] = render_once(made, settings);
        settings = small(made, 64, 2);
        test_set(settings, CLSHEAR_SAMPLER, "sz");
        test_set(settings, CLSHEAR_EXTENDABLE, "1");
        parts[paged] = test_render(made->scene, settings);
        test_set(settings, CLSHEAR_SPP, "128");
        test_ok(clshear_render_extend(made->scene, settings, parts[paged], &films[paged][2]));
        clshear_settings_free(settings);
    }
    made->context->page_bytes = before;
    for (int i = 0; i < 3; i++) {
        assert_true(same_bits(films[0][i], films[1][i]));
        clshear_film_free(films[0][i]);
        clshear_film_free(films[1][i]);
    }
    clshear_film_free(parts[0]);
    clshear_film_free(parts[1]);
}

/* Packet widths differ only by rounding: a sample may fall on the other side of an edge, and the
 * others agree to a part in 10^4. */
static void packet_widths_agree(void **state)
{
    (void)state;
    const int widths[] = {1, 4, 8, 16};
    float reference[PIXELS];
    for (int w = 0; w < 4; w++) {
        test_fixture made;
        open_scene(&made, 0, widths[w]);
        /* 11 blocks, the last one partial */
        clshear_film *film = render_once(&made, small(&made, 2 * 85, 2));
        const float *red = clshear_film_channel(film, "R");
        int different = 0;
        if (w == 0) memcpy(reference, red, sizeof reference);
        for (int p = 0; p < PIXELS; p++) {
            assert_near(red[p], reference[p], 0.02f * reference[p] + 1e-3f);
            different += fabsf(red[p] - reference[p]) > 1e-4f * reference[p];
        }
        assert_below(different, PIXELS / 50);
        clshear_film_free(film);
        close_scene(&made);
    }
}

static void a_crop_is_part_of_the_whole(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = small(made, 64, 2);
    test_set(settings, CLSHEAR_ADAPTIVE, "0"); /* other pixels share a crop's samples */
    clshear_film *whole = test_render(made->scene, settings);
    test_set(settings, CLSHEAR_CROP, "5,30,11,22");
    clshear_film *part = render_once(made, settings);
    assert_int_equal(test_film_info(part).width, 25);
    assert_int_equal(test_film_info(part).height, 11);
    for (size_t i = 0; clshear_film_channel_name(whole, i) != NULL; i++) {
        const char *name = clshear_film_channel_name(whole, i);
        for (int y = 0; y < 11; y++)
            assert_memory_equal(clshear_film_channel(part, name) + 25 * y,
                                clshear_film_channel(whole, name) + SIZE * (y + 11) + 5,
                                25 * sizeof(float));
    }
    clshear_film_free(whole);
    clshear_film_free(part);
}

/* Mean and variance of every pixel, from 32 replicates of about 64 samples. */
typedef struct estimates {
    float mean[PIXELS], variance[PIXELS];
} estimates;

static void measure_estimates(test_fixture *made, const char *sampler, clshear_shear shear,
                              uint32_t seed, estimates *result)
{
    clshear_settings *settings = small(made, 32 * 64, 32);
    test_set(settings, CLSHEAR_SEED, "%u", seed);
    test_set(settings, CLSHEAR_SAMPLER, "%s", sampler);
    test_set_number(settings, CLSHEAR_SHEAR, shear);
    clshear_film *film = render_once(made, settings);
    memcpy(result->mean, clshear_film_channel(film, "R"), sizeof result->mean);
    memcpy(result->variance, clshear_film_channel(film, "Variance.R"), sizeof result->variance);
    clshear_film_free(film);
}

/* Expects image means to differ by less than 5 standard errors (false alarms 6e-7), and chi-square
 * of the pixels' z-scores to be below 1.25 per pixel. Their t distribution with about 60 degrees of
 * freedom has variance 1.03; with 2304 pixels chance alone gives 1.03 +- 0.03. Nearly constant
 * pixels are left out, because their variance is rounding. */
static void expect_agreement(const estimates *a, const estimates *b, const char *what)
{
    double difference = 0.0, error = 0.0, chi = 0.0, used = 0.0;
    for (int p = 0; p < PIXELS; p++) {
        double d = (double)a->mean[p] - (double)b->mean[p];
        double v = (double)a->variance[p] + (double)b->variance[p];
        difference += d;
        error += v;
        if (v < 1e-12 * a->mean[p] * a->mean[p] || v == 0.0) continue;
        chi += d * d / v;
        used += 1.0;
    }
    if (fabs(difference) >= 5.0 * sqrt(error) || used <= PIXELS / 2 || chi / used >= 1.25)
        fail_msg("%s: %g standard errors, chi-square %g a pixel", what, difference / sqrt(error),
                 chi / used);
}

static void shears_agree(void **state)
{
    static estimates of[3];
    for (int shear = 0; shear < 3; shear++)
        measure_estimates(*state, "mj", (clshear_shear)shear, 40u + (uint32_t)shear, &of[shear]);
    expect_agreement(&of[0], &of[1], "none and toroidal");
    expect_agreement(&of[0], &of[2], "none and equal-area");
    expect_agreement(&of[1], &of[2], "toroidal and equal-area");
}

static void samplers_agree(void **state)
{
    static estimates reference, of;
    clshear_sampler_info info = {.struct_size = sizeof info};
    measure_estimates(*state, "random", CLSHEAR_SHEAR_NONE, 99, &reference);
    for (uint32_t i = 0; clshear_sampler_describe(i, &info); i++) {
        measure_estimates(*state, info.name, CLSHEAR_SHEAR_EQUAL_AREA, 50u + i, &of);
        expect_agreement(&reference, &of, info.name);
    }
}

/* The Variance channel is the variance of the pixel's mean. Over 64 seeds of 2 replicates of 32
 * samples, its image mean agrees with the variance across seeds within 15 %. The relative standard
 * error of either, from batches of seeds, is 2 to 3 %, so the tolerance is at least 4 of these. */
static void variance_channel_is_correct(void **state)
{
    test_fixture *made = *state;
    enum {
        SEEDS = 64
    };
    for (int shear = 0; shear < 3; shear++) {
        double *sum = calloc(PIXELS, sizeof *sum), *squares = calloc(PIXELS, sizeof *squares);
        double claimed = 0.0, across = 0.0;
        for (uint32_t seed = 0; seed < SEEDS; seed++) {
            clshear_settings *settings = small(made, 64, 2);
            test_set(settings, CLSHEAR_SEED, "%u", seed);
            test_set_number(settings, CLSHEAR_SHEAR, shear);
            clshear_film *film = render_once(made, settings);
            const float *red = clshear_film_channel(film, "R");
            const float *variance = clshear_film_channel(film, "Variance.R");
            for (int p = 0; p < PIXELS; p++) {
                sum[p] += (double)red[p];
                squares[p] += (double)red[p] * (double)red[p];
                claimed += (double)variance[p] / SEEDS;
            }
            clshear_film_free(film);
        }
        for (int p = 0; p < PIXELS; p++)
            across += (squares[p] - sum[p] * sum[p] / SEEDS) / (SEEDS - 1);
        assert_near(claimed / across, 1.0, 0.15);
        free(sum);
        free(squares);
    }
}

static int stop_at_a_third(void *user, const clshear_progress *progress)
{
    *(double *)user = progress->fraction;
    return progress->fraction > 0.3;
}

/* An interrupted render keeps its samples, reports their number, and is unbiased. Each pixel is
 * compared with a finished render, whose sample variance is better known. The interrupted one drew
 * whole blocks of CS_BLOCK = 16 neighbouring strata, so its variance is at most 16 times that of as
 * many independent samples; 6 such standard errors, false alarms 2e-9 per pixel. A launch ends with
 * each replicate at the latest, so the third launch stops in the second of four replicates, however
 * fast the machine is. */
static void interrupted_renders_are_usable(void **state)
{
    test_fixture *made = *state;
    double fraction = 0.0, samples = 0.0, bias = 0.0, error = 0.0;
    clshear_settings *settings = small(made, 16384, 4);
    clshear_film *whole = test_render(made->scene, settings);
    clshear_settings_set_progress(settings, stop_at_a_third, &fraction);
    test_set(settings, CLSHEAR_SEED, "5");
    clshear_film *part = render_once(made, settings);
    assert_int_equal(test_film_info(whole).complete, 1);
    assert_int_equal(test_film_info(part).complete, 0);
    assert_above(fraction, 0.3);
    assert_at_most(fraction, 0.5);
    const float *counts = clshear_film_channel(part, "Samples");
    for (int p = 0; p < PIXELS; p++) {
        samples += (double)counts[p];
        double v = 16.0 * (double)clshear_film_channel(whole, "SampleVariance.R")[p] / counts[p];
        double d = (double)clshear_film_channel(part, "R")[p] -
                   (double)clshear_film_channel(whole, "R")[p];
        assert_below(fabs(d), 6.0 * sqrt(v) + 1e-4);
        bias += d;
        error += v;
    }
    assert_below(fabs(bias), 5.0 * sqrt(error));
    assert_near(samples / (16384.0 * PIXELS), fraction, 1e-9);
    assert_near(samples, (double)test_film_info(part).samples, 0);
    clshear_film_free(whole);
    clshear_film_free(part);
}

static void counts_and_channels(void **state)
{
    test_fixture *made = *state;
    /* rounded up to two patterns of 4 */
    clshear_film *film = render_once(made, small(made, 7, 2));
    for (int p = 0; p < PIXELS; p++) {
        assert_near(clshear_film_channel(film, "Samples")[p], 8.0f, 0);
        const float rule = clshear_film_channel(film, "Oracle")[p]; /* 0 centre, 7 front */
        const float *nearest = clshear_film_channel(film, rule == 0.0f ? "Z" : "Z.near");
        const float *farthest = clshear_film_channel(film, rule == 0.0f ? "Z" : "Z.far");
        const float shear = clshear_film_channel(film, "Shear")[p];
        assert_true(rule == 0.0f || rule == 7.0f);
        if (isinf(nearest[p])) assert_near(shear, 0.0f, 0);
        if (farthest[p] < 930.0f) assert_true(shear > 0.0f);
        if (nearest[p] > 930.0f) assert_true(shear <= 0.0f);
        assert_true(isfinite(clshear_film_channel(film, "B")[p]));
    }
    assert_null(clshear_film_channel(film, "nonsense"));
    assert_int_equal(test_film_info(film).samples, 8 * PIXELS);
    clshear_film_free(film);
    film = render_once(made, small(made, 1, 0));
    assert_null(clshear_film_channel(film, "Variance.R"));
    clshear_film_free(film);
}

/* Invalid values are refused when they are set, and invalid combinations by the render. */
static void bad_settings_are_refused(void **state)
{
    static const struct {
        clshear_setting setting;
        const char *text, *words;
    } alone[] =
        {
            {CLSHEAR_SPP, "0", "spp 0: must be a whole number, 1 to 2000000000"},
            {CLSHEAR_WIDTH, "0", "width 0: must be a whole number, 1 to 65536"},
            {CLSHEAR_CROP, "5,5,0,1", "with X0 < X1 and Y0 < Y1"},
            {CLSHEAR_SHEAR, "sideways", "none, toroidal or equal-area"},
            {CLSHEAR_LENS_RADIUS, "-1", "lens-radius -1: must be a number, 0 to"},
            {CLSHEAR_FOV, "180", "fov 180: must be a number"},
        },
      together[] = {
          {CLSHEAR_REPLICATES, "17", "17 replicates of 16 samples per pixel: must be 1 to 16"},
          {CLSHEAR_CROP, "0,49,0,1", "crop 0,49,0,1: needs 0 <= x0 < x1 <= 48"},
          {CLSHEAR_SPP, "3000000", "1500000 samples in one pattern of sz: at most 1048576"},
          {CLSHEAR_TARGET, "276.4,274.4,800", "target"},
      };
    test_fixture *made = *state;
    clshear_film *film = NULL;
    clshear_settings *settings = small(made, 16, 2);
    for (size_t i = 0; i < sizeof alone / sizeof *alone; i++)
        test_refused(clshear_settings_set_text(settings, alone[i].setting, alone[i].text),
                     CLSHEAR_BAD_ARGUMENT, alone[i].words);
    test_refused(clshear_settings_set_integer(settings, CLSHEAR_SHEAR, 7), CLSHEAR_BAD_ARGUMENT,
                 "shear 7");
    for (size_t i = 0; i < sizeof together / sizeof *together; i++) {
        clshear_settings *wrong = test_settings(settings, SIZE, SIZE, 16);
        test_set(wrong, together[i].setting, "%s", together[i].text);
        test_refused(clshear_render(made->scene, wrong, &film), CLSHEAR_BAD_ARGUMENT,
                     together[i].words);
        clshear_settings_free(wrong);
    }
    assert_null(film);
    clshear_film_free(render_once(made, settings)); /* the settings are unchanged */
}

static void bad_contexts_are_refused(void **state)
{
    (void)state;
    clshear_context *context = NULL;
    clshear_settings *settings = NULL;
    test_ok(clshear_settings_create(&settings));
    test_set(settings, CLSHEAR_DEVICE, "no such device");
    test_refused(clshear_context_create(settings, &context), CLSHEAR_NO_DEVICE, "no such device");
    test_refused(clshear_settings_set_text(settings, CLSHEAR_PACKET, "5"), CLSHEAR_BAD_ARGUMENT,
                 "packet 5: must be 1, 4, 8 or 16");
    test_refused(clshear_settings_set_text(settings, CLSHEAR_THREADS, "-1"), CLSHEAR_BAD_ARGUMENT,
                 "threads -1");
    assert_null(context);
    clshear_settings_free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_seed_gives_one_image),
        cmocka_unit_test(pages_do_not_change_a_bit),
        cmocka_unit_test(packet_widths_agree),
        cmocka_unit_test(a_crop_is_part_of_the_whole),
        cmocka_unit_test(shears_agree),
        cmocka_unit_test(samplers_agree),
        cmocka_unit_test(variance_channel_is_correct),
        cmocka_unit_test(interrupted_renders_are_usable),
        cmocka_unit_test(counts_and_channels),
        cmocka_unit_test(bad_settings_are_refused),
        cmocka_unit_test(bad_contexts_are_refused),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
