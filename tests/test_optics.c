/* Apertures and pixel filters: their tables are correct, and the shears preserve their
 * distributions. */
#include "support.h"

#include <math.h>

#include "clshear/device/hash.h"
#include "clshear/device/shear.h"

static cs_f32 uniform(cs_u32 index, cs_u32 dimension)
{
    return (cs_f32)(cs_key(cs_key(991, index), dimension) >> 8) * (1.0f / 16777216.0f);
}

static const cs_f32 shears[] = {1e-6f, 0.3f, -0.3f, 1.0f, -1.0f, 3.0f, -25.0f};
enum {
    SHEARS = sizeof shears / sizeof *shears,
    LENSES = 6
};

/* A variety of apertures, with alternating filters. */
static cs_optics_tables lens(cs_u32 which)
{
    const cs_view views[LENSES] = {
        {.aperture = CLSHEAR_APERTURE_DISK},
        {.aperture = CLSHEAR_APERTURE_SQUARE, .anamorphic = 2.0f},
        {.aperture = CLSHEAR_APERTURE_POLYGON, .blades = 3, .blade_rotation_deg = 17.0f},
        {.aperture = CLSHEAR_APERTURE_POLYGON, .blades = 6},
        {.aperture = CLSHEAR_APERTURE_POLYGON, .blades = 4, .blade_rotation_deg = 45.0f},
        {.aperture = CLSHEAR_APERTURE_IMAGE, .image = test_aperture_image()}};
    static const cs_f32 widths[] = {0.0f, 2.5f, 0.0f, 1.7f, 0.0f};
    static const clshear_filter filters[] = {CLSHEAR_FILTER_GAUSSIAN, CLSHEAR_FILTER_BOX,
                                             CLSHEAR_FILTER_BOX, CLSHEAR_FILTER_TENT,
                                             CLSHEAR_FILTER_BLACKMAN_HARRIS};
    const cs_u32 filter = which / LENSES;
    return test_optics(&views[which % LENSES], filters[filter], widths[filter]);
}
enum {
    VARIANTS = 5 * LENSES
};

/* The filter's cumulative distribution at x. */
static cs_f32 filter_rank(const cs_optics_tables *lens, cs_f32 x)
{
    const cs_f32 *heights = lens->table.items;
    const cs_f32 step = lens->optics.filter_width / (cs_f32)lens->optics.filter_steps;
    const cs_f32 place = (x - 0.5f + 0.5f * lens->optics.filter_width) / step;
    cs_f32 sum = 0.0f;
    for (cs_u32 k = 0; k < lens->optics.filter_steps; k++)
        sum += heights[k] * step * cs_clamp(place - (cs_f32)k, 0.0f, 1.0f);
    return sum;
}

/* Index of a cell of equal probability in the four coordinates: v by its distribution given u. */
static cs_u32 cell_of(const cs_optics_tables *lens, const cs_camera_sample *p)
{
    const cs_f32 *table = lens->table.items;
    const cs_marginal across = cs_marginal_across(&lens->optics, table);
    const cs_chord chord = cs_chord_at(&lens->optics, table, &across, p->u);
    const cs_f32 v = (p->v - chord.centre) / cs_max(chord.length, 1e-9f);
    const cs_f32 ranks[4] = {filter_rank(lens, p->x), filter_rank(lens, p->y),
                             cs_marginal_at(&across, p->u).below,
                             cs_marginal_at(&chord.marginal, v).below};
    cs_u32 cell = 0;
    for (int d = 0; d < 4; d++) {
        assert_above(ranks[d], -1e-4f);
        assert_below(ranks[d], 1.0001f);
        cell = 4 * cell + (cs_u32)cs_clamp(4.0f * ranks[d], 0.0f, 3.0f);
    }
    return cell;
}

static double chi_square(const cs_optics_tables *lens, cs_f32 shear, cs_u32 salt)
{
    const cs_u32 count = 32000;
    cs_u32 hits[256] = {0};
    double chi = 0.0;
    for (cs_u32 i = salt; i < salt + count; i++) {
        const cs_camera_sample p =
            cs_shear(uniform(i, 0), uniform(i, 1), uniform(i, 2), uniform(i, 3),
                     shear == 0.0f ? CS_SHEAR_NONE : CS_SHEAR_EQUAL_AREA, &lens->optics,
                     lens->table.items, shear);
        hits[cell_of(lens, &p)]++;
    }
    for (int i = 0; i < 256; i++)
        chi += pow(hits[i] - count / 256.0, 2) / (count / 256.0);
    return chi;
}

/* Film and lens have the right distributions and are independent, sheared or not: chi-square of 256
 * cells, 255 degrees of freedom. The limit of 420 is 7.3 standard deviations up, false alarms below
 * 1e-9. */
static void measure_is_kept(void **state)
{
    (void)state;
    for (cs_u32 which = 0; which < VARIANTS; which++) {
        cs_optics_tables made = lens(which);
        assert_below(chi_square(&made, 0.0f, 1u + 40000u * which), 420.0);
        for (cs_u32 k = 0; k < SHEARS; k++) {
            const double chi = chi_square(&made, shears[k], 7u + 40000u * which);
            if (!(chi < 420.0))
                fail_msg("lens %u, shear %g: chi-square %g", which, (double)shears[k], chi);
        }
        cs_optics_free(&made);
    }
}

/* Any tuple, even an extreme one, ends inside filter and aperture. */
static void extreme_tuples_are_inside(void **state)
{
    (void)state;
    static const cs_f32 ends[] = {0.0f, 6e-8f, 5e-7f, 0.5f, 0.99999994f};
    for (cs_u32 which = 0; which < VARIANTS; which++) {
        cs_optics_tables made = lens(which);
        const cs_optics *o = &made.optics;
        const cs_f32 half = 0.5f * o->filter_width + 1e-5f;
        for (cs_u32 i = 0; i < 625 * SHEARS; i++) {
            const cs_camera_sample p =
                cs_shear(ends[i % 5], ends[i / 5 % 5], ends[i / 25 % 5], ends[i / 125 % 5],
                         CS_SHEAR_EQUAL_AREA, o, made.table.items, shears[i / 625]);
            if (!(fabsf(p.u) <= 1.0001f * o->half_width[0] &&
                  fabsf(p.v) <= 1.0001f * o->half_width[1] && fabsf(p.x - 0.5f) <= half &&
                  fabsf(p.y - 0.5f) <= half))
                fail_msg("lens %u, tuple %u: %g %g %g %g", which, i, (double)p.x, (double)p.y,
                         (double)p.u, (double)p.v);
        }
        cs_optics_free(&made);
    }
}

/* The fibre coordinate in x depends on the first coordinate alone and increases with it. With a
 * square aperture, so does the one in y. Disks and polygons have another map (test_shear.c). */
static void first_pair_fixes_the_fibre(void **state)
{
    (void)state;
    for (cs_u32 which = 0; which < VARIANTS; which++) {
        cs_optics_tables made = lens(which);
        const cs_optics *o = &made.optics;
        for (cs_u32 i = 0; i < 50 * SHEARS && !cs_has_chord_map(o); i++) {
            const cs_f32 s = shears[i % SHEARS], a = uniform(i, 0), b = uniform(i, 1);
            const cs_f32 *table = made.table.items;
            cs_camera_sample p[3];
            p[0] = cs_shear(a, b, uniform(i, 2), uniform(i, 3), 2, o, table, s);
            p[1] = cs_shear(a, b, uniform(i, 4), uniform(i, 5), 2, o, table, s);
            p[2] = cs_shear(a + 0.01f, b, uniform(i, 2), uniform(i, 3), 2, o, table, s);
            const cs_f32 tolerance = 2e-5f * (1.0f + fabsf(s));
            cs_f32 t[3];
            for (int k = 0; k < 3; k++)
                t[k] = p[k].x + s * o->squeeze * p[k].u;
            assert_near(t[0], t[1], tolerance);
            if (a < 0.98f) assert_above(t[2], t[0] - tolerance);
            if (o->marginal == CS_MARGINAL_UNIFORM)
                assert_near(p[0].y + s * p[0].v - p[1].y, s * p[1].v, tolerance);
        }
        cs_optics_free(&made);
    }
}

/* P(X + s U < t) = a; the left side is integrated numerically over the marginal. */
static void fibre_is_a_quantile(void **state)
{
    (void)state;
    for (cs_u32 which = 0; which < VARIANTS; which++) {
        cs_optics_tables made = lens(which);
        const cs_marginal across = cs_marginal_across(&made.optics, made.table.items);
        for (cs_u32 i = 0; i < 10 * SHEARS && !cs_has_chord_map(&made.optics); i++) {
            const cs_f32 s = shears[i % SHEARS] * made.optics.squeeze, a = uniform(i, 0);
            const cs_camera_sample p = cs_shear(a, 0.4f, 0.5f, 0.5f, 2, &made.optics,
                                                made.table.items, shears[i % SHEARS]);
            const cs_f32 t = p.x + s * p.u;
            double sum = 0.0;
            for (int j = 0; j < 4000; j++) {
                const cs_f32 u = cs_marginal_quantile(&across, ((cs_f32)j + 0.5f) / 4000.0f);
                const cs_f32 half = 0.5f * made.optics.filter_width;
                sum += (double)filter_rank(&made, cs_clamp(t - s * u, 0.5f - half, 0.5f + half));
            }
            assert_near(sum / 4000.0, (double)a, 1e-3);
        }
        cs_optics_free(&made);
    }
}

/* Point-in-polygon test for a regular polygon of area 1, with corners as in optics/polygon.c. */
static int is_in_polygon(int blades, double rotation_deg, double u, double v)
{
    const double pi = 3.14159265358979, radius = sqrt(2.0 / (blades * sin(2.0 * pi / blades)));
    const double apothem = radius * cos(pi / blades);
    for (int i = 0; i < blades; i++) {
        const double angle = 2.0 * pi * (i + 0.5) / blades + rotation_deg * pi / 180.0;
        if (u * cos(angle) - v * sin(angle) > apothem + 1e-5) return 0;
    }
    return 1;
}

/* Points lie in the polygon, and the unsheared ones have its second moments: radius^2 (2 + cos 2
 * pi/n) / 12 in every direction. 100 000 points, |z| < 5.5: false alarms of all tests below 1e-6.
 */
static void polygons_are_regular(void **state)
{
    (void)state;
    const cs_u32 count = 100000;
    for (int blades = 3; blades <= 32; blades += blades < 9 ? 1 : 23) {
        const double rotation = 7.0 * blades, pi = 3.14159265358979;
        const cs_view view = {.aperture = CLSHEAR_APERTURE_POLYGON,
                              .blades = blades,
                              .blade_rotation_deg = (float)rotation};
        cs_optics_tables made = test_optics(&view, CLSHEAR_FILTER_BOX, 0.0f);
        double sums[5] = {0}, squares[5] = {0};
        for (cs_u32 i = 0; i < count; i++) {
            const cs_camera_sample p = cs_shear(0.5f, 0.5f, uniform(i, 2), uniform(i, 3), 0,
                                                &made.optics, made.table.items, 0.0f);
            assert_true(is_in_polygon(blades, rotation, (double)p.u, (double)p.v));
            const cs_camera_sample q =
                cs_shear(uniform(i, 4), uniform(i, 5), uniform(i, 2), uniform(i, 3),
                         CS_SHEAR_EQUAL_AREA, &made.optics, made.table.items, shears[i % SHEARS]);
            assert_true(is_in_polygon(blades, rotation, (double)q.u, (double)q.v));
            const double u = (double)p.u, v = (double)p.v, all[5] = {u, v, u * u, v * v, u * v};
            for (int f = 0; f < 5; f++) {
                sums[f] += all[f] / count;
                squares[f] += all[f] * all[f] / count;
            }
        }
        const double radius2 = 2.0 / (blades * sin(2.0 * pi / blades));
        const double second = radius2 * (2.0 + cos(2.0 * pi / blades)) / 12.0;
        const double truth[5] = {0, 0, second, second, 0};
        for (int f = 0; f < 5; f++)
            assert_near(sums[f], truth[f], 5.5 * sqrt((squares[f] - sums[f] * sums[f]) / count));
        cs_optics_free(&made);
    }
}

/* Texels are hit in proportion to their luminance: chi-square, 9 degrees of freedom (10 texels are
 * not dark), false alarms below 1e-6 at 45. Dark texels are not hit. */
static void images_are_sampled_by_luminance(void **state)
{
    (void)state;
    const cs_aperture_image *image = test_aperture_image();
    const cs_view view = {.aperture = CLSHEAR_APERTURE_IMAGE, .image = image};
    cs_optics_tables made = test_optics(&view, CLSHEAR_FILTER_BOX, 0.0f);
    const cs_u32 count = 50000;
    cs_u32 hits[20] = {0};
    double sum = 0.0, chi = 0.0;
    for (int i = 0; i < 20; i++)
        sum += (double)image->luminance[i];
    for (cs_u32 i = 0; i < count; i++) {
        const cs_camera_sample p = cs_shear(0.5f, 0.5f, uniform(i, 2), uniform(i, 3), 0,
                                            &made.optics, made.table.items, 0.0f);
        hits[(int)((p.v + 0.4f) * 4.9999f) * 5 + (int)((p.u + 0.5f) * 4.9999f)]++;
    }
    for (int i = 0; i < 20; i++) {
        const double expected = (double)image->luminance[i] / sum * count;
        if (expected == 0.0)
            assert_at_most(hits[i], 2); /* rounding at the edges of texels */
        else
            chi += pow(hits[i] - expected, 2) / expected;
    }
    assert_below(chi, 45.0);
    cs_optics_free(&made);
}

/* Filters integrate to 1, are even and positive, and decrease from the centre. */
static void filters_are_filters(void **state)
{
    (void)state;
    const cs_view view = {.aperture = CLSHEAR_APERTURE_SQUARE};
    for (cs_u32 kind = 0; kind < 4; kind++) {
        cs_optics_tables made = test_optics(&view, (clshear_filter)kind, 2.0f);
        const cs_f32 *heights = made.table.items;
        const cs_u32 steps = made.optics.filter_steps;
        double sum = 0.0;
        for (cs_u32 k = 0; k < steps; k++) {
            sum += (double)heights[k] * 2.0 / steps;
            assert_above(heights[k], 0.0f);
            assert_near(heights[k], heights[steps - 1 - k], 1e-6f);
            if (k > 0 && 2 * k < steps) assert_above(heights[k], heights[k - 1]);
        }
        assert_near(sum, 1.0, 1e-6);
        cs_optics_free(&made);
    }
}

static void bad_lenses_are_refused(void **state)
{
    (void)state;
    static float dark[4], negative[4] = {1, -1, 0, 0};
    const cs_aperture_image black = {dark, 2, 2}, wrong = {negative, 2, 2}, huge = {dark, 300, 1};
    const struct {
        cs_view view;
        clshear_filter filter;
        float width;
        const char *said;
    } cases[] = {
        {{.aperture = CLSHEAR_APERTURE_POLYGON, .blades = 2}, 0, 0, "2 blades"},
        {{.aperture = CLSHEAR_APERTURE_POLYGON, .blades = 33}, 0, 0, "33 blades"},
        {{.aperture = CLSHEAR_APERTURE_IMAGE}, 0, 0, "needs an image"},
        {{.aperture = CLSHEAR_APERTURE_IMAGE, .image = &black}, 0, 0, "all black"},
        {{.aperture = CLSHEAR_APERTURE_IMAGE, .image = &wrong}, 0, 0, "luminance -1 at 1,0"},
        {{.aperture = CLSHEAR_APERTURE_IMAGE, .image = &huge}, 0, 0, "300 x 1"},
        {{.aperture = (clshear_aperture)9}, 0, 0, "aperture 9"},
        {{.anamorphic = -1.0f}, 0, 0, "anamorphic ratio -1"},
        {{.anamorphic = 1.0f}, (clshear_filter)7, 0, "filter 7"},
        {{.anamorphic = 1.0f}, CLSHEAR_FILTER_TENT, -2.0f, "filter width -2"},
        {{.anamorphic = 1.0f}, CLSHEAR_FILTER_TENT, 65.0f, "filter width 65"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        cs_error error = {{0}};
        cs_optics_tables made = {0};
        assert_int_equal(
            cs_optics_make(&cases[i].view, cases[i].filter, cases[i].width, &made, &error),
            CLSHEAR_BAD_ARGUMENT);
        if (strstr(error.message, cases[i].said) == NULL) fail_msg("%s", error.message);
        cs_optics_free(&made);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(measure_is_kept),
        cmocka_unit_test(extreme_tuples_are_inside),
        cmocka_unit_test(first_pair_fixes_the_fibre),
        cmocka_unit_test(fibre_is_a_quantile),
        cmocka_unit_test(polygons_are_regular),
        cmocka_unit_test(images_are_sampled_by_luminance),
        cmocka_unit_test(filters_are_filters),
        cmocka_unit_test(bad_lenses_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
