/* The shears preserve measure and align samples with the fibres. */
#include "support.h"

#include <math.h>

#include "clshear/device/hash.h"
#include "clshear/device/lens.h"
#include "clshear/device/shear.h"

static const cs_f32 shears[] = {0.0f, 1e-6f, 0.3f, -0.3f, 1.0f, -1.0f,
                                2.0f, -2.0f, 8.5f, -8.5f, 60.0f};
enum {
    SHEARS = sizeof shears / sizeof *shears,
    MODES = 3,
    APERTURES = 2
};

static cs_f32 uniform(cs_u32 index, cs_u32 dimension)
{
    return (cs_f32)(cs_key(cs_key(77, index), dimension) >> 8) * (1.0f / 16777216.0f);
}

/* A square or disk aperture and the usual pixel. */
static const cs_optics_tables *optics_of(cs_u32 aperture)
{
    static cs_optics_tables optics[APERTURES];
    if (optics[aperture].table.items == NULL) {
        const cs_view view = {.aperture = (clshear_aperture)aperture};
        optics[aperture] = test_optics(&view, CLSHEAR_FILTER_BOX, 0.0f);
    }
    return &optics[aperture];
}

/* Shears a tuple with one of them. */
static cs_camera_sample sheared(cs_f32 a, cs_f32 b, cs_f32 c, cs_f32 d, cs_u32 mode,
                                cs_u32 aperture, cs_f32 shear)
{
    const cs_optics_tables *optics = optics_of(aperture);
    return cs_shear(a, b, c, d, mode, &optics->optics, optics->table.items, shear);
}

static cs_camera_sample random_point(cs_u32 i, cs_u32 mode, cs_u32 aperture, cs_f32 shear)
{
    return sheared(uniform(i, 0), uniform(i, 1), uniform(i, 2), uniform(i, 3), mode, aperture,
                   shear);
}

/* Points are in the pixel and on the lens. */
static void points_are_inside(void **state)
{
    (void)state;
    const cs_f32 ends[] = {0.0f, 1e-7f, 0.5f, 0.99999994f};
    for (cs_u32 mode = 0; mode < MODES; mode++)
        for (cs_u32 aperture = 0; aperture < APERTURES; aperture++)
            for (int k = 0; k < SHEARS; k++)
                for (cs_u32 i = 0; i < 2256; i++) {
                    cs_camera_sample p =
                        i < 256 ? sheared(ends[i & 3], ends[i >> 2 & 3], ends[i >> 4 & 3],
                                          ends[i >> 6], mode, aperture, shears[k])
                                : random_point(i, mode, aperture, shears[k]);
                    assert_at_least(p.x, 0.0f);
                    assert_below(p.x, 1.0f);
                    assert_at_least(p.y, 0.0f);
                    assert_below(p.y, 1.0f);
                    cs_f32 radius = sqrtf(p.u * p.u + p.v * p.v);
                    if (aperture == CLSHEAR_APERTURE_DISK)
                        assert_at_most(radius, CS_DISK_RADIUS * 1.00001f);
                    else
                        assert_true(fabsf(p.u) <= 0.50001f && fabsf(p.v) <= 0.50001f);
                }
}

/* Nine integrands with known means over pixel x aperture: moments of each coordinate, mixed
 * moments, and a half plane across the fibres. */
enum {
    INTEGRANDS = 9
};

static void integrands(const cs_camera_sample *p, double *values)
{
    double x = p->x - 0.5, y = p->y - 0.5, u = p->u, v = p->v;
    const double all[INTEGRANDS] = {x,     y * y,        u, v, u * u, v * v, u * u * v * v,
                                    x * u, x * x * v * v};
    memcpy(values, all, sizeof all);
}

/* Second moments: 1/12 for the square; for the disk R^2/4 = 1/(4 pi), and E[u^2 v^2] = R^4/24. */
static void truths(cs_u32 aperture, double *values)
{
    const double pi = 3.14159265358979, square = 1.0 / 12.0;
    double second = aperture == CLSHEAR_APERTURE_DISK ? 1.0 / (4.0 * pi) : square;
    double mixed = aperture == CLSHEAR_APERTURE_DISK ? 1.0 / (24.0 * pi * pi) : square * square;
    const double all[INTEGRANDS] = {0, square, 0, 0, second, second, mixed, 0, square * second};
    memcpy(values, all, sizeof all);
}

/* The shears preserve measure: means of 200 000 independent points, |z| < 5.5. There are 594
 * comparisons; the false-alarm rate of each is 4e-8, of all 2e-5. */
static void measure_is_kept(void **state)
{
    (void)state;
    const cs_u32 count = 200000;
    for (cs_u32 mode = 0; mode < MODES; mode++)
        for (cs_u32 aperture = 0; aperture < APERTURES; aperture++)
            for (int k = 0; k < SHEARS; k++) {
                double sum[INTEGRANDS] = {0}, squares[INTEGRANDS] = {0};
                double value[INTEGRANDS], truth[INTEGRANDS];
                for (cs_u32 i = 0; i < count; i++) {
                    cs_camera_sample p =
                        random_point(i + count * (cs_u32)k, mode, aperture, shears[k]);
                    integrands(&p, value);
                    for (int f = 0; f < INTEGRANDS; f++) {
                        sum[f] += value[f];
                        squares[f] += value[f] * value[f];
                    }
                }
                truths(aperture, truth);
                for (int f = 0; f < INTEGRANDS; f++) {
                    double mean = sum[f] / count;
                    double error = sqrt((squares[f] / count - mean * mean) / count);
                    assert_near(mean, truth[f], 5.5 * error);
                }
            }
}

/* The joint distribution is uniform, not only its moments: chi-square of (x, u) on 8 x 8 cells of
 * equal probability (u through the aperture's own distribution), 63 degrees of freedom. The limit
 * of 140 is 6.9 standard deviations up, false alarms below 1e-7. */
static void film_and_lens_stay_independent(void **state)
{
    (void)state;
    const cs_u32 count = 64000;
    for (cs_u32 mode = 0; mode < MODES; mode++)
        for (cs_u32 aperture = 0; aperture < APERTURES; aperture++)
            for (int k = 0; k < SHEARS; k++) {
                cs_u32 hits[64] = {0};
                double chi = 0.0;
                for (cs_u32 i = 0; i < count; i++) {
                    cs_camera_sample p = random_point(i + 7777777u, mode, aperture, shears[k]);
                    cs_f32 rank = aperture == CLSHEAR_APERTURE_DISK ? cs_disk_cdf(p.u) : p.u + 0.5f;
                    cs_u32 column = (cs_u32)(p.x * 8.0f), row = (cs_u32)(rank * 7.99999f);
                    hits[row * 8 + column]++;
                }
                for (int i = 0; i < 64; i++)
                    chi += pow(hits[i] - count / 64.0, 2) / (count / 64.0);
                assert_below(chi, 140.0);
            }
}

/* Whether the map of an aperture with a box filter is exact. */
static int is_exact(cs_u32 aperture, cs_f32 shear)
{
    return aperture == CLSHEAR_APERTURE_SQUARE ||
           cs_shears_together(CS_SHEAR_EQUAL_AREA, &optics_of(aperture)->optics, shear);
}

/* After the exact equal-area shears the fibre coordinates depend on the first pair alone, t_x on a
 * and t_y on a and b, for any second pair. */
static void first_pair_fixes_the_fibre(void **state)
{
    (void)state;
    const cs_u32 mode = CS_SHEAR_EQUAL_AREA;
    for (int k = 0; k < SHEARS; k++) {
        const cs_f32 s = shears[k], tolerance = 2e-5f * (1.0f + fabsf(s));
        for (cs_u32 i = 0; i < 500; i++)
            for (cs_u32 aperture = 0; aperture < APERTURES; aperture++) {
                if (!is_exact(aperture, s)) continue;
                cs_f32 a = uniform(i, 0), b = uniform(i, 1);
                cs_camera_sample p = sheared(a, b, uniform(i, 2), uniform(i, 3), mode, aperture, s);
                cs_camera_sample q = sheared(a, b, uniform(i, 4), uniform(i, 5), mode, aperture, s);
                cs_camera_sample r =
                    sheared(a, uniform(i, 6), uniform(i, 4), uniform(i, 5), mode, aperture, s);
                assert_near(p.x + s * p.u, q.x + s * q.u, tolerance);
                assert_near(p.y + s * p.v, q.y + s * q.v, tolerance);
                assert_near(p.x + s * p.u, r.x + s * r.u, tolerance);
            }
    }
}

/* Half the mean square of what a change of the second pair moves the fibre by, both axes, px^2. */
static double fibre_moves(const cs_optics_tables *made, cs_u32 mode, cs_f32 s)
{
    const cs_u32 count = 4000;
    double square = 0.0;
    for (cs_u32 i = 0; i < count; i++) {
        cs_camera_sample p[2];
        for (cs_u32 j = 0; j < 2; j++)
            p[j] = cs_shear(uniform(i, 0), uniform(i, 1), uniform(i, 2 + 2 * j),
                            uniform(i, 3 + 2 * j), mode, &made->optics, made->table.items, s);
        square += pow((double)(p[0].x + s * p[0].u - p[1].x - s * p[1].u), 2) +
                  pow((double)(p[0].y + s * p[0].v - p[1].y - s * p[1].v), 2);
    }
    return 0.5 * square / count;
}

/* With chords, the second pair moves the fibre by little, for any blur: by a thirtieth of what it
 * moves by without a shear or less for narrow blurs, and by `most` square pixels anywhere. */
static void chords_nearly_keep_the_fibre(void **state)
{
    static const struct {
        clshear_aperture aperture;
        clshear_filter filter;
        double most;
    } lenses[] = {{CLSHEAR_APERTURE_DISK, CLSHEAR_FILTER_BOX, 0.005},
                  {CLSHEAR_APERTURE_POLYGON, CLSHEAR_FILTER_BOX, 0.006},
                  {CLSHEAR_APERTURE_DISK, CLSHEAR_FILTER_TENT, 0.045},
                  {CLSHEAR_APERTURE_DISK, CLSHEAR_FILTER_GAUSSIAN, 0.06},
                  {CLSHEAR_APERTURE_POLYGON, CLSHEAR_FILTER_BLACKMAN_HARRIS, 0.05}};
    static const cs_f32 blurs[] = {1e-6f, 0.1f, 0.25f, -0.5f,  1.0f,
                                   -1.5f, 2.0f, 6.0f,  -12.0f, 50.0f};
    (void)state;
    for (size_t l = 0; l < sizeof lenses / sizeof *lenses; l++) {
        const cs_view view = {.aperture = lenses[l].aperture, .blades = 6};
        cs_optics_tables made = test_optics(&view, lenses[l].filter, 0.0f);
        for (size_t k = 0; k < sizeof blurs / sizeof *blurs; k++) {
            const double moved = fibre_moves(&made, CS_SHEAR_EQUAL_AREA, blurs[k]);
            const double free = fibre_moves(&made, CS_SHEAR_NONE, blurs[k]);
            print_message("lens %zu, blur %5.1f: moves %.4f px^2, without shear %.4f\n", l,
                          (double)blurs[k], moved, free);
            assert_at_most(moved, lenses[l].most);
            assert_at_most(moved, (fabsf(blurs[k]) < 0.4f ? 0.05 : 0.15) * free + 1e-9);
        }
        cs_optics_free(&made);
    }
}

/* Integrates numerically the share of the pixel and of the disk's slab at t_x with y - 1/2 + s v <
 * t_y: the slab's chords weighted by their length, v clipped exactly. */
static double fibre_share(double t_x, double t_y, double s)
{
    const int steps = 20000;
    const double radius = CS_DISK_RADIUS;
    double low = fmax((t_x - 0.5) / s, -radius), high = fmin((t_x + 0.5) / s, radius);
    double below = 0.0, total = 0.0;
    for (int i = 0; i < steps; i++) {
        double u = low + (high - low) * (i + 0.5) / steps;
        double chord = sqrt(fmax(radius * radius - u * u, 0.0)), part[2];
        for (int side = 0; side < 2; side++) { /* integral of max(q - v, 0) over the chord */
            double q = (t_y + (side == 0 ? 0.5 : -0.5)) / s;
            double reach = fmin(fmax(q, -chord), chord) + chord;
            part[side] = 0.5 * reach * reach + 2.0 * chord * fmax(q - chord, 0.0);
        }
        below += s * (part[0] - part[1]);
        total += 2.0 * chord;
    }
    return below / total;
}

/* With the disk, t_y is the quantile b of its distribution given t_x, with the lens coordinate u
 * integrated out. */
static void disk_fibre_is_a_quantile(void **state)
{
    (void)state;
    const cs_f32 blurs[] = {1e-5f, 0.01f, 0.4f, 1.0f, 3.0f, 8.5f, 60.0f};
    for (size_t k = 0; k < sizeof blurs / sizeof *blurs; k++)
        for (cs_u32 i = 0; i < 60; i++) {
            const cs_f32 s = blurs[k];
            cs_f32 a = 0.01f + 0.98f * uniform(i, 0), b = uniform(i, 1);
            cs_camera_sample p = {a, b, uniform(i, 2), uniform(i, 3)};
            cs_disk_map(&p, &s, 1, 1.0f);
            double t_x = (double)p.x - 0.5 + (double)s * p.u;
            double t_y = (double)p.y - 0.5 + (double)s * p.v;
            assert_near(fibre_share(t_x, t_y, s), b, 2e-5);
        }
}

/* The fibre coordinate increases with the first pair without jumps: no seams. */
static void equal_area_has_no_seams(void **state)
{
    (void)state;
    for (cs_u32 aperture = 0; aperture < APERTURES; aperture++)
        for (int k = 0; k < SHEARS; k++) {
            const cs_f32 s = shears[k], span = 1.0f + fabsf(s) * 1.2f;
            if (!is_exact(aperture, s)) continue;
            cs_f32 before = -INFINITY;
            for (cs_u32 i = 0; i < 4096; i++) {
                cs_camera_sample p = sheared(((cs_f32)i + 0.5f) / 4096.0f, 0.5f, 0.3f, 0.7f,
                                             CS_SHEAR_EQUAL_AREA, aperture, s);
                cs_f32 t = p.x + s * p.u;
                assert_above(t, before - 1e-5f * span);
                if (i > 0) assert_below(t - before, 0.05f * span);
                before = t;
            }
        }
}

/* The toroidal shear cancels the slope: modulo the wrap, x + s u is the first pair. */
static void toroidal_slides_along_fibres(void **state)
{
    (void)state;
    for (cs_u32 i = 0; i < 1000; i++) {
        const cs_f32 s = 0.8f;
        cs_f32 a = uniform(i, 0), c = uniform(i, 2);
        cs_camera_sample p =
            sheared(a, 0.5f, c, 0.5f, CS_SHEAR_TOROIDAL, CLSHEAR_APERTURE_SQUARE, s);
        cs_f32 t = p.x + s * p.u;
        cs_f32 wrapped = t - a - roundf(t - a);
        assert_below(fabsf(wrapped), 1e-5f);
        assert_near(p.u, c - 0.5f, 0);
    }
}

static cs_f32 disk_fibre(cs_f32 across, cs_f32 blur)
{
    const cs_f32 cdf = cs_disk_fibre_mass(across);
    cs_f32 t = cs_disk_fibre_guess(cdf, blur);
    cs_i32 rough = 1;
    for (int step = 0; step < 2 && rough; step++)
        t = cs_disk_fibre_step(t, sqrtf(cdf), blur, &rough);
    return across > 0.5f ? -t : t;
}

/* Inverse and distribution of the disk's marginal agree, and the fibre quantile inverts its
 * distribution (checked by numerical integration over the pixel). */
static void disk_functions_invert(void **state)
{
    (void)state;
    for (cs_u32 i = 1; i < 4000; i++) {
        cs_f32 cdf = (cs_f32)i / 4000.0f;
        assert_near(cs_disk_cdf(cs_disk_quantile(cdf)), cdf, 1e-6f);
    }
    const cs_f32 blurs[] = {1e-5f, 0.01f, 0.4f, 1.0f, 3.0f, 5.9f, 6.1f, 20.0f};
    for (size_t k = 0; k < sizeof blurs / sizeof *blurs; k++)
        for (cs_u32 i = 1; i < 40; i++) {
            cs_f32 cdf = (cs_f32)i / 40.0f, t = disk_fibre(cdf, blurs[k]);
            double sum = 0.0;
            for (int j = 0; j < 4000; j++)
                sum += cs_disk_cdf((cs_f32)((t - (j + 0.5) / 4000.0 + 0.5) / blurs[k]));
            assert_near(sum / 4000.0, cdf, 3e-4);
        }
}

/* The thin lens: all rays of a raster point meet on the focal plane, and a point at depth z seen
 * through (x, u) appears, through the lens centre, at x + shear * squeeze * u. */
static void lens_agrees_with_shear(void **state)
{
    (void)state;
    const cs_camera camera = {.eye = {1, 2, 3},
                              .right = {1, 0, 0},
                              .down = {0, -1, 0},
                              .forward = {0, 0, -1},
                              .focal_distance = 4.0f,
                              .pixel_width = 0.01f,
                              .aperture_width = 0.3f,
                              .optics = {.squeeze = 0.5f},
                              .centre_px = {256, 256}};
    const cs_f32 depths[] = {0.7f, 2.0f, 4.0f, 9.0f, 50.0f};
    for (int k = 0; k < 5; k++)
        for (cs_u32 i = 0; i < 200; i++) {
            cs_f32 x = 512.0f * uniform(i, 0), y = 512.0f * uniform(i, 1);
            cs_f32 u = uniform(i, 2) - 0.5f, v = uniform(i, 3) - 0.5f, z = depths[k];
            cs_ray ray = cs_lens_ray(camera, x, y, u, v);
            cs_f32 right = ray.origin[0] + z * ray.direction[0] - camera.eye[0];
            cs_f32 down = camera.eye[1] - ray.origin[1] - z * ray.direction[1];
            cs_f32 scale = camera.focal_distance / z / camera.pixel_width;
            cs_f32 shear = cs_shear_of_depth(camera, z);
            assert_near(256.0f + right * scale, x + 0.5f * shear * u, 2e-3f);
            assert_near(256.0f + down * scale, y + shear * v, 2e-3f);
            assert_near(ray.origin[2] + z * ray.direction[2], camera.eye[2] - z, 1e-4f);
        }
    assert_above(cs_shear_of_depth(camera, 2.0f), 0.0f);
    assert_below(cs_shear_of_depth(camera, 9.0f), 0.0f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_are_inside),
        cmocka_unit_test(measure_is_kept),
        cmocka_unit_test(film_and_lens_stay_independent),
        cmocka_unit_test(first_pair_fixes_the_fibre),
        cmocka_unit_test(chords_nearly_keep_the_fibre),
        cmocka_unit_test(disk_fibre_is_a_quantile),
        cmocka_unit_test(equal_area_has_no_seams),
        cmocka_unit_test(toroidal_slides_along_fibres),
        cmocka_unit_test(disk_functions_invert),
        cmocka_unit_test(lens_agrees_with_shear),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
