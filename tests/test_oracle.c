/* The oracle: depth to shear, without tracing. */
#include "support.h"

#include <math.h>

#include "lens.h"
#include "oracle/oracle.h"

/* s = A / w * (F / z - 1): positive in front of the focal plane, zero on it, negative behind; what
 * sees nothing is not sheared. */
static void depth_becomes_shear(void **state)
{
    (void)state;
    const cs_camera camera = {.focal_distance = 4.0f, .pixel_width = 0.01f, .aperture_width = 0.2f};
    const float z[5] = {2.0f, 4.0f, 8.0f, 1e30f, INFINITY};
    const float expected[5] = {20.0f, 0.0f, -10.0f, -20.0f, 0.0f};
    for (int i = 0; i < 5; i++) {
        const cs_depth depth = {z[i], z[i], z[i], z[i], isfinite(z[i]) ? 0.0f : 1.0f};
        for (int rule = CS_RULE_CENTRE; rule <= CS_RULE_FAR; rule++)
            assert_true(fabsf(cs_oracle_shear(&camera, &depth, (cs_rule)rule) - expected[i]) <
                        1e-4f);
        assert_true(cs_oracle_shear(&camera, &depth, CS_RULE_NONE) == 0.0f);
    }
}

/* Every rule takes its own depth; a centre that sees nothing takes the median. */
static void rules_take_their_depths(void **state)
{
    (void)state;
    const cs_camera camera = {.focal_distance = 4.0f, .pixel_width = 0.01f, .aperture_width = 0.2f};
    cs_depth depth = {2.0f, 1.0f, 4.0f, 8.0f, 0.5f};
    const float expected[CS_RULE_COUNT] = {20.0f, 0.0f, 60.0f, -10.0f, 0.0f};
    for (int rule = 0; rule < CS_RULE_COUNT; rule++)
        assert_true(fabsf(cs_oracle_shear(&camera, &depth, (cs_rule)rule) - expected[rule]) <
                    1e-4f);
    depth.centre = INFINITY;
    assert_true(cs_oracle_shear(&camera, &depth, CS_RULE_CENTRE) == 0.0f);
    depth.median = 1.0f;
    assert_true(fabsf(cs_oracle_shear(&camera, &depth, CS_RULE_CENTRE) - 60.0f) < 1e-4f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(depth_becomes_shear),
                                       cmocka_unit_test(rules_take_their_depths)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
