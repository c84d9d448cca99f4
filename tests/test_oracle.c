/* The oracle without tracing: shear from depth, rules from evidence, sample counts from
 * variance. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "accel/front.h"
#include "clshear/device/hash.h"
#include "clshear/device/lens.h"
#include "oracle/certain.h"
#include "oracle/choose_rule.h"

/* s = A / w * (F / z - 1): positive in front of the focal plane, 0 on it, negative behind it, and 0
 * without a hit. */
static void depth_becomes_shear(void **state)
{
    (void)state;
    const cs_camera camera = {.focal_distance = 4.0f, .pixel_width = 0.01f, .aperture_width = 0.2f};
    const float z[5] = {2.0f, 4.0f, 8.0f, 1e30f, INFINITY};
    const float expected[5] = {20.0f, 0.0f, -10.0f, -20.0f, 0.0f};
    for (int i = 0; i < 5; i++) {
        const cs_depth depth = {z[i], z[i], z[i], z[i], isfinite(z[i]) ? 0.0f : 1.0f, INFINITY};
        for (int rule = CS_RULE_CENTRE; rule <= CS_RULE_FAR; rule++)
            assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, (cs_rule)rule), expected[i],
                        1e-4f);
        assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, CS_RULE_NONE), 0.0f, 0);
    }
}

/* Every rule takes its own depth. The centre takes the median if its ray hits nothing, and is what
 * the front's rule takes where nothing stands in front. */
static void rules_take_their_depths(void **state)
{
    (void)state;
    const cs_camera camera = {.focal_distance = 4.0f, .pixel_width = 0.01f, .aperture_width = 0.2f};
    cs_depth depth = {2.0f, 1.0f, 4.0f, 8.0f, 0.5f, 7.0f};
    const float expected[CS_RULE_COUNT] = {20.0f, 0.0f, 60.0f, -10.0f, 0.0f, 20.0f, 0.0f, 7.0f};
    for (int rule = 0; rule < CS_RULE_COUNT; rule++)
        assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, (cs_rule)rule), expected[rule],
                    1e-4f);
    depth.centre = INFINITY;
    assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, CS_RULE_CENTRE), 0.0f, 0);
    depth.median = 1.0f;
    assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, CS_RULE_CENTRE), 60.0f, 1e-4f);
    depth.front_px = INFINITY;
    assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, CS_RULE_FRONT), 60.0f, 1e-4f);
}

/* What stands in front ends at the first gap, of more than 0.05 pixels and a quarter of the shear
 * before it; rays that hit nothing see infinity, where the shear is -20 pixels or, in parallel
 * views, has no bounds. */
static void fronts_end_at_gaps(void **state)
{
    (void)state;
    cs_camera camera = {.focal_distance = 4.0f, .pixel_width = 0.01f, .aperture_width = 0.2f};
    const struct {
        float depths[4], front_px;
    } cases[] = {{{1.0f, 2.0f, 2.1f, 8.0f}, 60.0f},        /* 60, then 20 */
                 {{2.0f, 2.1f, 2.2f, 8.0f}, 18.1530f},     /* 20, 18.1, 16.4, then -10 */
                 {{2.0f, 2.1f, 2.2f, 2.3f}, INFINITY},     /* steps of 2 beside 20 */
                 {{2.0f, 2.1f, 2.2f, INFINITY}, 18.1530f}, /* -20 behind */
                 {{4.0f, 4.0f, 4.2f, 4.2f}, 0.0f},         /* 0, then -0.95 */
                 {{4.0f, 4.0f, 4.005f, 4.01f}, INFINITY},  /* 0, -0.025, -0.05 */
                 {{INFINITY, INFINITY, INFINITY, INFINITY}, INFINITY}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const cs_f32 front = cs_front_shear(&camera, 0.0f, 0.0f, cases[i].depths, 4);
        if (isfinite(cases[i].front_px))
            assert_near(front, cases[i].front_px, 1e-3f);
        else
            assert_true(isinf(front));
    }
    assert_true(isinf(cs_front_shear(&camera, 0.0f, 0.0f, NULL, 0)));
    camera.orthographic = 1;
    assert_near(cs_front_shear(&camera, 0.0f, 0.0f, cases[3].depths, 4), 9.5f, 1e-4f);
}

static void edges_take_the_front(void **state)
{
    (void)state;
    cs_depth depth = {2.0f, 1.0f, 2.0f, 8.0f, 0.0f, 60.0f};
    assert_int_equal(cs_oracle_rule(CLSHEAR_ORACLE_EDGE, &depth), CS_RULE_FRONT);
    assert_int_equal(cs_oracle_rule(CLSHEAR_ORACLE_FAR, &depth), CS_RULE_FAR);
    assert_int_equal(cs_oracle_rule(CLSHEAR_ORACLE_PILOT, &depth), CS_RULE_CENTRE);
    depth.front_px = INFINITY;
    assert_int_equal(cs_oracle_rule(CLSHEAR_ORACLE_EDGE, &depth), CS_RULE_CENTRE);
}

enum {
    SIDE = 64,
    PIXELS = SIDE * SIDE
};

static cs_f32 uniform(cs_u32 index)
{
    return (cs_f32)(cs_hash(index + 1u) >> 8) * 0x1p-24f;
}

/* The nearest depth has a third of the prior's variance on the left and three times it on the
 * right, under exponential noise, and the pilot sampled a quarter of the pixels. The farthest depth
 * is only slightly better, which is not clear enough. Windows hold 110 values: their mean has an
 * error of 10 %, so a wrong choice well inside either half is practically impossible. */
static void clear_evidence_decides(void **state)
{
    static cs_f32 prior[PIXELS], near[PIXELS], far[PIXELS];
    static uint8_t rules[PIXELS];
    cs_evidence evidence[CS_RULE_COUNT] = {{0}};
    cs_error error;
    (void)state;
    for (cs_u32 i = 0; i < PIXELS; i++) {
        const int looked = cs_hash(i ^ 77u) % 4u == 0u, left = i % SIDE < SIDE / 2;
        prior[i] = looked ? -logf(uniform(3 * i) + 1e-6f) : -1.0f;
        near[i] = looked ? -logf(uniform(3 * i + 1) + 1e-6f) * (left ? 0.33f : 3.0f) : -1.0f;
        far[i] = looked ? prior[i] * 0.95f : -1.0f;
    }
    evidence[CS_RULE_NEAR] = (cs_evidence){near, prior};
    evidence[CS_RULE_FAR] = (cs_evidence){far, prior};
    assert_int_equal(cs_pilot_choose(evidence, CS_RULE_CENTRE, SIDE, SIDE, 10, rules, &error),
                     CLSHEAR_OK);
    for (cs_u32 i = 0; i < PIXELS; i++) {
        const cs_u32 x = i % SIDE, y = i / SIDE;
        if (x < 10 || x >= SIDE - 10 || y < 10 || y >= SIDE - 10)
            continue; /* windows are cut off at the border */
        if (x < SIDE / 2 - 10) assert_int_equal(rules[i], CS_RULE_NEAR);
        if (x >= SIDE / 2 + 10) assert_int_equal(rules[i], CS_RULE_CENTRE);
    }
}

static void without_evidence_the_prior_stays(void **state)
{
    static cs_f32 nothing[PIXELS];
    static uint8_t rules[PIXELS];
    cs_evidence evidence[CS_RULE_COUNT] = {{0}};
    cs_error error;
    (void)state;
    for (cs_u32 i = 0; i < PIXELS; i++)
        nothing[i] = -1.0f;
    evidence[CS_RULE_NEAR] = (cs_evidence){nothing, nothing};
    assert_int_equal(cs_pilot_choose(evidence, CS_RULE_MEDIAN, SIDE, SIDE, 5, rules, &error),
                     CLSHEAR_OK);
    for (cs_u32 i = 0; i < PIXELS; i++)
        assert_int_equal(rules[i], CS_RULE_MEDIAN);
}

/* Pixels are certain that no reach covers, by definition, pixel by pixel: with reaches of no pixel,
 * of one or some, of all sizes up to beyond the window. */
static void nothing_reaches_certain_pixels(void **state)
{
    enum {
        WIDE = 37,
        HIGH = 23
    };
    static cs_f32 reach[WIDE * HIGH];
    static uint8_t certain[WIDE * HIGH];
    cs_error error;
    (void)state;
    for (cs_u32 round = 0; round < 40; round++) {
        const cs_f32 part = round == 0 ? 0.0f : 0.002f * (cs_f32)round;
        for (cs_u32 i = 0; i < WIDE * HIGH; i++)
            reach[i] = uniform(2 * i + 1000003 * round) < part
                           ? 50.0f * powf(uniform(2 * i + 1 + 1000003 * round), 4.0f)
                           : -1.0f;
        assert_int_equal(cs_mark_certain(reach, WIDE, HIGH, certain, &error), CLSHEAR_OK);
        for (int i = 0; i < WIDE * HIGH; i++) {
            int expected = 1;
            for (int k = 0; k < WIDE * HIGH; k++) {
                const int across = abs(i % WIDE - k % WIDE), along = abs(i / WIDE - k / WIDE);
                const int distance = across > along ? across : along;
                if (reach[k] >= (cs_f32)distance) expected = 0;
            }
            assert_int_equal(certain[i], expected);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(depth_becomes_shear),
        cmocka_unit_test(rules_take_their_depths),
        cmocka_unit_test(fronts_end_at_gaps),
        cmocka_unit_test(edges_take_the_front),
        cmocka_unit_test(clear_evidence_decides),
        cmocka_unit_test(without_evidence_the_prior_stays),
        cmocka_unit_test(nothing_reaches_certain_pixels),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
