/* The oracle without tracing: shear from depth, rules from evidence, sample counts from
 * variance. */
#include "support.h"

#include <math.h>

#include "clshear/device/hash.h"
#include "clshear/device/lens.h"
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
        const cs_depth depth = {z[i], z[i], z[i], z[i], isfinite(z[i]) ? 0.0f : 1.0f};
        for (int rule = CS_RULE_CENTRE; rule <= CS_RULE_FAR; rule++)
            assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, (cs_rule)rule), expected[i],
                        1e-4f);
        assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, CS_RULE_NONE), 0.0f, 0);
    }
}

/* Every rule takes its own depth. The centre takes the median if its ray hits nothing. */
static void rules_take_their_depths(void **state)
{
    (void)state;
    const cs_camera camera = {.focal_distance = 4.0f, .pixel_width = 0.01f, .aperture_width = 0.2f};
    cs_depth depth = {2.0f, 1.0f, 4.0f, 8.0f, 0.5f};
    const float expected[CS_RULE_COUNT] = {20.0f, 0.0f, 60.0f, -10.0f, 0.0f, 20.0f, 0.0f};
    for (int rule = 0; rule < CS_RULE_COUNT; rule++)
        assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, (cs_rule)rule), expected[rule],
                    1e-4f);
    depth.centre = INFINITY;
    assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, CS_RULE_CENTRE), 0.0f, 0);
    depth.median = 1.0f;
    assert_near(cs_oracle_shear(&camera, 0.0f, 0.0f, &depth, CS_RULE_CENTRE), 60.0f, 1e-4f);
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

static const cs_f32 still[PIXELS]; /* shears of a picture in focus */

/* Allocation keeps the total and the limits, and more variance gets more samples: a block of pixels
 * with 1000 times the variance gets about 1000^0.4 = 16 times the samples. */
static void samples_follow_variance(void **state)
{
    static cs_f32 variance[PIXELS], intensity[PIXELS];
    static cs_u32 samples[PIXELS];
    double total = 0.0;
    cs_error error;
    (void)state;
    for (cs_u32 i = 0; i < PIXELS; i++) {
        const int block = i % SIDE >= 20 && i % SIDE < 32 && i / SIDE >= 20 && i / SIDE < 32;
        variance[i] = block ? 1.0f : 1e-3f;
        intensity[i] = 1.0f;
    }
    const cs_pilot_picture pilot = {variance, intensity, variance, intensity, still,
                                    SIDE,     SIDE,      16,       4};
    assert_int_equal(cs_allocate_samples(&pilot, &(cs_range){64, 1000, 1 << 20}, samples, &error),
                     CLSHEAR_OK);
    for (cs_u32 i = 0; i < PIXELS; i++) {
        total += samples[i];
        assert_int_equal(samples[i] & (samples[i] - 1), 0);
        assert_at_least(samples[i], 64);
        assert_at_most(samples[i], 16000);
    }
    assert_at_most(total, 1000.0 * PIXELS);
    assert_above(total, 500.0 * PIXELS);
    const cs_u32 inside = samples[26 * SIDE + 26], outside = samples[5 * SIDE + 5];
    assert_int_equal(inside, 16 * outside);
}

/* With one dominant pixel, the sampler's largest pattern is the limit, and the mean is not
 * exceeded, however small it is. */
static void allocation_keeps_limits(void **state)
{
    static const struct {
        cs_range range;
        cs_u32 most;
    } cases[] = {{{1, 1, 1 << 20}, 1},           {{2, 2, 1 << 20}, 2},
                 {{2, 3, 1 << 20}, 32},          {{8, 100, 1 << 20}, 1024},
                 {{8192, 100000, 65536}, 65536}, {{1 << 16, 1 << 20, 1 << 20}, 1 << 20}};
    static cs_f32 variance[PIXELS], intensity[PIXELS];
    static cs_u32 samples[PIXELS];
    cs_error error;
    (void)state;
    variance[PIXELS / 2] = 1.0f;
    const cs_pilot_picture pilot = {variance, intensity, variance, intensity, still,
                                    SIDE,     SIDE,      16,       4};
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        double total = 0.0;
        assert_int_equal(cs_allocate_samples(&pilot, &cases[c].range, samples, &error), CLSHEAR_OK);
        for (cs_u32 i = 0; i < PIXELS; i++) {
            total += samples[i];
            assert_at_least(samples[i], cases[c].range.least);
            assert_at_most(samples[i], cases[c].most);
        }
        assert_at_most(total, (double)cases[c].range.mean * PIXELS);
        assert_int_equal(samples[0], cases[c].range.least);
        assert_int_equal(samples[PIXELS / 2], cases[c].most);
    }
}

/* A pilot with an edge between two columns, but no variance in either, still allocates samples to
 * the edge. */
static void contrast_gets_samples(void **state)
{
    static cs_f32 variance[PIXELS], intensity[PIXELS];
    static cs_u32 samples[PIXELS];
    cs_error error;
    (void)state;
    for (cs_u32 i = 0; i < PIXELS; i++) {
        variance[i] = 1e-7f;
        intensity[i] = i % SIDE < SIDE / 2 ? 0.2f : 1.0f;
    }
    const cs_pilot_picture pilot = {variance, intensity, variance, intensity, still,
                                    SIDE,     SIDE,      16,       4};
    assert_int_equal(cs_allocate_samples(&pilot, &(cs_range){64, 1000, 1 << 20}, samples, &error),
                     CLSHEAR_OK);
    for (cs_u32 y = 0; y < SIDE; y++) {
        const cs_u32 *row = samples + y * SIDE;
        assert_at_least(row[SIDE / 2 - 1], 8 * row[SIDE / 2 - 2]);
        assert_at_least(row[SIDE / 2], 8 * row[SIDE / 2 + 1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(depth_becomes_shear),
                                       cmocka_unit_test(rules_take_their_depths),
                                       cmocka_unit_test(clear_evidence_decides),
                                       cmocka_unit_test(without_evidence_the_prior_stays),
                                       cmocka_unit_test(allocation_keeps_limits),
                                       cmocka_unit_test(samples_follow_variance),
                                       cmocka_unit_test(contrast_gets_samples)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
