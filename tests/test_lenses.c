/* Every aperture and filter in whole renders: sheared and unsheared renders agree, and the
 * out-of-focus wall of the Cornell box converges at the expected rate. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/analysis.h"

enum {
    REPLICATES = 64,
    SIZES = 4,
    PIXELS = 16
};

typedef struct lens {
    const char *name;
    clshear_aperture aperture;
    int blades;
    float anamorphic;
    clshear_filter filter;
} lens;

static const lens lenses[] = {
    {"disk", CLSHEAR_APERTURE_DISK, 0, 1, CLSHEAR_FILTER_BOX},
    {"square", CLSHEAR_APERTURE_SQUARE, 0, 1, CLSHEAR_FILTER_BOX},
    {"hexagon", CLSHEAR_APERTURE_POLYGON, 6, 1, CLSHEAR_FILTER_BOX},
    {"triangle", CLSHEAR_APERTURE_POLYGON, 3, 1, CLSHEAR_FILTER_BOX},
    {"disk, anamorphic", CLSHEAR_APERTURE_DISK, 0, 2, CLSHEAR_FILTER_BOX},
    {"hexagon, anamorphic", CLSHEAR_APERTURE_POLYGON, 6, 0.5f, CLSHEAR_FILTER_BOX},
    {"image", CLSHEAR_APERTURE_IMAGE, 0, 1, CLSHEAR_FILTER_BOX},
    {"square, tent", CLSHEAR_APERTURE_SQUARE, 0, 1, CLSHEAR_FILTER_TENT},
    {"square, gaussian", CLSHEAR_APERTURE_SQUARE, 0, 1, CLSHEAR_FILTER_GAUSSIAN},
    {"disk, gaussian", CLSHEAR_APERTURE_DISK, 0, 1, CLSHEAR_FILTER_GAUSSIAN},
    {"disk, blackman-harris", CLSHEAR_APERTURE_DISK, 0, 1, CLSHEAR_FILTER_BLACKMAN_HARRIS},
    {"hexagon, blackman-harris", CLSHEAR_APERTURE_POLYGON, 6, 1, CLSHEAR_FILTER_BLACKMAN_HARRIS},
    {"image, gaussian", CLSHEAR_APERTURE_IMAGE, 0, 1, CLSHEAR_FILTER_GAUSSIAN},
};
enum {
    LENSES = sizeof lenses / sizeof *lenses
};

/* Means and their variances, in green, of 4 x 4 pixels from (x, y). */
typedef struct patch {
    double mean[PIXELS];
    double variance[PIXELS];
} patch;

static patch render(test_fixture *made, const lens *lens, int x, int y, uint32_t pattern,
                    clshear_shear shear)
{
    patch result;
    const cs_aperture_image *image = test_aperture_image();
    clshear_settings *settings = test_settings(made->settings, 512, 512, REPLICATES * pattern);
    test_set(settings, CLSHEAR_CROP, "%d,%d,%d,%d", x, x + 4, y, y + 4);
    test_set(settings, CLSHEAR_REPLICATES, "%d", REPLICATES);
    test_set(settings, CLSHEAR_ORACLE, "centre");
    test_set(settings, CLSHEAR_BLADE_ROTATION, "20");
    test_set_number(settings, CLSHEAR_SHEAR, shear);
    test_set_number(settings, CLSHEAR_FILTER, lens->filter);
    test_set_number(settings, CLSHEAR_SEED, shear); /* independent seeds */
    test_set_number(settings, CLSHEAR_ANAMORPHIC, (double)lens->anamorphic);
    if (lens->blades > 0) test_set_number(settings, CLSHEAR_BLADES, lens->blades);
    test_ok(clshear_settings_set_aperture(settings, image->luminance, image->width, image->height));
    test_set_number(settings, CLSHEAR_APERTURE, lens->aperture);
    clshear_film *film = test_render(made->scene, settings);
    for (int i = 0; i < PIXELS; i++) {
        result.mean[i] = (double)clshear_film_channel(film, "G")[i];
        result.variance[i] = (double)clshear_film_channel(film, "Variance.G")[i];
    }
    clshear_film_free(film);
    clshear_settings_free(settings);
    return result;
}

/* Upper left pixels of the patches: the wall, the edge of the tall box, its foot. */
static const int places[][2] = {{302, 130}, {146, 330}, {230, 440}};

/* Sheared and unsheared means agree, with 64 replicates of 256 samples each. The sum over 16 pixels
 * of z^2 has mean 16 (16.3, because variances are estimated) and standard deviation 5.8. The limit
 * of 60 is far in its tail, 2e-7 for each of the 39 comparisons. */
static void sheared_equals_unsheared(void **state)
{
    test_fixture *made = *state;
    for (int l = 0; l < LENSES; l++)
        for (size_t p = 0; p < sizeof places / sizeof *places; p++) {
            const int x = places[p][0], y = places[p][1];
            const patch none = render(made, &lenses[l], x, y, 256, CLSHEAR_SHEAR_NONE);
            const patch sheared = render(made, &lenses[l], x, y, 256, CLSHEAR_SHEAR_EQUAL_AREA);
            double sum = 0.0;
            for (int i = 0; i < PIXELS; i++)
                sum += pow(none.mean[i] - sheared.mean[i], 2) /
                       (none.variance[i] + sheared.variance[i]);
            if (!(sum < 60.0)) fail_msg("%s at %d,%d: %g", lenses[l].name, x, y, sum);
        }
}

/* Slope of the mean variance of 16 pixels of the wall, over patterns of 64 to 4096 samples. Its
 * relative standard error is sqrt(2 / 63 / 16) = 0.045 at each size, 0.09 with heavy tails; the
 * slope's error is 0.029. All measured slopes are at least 3.5 of these below -1.35. */
static void wall_converges_faster(void **state)
{
    static const uint32_t sizes[SIZES] = {64, 256, 1024, 4096};
    test_fixture *made = *state;
    printf("%-26s slope   none/sheared at N = 1024\n", "");
    for (int l = 0; l < LENSES; l++) {
        double variance[SIZES][PIXELS], errors[SIZES], unsheared = 0.0;
        clshear_fit fit = {.struct_size = sizeof fit};
        for (int k = 0; k < SIZES; k++) {
            const patch sheared =
                render(made, &lenses[l], 302, 130, sizes[k], CLSHEAR_SHEAR_EQUAL_AREA);
            memcpy(variance[k], sheared.variance, sizeof variance[k]);
        }
        const patch none = render(made, &lenses[l], 302, 130, sizes[2], CLSHEAR_SHEAR_NONE);
        for (int i = 0; i < PIXELS; i++)
            unsheared += none.variance[i] / PIXELS;
        test_ok(clshear_fit_slope_of_parts(sizes, SIZES, variance[0], PIXELS, errors, &fit));
        const double gain = unsheared / errors[2];
        printf("%-26s %.2f   %.1f\n", lenses[l].name, fit.slope, gain);
        assert_at_most(fit.slope, -1.35);
        assert_above(gain, 0.8); /* the standard error of its logarithm is 0.09 * sqrt(2) */
    }
}

/* The mean of the integrand over random points of film and lens is the pixel's value: 20 000 points
 * against a render, |z| < 5, false alarms 6e-7. The points' order is film, then lens: the ends of
 * the lens see the tall box's edge from either side. */
static void radiance_is_the_integrand(void **state)
{
    enum {
        COUNT = 20000
    };
    test_fixture *made = *state;
    const lens square = {"square", CLSHEAR_APERTURE_SQUARE, 0, 1, CLSHEAR_FILTER_BOX};
    const patch rendered = render(made, &square, 146, 330, 256, CLSHEAR_SHEAR_EQUAL_AREA);
    clshear_settings *settings = test_settings(made->settings, 512, 512, 16);
    clshear_points *points = NULL;
    float *rgb = malloc(3 * COUNT * sizeof *rgb);
    double sum = 0.0, squares = 0.0;
    test_set(settings, CLSHEAR_APERTURE, "square");
    test_ok(clshear_points_draw("random", COUNT, 1, 1, &points));
    test_ok(clshear_points_select(points, "xyuv"));
    const float *values = clshear_points_values(points);
    test_ok(clshear_radiance(made->scene, settings, 146, 330, values, COUNT, rgb));
    for (int i = 0; i < COUNT; i++) {
        sum += (double)rgb[3 * i + 1] / COUNT;
        squares += (double)rgb[3 * i + 1] * (double)rgb[3 * i + 1] / COUNT;
    }
    const double error = sqrt((squares - sum * sum) / COUNT + rendered.variance[0]);
    assert_near(sum, rendered.mean[0], 5.0 * error);
    const float ends[2][4] = {{0.5f, 0.5f, 0.02f, 0.5f}, {0.5f, 0.5f, 0.98f, 0.5f}};
    test_ok(clshear_radiance(made->scene, settings, 146, 330, ends[0], 2, rgb));
    assert_above(rgb[1], 0.1f);
    assert_below(rgb[4], 0.05f);
    test_refused(clshear_radiance(made->scene, settings, 512, 0, ends[0], 2, rgb),
                 CLSHEAR_BAD_ARGUMENT, "512,0");
    clshear_points_free(points);
    clshear_settings_free(settings);
    free(rgb);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sheared_equals_unsheared),
        cmocka_unit_test(wall_converges_faster),
        cmocka_unit_test(radiance_is_the_integrand),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
