/* Pilots and adaptive allocation in renders: they discard and keep the right samples and do not
 * bias the picture. */
#include "support.h"

#include <math.h>
#include <stdio.h>

enum {
    SIZE = 96,
    PIXELS = SIZE * SIZE,
    SPP = 512
};

static clshear_film *render(test_fixture *made, clshear_oracle oracle, int adaptive, uint32_t seed)
{
    clshear_settings *settings = test_settings(made->settings, SIZE, SIZE, SPP);
    test_set_number(settings, CLSHEAR_SEED, seed);
    test_set_number(settings, CLSHEAR_ORACLE, oracle);
    test_set_number(settings, CLSHEAR_ADAPTIVE, adaptive);
    clshear_film *film = test_render(made->scene, settings);
    clshear_settings_free(settings);
    return film;
}

/* The Shear channel follows the rule of the Oracle channel, and the pilot stays within its
 * budget. */
static void the_choice_is_visible(void **state)
{
    test_fixture *made = *state;
    clshear_film *pilot = render(made, CLSHEAR_ORACLE_PILOT, 0, 1), *rules[4];
    const float *rule = clshear_film_channel(pilot, "Oracle");
    const float *shear = clshear_film_channel(pilot, "Shear");
    const clshear_film_info info = test_film_info(pilot);
    assert_above(info.pilot_samples, 0);
    assert_at_most((double)info.pilot_samples, 0.1 * (double)info.samples);
    for (int r = 0; r < 4; r++)
        rules[r] = render(made, (clshear_oracle)r, 0, 1);
    for (int i = 0; i < PIXELS; i++) {
        assert_at_least(rule[i], 0.0f);
        assert_at_most(rule[i], 4.0f);
        const int r = (int)rule[i];
        if (r == 4)
            assert_near(shear[i], 0.0f, 0);
        else
            assert_near(shear[i], clshear_film_channel(rules[r], "Shear")[i], 0);
    }
    clshear_film_free(pilot);
    for (int r = 0; r < 4; r++)
        clshear_film_free(rules[r]);
}

/* By default, what is at rest takes what stands in front in some pixels (7) and the centre's
 * depth in the others (0), without a pilot, and what moves has one. */
static void only_motion_needs_a_pilot(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = test_settings(made->settings, SIZE, SIZE, 64);
    test_set(settings, CLSHEAR_ADAPTIVE, "1"); /* by default another pilot asks whether it pays */
    clshear_film *film = test_render(made->scene, settings);
    const float *rule = clshear_film_channel(film, "Oracle");
    int front = 0;
    for (int i = 0; i < PIXELS; i++) {
        assert_true(rule[i] == 0.0f || rule[i] == 7.0f);
        front += rule[i] == 7.0f;
    }
    assert_above(front, 0);
    assert_below(front, PIXELS / 2);
    assert_int_equal(test_film_info(film).pilot_samples, 0);
    clshear_film_free(film);
    test_set(settings, CLSHEAR_CAMERA_TO, "290,274,800,276,274,0");
    film = test_render(made->scene, settings);
    assert_above(test_film_info(film).pilot_samples, 0);
    clshear_film_free(film);
    clshear_settings_free(settings);
}

static void samples_are_counted(void **state)
{
    test_fixture *made = *state;
    clshear_film *film = render(made, CLSHEAR_ORACLE_PILOT, 1, 1);
    const float *samples = clshear_film_channel(film, "Samples");
    double total = 0.0, least = 1e9, most = 0.0;
    for (int i = 0; i < PIXELS; i++) {
        total += (double)samples[i];
        least = fmin(least, (double)samples[i]);
        most = fmax(most, (double)samples[i]);
    }
    assert_near(total, (double)test_film_info(film).samples, 0);
    assert_at_most(total, 1.03 * SPP * PIXELS); /* --spp is the mean, about: see choose_rule.h */
    assert_above(total, 0.5 * SPP * PIXELS);
    assert_at_least(least, SPP / 16.0);
    assert_at_most(most, 16.0 * SPP);
    assert_at_least(most, 4.0 * least);
    clshear_film_free(film);
}

static int stop_after_a_third(void *user, const clshear_progress *progress)
{
    (void)user;
    return progress->fraction > 0.33;
}

/* Patterns of all sizes grow together, so an interrupted picture has samples in every pixel. The
 * smallest patterns here have 64 samples, which are drawn at once, in the first step: a sixteenth
 * of all. */
static void interruption_leaves_no_holes(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = test_settings(made->settings, SIZE, SIZE, 1024);
    test_set(settings, CLSHEAR_REPLICATES, "1");
    test_set(settings, CLSHEAR_ADAPTIVE, "1");
    clshear_settings_set_progress(settings, stop_after_a_third, NULL);
    clshear_film *film = test_render(made->scene, settings);
    assert_int_equal(test_film_info(film).complete, 0);
    for (int i = 0; i < PIXELS; i++)
        assert_above(clshear_film_channel(film, "Samples")[i], 0.0f);
    clshear_film_free(film);
    clshear_settings_free(settings);
}

/* Adaptive allocation gives the same picture as equal samples, with less noise. 16 seeds each: the
 * image means differ by less than 5 standard errors (false alarms 6e-7). The variance is lower by a
 * factor of at least 1.15. It is 1.27 here, and its relative standard error over seeds and pixels
 * is below 3 %. */
static void adaptive_allocation_is_unbiased_and_less_noisy(void **state)
{
    enum {
        SEEDS = 16
    };
    test_fixture *made = *state;
    double mean[2] = {0}, error[2] = {0}, variance[2] = {0};
    for (int adaptive = 0; adaptive < 2; adaptive++)
        for (uint32_t seed = 0; seed < SEEDS; seed++) {
            clshear_film *film = render(made, CLSHEAR_ORACLE_CENTRE, adaptive, 100u + seed);
            for (int i = 0; i < PIXELS; i++) {
                mean[adaptive] += (double)clshear_film_channel(film, "G")[i] / SEEDS;
                const double v = (double)clshear_film_channel(film, "Variance.G")[i];
                variance[adaptive] += v / SEEDS;
                error[adaptive] += v / (SEEDS * SEEDS);
            }
            clshear_film_free(film);
        }
    assert_near(mean[0], mean[1], 5.0 * sqrt(error[0] + error[1]));
    printf("variance %g even, %g shared out\n", variance[0], variance[1]);
    assert_above(variance[0], 1.15 * variance[1]);
}

/* Sums over a tile of 8 x 8 pixels of a small picture. */
typedef struct tile {
    double difference; /* of the mean over seeds from a finer picture */
    double error;      /* variance of this difference */
} tile;

enum {
    SMALL = 48,
    TILES = SMALL / 8 * (SMALL / 8),
    SMALL_SEEDS = 64
};

static clshear_film *render_small(test_fixture *made, uint32_t samples, int adaptive, uint32_t seed)
{
    clshear_settings *settings = test_settings(made->settings, SMALL, SMALL, samples);
    test_set_number(settings, CLSHEAR_SEED, seed);
    test_set_number(settings, CLSHEAR_ORACLE, CLSHEAR_ORACLE_CENTRE); /* without a pilot */
    test_set_number(settings, CLSHEAR_ADAPTIVE, adaptive);
    clshear_film *film = test_render(made->scene, settings);
    clshear_settings_free(settings);
    return film;
}

/* Sharing out is unbiased pixel by pixel, also where a beginning is all of a pattern: mean of 64
 * seeds against an even picture of 16 384 samples: z of each tile of 8 x 8 pixels, each pixel's
 * variance measured across seeds. The sum of z^2 of 36 tiles is chi-square distributed: above 36 +
 * 6 sqrt(72) = 87 with probability 4e-6. And the Variance channel is honest: its mean and the
 * variance across seeds, whose relative standard error is 2 % here, differ by less than a tenth. */
static void beginnings_do_not_bias(void **state)
{
    static const uint32_t cases[] = {16, 64};
    static double mean[SMALL * SMALL], m2[SMALL * SMALL];
    test_fixture *made = *state;
    clshear_film *fine = render_small(made, 16384, 0, 9999);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        tile tiles[TILES] = {{0}};
        double claimed = 0.0, measured = 0.0, sum = 0.0;
        for (uint32_t seed = 0; seed < SMALL_SEEDS; seed++) {
            clshear_film *film = render_small(made, cases[k], 1, seed);
            assert_int_equal(test_film_info(film).pilot_samples, 0);
            for (int i = 0; i < SMALL * SMALL; i++) {
                const double value = (double)clshear_film_channel(film, "G")[i];
                if (seed == 0) mean[i] = m2[i] = 0.0;
                const double delta = value - mean[i];
                mean[i] += delta / (seed + 1);
                m2[i] += delta * (value - mean[i]);
                claimed += (double)clshear_film_channel(film, "Variance.G")[i] / SMALL_SEEDS;
            }
            clshear_film_free(film);
        }
        for (int i = 0; i < SMALL * SMALL; i++) {
            tile *t = &tiles[i / (8 * SMALL) * (SMALL / 8) + i % SMALL / 8];
            const double variance = m2[i] / (SMALL_SEEDS - 1);
            t->difference += mean[i] - (double)clshear_film_channel(fine, "G")[i];
            t->error +=
                variance / SMALL_SEEDS + (double)clshear_film_channel(fine, "Variance.G")[i];
            measured += variance;
        }
        for (int i = 0; i < TILES; i++)
            sum += tiles[i].difference * tiles[i].difference / tiles[i].error;
        printf("sum of z^2 of %d tiles: %.1f; variance %g claimed, %g measured\n", TILES, sum,
               claimed, measured);
        assert_at_most(sum, TILES + 6.0 * sqrt(2.0 * TILES));
        assert_near(claimed, measured, 0.1 * measured);
    }
    clshear_film_free(fine);
}

enum {
    WALL = 24, /* pixels of the picture's sides; a wall fills its left half */
    SPECKS = WALL * WALL / 2,
    SPECK_SEEDS = 64
};

static const float speck_px = 0.25f, wall_radiance = 0.05f;

/* A dark wall with a white speck in each pixel, and nothing beside it. A unit is a pixel. */
static clshear_scene *speckled_wall(clshear_context *context)
{
    static float corners[SPECKS][3][3];
    static uint32_t indices[SPECKS][3];
    static const float wall[] = {-12, -12, 0, 0, -12, 0, 0, 12, 0, -12, 12, 0};
    static const uint32_t halves[] = {0, 1, 2, 0, 2, 3};
    for (uint32_t i = 0; i < SPECKS; i++) {
        const uint32_t column = i % (WALL / 2), row = i / (WALL / 2);
        for (uint32_t k = 0; k < 3; k++) {
            corners[i][k][0] = (float)column - 11.7f + (k == 1 ? speck_px : 0.0f);
            corners[i][k][1] = (float)row - 11.6f + (k == 2 ? speck_px : 0.0f);
            corners[i][k][2] = 0.1f;
            indices[i][k] = 3 * i + k;
        }
    }
    const clshear_mesh meshes[] = {{.positions = wall,
                                    .indices = halves,
                                    .vertex_count = 4,
                                    .triangle_count = 2,
                                    .emission = {wall_radiance, wall_radiance, wall_radiance}},
                                   {.positions = &corners[0][0][0],
                                    .indices = &indices[0][0],
                                    .vertex_count = 3 * SPECKS,
                                    .triangle_count = SPECKS,
                                    .emission = {1, 1, 1}}};
    return test_meshes(context, meshes, 2);
}

/* Mean over the wall in one render. Adds to `different` the pixels of it that have other counts of
 * samples than the first. */
static double mean_of_wall(clshear_scene *scene, const char *sampler, uint32_t seed, int *different)
{
    clshear_settings *settings = test_settings(NULL, WALL, WALL, 64);
    test_set(settings, CLSHEAR_EYE, "0,0,10");
    test_set(settings, CLSHEAR_TARGET, "0,0,0");
    test_set(settings, CLSHEAR_ORTHOGRAPHIC, "%d", WALL);
    test_set(settings, CLSHEAR_LENS_RADIUS, "0");
    test_set(settings, CLSHEAR_SAMPLER, "%s", sampler);
    test_set_number(settings, CLSHEAR_SEED, seed);
    clshear_film *film = test_render(scene, settings);
    const float *green = clshear_film_channel(film, "G");
    const float *samples = clshear_film_channel(film, "Samples");
    double mean = 0.0;
    for (int i = 0; i < WALL * WALL; i++) {
        if (i % WALL >= WALL / 2) continue;
        mean += (double)green[i] / SPECKS;
        *different += samples[i] != samples[0];
    }
    clshear_film_free(film);
    clshear_settings_free(settings);
    return mean;
}

/* Samples that meet something rare do not decide the size of their own pattern: if they did,
 * patterns that have missed the specks would stay small and weigh as much as the others. The mean
 * over the wall is known: specks are triangles of speck_px^2 / 2. Its standard error is that of 64
 * seeds, so that 5 of them are passed by chance with probability 5e-6 (Student's t). */
static void what_is_rare_does_not_bias(void **state)
{
    static const char *const samplers[] = {"random", "sz"};
    test_fixture *made = *state;
    clshear_scene *scene = speckled_wall(made->context);
    const double part = 0.5 * (double)speck_px * (double)speck_px;
    const double truth = part + (1.0 - part) * (double)wall_radiance;
    for (size_t k = 0; k < sizeof samplers / sizeof *samplers; k++) {
        double mean = 0.0, m2 = 0.0;
        int different = 0;
        for (uint32_t seed = 0; seed < SPECK_SEEDS; seed++) {
            const double value = mean_of_wall(scene, samplers[k], seed, &different);
            const double delta = value - mean;
            mean += delta / (seed + 1);
            m2 += delta * (value - mean);
        }
        const double error = sqrt(m2 / (SPECK_SEEDS - 1) / SPECK_SEEDS);
        printf("%s: mean %g, true %g, standard error %g\n", samplers[k], mean, truth, error);
        assert_above(different, SPECKS); /* patterns of the wall do have different sizes */
        assert_near(mean, truth, 5.0 * error);
    }
    clshear_scene_free(scene);
}

/* Without shear there is nothing to gain. With shear most pixels of this scene gain. */
static void gain_is_shown(void **state)
{
    test_fixture *made = *state;
    for (int shear = 0; shear <= CLSHEAR_SHEAR_EQUAL_AREA; shear += CLSHEAR_SHEAR_EQUAL_AREA) {
        clshear_settings *settings = test_settings(made->settings, SIZE, SIZE, 64);
        int better = 0;
        test_set_number(settings, CLSHEAR_SHEAR, shear);
        test_set(settings, CLSHEAR_GAIN, "1");
        clshear_film *film = test_render(made->scene, settings);
        const float *gain = clshear_film_channel(film, "Gain");
        assert_non_null(gain);
        for (int i = 0; i < PIXELS; i++) {
            assert_true(isfinite(gain[i]));
            assert_at_least(gain[i], 0.0f);
            if (shear == 0) assert_near(gain[i], 1.0f, 0);
            better += gain[i] > 1.0f;
        }
        if (shear != 0) assert_above(better, PIXELS / 2);
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
}

/* Without a word of the caller samples are shared out where all of them can be kept; where not, and
 * where the caller says no, all pixels have as many. */
static void sharing_out_is_the_default(void **state)
{
    static const struct {
        clshear_setting setting;
        const char *value;
        int shares;
    } cases[] = {{CLSHEAR_SPP, "64", 1},        {CLSHEAR_ADAPTIVE, "1", 1},
                 {CLSHEAR_ADAPTIVE, "0", 0},    {CLSHEAR_EXTENDABLE, "1", 0},
                 {CLSHEAR_REPLICATES, "4", 0},  {CLSHEAR_SAMPLER, "mj", 0},
                 {CLSHEAR_SHARD, "1/2", 0},     {CLSHEAR_SPP, "14", 0},
                 {CLSHEAR_NOISE, "0.00001", 0}, {CLSHEAR_SPP, "62", 0}};
    test_fixture *made = *state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        clshear_settings *settings = test_settings(made->settings, SIZE, SIZE, 64);
        test_set_number(settings, CLSHEAR_FOV, 90.0); /* much is background: it pays */
        test_set(settings, cases[k].setting, "%s", cases[k].value);
        clshear_film *film = test_render(made->scene, settings);
        const float *samples = clshear_film_channel(film, "Samples");
        int different = 0;
        for (int i = 0; i < PIXELS; i++)
            different += samples[i] != samples[0];
        if (cases[k].shares)
            assert_above(different, 0);
        else
            assert_int_equal(different, 0);
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
}

static int has_even_samples(const clshear_film *film)
{
    const float *samples = clshear_film_channel(film, "Samples");
    for (int i = 0; i < PIXELS; i++)
        if (samples[i] != samples[0]) return 0;
    return 1;
}

/* Without a word the box has even samples, since sharing out promises little there. */
static void little_gain_is_left(void **state)
{
    test_fixture *made = *state;
    for (int asked = 0; asked < 2; asked++) {
        clshear_settings *settings = test_settings(made->settings, SIZE, SIZE, 64);
        if (asked) test_set(settings, CLSHEAR_ADAPTIVE, "1");
        clshear_film *film = test_render(made->scene, settings);
        assert_int_equal(has_even_samples(film), !asked);
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
}

/* A floor under an even sky has the same noise everywhere: nothing is shared out without a word,
 * which a pilot of a few samples finds. */
static void even_noise_has_even_samples(void **state)
{
    test_fixture *made = *state;
    clshear_scene *scene = test_floor(made->context, 100.0f, 0.5f);
    clshear_settings *settings = test_looking_down(0.0, 64);
    test_set_number(settings, CLSHEAR_WIDTH, SIZE);
    test_set_number(settings, CLSHEAR_HEIGHT, SIZE);
    test_set_number(settings, CLSHEAR_FOV, 40.0);
    test_set_number(settings, CLSHEAR_REPLICATES, 2);
    test_set(settings, CLSHEAR_ENVIRONMENT, "gradient:1,1,1,0,0,0");
    clshear_film *film = test_render(scene, settings);
    const float *samples = clshear_film_channel(film, "Samples");
    for (int i = 0; i < PIXELS; i++)
        assert_near(samples[i], 64.0f, 0);
    const clshear_film_info info = test_film_info(film);
    assert_above(info.pilot_samples, 0);
    assert_at_most((double)info.pilot_samples, 0.02 * (double)info.samples);
    clshear_film_free(film);
    test_set(settings, CLSHEAR_ADAPTIVE, "1"); /* is not questioned */
    film = test_render(scene, settings);
    assert_int_equal(test_film_info(film).pilot_samples, 0);
    clshear_film_free(film);
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_choice_is_visible),
        cmocka_unit_test(only_motion_needs_a_pilot),
        cmocka_unit_test(samples_are_counted),
        cmocka_unit_test(interruption_leaves_no_holes),
        cmocka_unit_test(beginnings_do_not_bias),
        cmocka_unit_test(what_is_rare_does_not_bias),
        cmocka_unit_test(gain_is_shown),
        cmocka_unit_test(sharing_out_is_the_default),
        cmocka_unit_test(even_noise_has_even_samples),
        cmocka_unit_test(little_gain_is_left),
        cmocka_unit_test(adaptive_allocation_is_unbiased_and_less_noisy),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
