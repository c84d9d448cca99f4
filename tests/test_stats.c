/* Running moments equal those of the whole batch. */
#include "support.h"

#include <math.h>

#include "clshear/device/hash.h"
#include "clshear/device/stats.h"

enum {
    COUNT = 5000
};

static void fill(cs_f32 *values, cs_f32 offset)
{
    for (cs_u32 i = 0; i < COUNT; i++)
        values[i] = offset + (cs_f32)(cs_key(5, i) >> 8) * (1.0f / 16777216.0f);
}

static void batch(const cs_f32 *values, double *mean, double *m2)
{
    *mean = *m2 = 0.0;
    for (int i = 0; i < COUNT; i++)
        *mean += (double)values[i] / COUNT;
    for (int i = 0; i < COUNT; i++)
        *m2 += pow((double)values[i] - *mean, 2);
}

static void adding_equals_the_batch(void **state)
{
    (void)state;
    cs_f32 values[COUNT];
    double mean, m2;
    const cs_f32 offsets[] = {0.0f, 100.0f};
    for (int k = 0; k < 2; k++) {
        cs_moments moments = {0};
        fill(values, offsets[k]);
        batch(values, &mean, &m2);
        for (int i = 0; i < COUNT; i++)
            moments = cs_moments_add(moments, values[i]);
        assert_near(moments.count, COUNT, 0);
        assert_near(moments.mean, mean, 2e-5 * (1.0 + offsets[k]));
        assert_near(moments.m2 / m2, 1.0, 2e-3);
    }
}

static void merging_equals_the_batch(void **state)
{
    (void)state;
    cs_f32 values[COUNT];
    double mean, m2;
    fill(values, 3.0f);
    batch(values, &mean, &m2);
    cs_moments whole = {0};
    for (int first = 0; first < COUNT;) {
        cs_moments part = {0};
        int size = 1 + first % 97;
        for (int i = first; i < first + size && i < COUNT; i++)
            part = cs_moments_add(part, values[i]);
        whole = cs_moments_merge(whole, part);
        first += size;
    }
    assert_near(whole.count, COUNT, 0);
    assert_near(whole.mean, mean, 1e-5);
    assert_near(whole.m2 / m2, 1.0, 1e-4);
}

static void empty_sets_change_nothing(void **state)
{
    (void)state;
    const cs_moments none = {0}, some = {3.0f, 2.0f, 5.0f};
    cs_moments left = cs_moments_merge(none, some), right = cs_moments_merge(some, none);
    assert_memory_equal(&left, &some, sizeof some);
    assert_memory_equal(&right, &some, sizeof some);
    assert_near(cs_moments_merge(none, none).count, 0.0f, 0);
}

/* Sums a million small terms and a large one. A plain float sum would lose all of them. */
static void exact_sums_lose_nothing(void **state)
{
    (void)state;
    cs_exact_sum total = {1e7f, 0.0f};
    cs_f32 plain = 1e7f;
    for (int i = 0; i < 1000000; i++) {
        total = cs_exact_add(total, 0.01f);
        plain += 0.01f;
    }
    double expected = 1e7 + 1e6 * (double)0.01f;
    assert_near((double)total.sum + (double)total.carry, expected, 1e-2);
    assert_above(fabs((double)plain - expected), 1e3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(adding_equals_the_batch),
        cmocka_unit_test(merging_equals_the_batch),
        cmocka_unit_test(empty_sets_change_nothing),
        cmocka_unit_test(exact_sums_lose_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
