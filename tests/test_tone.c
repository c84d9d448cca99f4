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
    float pixels[9] = {0.5f, 0.5f, 0.5f, 8.0f, 8.0f, 8.0f, 0.0f, 0.0f, 0.0f};
    const cs_tone tone = {.is_auto = 1, .exposure = 1.0f};
    assert_float_equal(cs_tone_auto_scale(pixels, 3), 0.09, 1e-6);
    cs_tone_apply(&tone, pixels, 3);
    assert_float_equal(sqrtf(pixels[0] * pixels[3]), 0.36, 1e-5);
    assert_true(cs_tone_auto_scale(pixels + 6, 1) == 1.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_filmic_rises_from_0_to_1),
        cmocka_unit_test(test_auto_exposure_makes_the_log_average_mid_grey),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
