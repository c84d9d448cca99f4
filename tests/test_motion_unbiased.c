/* The shears of lens and time leave the mean where it is: 64 pictures of each lens, with 64 seeds,
 * against 64 unsheared ones. */
#include "support.h"

#include <math.h>

enum {
    SIDE = 24,
    PIXELS = SIDE * SIDE,
    SEEDS = 64,
    ACROSS = SIDE / 8,
    SUMS = 3 * ACROSS * ACROSS /* of the colours of blocks of 8 x 8 pixels */
};

/* A way of sampling, and the means and variances that pictures with it have. */
typedef struct way {
    const char *sampler;
    const char *shear;
    uint32_t spp;
    double mean[SUMS];
    double variance[SUMS]; /* of the mean over the seeds */
} way;

static void block_means(const clshear_film *film, double *means)
{
    static const char *const names[3] = {"R", "G", "B"};
    memset(means, 0, SUMS * sizeof *means);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < PIXELS; i++)
            means[3 * (ACROSS * (i / SIDE / 8) + i % SIDE / 8) + c] +=
                (double)clshear_film_channel(film, names[c])[i] / 64.0;
}

static void measure(clshear_scene *scene, clshear_settings *settings, way *way)
{
    double means[SUMS];
    test_set(settings, CLSHEAR_SAMPLER, "%s", way->sampler);
    test_set(settings, CLSHEAR_SHEAR, "%s", way->shear);
    test_set(settings, CLSHEAR_SPP, "%u", way->spp);
    for (int seed = 0; seed < SEEDS; seed++) {
        test_set(settings, CLSHEAR_SEED, "%d", 1000 * (int)way->spp + seed);
        clshear_film *film = test_render(scene, settings);
        block_means(film, means);
        for (int i = 0; i < SUMS; i++) {
            const double off = means[i] - way->mean[i];
            way->mean[i] += off / (seed + 1);
            way->variance[i] += off * (means[i] - way->mean[i]) / (SEEDS * (SEEDS - 1.0));
        }
        clshear_film_free(film);
    }
}

/* |z| < 6.5 for the differences of 27 sums. z has Student's distribution with 63 degrees of freedom
 * or more, so that 6.5 has the probability 1.4e-8: false alarms 2e-6 for all five lenses. */
static void the_mean_of_64_seeds_is_that_without_shear(void **state)
{
    test_fixture *made = *state;
    static const struct {
        const char *aperture, *anamorphic, *radius, *filter;
    } lenses[] = {{"disk", "1", "30", "box"},
                  {"disk", "2", "3", "box"},
                  {"polygon", "1", "30", "box"},
                  {"polygon", "1.5", "15", "gaussian"},
                  {"square", "1", "30", "tent"}};
    for (size_t k = 0; k < sizeof lenses / sizeof *lenses; k++) {
        clshear_settings *settings = test_settings(made->settings, SIDE, SIDE, 64);
        way sheared = {.sampler = "sobol", .shear = "equal-area", .spp = 64};
        way reference = {.sampler = "mj", .shear = "none", .spp = 256};
        double most = 0.0;
        test_set(settings, CLSHEAR_APERTURE, "%s", lenses[k].aperture);
        test_set(settings, CLSHEAR_ANAMORPHIC, "%s", lenses[k].anamorphic);
        test_set(settings, CLSHEAR_LENS_RADIUS, "%s", lenses[k].radius);
        test_set(settings, CLSHEAR_FILTER, "%s", lenses[k].filter);
        test_set(settings, CLSHEAR_CAMERA_TO, "330,250,780,340,290,0");
        measure(made->scene, settings, &sheared);
        measure(made->scene, settings, &reference);
        for (int i = 0; i < SUMS; i++)
            most = fmax(most, fabs(sheared.mean[i] - reference.mean[i]) /
                                  sqrt(sheared.variance[i] + reference.variance[i] + 1e-20));
        print_message("lens %zu: largest |z| %.2f\n", k, most);
        assert_above(6.5, most);
        clshear_settings_free(settings);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_mean_of_64_seeds_is_that_without_shear)};
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
