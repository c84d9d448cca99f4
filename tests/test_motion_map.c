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
    CASES = sizeof cases / sizeof *cases
};

/* The chain has the first, other maps the rest. */
static const struct {
    cs_view view;
    clshear_filter filter;
} lenses[] = {
    {{.aperture = CLSHEAR_APERTURE_SQUARE}, CLSHEAR_FILTER_BOX},
    {{.aperture = CLSHEAR_APERTURE_DISK}, CLSHEAR_FILTER_BOX},
    {{.aperture = CLSHEAR_APERTURE_POLYGON, .blades = 6, .blade_rotation_deg = 10.0f},
     CLSHEAR_FILTER_BOX},
    {{.aperture = CLSHEAR_APERTURE_POLYGON, .blades = 3, .anamorphic = 1.7f}, CLSHEAR_FILTER_TENT},
    {{.aperture = CLSHEAR_APERTURE_DISK, .anamorphic = 2.0f}, CLSHEAR_FILTER_GAUSSIAN},
    {{.aperture = CLSHEAR_APERTURE_SQUARE}, CLSHEAR_FILTER_TENT},
};
enum {
    LENSES = sizeof lenses / sizeof *lenses,
    SQUARE = 0
};

static const cs_optics_tables *optics_of(cs_u32 lens)
{
    static cs_optics_tables optics[LENSES];
    if (optics[lens].table.items == NULL)
        optics[lens] = test_optics(&lenses[lens].view, lenses[lens].filter, 0.0f);
    return &optics[lens];
}

static cs_moving_sample mapped(const cs_f32 *tuple, cs_u32 lens, const motion_case *at)
{
    const cs_optics_tables *optics = optics_of(lens);
    const cs_camera_sample point = {tuple[0], tuple[1], tuple[2], tuple[3]};
    return cs_shear_moving(point, tuple[4], CS_SHEAR_EQUAL_AREA, &optics->optics,
                           optics->table.items, at->shear, at->velocity);
}

static cs_moving_sample random_sample(cs_u32 i, cs_u32 lens, const motion_case *at)
{
    cs_f32 tuple[5];
    for (cs_u32 d = 0; d < 5; d++)
        tuple[d] = uniform(i, d);
    return mapped(tuple, lens, at);
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

/* Widths within 1 : 270 of each other, beyond the limit of the chain. */
static void quantiles_invert_the_distribution(void **state)
{
    (void)state;
    for (cs_u32 i = 0; i < 20000; i++) {
        const cs_f32 a = expf(5.6f * (uniform(i, 0) - 0.5f)),
                     b = expf(5.6f * (uniform(i, 1) - 0.5f));
        const cs_f32 c = expf(5.6f * (uniform(i, 2) - 0.5f)), mass = uniform(i, 3);
        const cs_f32 t = cs_three_boxes_quantile(a, b, c, mass);
        assert_near(three_below((double)a, (double)b, (double)c, (double)t), mass, 4e-6);
        const cs_two_boxes two = cs_two_boxes_of(a, b);
        assert_near(cs_two_boxes_below(two, cs_two_boxes_quantile(two, mass)), mass, 1e-6);
    }
}

/* By how much (u, v) is outside of a lens, in lens units; below 0 inside. */
static double outside(const cs_optics_tables *optics, double u, double v)
{
    if (optics->optics.marginal == CS_MARGINAL_DISK) return hypot(u, v) - (double)CS_DISK_RADIUS;
    if (optics->optics.marginal == CS_MARGINAL_UNIFORM) return fmax(fabs(u), fabs(v)) - 0.5;
    const cs_marginal across = cs_marginal_across(&optics->optics, optics->table.items);
    const cs_chord chord = cs_chord_at(&optics->optics, optics->table.items, &across, (cs_f32)u);
    const double beyond = fmax((double)across.low - u, u - (double)across.high);
    return fmax(beyond, fabs(v - (double)chord.centre) - 0.5 * (double)chord.length);
}

/* Everything stays in pixel, lens and shutter, at the ends too. */
static void samples_are_inside(void **state)
{
    (void)state;
    const cs_f32 ends[] = {0.0f, 1e-7f, 0.5f, 0.99999994f};
    for (cs_u32 lens = 0; lens < LENSES; lens++)
        for (int k = 0; k < CASES; k++)
            for (cs_u32 i = 0; i < 3072; i++) {
                const cs_f32 tuple[5] = {ends[i & 3], ends[i >> 2 & 3], ends[i >> 4 & 3],
                                         ends[i >> 6 & 3], ends[i >> 8 & 3]};
                const cs_moving_sample s =
                    i < 1024 ? mapped(tuple, lens, &cases[k]) : random_sample(i, lens, &cases[k]);
                const cs_camera_sample *p = &s.point;
                const double reach = 0.5 * (double)optics_of(lens)->optics.filter_width;
                assert_at_most(fabs((double)p->x - 0.5), reach);
                assert_at_most(fabs((double)p->y - 0.5), reach);
                assert_true(reach > 0.5 || (p->x < 1.0f && p->y < 1.0f));
                assert_true(s.time >= 0.0f && s.time <= 1.0f);
                assert_at_most(outside(optics_of(lens), (double)p->u, (double)p->v), 1e-5);
            }
}

/* The part of a filter's mass that is left of x, pixels from the pixel's centre. */
static double filter_below(const cs_optics_tables *optics, double x)
{
    const cs_u32 steps = optics->optics.filter_steps;
    const double width = (double)optics->optics.filter_width, step = width / steps;
    const cs_f32 *density = optics->table.items;
    double mass = 0.0;
    for (cs_u32 k = 0; k < steps; k++) {
        const double inside = fmin(fmax(x + 0.5 * width - k * step, 0.0), step);
        mass += inside * (steps == 1 ? 1.0 / width : (double)density[k]);
    }
    return mass;
}

/* The five coordinates as numbers in [0, 1] that are independent and uniform if measure is kept: x
 * and y by the filter, u by its marginal, v by its place on the chord. */
static void uniforms(const cs_moving_sample *s, cs_u32 lens, double *z)
{
    const cs_optics_tables *tables = optics_of(lens);
    const cs_marginal across = cs_marginal_across(&tables->optics, tables->table.items);
    const cs_chord chord = cs_chord_at(&tables->optics, tables->table.items, &across, s->point.u);
    z[0] = filter_below(tables, (double)s->point.x - 0.5);
    z[1] = filter_below(tables, (double)s->point.y - 0.5);
    z[2] = (double)cs_marginal_at(&across, s->point.u).below;
    z[3] = 0.5 + (double)((s->point.v - chord.centre) / fmaxf(chord.length, 1e-6f));
    z[4] = (double)s->time;
}

/* Products of cosines of all pairs, and of each alone, have mean 0. 25 means of 200 000 independent
 * samples for each of 66 maps, |z| < 5.5: false alarms 4e-8 each, 6e-5 together. */
static void measure_is_kept(void **state)
{
    (void)state;
    const cs_u32 count = 200000;
    for (cs_u32 lens = 0; lens < LENSES; lens++)
        for (int k = 0; k < CASES; k++) {
            double sum[25] = {0};
            for (cs_u32 i = 0; i < count; i++) {
                double z[5];
                const cs_moving_sample s = random_sample(i, lens, &cases[k]);
                uniforms(&s, lens, z);
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

/* Chi-square of three of the coordinates on 6 x 6 x 6 cells of equal probability. */
static double chi_square(double (*z)[5], cs_u32 count, const int *axes)
{
    double hits[216] = {0}, chi = 0.0;
    for (cs_u32 i = 0; i < count; i++) {
        int cell = 0;
        for (int d = 0; d < 3; d++)
            cell = 6 * cell + (int)fmin(fmax(z[i][axes[d]] * 6.0, 0.0), 5.0);
        hits[cell]++;
    }
    for (int i = 0; i < 216; i++)
        chi += pow(hits[i] - count / 216.0, 2) / (count / 216.0);
    return chi;
}

/* Film, lens and time stay independent and uniform, not only in their moments. 215 degrees of
 * freedom: a chi-square above 360 has the probability 3e-9 (5.9 deviations by Wilson and
 * Hilferty's cube root), once in the 264 below 1e-6. */
static void film_lens_and_time_stay_independent(void **state)
{
    (void)state;
    enum {
        COUNT = 100000
    };
    static const int axes[4][3] = {{0, 2, 4}, {1, 3, 4}, {0, 3, 4}, {0, 1, 4}};
    static double z[COUNT][5];
    for (cs_u32 lens = 0; lens < LENSES; lens++)
        for (int k = 0; k < CASES; k++) {
            for (cs_u32 i = 0; i < COUNT; i++) {
                const cs_moving_sample s = random_sample(i + 5000000u, lens, &cases[k]);
                uniforms(&s, lens, z[i]);
            }
            for (int n = 0; n < 4; n++)
                assert_below(chi_square(z, COUNT, axes[n]), 360.0);
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
                const cs_moving_sample s = mapped(tuple, SQUARE, at);
                t[j][0] = (double)(s.point.x + at->shear * s.point.u - at->velocity.x * s.time);
                t[j][1] = (double)(s.point.y + at->shear * s.point.v - at->velocity.y * s.time);
            }
            assert_near(t[0][0], t[1][0], 1e-3);
            assert_near(t[0][1], t[1][1], 1e-3);
        }
    }
}

/* Half the mean square of what a change of the other three numbers moves the fibre by, px^2, of
 * both axes. */
static double fibre_moves(cs_u32 lens, const motion_case *at, cs_u32 mode)
{
    const cs_optics_tables *optics = optics_of(lens);
    const cs_u32 count = 4000;
    double square = 0.0;
    for (cs_u32 i = 0; i < count; i++) {
        double t[2][2];
        for (cs_u32 j = 0; j < 2; j++) {
            const cs_camera_sample tuple = {uniform(i, 0), uniform(i, 1), uniform(i, 2 + 3 * j),
                                            uniform(i, 3 + 3 * j)};
            const cs_moving_sample s =
                cs_shear_moving(tuple, uniform(i, 4 + 3 * j), mode, &optics->optics,
                                optics->table.items, at->shear, at->velocity);
            t[j][0] = (double)(s.point.x + at->shear * optics->optics.squeeze * s.point.u -
                               at->velocity.x * s.time);
            t[j][1] = (double)(s.point.y + at->shear * s.point.v - at->velocity.y * s.time);
        }
        square += pow(t[0][0] - t[1][0], 2) + pow(t[0][1] - t[1][1], 2);
    }
    return 0.5 * square / count;
}

/* With chords, the other three numbers move the fibre by little, for any blur and motion: wider
 * filters more, because their boxes differ in width. */
static void chords_nearly_keep_the_fibre(void **state)
{
    static const double most[LENSES] = {0.0, 0.02, 0.02, 0.15, 0.25, 0.12};
    (void)state;
    for (cs_u32 lens = 1; lens < LENSES; lens++)
        for (int k = 0; k < CASES; k++) {
            const double moved = fibre_moves(lens, &cases[k], CS_SHEAR_EQUAL_AREA);
            const double free = fibre_moves(lens, &cases[k], CS_SHEAR_NONE);
            print_message("lens %u, blur %5.1f, motion %5.1f,%5.1f: moves %.4f px^2, without shear "
                          "%.4f\n",
                          lens, (double)cases[k].shear, (double)cases[k].velocity.x,
                          (double)cases[k].velocity.y, moved, free);
            assert_at_most(moved, most[lens]);
            assert_at_most(moved, 0.5 * free);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(times_follow_the_shutter),
        cmocka_unit_test(quantiles_invert_the_distribution),
        cmocka_unit_test(samples_are_inside),
        cmocka_unit_test(measure_is_kept),
        cmocka_unit_test(film_lens_and_time_stay_independent),
        cmocka_unit_test(fibres_are_followed),
        cmocka_unit_test(chords_nearly_keep_the_fibre),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
