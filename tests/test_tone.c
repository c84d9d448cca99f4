/* Exposure and tone curves. */
#include "support.h"

#include <math.h>

#include "clshear/clshear.h"
#include "image/tone.h"

static void test_filmic_rises_from_0_to_1(void **state)
{
    (void)state;
    assert_true(cs_tone_filmic(0.0f) == 0.0f && cs_tone_filmic(-1.0f) == 0.0f);
    assert_float_equal(cs_tone_filmic(5.6f), 1.0, 1e-5);
    for (int i = 0; i < 560; i++)
        assert_true(cs_tone_filmic((float)(i + 1) * 0.01f) > cs_tone_filmic((float)i * 0.01f));
}

static void test_auto_exposure_makes_the_log_average_mid_grey(void **state)
{
    (void)state;
    /* Luminances 0.5 and 8, of log-average 2, and a black pixel that does not count. */
    const float plane[3] = {0.5f, 8.0f, 0.0f}, *const planes[3] = {plane, plane, plane};
    const float *const black[3] = {plane + 2, plane + 2, plane + 2};
    float pixels[6] = {0.5f, 0.5f, 0.5f, 8.0f, 8.0f, 8.0f};
    const cs_tone tone = {.is_auto = 1, .exposure = 1.0f};
    assert_float_equal(cs_tone_auto_scale(planes, 3), 0.09, 1e-6);
    cs_tone_apply(&tone, cs_tone_scale(&tone, planes, 3), pixels, 2);
    assert_float_equal(sqrtf(pixels[0] * pixels[3]), 0.36, 1e-5);
    assert_true(cs_tone_auto_scale(black, 1) == 1.0f);
}

/* The published pivot, slope and ends; a rising curve; the same on both sides of the pivot. */
static void test_agx_curve_has_its_pivot_and_ends(void **state)
{
    (void)state;
    const float grey = 10.0f / 16.5f, step = 1e-3f;
    assert_float_equal(cs_tone_agx_curve(0.0f), 0.0, 1e-5);
    assert_float_equal(cs_tone_agx_curve(grey), 0.5, 1e-6);
    assert_float_equal(cs_tone_agx_curve(1.0f), 1.0, 1e-5);
    assert_float_equal((cs_tone_agx_curve(grey + step) - 0.5f) / step, 2.0, 1e-2);
    assert_float_equal((0.5f - cs_tone_agx_curve(grey - step)) / step, 2.0, 1e-2);
    for (int i = 0; i < 1000; i++)
        assert_true(cs_tone_agx_curve((float)(i + 1) * step) >= cs_tone_agx_curve((float)i * step));
}

/* Greys stay grey within the digits of the matrix, whose rows sum to 1 +- 1.4e-4: 2e-4
 * stops, 1.2e-5 of the encoding, twice that after the curve and at most 2.4 times that when made
 * linear; grey becomes the screen's 0.5, which is 0.214 linear; what is dark is black, what is
 * bright white, and a bright pure red is pale. */
static void test_agx_takes_colour_out_of_highlights(void **state)
{
    (void)state;
    float grey[3] = {0.18f, 0.18f, 0.18f}, black[3] = {0.0f, -1.0f, 0.0f};
    float white[3] = {1e4f, 1e4f, 1e4f}, red[3] = {20.0f, 0.0f, 0.0f};
    cs_tone_agx(grey);
    cs_tone_agx(black);
    cs_tone_agx(white);
    cs_tone_agx(red);
    for (int c = 0; c < 3; c++) {
        assert_float_equal(grey[c], 0.21404114, 1e-4);
        assert_float_equal(black[c], 0.0, 1e-6);
        assert_float_equal(white[c], 1.0, 1e-5);
        assert_true(red[c] > 0.1f && red[c] <= 1.0f);
    }
    assert_true(red[0] > red[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_filmic_rises_from_0_to_1),
        cmocka_unit_test(test_auto_exposure_makes_the_log_average_mid_grey),
        cmocka_unit_test(test_agx_curve_has_its_pivot_and_ends),
        cmocka_unit_test(test_agx_takes_colour_out_of_highlights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
