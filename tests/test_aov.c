/* AOVs: the picture keeps its bits, parts of light add up, and means obey closed forms. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "film/film.h"

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

/* Tolerance in parts of the value. */
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

/* A matrix of the film's metadata. */
static const float *matrix_of(const clshear_film *film, const char *name)
{
    const cs_attribute *attributes = film->attributes.items;
    for (size_t i = 0; i < film->attributes.count; i++)
        if (strcmp(attributes[i].name, name) == 0) return attributes[i].numbers;
    fail_msg("no %s", name);
    return NULL;
}

/* The matrix of the metadata finds each pixel from what it sees: mean positions lie in the pixel's
 * pyramid of sight, which is convex. Tolerance for floats. */
static void the_matrix_finds_the_pixels(void **state)
{
    test_fixture *made = *state;
    for (int k = 0; k < 2; k++) {
        clshear_settings *settings = test_settings(made->settings, 24, 16, 16);
        test_set(settings, CLSHEAR_AOV, "position");
        test_set(settings, CLSHEAR_LENS_RADIUS, "0");
        test_set(settings, CLSHEAR_CROP, "5,20,2,13");
        if (k == 1) test_set(settings, CLSHEAR_ORTHOGRAPHIC, "700");
        clshear_film *film = test_render(made->scene, settings);
        const float *m = matrix_of(film, "worldToNDC");
        const float *p[3] = {clshear_film_channel(film, "P.X"), clshear_film_channel(film, "P.Y"),
                             clshear_film_channel(film, "P.Z")};
        for (int i = 0; i < 15 * 11; i++) {
            float at[4];
            if (clshear_film_channel(film, "Coverage.A")[i] <= 0.0f) continue;
            for (int c = 0; c < 4; c++)
                at[c] = p[0][i] * m[c] + p[1][i] * m[4 + c] + p[2][i] * m[8 + c] + m[12 + c];
            assert_near(24.0f * at[0] / at[3], (float)(5 + i % 15) + 0.5f, 0.501f);
            assert_near(16.0f * at[1] / at[3], (float)(2 + i / 15) + 0.5f, 0.501f);
        }
        clshear_film_free(film);
        clshear_settings_free(settings);
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

static float largest_of(const clshear_film *film, const char *name)
{
    float most = 0.0f;
    for (int i = 0; i < SIDE * SIDE; i++)
        most = fmaxf(most, fabsf(clshear_film_channel(film, name)[i]));
    return most;
}

/* Equal but for the roundings that a continuation adds: of the mean in the file, of the coverage by
 * which its sum is found, and of the sum on the device; and one of the result. Each is at most
 * 2^-24 of the largest value, and so is what the order of sums makes of the same packets: 8 in all.
 */
static void expect_continued(const clshear_film *whole, const clshear_film *film, const char *name)
{
    const float *expected = clshear_film_channel(whole, name);
    const double tolerance = 8.0 * 0x1p-24 * (double)largest_of(whole, name);
    for (int i = 0; i < SIDE * SIDE; i++)
        assert_near(clshear_film_channel(film, name)[i], expected[i], tolerance);
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
        expect_continued(whole, film, names[i]);
    clshear_film_free(bare);
    clshear_film_free(first);
    clshear_film_free(film);
    clshear_film_free(whole);
    clshear_settings_free(settings);
}

static clshear_settings *from_above(const char *lens)
{
    clshear_settings *settings = test_settings(NULL, SIDE, SIDE, 1024);
    test_set(settings, CLSHEAR_EYE, "0,3,0");
    test_set(settings, CLSHEAR_TARGET, "0,0,0");
    test_set(settings, CLSHEAR_UP, "0,0,-1");
    test_set(settings, CLSHEAR_ORTHOGRAPHIC, "%g", 0.1 * SIDE);
    test_set(settings, CLSHEAR_FOCAL_DISTANCE, "2");
    test_set(settings, CLSHEAR_LENS_RADIUS, "%s", lens);
    test_set(settings, CLSHEAR_APERTURE, "square");
    test_set(settings, CLSHEAR_LIGHT, "0,9,0,1,1,1");
    test_set(settings, CLSHEAR_BOUNCES, "0");
    test_set(settings, CLSHEAR_ORACLE, "centre");
    test_set(settings, CLSHEAR_AOV, "%s", all_aovs);
    return settings;
}

/* Part of a pixel and lens that see |x| <= half, and the mean of x there: x is the sum of a place
 * in a pixel 0.1 wide around `middle` and of one in a blur of this width. */
static void expect_in_strip(double middle, double blur, double half, double *part, double *mean)
{
    enum {
        STEPS = 200
    };
    double sum = 0.0;
    int hits = 0;
    for (int i = 0; i < STEPS * STEPS; i++) {
        const double x = middle + 0.1 * ((i % STEPS + 0.5) / STEPS - 0.5) +
                         blur * ((i / STEPS + 0.5) / STEPS - 0.5);
        if (fabs(x) > half) continue;
        sum += x;
        hits++;
    }
    *part = (double)hits / (STEPS * STEPS);
    *mean = hits > 0 ? sum / hits : 0.0;
}

/* A square of albedo 0.6 from above, |x|, |z| <= 0.83, sharp and blurred over 3.5 pixels by
 * parallel lines of sight: part and mean of x are products of those of two strips. Albedo, normal
 * and coverage are means over all samples; position and depth over those that see it. A share of
 * 1024 samples has a standard error of at most 0.5 / 32, the mean of x one of at most 0.225 /
 * sqrt(12 * 1024 * part): 6 of them, for samples that are at most as noisy as independent ones;
 * 2^-20 for rounding. */
static void means_through_the_lens_obey_closed_forms(void **state)
{
    static const char *const lenses[] = {"0", "0.35"};
    clshear_scene *floor = test_floor(((test_fixture *)*state)->context, 0.83f, 0.6f);
    for (int k = 0; k < 2; k++) {
        clshear_settings *settings = from_above(lenses[k]);
        clshear_film *film = test_render(floor, settings);
        for (int i = 0; i < SIDE * SIDE; i++) {
            double part[2], mean[2];
            const float *seen = clshear_film_channel(film, "Coverage.A");
            expect_in_strip(0.1 * (i % SIDE + 0.5 - SIDE / 2), 0.35 * k, 0.83, &part[0], &mean[0]);
            expect_in_strip(0.1 * (i / SIDE + 0.5 - SIDE / 2), 0.35 * k, 0.83, &part[1], &mean[1]);
            const double share = part[0] * part[1];
            const double error = share > 0.0 && share < 1.0 ? 6.0 * 0.5 / 32.0 : 0.0;
            assert_near(seen[i], share, error + 0x1p-20);
            assert_near(clshear_film_channel(film, "Albedo.G")[i], 0.6 * (double)seen[i], 0x1p-20);
            assert_near(clshear_film_channel(film, "N.Y")[i], seen[i], 0x1p-20);
            assert_near(clshear_film_channel(film, "N.X")[i], 0.0, 0x1p-20);
            assert_near(clshear_film_channel(film, "Emission.R")[i], 0.0, 0.0);
            if (seen[i] == 0.0f) {
                assert_true(isinf(clshear_film_channel(film, "Depth.Z")[i]));
                continue;
            }
            const double spread = 6.0 * 0.45 / sqrt(12.0 * 1024.0 * (double)seen[i]);
            assert_near(clshear_film_channel(film, "P.X")[i], mean[0], spread);
            assert_near(clshear_film_channel(film, "P.Z")[i], mean[1], spread);
            assert_near(clshear_film_channel(film, "P.Y")[i], 0.0, 0x1p-20);
            assert_near(clshear_film_channel(film, "Depth.Z")[i], 3.0, 4 * 0x1p-20);
        }
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
    clshear_scene_free(floor);
}

/* A crop has the bits of the whole picture, if all pixels have the same samples. */
static void a_crop_has_the_same_channels(void **state)
{
    clshear_scene *floor = test_floor(((test_fixture *)*state)->context, 0.83f, 0.6f);
    clshear_settings *settings = from_above("0.35");
    test_set(settings, CLSHEAR_SPP, "64");
    test_set(settings, CLSHEAR_ADAPTIVE, "0");
    clshear_film *whole = test_render(floor, settings);
    test_set(settings, CLSHEAR_CROP, "1,7,2,22");
    clshear_film *crop = test_render(floor, settings);
    static const char *const names[] = {"R", "Albedo.B", "N.Y", "P.X", "Depth.Z", "Coverage.A"};
    for (size_t n = 0; n < sizeof names / sizeof *names; n++)
        for (int y = 2; y < 22; y++)
            assert_memory_equal(clshear_film_channel(crop, names[n]) + 6 * (y - 2),
                                clshear_film_channel(whole, names[n]) + SIDE * y + 1,
                                6 * sizeof(float));
    clshear_film_free(whole);
    clshear_film_free(crop);
    clshear_settings_free(settings);
    clshear_scene_free(floor);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_picture_stays_and_parts_add_up),
        cmocka_unit_test(the_matrix_finds_the_pixels),
        cmocka_unit_test(extended_equals_whole),
        cmocka_unit_test(means_through_the_lens_obey_closed_forms),
        cmocka_unit_test(a_crop_has_the_same_channels),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
