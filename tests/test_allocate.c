/* How samples are shared out between pixels by their variance. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/device/hash.h"
#include "oracle/allocate.h"

enum {
    SIDE = 64,
    PIXELS = SIDE * SIDE
};

static cs_f32 uniform(cs_u32 index)
{
    return (cs_f32)(cs_hash(index + 1u) >> 8) * 0x1p-24f;
}

static const uint8_t none_certain[PIXELS];

/* A picture of 64 x 64 pixels, looked at by one pattern of 16 samples in each. */
typedef struct picture {
    cs_f32 variance[PIXELS];
    cs_f32 intensity[PIXELS];
    cs_u32 samples[PIXELS]; /* that are allocated */
} picture;

static cs_pilot_picture pilot_of(const picture *p, const uint8_t *certain)
{
    return (cs_pilot_picture){.variance = p->variance,
                              .intensity = p->intensity,
                              .near_variance = p->variance,
                              .near_intensity = p->intensity,
                              .certain = certain,
                              .width = SIDE,
                              .height = SIDE,
                              .pattern = 16,
                              .replicates = 1};
}

/* Shares samples out; returns their total. */
static double allocate(picture *p, const uint8_t *certain, cs_range range)
{
    double total = 0.0;
    cs_error error;
    const cs_pilot_picture pilot = pilot_of(p, certain);
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

/* The promised gain is what the plan makes of the picture, also by a look at a fourth of it; and
 * nothing where all pixels are alike, or without variance. */
static void the_gain_is_foretold(void **state)
{
    static picture p;
    const cs_range range = {4, 64, 1000, 1000, 1 << 20};
    const cs_pilot_picture pilot = pilot_of(&p, none_certain);
    double gain[3], even = 0.0, shared = 0.0;
    cs_error error;
    (void)state;
    for (int look = 0; look < 3; look++) {
        for (cs_u32 i = 0; i < PIXELS; i++) {
            const int is_seen = look < 2 || (i % SIDE % 6 < 3 && i / SIDE % 6 < 3);
            p.variance[i] = look == 0 ? 1.0f : !is_seen ? -1.0f : in_block(i) ? 1.0f : 1e-3f;
            p.intensity[i] = 1.0f;
        }
        assert_int_equal(cs_allocate_gain(&pilot, &range, &gain[look], &error), CLSHEAR_OK);
        if (look != 1) continue;
        allocate(&p, none_certain, range);
        for (cs_u32 i = 0; i < PIXELS; i++) {
            even += (double)p.variance[i] * pow(1000.0, -1.4);
            shared += (double)p.variance[i] * pow(p.samples[i], -1.4);
        }
    }
    print_message("gain %.3f, %.3f of %.3f, by a fourth %.3f\n", gain[0], gain[1], even / shared,
                  gain[2]);
    assert_near(gain[0], 1.0, 1e-6);
    assert_near(gain[1], even / shared, 0.05 * gain[1]); /* the block's rim is smoothed */
    assert_above(gain[1], 3.0);
    assert_near(gain[2], gain[1], 0.3 * gain[1]);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(allocation_keeps_limits),
        cmocka_unit_test(samples_follow_variance),
        cmocka_unit_test(the_gain_is_foretold),
        cmocka_unit_test(certain_pixels_give),
        cmocka_unit_test(only_a_gain_lowers_bright_pixels),
        cmocka_unit_test(neither_error_rises),
        cmocka_unit_test(contrast_gets_samples),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
