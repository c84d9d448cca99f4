/* The exact maps of a disk or a square and time to their fibres. */
#include "support.h"

#include <math.h>

#include "clshear/device/disk_time.h"
#include "clshear/device/hash.h"

static cs_f32 uniform(cs_u32 index, cs_u32 dimension)
{
    return (cs_f32)(cs_key(cs_key(404, index), dimension) >> 8) * 0x1p-24f;
}

/* How far a shape of area 1 moves while the shutter is open, in its own unit. */
static const cs_f32 rates[][2] = {{0.016f, 0.01f}, {0.1f, 0.1f}, {0.5f, 0.2f},  {1.0f, 0.0f},
                                  {1.0f, 1.0f},    {3.0f, 2.0f}, {20.0f, 3.0f}, {100.0f, 99.0f}};
enum {
    RATES = sizeof rates / sizeof *rates
};

/* Third numbers do not move the fibre, beyond rounding. */
static void the_first_two_fix_the_fibre(void **state)
{
    (void)state;
    for (int k = 0; k < RATES; k++)
        for (cs_u32 i = 0; i < 20000; i++) {
            const cs_f32 a = uniform(i, 0), b = uniform(i, 1), x = rates[k][0], y = rates[k][1];
            for (int shape = 0; shape < 2; shape++) {
                cs_timed_place p[2];
                for (cs_u32 j = 0; j < 2; j++)
                    p[j] = shape == 0 ? cs_disk_and_time(a, b, uniform(i, 2 + j), x, y)
                                      : cs_square_and_time(a, b, uniform(i, 2 + j), x, y);
                const double tolerance = 1e-6 * (1.0 + (double)x);
                assert_near(p[0].x + x * p[0].time, p[1].x + x * p[1].time, tolerance);
                assert_near(p[0].y + y * p[0].time, p[1].y + y * p[1].time, tolerance);
            }
        }
}

/* Length of the chord of the disk along v at u, and the part of it below a line. */
static double chord_at(double u, double line, double *below)
{
    const double radius = (double)CS_DISK_RADIUS;
    const double chord = sqrt(fmax(radius * radius - u * u, 0.0));
    *below = fmin(fmax(line + chord, 0.0), 2.0 * chord);
    return 2.0 * chord;
}

/* P(U + x T < p), and P(V + y T < q | U + x T = p), by the middles of 20 000 steps of u: T takes
 * the rest. */
static void shares_of(double p, double q, double x, double y, double *first, double *second)
{
    const int steps = 20000;
    const double radius = (double)CS_DISK_RADIUS;
    double mass = 0.0, below = 0.0, total = 0.0, part;
    for (int i = 0; i < steps; i++) {
        const double u = radius * (2.0 * (i + 0.5) / steps - 1.0);
        mass += chord_at(u, 0.0, &part) * fmin(fmax((p - u) / x, 0.0), 1.0);
    }
    *first = mass * 2.0 * radius / steps;
    const double low = fmax(p - x, -radius), high = fmin(p, radius);
    for (int i = 0; i < steps; i++) {
        const double u = low + (high - low) * (i + 0.5) / steps;
        total += chord_at(u, q - y * (p - u) / x, &part);
        below += part;
    }
    *second = below / total;
}

/* The fibre is the pair of quantiles: the first number's, and the second's given the first. The
 * error of the integrals is below 1e-6 but for slabs that end within 1e-3 of the disk's edge. */
static void the_fibre_of_the_disk_is_a_quantile(void **state)
{
    (void)state;
    for (int k = 0; k < RATES; k++)
        for (cs_u32 i = 0; i < 100; i++) {
            const cs_f32 a = 0.01f + 0.98f * uniform(i, 3), b = 0.001f + 0.998f * uniform(i, 4);
            const cs_timed_place at =
                cs_disk_and_time(a, b, uniform(i, 5), rates[k][0], rates[k][1]);
            double first, second;
            const double x = (double)rates[k][0], y = (double)rates[k][1];
            shares_of((double)at.x + x * (double)at.time, (double)at.y + y * (double)at.time, x, y,
                      &first, &second);
            assert_near(first, a, 1e-5);
            assert_near(second, b, 3e-5);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_two_fix_the_fibre),
        cmocka_unit_test(the_fibre_of_the_disk_is_a_quantile),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
