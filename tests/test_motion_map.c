/* The maps of (pixel, lens, time) preserve measure and follow the fibres. */
#include "support.h"

#include <math.h>

#include "clshear/device/hash.h"
#include "clshear/device/motion.h"
#include "clshear/device/shutter.h"

static cs_f32 uniform(cs_u32 index, cs_u32 dimension)
{
    return (cs_f32)(cs_key(cs_key(991, index), dimension) >> 8) * 0x1p-24f;
}

typedef struct motion_case {
    cs_f32 shear;
    cs_velocity velocity;
} motion_case;

static const motion_case cases[] = {
    {0.0f, {8.0f, 3.0f}},    {0.0f, {-0.3f, 0.7f}}, {2.0f, {5.0f, -2.0f}},   {-2.0f, {2.0f, 9.0f}},
    {8.0f, {20.0f, 0.0f}},   {0.3f, {4.0f, 4.0f}},  {-9.0f, {0.0f, -3.0f}},  {30.0f, {-6.0f, 2.0f}},
    {1.0f, {0.01f, 0.004f}}, {2.0f, {0.0f, 0.0f}},  {5.0f, {100.0f, -37.0f}}};
enum {
    CASES = sizeof cases / sizeof *cases,
    APERTURES = 2
};

static cs_moving_sample mapped(const cs_f32 *tuple, cs_u32 aperture, const motion_case *at)
{
    static cs_optics_tables optics[APERTURES];
    if (optics[aperture].table.items == NULL) {
        const cs_view view = {.aperture = (clshear_aperture)aperture};
        optics[aperture] = test_optics(&view, CLSHEAR_FILTER_BOX, 0.0f);
    }
    const cs_camera_sample point = {tuple[0], tuple[1], tuple[2], tuple[3]};
    return cs_shear_moving(point, tuple[4], CS_SHEAR_EQUAL_AREA, &optics[aperture].optics,
                           optics[aperture].table.items, at->shear, at->velocity);
}

static cs_moving_sample random_sample(cs_u32 i, cs_u32 aperture, const motion_case *at)
{
    cs_f32 tuple[5];
    for (cs_u32 d = 0; d < 5; d++)
        tuple[d] = uniform(i, d);
    return mapped(tuple, aperture, at);
}

/* Light that a trapezoid has let in up to a time. */
static double let_in(double opening, double closing, double time)
{
    const double start = fmin(time, opening), end = fmax(time - (1.0 - closing), 0.0);
    const double risen = opening > 0.0 ? 0.5 * start * start / opening : 0.0;
    const double fallen = closing > 0.0 ? end - 0.5 * end * end / closing : end;
    return risen + fmin(fmax(time - opening, 0.0), 1.0 - closing - opening) + fallen;
}

/* As much light has come in before a time of the shutter as was asked for. */
static void times_follow_the_shutter(void **state)
{
    (void)state;
    static const cs_shutter shutters[] = {{0, 0}, {0.25f, 0.25f}, {0.5f, 0.5f}, {0, 1},
                                          {1, 0}, {0.1f, 0.6f},   {0.3f, 0}};
    for (size_t k = 0; k < sizeof shutters / sizeof *shutters; k++)
        for (int i = 0; i <= 1000; i++) {
            const cs_f32 part = (cs_f32)i / 1000.0f;
            const cs_f32 time = cs_shutter_time(part, shutters[k]);
            const double opening = (double)shutters[k].opening;
            const double closing = (double)shutters[k].closing;
            assert_true(time >= 0.0f && time <= 1.0f);
            assert_near(let_in(opening, closing, (double)time),
                        (double)part * let_in(opening, closing, 1.0), 2e-6);
        }
    assert_true(cs_shutter_time(0.3f, shutters[0]) == 0.3f);
}

/* Distribution of the sum of three boxes, in double precision. */
static double three_below(double a, double b, double c, double t)
{
    const double knots[8] = {0, a, b, c, a + b, a + c, b + c, a + b + c};
    const double signs[8] = {1, -1, -1, -1, 1, 1, 1, -1};
    double sum = 0.0;
    for (int i = 0; i < 8; i++)
        if (t > knots[i]) sum += signs[i] * pow(t - knots[i], 3.0);
    return sum / (6.0 * a * b * c);
}

/* Widths within 1 : 100 of each other: beyond that the reference itself loses digits. */
static void quantiles_invert_the_distribution(void **state)
{
    (void)state;
    for (cs_u32 i = 0; i < 20000; i++) {
        const cs_f32 a = expf(4.6f * (uniform(i, 0) - 0.5f)),
                     b = expf(4.6f * (uniform(i, 1) - 0.5f));
        const cs_f32 c = expf(4.6f * (uniform(i, 2) - 0.5f)), mass = uniform(i, 3);
        const cs_f32 t = cs_three_boxes_quantile(a, b, c, mass);
        assert_near(three_below((double)a, (double)b, (double)c, (double)t), mass, 4e-6);
        const cs_two_boxes two = cs_two_boxes_of(a, b);
        assert_near(cs_two_boxes_below(two, cs_two_boxes_quantile(two, mass)), mass, 1e-6);
    }
}

/* Everything stays in pixel, lens and shutter, at the ends too. */
static void samples_are_inside(void **state)
{
    (void)state;
    const cs_f32 ends[] = {0.0f, 1e-7f, 0.5f, 0.99999994f};
    for (cs_u32 aperture = 0; aperture < APERTURES; aperture++)
        for (int k = 0; k < CASES; k++)
            for (cs_u32 i = 0; i < 1024; i++) {
                const cs_f32 tuple[5] = {ends[i & 3], ends[i >> 2 & 3], ends[i >> 4 & 3],
                                         ends[i >> 6 & 3], ends[i >> 8]};
                const cs_moving_sample s = mapped(tuple, aperture, &cases[k]);
                const cs_camera_sample *p = &s.point;
                const cs_f32 radius = aperture == CLSHEAR_APERTURE_DISK
                                          ? sqrtf(p->u * p->u + p->v * p->v)
                                          : fmaxf(fabsf(p->u), fabsf(p->v));
                assert_true(p->x >= 0.0f && p->x < 1.0f && p->y >= 0.0f && p->y < 1.0f);
                assert_true(s.time >= 0.0f && s.time <= 1.0f);
                assert_at_most(radius, aperture == CLSHEAR_APERTURE_DISK ? 0.56420f : 0.50001f);
            }
}

/* The five coordinates as numbers in [0, 1] that are independent and uniform if measure is kept;
 * for a disk, u by its marginal and v by its place on the chord. */
static void uniforms(const cs_moving_sample *s, cs_u32 aperture, double *z)
{
    const double u = (double)s->point.u, v = (double)s->point.v;
    z[0] = (double)s->point.x;
    z[1] = (double)s->point.y;
    z[2] = u + 0.5;
    z[3] = v + 0.5;
    z[4] = (double)s->time;
    if (aperture != CLSHEAR_APERTURE_DISK) return;
    const double r = (double)CS_DISK_RADIUS, w = fmax(-1.0, fmin(1.0, u / r));
    const double chord = sqrt(fmax(r * r - u * u, 1e-12));
    z[2] = 0.5 + (w * sqrt(1.0 - w * w) + asin(w)) / 3.14159265358979;
    z[3] = 0.5 + 0.5 * v / chord;
}

/* Products of cosines of all pairs, and of each alone, have mean 0. 25 means of 200 000 independent
 * samples for each of 22 maps, |z| < 5.5: false alarms 4e-8 each, 2e-5 together. */
static void measure_is_kept(void **state)
{
    (void)state;
    const cs_u32 count = 200000;
    for (cs_u32 aperture = 0; aperture < APERTURES; aperture++)
        for (int k = 0; k < CASES; k++) {
            double sum[25] = {0};
            for (cs_u32 i = 0; i < count; i++) {
                double z[5];
                const cs_moving_sample s = random_sample(i, aperture, &cases[k]);
                uniforms(&s, aperture, z);
                int n = 0;
                for (int d = 0; d < 5; d++) {
                    const double wave = cos(6.28318530717959 * z[d]);
                    sum[n++] += sqrt(2.0) * wave;
                    sum[n++] += sqrt(12.0) * (z[d] - 0.5);
                    sum[n++] += sqrt(2.0) * (2.0 * wave * wave - 1.0);
                    for (int e = 0; e < d; e++)
                        sum[n++] += 12.0 * (z[d] - 0.5) * (z[e] - 0.5);
                }
            }
            for (int n = 0; n < 25; n++)
                assert_near(sum[n] / sqrt(count), 0.0, 5.5);
        }
}

/* Where the fibre is exact it does not move when the other three numbers do: without a lens, and
 * for motion along an axis with a square lens. */
static void fibres_are_followed(void **state)
{
    (void)state;
    for (int k = 0; k < CASES; k++) {
        const motion_case *at = &cases[k];
        if (at->shear != 0.0f && at->velocity.x != 0.0f && at->velocity.y != 0.0f) continue;
        for (cs_u32 i = 0; i < 2000; i++) {
            double t[2][2];
            for (cs_u32 j = 0; j < 2; j++) {
                const cs_f32 tuple[5] = {uniform(i, 0), uniform(i, 1), uniform(i, 2 + 3 * j),
                                         uniform(i, 3 + 3 * j), uniform(i, 4 + 3 * j)};
                const cs_moving_sample s = mapped(tuple, CLSHEAR_APERTURE_SQUARE, at);
                t[j][0] = (double)(s.point.x + at->shear * s.point.u - at->velocity.x * s.time);
                t[j][1] = (double)(s.point.y + at->shear * s.point.v - at->velocity.y * s.time);
            }
            assert_near(t[0][0], t[1][0], 1e-3);
            assert_near(t[0][1], t[1][1], 1e-3);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(times_follow_the_shutter),
        cmocka_unit_test(quantiles_invert_the_distribution),
        cmocka_unit_test(samples_are_inside),
        cmocka_unit_test(measure_is_kept),
        cmocka_unit_test(fibres_are_followed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
