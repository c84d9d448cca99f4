/* What a render promises, on the Cornell box. */
#include "support.h"

#include <math.h>

#include "context/context.h"
#include "kernels/pixel.h"

enum {
    SIZE = 48,
    PIXELS = SIZE * SIZE
};

typedef struct fixture {
    clshear_context *context;
    clshear_scene *scene;
    clshear_camera camera;
} fixture;

static void open_scene(fixture *made, int threads, int packet)
{
    clshear_context_options options = clshear_context_defaults();
    options.threads = threads;
    options.packet = packet;
    if (clshear_context_create(&options, &made->context) != CLSHEAR_OK)
        fail_msg("%s", clshear_message(NULL));
    made->scene = test_cornell(made->context, &made->camera);
}

static void close_scene(fixture *made)
{
    clshear_scene_free(made->scene);
    clshear_context_free(made->context);
}

static int set_up(void **state)
{
    fixture *made = calloc(1, sizeof *made);
    open_scene(made, 0, 0);
    *state = made;
    return 0;
}

static int tear_down(void **state)
{
    close_scene(*state);
    free(*state);
    return 0;
}

static clshear_options small(uint32_t spp, uint32_t replicates)
{
    clshear_options options = clshear_options_defaults();
    options.width = options.height = SIZE;
    options.spp = spp;
    options.replicates = replicates;
    return options;
}

static clshear_film *render(fixture *made, const clshear_options *options)
{
    clshear_film *film = NULL;
    test_ok(made->context, clshear_render(made->scene, &made->camera, options, &film));
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
    fixture *made = *state, alone;
    clshear_options options = small(200, 2);
    clshear_film *first = render(made, &options), *second = render(made, &options);
    open_scene(&alone, 1, 0);
    clshear_film *third = render(&alone, &options);
    assert_true(same_bits(first, second));
    assert_true(same_bits(first, third));
    options.seed = 1;
    clshear_film *other = render(made, &options);
    assert_false(same_bits(first, other));
    clshear_film_free(first);
    clshear_film_free(second);
    clshear_film_free(third);
    clshear_film_free(other);
    close_scene(&alone);
}

/* Widths differ by rounding only: a sample may fall on the other side of an edge, and the rest
 * agree to a part in 10^4. */
/* Large images keep their pixels in several buffers: here of 8 rows each, six of them. */
static void pages_do_not_change_a_bit(void **state)
{
    fixture *made = *state;
    const size_t before = made->context->page_bytes;
    clshear_film *films[2][3], *parts[2];
    for (int paged = 0; paged < 2; paged++) {
        made->context->page_bytes = paged ? 8 * SIZE * sizeof(cs_pixel) : before;
        clshear_options options = small(128, 2);
        films[paged][0] = render(made, &options);
        options.adaptive = 1;
        films[paged][1] = render(made, &options);
        options = small(64, 2);
        options.sampler = "sz";
        options.extendable = 1;
        parts[paged] = render(made, &options);
        options.spp = 128;
        options.extend = parts[paged];
        films[paged][2] = render(made, &options);
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

static void packet_widths_agree(void **state)
{
    (void)state;
    const int widths[] = {1, 4, 8, 16};
    float reference[PIXELS];
    clshear_options options = small(2 * 85, 2); /* 11 blocks, the last one not full */
    for (int w = 0; w < 4; w++) {
        fixture made;
        open_scene(&made, 0, widths[w]);
        clshear_film *film = render(&made, &options);
        const float *red = clshear_film_channel(film, "R");
        int different = 0;
        if (w == 0) memcpy(reference, red, sizeof reference);
        for (int p = 0; p < PIXELS; p++) {
            assert_true(fabsf(red[p] - reference[p]) <= 0.02f * reference[p] + 1e-3f);
            different += fabsf(red[p] - reference[p]) > 1e-4f * reference[p];
        }
        assert_true(different < PIXELS / 50);
        clshear_film_free(film);
        close_scene(&made);
    }
}

static void a_crop_is_part_of_the_whole(void **state)
{
    fixture *made = *state;
    clshear_options options = small(64, 2);
    options.oracle = CLSHEAR_ORACLE_MEDIAN; /* a pilot sees less in a crop */
    clshear_film *whole = render(made, &options);
    const int crop[4] = {5, 30, 11, 22};
    memcpy(options.crop, crop, sizeof crop);
    clshear_film *part = render(made, &options);
    assert_int_equal(clshear_film_describe(part).width, 25);
    assert_int_equal(clshear_film_describe(part).height, 11);
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

static void measure(fixture *made, const char *sampler, clshear_shear shear, uint32_t seed,
                    estimates *result)
{
    clshear_options options = small(32 * 64, 32);
    options.seed = seed;
    options.sampler = sampler;
    options.shear = shear;
    clshear_film *film = render(made, &options);
    memcpy(result->mean, clshear_film_channel(film, "R"), sizeof result->mean);
    memcpy(result->variance, clshear_film_channel(film, "Variance.R"), sizeof result->variance);
    clshear_film_free(film);
}

/* The image means differ by less than 5 standard errors (false alarms 6e-7), and chi-square of the
 * pixels' z-scores, whose t distribution with about 60 degrees of freedom has variance 1.03, stays
 * below 1.25 a pixel: with 2304 pixels chance alone gives 1.03 +- 0.03. Pixels that hardly vary are
 * left out: their variance is rounding. */
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
        measure(*state, "mj", (clshear_shear)shear, 40u + (uint32_t)shear, &of[shear]);
    expect_agreement(&of[0], &of[1], "none and toroidal");
    expect_agreement(&of[0], &of[2], "none and equal-area");
    expect_agreement(&of[1], &of[2], "toroidal and equal-area");
}

static void samplers_agree(void **state)
{
    static estimates reference, of;
    clshear_sampler_info info;
    measure(*state, "random", CLSHEAR_SHEAR_NONE, 99, &reference);
    for (uint32_t i = 0; clshear_sampler_describe(i, &info); i++) {
        measure(*state, info.name, CLSHEAR_SHEAR_EQUAL_AREA, 50u + i, &of);
        expect_agreement(&reference, &of, info.name);
    }
}

/* The Variance channel is the variance of the pixel's mean. Over 64 seeds of 2 replicates of 32
 * samples, its image mean and that of the variance across seeds agree within 15 %; the relative
 * standard error of either, from batches of seeds, is 2 to 3 %, so this is 4 or more of them. */
static void variance_channel_is_honest(void **state)
{
    fixture *made = *state;
    enum {
        SEEDS = 64
    };
    for (int shear = 0; shear < 3; shear++) {
        double *sum = calloc(PIXELS, sizeof *sum), *squares = calloc(PIXELS, sizeof *squares);
        double claimed = 0.0, across = 0.0;
        for (uint32_t seed = 0; seed < SEEDS; seed++) {
            clshear_options options = small(64, 2);
            options.seed = seed;
            options.shear = (clshear_shear)shear;
            clshear_film *film = render(made, &options);
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
        assert_true(fabs(claimed / across - 1.0) < 0.15);
        free(sum);
        free(squares);
    }
}

static int stop_at_half(void *user, const clshear_progress *progress)
{
    *(double *)user = progress->fraction;
    return progress->fraction > 0.3;
}

/* An interrupted render keeps what it has, says how much that is, and is unbiased: compared pixel
 * by pixel with a finished one, whose sample variance is the better known. It drew whole blocks of
 * CS_BLOCK = 16 neighbouring strata, so its variance is at most 16 times that of as many
 * independent samples; 6 such standard errors, false alarms 2e-9 a pixel. */
static void interrupted_renders_are_usable(void **state)
{
    fixture *made = *state;
    double fraction = 0.0, samples = 0.0, bias = 0.0, error = 0.0;
    clshear_options options = small(16384, 1); /* several launches on a fast machine too */
    clshear_film *whole = render(made, &options), *part = NULL;
    options.progress = stop_at_half;
    options.progress_user = &fraction;
    options.seed = 5;
    assert_int_equal(clshear_render(made->scene, &made->camera, &options, &part),
                     CLSHEAR_CANCELLED);
    assert_true(fraction > 0.3 && fraction < 0.95);
    assert_null(clshear_film_channel(part, "Variance.R"));
    const float *counts = clshear_film_channel(part, "Samples");
    for (int p = 0; p < PIXELS; p++) {
        samples += (double)counts[p];
        double v = 16.0 * (double)clshear_film_channel(whole, "SampleVariance.R")[p] / counts[p];
        double d = (double)clshear_film_channel(part, "R")[p] -
                   (double)clshear_film_channel(whole, "R")[p];
        assert_true(fabs(d) < 6.0 * sqrt(v) + 1e-4);
        bias += d;
        error += v;
    }
    assert_true(fabs(bias) < 5.0 * sqrt(error));
    assert_true(fabs(samples / (16384.0 * PIXELS) - fraction) < 1e-9);
    assert_true(samples == (double)clshear_film_describe(part).samples);
    clshear_film_free(whole);
    clshear_film_free(part);
}

static void counts_and_channels(void **state)
{
    fixture *made = *state;
    clshear_options options = small(7, 2); /* rounded up to two patterns of 4 */
    clshear_film *film = render(made, &options);
    for (int p = 0; p < PIXELS; p++) {
        assert_true(clshear_film_channel(film, "Samples")[p] == 8.0f);
        float depth = clshear_film_channel(film, "Z")[p];
        float shear = clshear_film_channel(film, "Shear")[p];
        assert_true(isinf(depth) ? shear == 0.0f : (shear > 0.0f) == (depth < 930.0f));
        assert_true(isfinite(clshear_film_channel(film, "B")[p]));
    }
    assert_null(clshear_film_channel(film, "nonsense"));
    assert_int_equal(clshear_film_describe(film).samples, 8 * PIXELS);
    clshear_film_free(film);
    options = small(1, 0);
    film = render(made, &options);
    assert_null(clshear_film_channel(film, "Variance.R"));
    clshear_film_free(film);
}

static void bad_options_are_refused(void **state)
{
    fixture *made = *state;
    clshear_film *film = NULL;
    clshear_options good = small(16, 2), bad[6];
    for (int i = 0; i < 6; i++)
        bad[i] = good;
    bad[0].spp = 0;
    bad[1].replicates = 17;
    bad[2].width = 0;
    bad[3].crop[1] = SIZE + 1;
    bad[3].crop[3] = 1;
    bad[4].spp = 3000000;
    bad[5].shear = (clshear_shear)7;
    for (int i = 0; i < 6; i++) {
        assert_int_equal(clshear_render(made->scene, &made->camera, &bad[i], &film),
                         CLSHEAR_BAD_ARGUMENT);
        assert_true(strlen(clshear_message(made->context)) > 10);
        assert_null(strchr(clshear_message(made->context), '\n'));
        assert_null(film);
    }
    clshear_camera camera = made->camera;
    camera.lens_radius = -1.0f;
    assert_int_equal(clshear_render(made->scene, &camera, &good, &film), CLSHEAR_BAD_ARGUMENT);
    camera = made->camera;
    memcpy(camera.target, camera.eye, sizeof camera.eye);
    assert_int_equal(clshear_render(made->scene, &camera, &good, &film), CLSHEAR_BAD_ARGUMENT);
    camera = made->camera;
    camera.fov_deg = 180.0f;
    assert_int_equal(clshear_render(made->scene, &camera, &good, &film), CLSHEAR_BAD_ARGUMENT);
}

static void bad_contexts_are_refused(void **state)
{
    (void)state;
    clshear_context *context = NULL;
    clshear_context_options options = clshear_context_defaults();
    options.device = "no such device";
    assert_int_equal(clshear_context_create(&options, &context), CLSHEAR_NO_DEVICE);
    assert_non_null(strstr(clshear_message(NULL), "no such device"));
    options = clshear_context_defaults();
    options.packet = 5;
    assert_int_equal(clshear_context_create(&options, &context), CLSHEAR_BAD_ARGUMENT);
    options = clshear_context_defaults();
    options.threads = -1;
    assert_int_equal(clshear_context_create(&options, &context), CLSHEAR_BAD_ARGUMENT);
    assert_null(context);
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
        cmocka_unit_test(variance_channel_is_honest),
        cmocka_unit_test(interrupted_renders_are_usable),
        cmocka_unit_test(counts_and_channels),
        cmocka_unit_test(bad_options_are_refused),
        cmocka_unit_test(bad_contexts_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
