/* The oracle without tracing: shear from depth, rules from evidence, sample counts from
 * variance. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "accel/front.h"
#include "clshear/device/hash.h"
#include "clshear/device/lens.h"
#include "oracle/allocate.h"
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

static const uint8_t none_certain[PIXELS];

/* A picture of 64 x 64 pixels, looked at by one pattern of 16 samples in each. */
typedef struct picture {
    cs_f32 variance[PIXELS];
    cs_f32 intensity[PIXELS];
    cs_u32 samples[PIXELS]; /* that are allocated */
} picture;

/* Shares samples out; returns their total. */
static double allocate(picture *p, const uint8_t *certain, cs_range range)
{
    double total = 0.0;
    cs_error error;
    const cs_pilot_picture pilot = {.variance = p->variance,
                                    .intensity = p->intensity,
                                    .near_variance = p->variance,
                                    .near_intensity = p->intensity,
                                    .certain = certain,
                                    .width = SIDE,
                                    .height = SIDE,
                                    .pattern = 16,
                                    .replicates = 1};
    assert_int_equal(cs_allocate_samples(&pilot, &range, p->samples, &error), CLSHEAR_OK);
    for (size_t i = 0; i < PIXELS; i++)
        total += p->samples[i];
    return total;
}

static int in_block(cs_u32 i)
{
    return i % SIDE >= 20 && i % SIDE < 32 && i / SIDE >= 20 && i / SIDE < 32;
}

/* Allocation keeps the total and the limits, and more variance gets more samples: a block of pixels
 * with 1000 times the variance gets about 1000^0.4 = 16 times the samples, where the limits allow
 * it. */
static void samples_follow_variance(void **state)
{
    static picture p;
    (void)state;
    for (cs_u32 i = 0; i < PIXELS; i++) {
        p.variance[i] = in_block(i) ? 1.0f : 1e-3f;
        p.intensity[i] = 1.0f;
    }
    const double total = allocate(&p, none_certain, (cs_range){4, 64, 1000, 1000, 1 << 20});
    for (cs_u32 i = 0; i < PIXELS; i++) {
        assert_int_equal(p.samples[i] & (p.samples[i] - 1), 0);
        assert_at_least(p.samples[i], 64);
        assert_at_most(p.samples[i], 16000);
    }
    assert_at_most(total, 1000.0 * PIXELS);
    assert_above(total, 500.0 * PIXELS);
    assert_int_equal(p.samples[26 * SIDE + 26], 16 * p.samples[5 * SIDE + 5]);
}

/* What certain pixels leave goes to the others, by their variance. No pixel that is not certain has
 * less than the mean, so no picture is worse than with equal samples. */
static void certain_pixels_give(void **state)
{
    static picture p;
    static uint8_t certain[PIXELS];
    (void)state;
    for (cs_u32 i = 0; i < PIXELS; i++) {
        certain[i] = i / SIDE < SIDE / 2;
        p.variance[i] = certain[i] ? 0.0f : i % SIDE < SIDE / 2 ? 1e-4f : 1e-3f;
        p.intensity[i] = certain[i] ? 0.0f : 0.01f;
    }
    /* One bright pixel: all others are dark. */
    p.intensity[PIXELS - 1] = 1e4f;
    const double total = allocate(&p, certain, (cs_range){2, 16, 100, 100, 1 << 20});
    for (cs_u32 i = 0; i < PIXELS; i++)
        if (certain[i])
            assert_int_equal(p.samples[i], 2);
        else
            assert_at_least(p.samples[i], 100);
    assert_at_most(total, 100.0 * PIXELS);
    assert_above(total, 80.0 * PIXELS);
    assert_above(p.samples[50 * SIDE + 50], p.samples[50 * SIDE + 10]);
}

/* Where all pixels are alike, nothing is gained by less in some: all have the mean. Where some are
 * bright and much quieter, they give down to their limit, and dark ones still do not. */
static void only_a_gain_lowers_bright_pixels(void **state)
{
    static picture p;
    (void)state;
    for (cs_u32 i = 0; i < PIXELS; i++)
        p.variance[i] = 1e-3f * (1.0f + 0.2f * uniform(i)), p.intensity[i] = 1.0f;
    allocate(&p, none_certain, (cs_range){2, 16, 50, 50, 1 << 20});
    for (cs_u32 i = 0; i < PIXELS; i++)
        assert_int_equal(p.samples[i], 50);
    for (cs_u32 i = 0; i < PIXELS; i++) {
        const cs_u32 third = i / SIDE / 22; /* noisy, quiet and bright, quiet and dark */
        p.variance[i] = third == 0 ? 1.0f : 1e-7f;
        p.intensity[i] = third == 2 ? 1e-3f : 1.0f;
    }
    allocate(&p, none_certain, (cs_range){2, 16, 50, 50, 1 << 20});
    for (cs_u32 x = 0; x < SIDE; x++) {
        assert_above(p.samples[10 * SIDE + x], 50);
        assert_int_equal(p.samples[33 * SIDE + x], 16);
        assert_at_least(p.samples[55 * SIDE + x], 50);
    }
}

/* Noise of its own in every pixel, and dark stripes whose relative error is great: what these would
 * gain costs absolute error. Neither error rises, if variance falls as N^-1.4. */
static void neither_error_rises(void **state)
{
    static picture p;
    double absolute[2] = {0}, relative[2] = {0};
    (void)state;
    for (cs_u32 i = 0; i < PIXELS; i++) {
        const int is_dark = i / SIDE % 16 < 3;
        p.intensity[i] = is_dark ? 0.01f : 1.0f;
        p.variance[i] = (is_dark ? 1e-4f : 1e-3f) * (0.5f + uniform(i));
    }
    allocate(&p, none_certain, (cs_range){2, 16, 64, 64, 1 << 20});
    for (size_t i = 0; i < PIXELS; i++) {
        const double v = (double)p.variance[i], square = (double)p.intensity[i] * p.intensity[i];
        const double left = pow(p.samples[i] / 64.0, -1.4);
        absolute[0] += v, absolute[1] += v * left;
        relative[0] += v / square, relative[1] += v / square * left;
    }
    printf("%g of the absolute error, %g of the relative\n", absolute[1] / absolute[0],
           relative[1] / relative[0]);
    assert_at_most(absolute[1], 1.02 * absolute[0]);
    assert_at_most(relative[1], 1.02 * relative[0]);
}

/* With one dominant pixel, the sampler's largest pattern is the limit, and the mean is not
 * exceeded, however small it is. The others are quiet: they have the least where that lets the
 * dominant pixel have more. */
static void allocation_keeps_limits(void **state)
{
    static const struct {
        cs_range range;
        cs_u32 most;
        cs_u32 quiet;
    } cases[] = {{{1, 1, 1, 1, 1 << 20}, 1, 1},
                 {{2, 2, 2, 2, 1 << 20}, 2, 2},
                 {{2, 2, 3, 3, 1 << 20}, 32, 2},
                 {{2, 8, 100, 100, 1 << 20}, 1024, 8},
                 {{512, 8192, 65536, 100000, 65536}, 65536, 65536},
                 {{1 << 12, 1 << 16, 1 << 20, 1 << 20, 1 << 20}, 1 << 20, 1 << 20}};
    static picture p;
    (void)state;
    for (cs_u32 i = 0; i < PIXELS; i++)
        p.intensity[i] = 1.0f;
    p.variance[PIXELS / 2] = 1.0f;
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        const double total = allocate(&p, none_certain, cases[c].range);
        for (cs_u32 i = 0; i < PIXELS; i++) {
            assert_at_least(p.samples[i], cases[c].range.least);
            assert_at_most(p.samples[i], cases[c].most);
        }
        assert_at_most(total, (double)cases[c].range.mean * PIXELS);
        assert_int_equal(p.samples[0], cases[c].quiet);
        assert_int_equal(p.samples[PIXELS / 2], cases[c].most);
    }
}

/* A pilot with an edge between two columns, but no variance in either, still allocates samples to
 * the edge. */
static void contrast_gets_samples(void **state)
{
    static picture p;
    (void)state;
    for (cs_u32 i = 0; i < PIXELS; i++) {
        p.variance[i] = 1e-7f;
        p.intensity[i] = i % SIDE < SIDE / 2 ? 0.5f : 1.0f;
    }
    allocate(&p, none_certain, (cs_range){4, 64, 1000, 1000, 1 << 20});
    for (cs_u32 y = 0; y < SIDE; y++) {
        const cs_u32 *row = p.samples + y * SIDE;
        assert_at_least(row[SIDE / 2 - 1], 8 * row[SIDE / 2 - 2]);
        assert_at_least(row[SIDE / 2], 8 * row[SIDE / 2 + 1]);
    }
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
    const struct CMUnitTest tests[] = {cmocka_unit_test(depth_becomes_shear),
                                       cmocka_unit_test(rules_take_their_depths),
                                       cmocka_unit_test(fronts_end_at_gaps),
                                       cmocka_unit_test(edges_take_the_front),
                                       cmocka_unit_test(clear_evidence_decides),
                                       cmocka_unit_test(without_evidence_the_prior_stays),
                                       cmocka_unit_test(allocation_keeps_limits),
                                       cmocka_unit_test(samples_follow_variance),
                                       cmocka_unit_test(certain_pixels_give),
                                       cmocka_unit_test(only_a_gain_lowers_bright_pixels),
                                       cmocka_unit_test(neither_error_rises),
                                       cmocka_unit_test(nothing_reaches_certain_pixels),
                                       cmocka_unit_test(contrast_gets_samples)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
