/* The BSDFs alone, for one lane on the host. */
#include "clshear/device/hash.h"
#include "kernels/bsdf/bsdf.h"
#include "scene/albedo.h"
#include "support.h"

enum {
    SIDE = 256, /* strata along each coordinate of the unit square */
    LOBES = 11
};

static const char *const names[] = {
#define NAME(identifier, name, suffix) name,
    CS_BSDF_LIST(NAME)
#undef NAME
};

static const float roughnesses[] = {0.05f, 0.2f, 0.4f, 0.7f, 1.0f};
static const float cosines[] = {1.0f, 0.7f, 0.3f, 0.08f};

/* What of the standard surface is looked at: each reflects or lets through all light. */
typedef struct lobe {
    const char *name;
    float base[3];
    float metallic;
    float f0;
    float transmission;
    float coat;
    float sheen;
    int symmetric;
    float index; /* of refraction, of solids */
    int inside;
} lobe;

static const lobe lobes[LOBES] = {
    {"white metal", {1, 1, 1}, 1.0f, 0.04f, 0.0f, 0.0f, 0.0f, 1, 0.0f, 0},
    {"grey metal", {0.5f, 0.5f, 0.5f}, 1.0f, 0.04f, 0.0f, 0.0f, 0.0f, 1, 0.0f, 0},
    {"white dielectric", {1, 1, 1}, 0.0f, 0.04f, 0.0f, 0.0f, 0.0f, 1, 0.0f, 0},
    {"half metal, f0 0.2", {1, 1, 1}, 0.5f, 0.2f, 0.0f, 0.0f, 0.0f, 1, 0.0f, 0},
    {"thin glass", {1, 1, 1}, 0.0f, 0.04f, 1.0f, 0.0f, 0.0f, 1, 0.0f, 0},
    {"half glass", {1, 1, 1}, 0.0f, 0.1f, 0.5f, 0.0f, 0.0f, 1, 0.0f, 0},
    {"coat over white", {1, 1, 1}, 0.0f, 0.04f, 0.0f, 1.0f, 0.0f, 0, 0.0f, 0},
    {"sheen over white", {1, 1, 1}, 0.0f, 0.04f, 0.0f, 0.0f, 0.8f, 0, 0.0f, 0},
    {"solid glass", {1, 1, 1}, 0.0f, 0.04f, 1.0f, 0.0f, 0.0f, 0, 1.5f, 0},
    {"inside of glass", {1, 1, 1}, 0.0f, 0.04f, 1.0f, 0.0f, 0.0f, 0, 1.5f, 1},
    {"half of glass, metal", {1, 1, 1}, 0.4f, 0.04f, 0.7f, 0.0f, 0.0f, 0, 2.0f, 0},
};

/* By which a solid's radiance grows from beyond the surface to here. */
static double growth(const lobe *lobe)
{
    if (lobe->index == 0.0f) return 1.0;
    return pow((double)lobe->index, lobe->inside ? 2.0 : -2.0);
}

static cs_surface surface_of(int kind, const float *normal)
{
    cs_surface surface = {
        .hit = 1, .albedo = {0.2f, 0.5f, 0.8f}, .bsdf = kind, .albedos = cs_albedo_table};
    for (int axis = 0; axis < 3; axis++)
        surface.normal[axis] = surface.outward[axis] = normal[axis];
    surface.parameters[CS_PARAMETER_ROUGHNESS] = 0.3f;
    surface.parameters[CS_PARAMETER_F0] = 0.04f;
    surface.parameters[CS_PARAMETER_F90] = 1.0f;
    return surface;
}

static cs_surface surface_with(const lobe *lobe, float roughness)
{
    static const float up[3] = {0, 0, 1};
    cs_surface surface = surface_of(CS_BSDF_STANDARD, up);
    float *p = surface.parameters;
    p[CS_PARAMETER_ROUGHNESS] = p[CS_PARAMETER_COAT_ROUGHNESS] = roughness;
    p[CS_PARAMETER_SHEEN_ROUGHNESS] = roughness;
    p[CS_PARAMETER_METALLIC] = lobe->metallic;
    p[CS_PARAMETER_F0] = lobe->f0;
    p[CS_PARAMETER_TRANSMISSION] = lobe->transmission;
    p[CS_PARAMETER_COAT] = lobe->coat;
    p[CS_PARAMETER_INDEX] = lobe->index;
    surface.inside = lobe->inside;
    if (lobe->index > 0.0f) surface.bsdf = CS_BSDF_GLASS;
    for (int c = 0; c < 3; c++) {
        surface.albedo[c] = lobe->base[c];
        p[CS_PARAMETER_SHEEN + c] = lobe->sheen;
    }
    return surface;
}

static double dot(const float *a, const float *b)
{
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

static cs_bsdf_value value_of(const cs_surface *surface, const float *out, const float *in)
{
    const cs_bsdf_view view = cs_bsdf_view_of(surface, out);
    return cs_bsdf_eval(&view, in);
}

static cs_bsdf_direction draw(const cs_surface *surface, const float *out, cs_pair pair,
                              float choice)
{
    const cs_bsdf_view view = cs_bsdf_view_of(surface, out);
    return cs_bsdf_sample(&view, pair, choice);
}

static float unit_number(cs_u32 seed, cs_u32 index)
{
    return (float)(cs_key(seed, index) >> 8) * 0x1p-24f;
}

/* Integrates over drawn directions: the reflectance of channel 0, and 1 / density, which is the
 * solid angle of the hemisphere. */
static void check_draws(int kind, const float *normal)
{
    const cs_surface surface = surface_of(kind, normal);
    const float out[3] = {normal[0], normal[1], normal[2]};
    double reflected = 0.0, cosines_sum = 0.0, evaluated = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const cs_pair pair = {((float)(i % SIDE) + 0.5f) / SIDE, ((float)(i / SIDE) + 0.5f) / SIDE};
        const float choice = unit_number(3, (cs_u32)i);
        const cs_bsdf_direction drawn = draw(&surface, out, pair, choice);
        const double cosine = dot(drawn.in, normal);
        if (!(drawn.value.density > 0.0f)) continue;
        assert_true(fabs(dot(drawn.in, drawn.in) - 1.0) < 1e-5 && cosine > -1e-6);
        const cs_bsdf_value value = value_of(&surface, out, drawn.in);
        const float longer[3] = {3.0f * drawn.in[0], 3.0f * drawn.in[1], 3.0f * drawn.in[2]};
        const double density = (double)value_of(&surface, out, longer).density;
        assert_near(density, drawn.value.density, 2e-3 * density + 1e-6);
        const double share = cosine / (double)drawn.value.density / (SIDE * SIDE);
        reflected += (double)(drawn.value.scale * drawn.value.colour[0]) * share;
        evaluated += (double)(value.scale * value.colour[0]) * share;
        cosines_sum += share;
    }
    print_message("%-10s reflects %.4f\n", names[kind], reflected);
    /* Independent choices of a lobe leave some noise. */
    assert_near(cosines_sum, acos(-1.0), kind == CS_BSDF_LAMBERT ? 1e-3 : 0.05);
    assert_near(evaluated, reflected, 1e-4);
    assert_true(reflected > 0.0 && reflected < 1.0);
    if (kind == CS_BSDF_LAMBERT) assert_near(reflected, 0.2, 1e-4);
}

static void drawn_directions_follow_their_density(void **state)
{
    static const float normals[][3] = {
        {0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0.6f, -0.8f, 0}, {0.48f, 0.6f, -0.64f}};
    (void)state;
    for (int kind = 0; kind < CS_BSDF_KINDS; kind++)
        for (size_t i = 0; i < sizeof normals / sizeof *normals; i++)
            check_draws(kind, normals[i]);
}

/* Density of horizon_draw, per steradian, by the height of a direction. */
static double horizon_density(double height)
{
    return 1.0 / (4.0 * acos(-1.0) * sqrt(fmax(height, 1e-12)));
}

/* Directions that crowd at the horizon, where sheen shines: their height is a square. */
static void horizon_draw(cs_pair pair, float *in)
{
    const float height = pair.y * pair.y, sine = sqrtf(1.0f - height * height);
    in[0] = sine * cosf(2.0f * CS_PI * pair.x);
    in[1] = sine * sinf(2.0f * CS_PI * pair.x);
    in[2] = height;
}

/* Albedo by drawn directions, half of them by the BSDF and half by horizon_draw, stratified in all
 * three numbers: the mean of value cosine / density, of light that grows as it does in solids. */
static double albedo_of(const lobe *lobe, const cs_surface *surface, const float *out)
{
    enum {
        ACROSS = 128,
        CHOICES = 24
    };
    double sum = 0.0;
    for (cs_u32 i = 0; i < ACROSS * ACROSS * CHOICES * 2; i++) {
        const cs_u32 place = i / 2 % (ACROSS * ACROSS), layer = i / 2 / (ACROSS * ACROSS);
        const cs_pair pair = {((float)(place % ACROSS) + unit_number(1, i)) / ACROSS,
                              ((float)(place / ACROSS) + unit_number(2, i)) / ACROSS};
        const float choice = ((float)layer + unit_number(3, i)) / CHOICES;
        cs_bsdf_direction drawn;
        if (i % 2 == 0) {
            drawn = draw(surface, out, pair, choice);
            if (!(drawn.value.density > 0.0f)) continue;
        } else {
            horizon_draw(pair, drawn.in);
            drawn.value = value_of(surface, out, drawn.in);
        }
        const double height = dot(drawn.in, surface->normal);
        const double other = height > 0.0 ? horizon_density(height) : 0.0;
        sum += (double)drawn.value.scale * (double)drawn.value.colour[0] * fabs(height) *
               (height < 0.0 ? 1.0 / growth(lobe) : 1.0) / ((double)drawn.value.density + other);
    }
    return sum / (ACROSS * ACROSS * CHOICES);
}

/* In a white furnace a white surface is white, within 0.5 %: half of it for the table's linear
 * pieces, the rest for noise. Nothing gives more than it gets. */
static void white_is_white(void **state)
{
    (void)state;
    for (int l = 0; l < LOBES; l++)
        for (size_t r = 0; r < sizeof roughnesses / sizeof *roughnesses; r++) {
            print_message("%-20s %.2f:", lobes[l].name, (double)roughnesses[r]);
            const cs_surface surface = surface_with(&lobes[l], roughnesses[r]);
            const int is_white = lobes[l].base[0] == 1.0f;
            for (size_t c = 0; c < sizeof cosines / sizeof *cosines; c++) {
                const float out[3] = {sqrtf(1.0f - cosines[c] * cosines[c]), 0.0f, cosines[c]};
                const double albedo = albedo_of(&lobes[l], &surface, out);
                print_message(" %.4f", albedo);
                assert_below(albedo, 1.005);
                if (is_white) assert_above(albedo, 0.995);
            }
            print_message("\n");
        }
}

/* Head-on, smooth glass reflects ((n - 1) / (n + 1))^2 from both sides; inside, beyond the critical
 * angle, everything; what is refracted obeys Snell; nothing is NaN at roughness 0. */
static void smooth_glass_obeys_fresnel(void **state)
{
    static const float slants[] = {1.0f, 0.9f, 0.75f, 0.5f, 0.2f, 0.01f};
    (void)state;
    for (int l = LOBES - 3; l < LOBES - 1; l++)
        for (size_t s = 0; s < sizeof slants / sizeof *slants; s++) {
            const cs_surface surface = surface_with(&lobes[l], 0.0f);
            const double here = lobes[l].inside ? 1.5 : 1.0, beyond = 2.5 - here;
            const double cosine = (double)slants[s], sine = sqrt(1.0 - cosine * cosine);
            const double cosine_beyond = sqrt(fmax(1.0 - pow(here / beyond * sine, 2.0), 0.0));
            const double across =
                (here * cosine - beyond * cosine_beyond) / (here * cosine + beyond * cosine_beyond);
            const double along =
                (beyond * cosine - here * cosine_beyond) / (beyond * cosine + here * cosine_beyond);
            const double truth = 0.5 * (across * across + along * along);
            const float out[3] = {(float)sine, 0.0f, (float)cosine};
            double reflected = 0.0, refracted = 0.0, aside = 0.0;
            for (cs_u32 i = 0; i < 10000; i++) {
                const cs_pair pair = {unit_number(1, i), unit_number(2, i)};
                const cs_bsdf_direction drawn =
                    draw(&surface, out, pair, ((float)i + 0.5f) / 10000.0f);
                if (!(drawn.value.density > 0.0f)) continue;
                const double height = dot(drawn.in, surface.normal);
                const double weight =
                    (double)drawn.value.colour[0] * fabs(height) / (double)drawn.value.density;
                assert_true(isfinite(weight));
                if (height > 0.0) {
                    reflected += weight / 10000.0;
                } else {
                    refracted += 1.0;
                    aside += (double)drawn.in[0];
                }
            }
            print_message("%s, cosine %.2f: %.4f of %.4f\n", lobes[l].name, cosine, reflected,
                          truth);
            assert_near(reflected, truth, 0.02);
            if (refracted > 1000.0) assert_near(aside / refracted, -here / beyond * sine, 0.005);
        }
}

/* The value is the same with both directions exchanged, but for layers that pass light on by `out`
 * alone (bsdf/standard.h) and facets of glass, which do not shadow `in` (bsdf/glass.h). */
static void values_are_symmetric(void **state)
{
    (void)state;
    for (int l = 0; l < LOBES; l++)
        for (cs_u32 i = 0; i < 500 && lobes[l].symmetric; i++) {
            const cs_surface surface = surface_with(&lobes[l], roughnesses[i % 5]);
            float direction[2][3];
            for (cs_u32 k = 0; k < 2; k++) {
                const float z = 0.05f + 0.9f * unit_number(4 + k, i);
                const float angle = 2.0f * CS_PI * unit_number(6 + k, i);
                direction[k][0] = sqrtf(1.0f - z * z) * cosf(angle);
                direction[k][1] = sqrtf(1.0f - z * z) * sinf(angle);
                direction[k][2] = z;
            }
            const cs_bsdf_value a = value_of(&surface, direction[0], direction[1]);
            const cs_bsdf_value b = value_of(&surface, direction[1], direction[0]);
            assert_near(a.colour[0], b.colour[0], 2e-3 * (double)a.colour[0] + 1e-6);
        }
}

/* Part of the facets that a direction sees (Smith, for GGX: Walter et al. 2007, equation 34). */
static double part_seen(double cosine, double width)
{
    const double square = cosine * cosine;
    return 2.0 / (1.0 + sqrt(1.0 + width * width * (1.0 - square) / square));
}

/* Through the surface of a polished solid, value by the part of facets that `in` sees is that with
 * both directions exchanged by the square of the index on the side of `out` (Walter et al. 2007,
 * section 2.1, as radiance). What is mirrored at the surface adds next to nothing to directions
 * that facets refract. */
static void refraction_is_symmetric(void **state)
{
    const float roughness = 0.2f;
    const double width = 0.04;
    int count = 0;
    (void)state;
    for (cs_u32 i = 0; i < 500; i++) {
        cs_surface surface = surface_with(&lobes[LOBES - 3], roughness);
        const float height = 0.3f + 0.7f * unit_number(4, i);
        const float out[3] = {sqrtf(1.0f - height * height), 0.0f, height};
        const cs_pair pair = {unit_number(5, i), 0.9f * unit_number(6, i)};
        const cs_bsdf_direction drawn = draw(&surface, out, pair, 0.99f);
        if (drawn.in[2] > -0.3f) continue;
        count++;
        surface.inside = -1;
        surface.normal[2] = surface.outward[2] = -1.0f;
        const cs_bsdf_value back = value_of(&surface, drawn.in, out);
        const double here = (double)drawn.value.colour[0] * part_seen((double)-drawn.in[2], width);
        const double there = (double)back.colour[0] * part_seen((double)height, width);
        assert_near(there, here * 1.5 * 1.5, 2e-3 * there);
    }
    assert_in_range(count, 400, 500);
}

enum {
    DRAWS = 100000,
    ACROSS = 24, /* boxes of the sphere, equal in azimuth and in height */
    DOWN = 24,
    BOXES = ACROSS * DOWN,
    STEPS = 24 /* midpoints of a box, each way */
};

/* How many of the drawn directions each box is to have, by the density; returns their part of all.
 */
static double expect_in_boxes(const cs_surface *surface, const float *out, double *expected)
{
    double total = 0.0;
    memset(expected, 0, BOXES * sizeof *expected);
    for (int i = 0; i < BOXES * STEPS * STEPS; i++) {
        const int x = i % (ACROSS * STEPS), y = i / (ACROSS * STEPS);
        const float z = 2.0f * ((float)y + 0.5f) / (DOWN * STEPS) - 1.0f;
        const float angle = 2.0f * CS_PI * ((float)x + 0.5f) / (ACROSS * STEPS);
        const float in[3] = {sqrtf(1.0f - z * z) * cosf(angle), sqrtf(1.0f - z * z) * sinf(angle),
                             z};
        const double part = (double)value_of(surface, out, in).density * 4.0 * (double)CS_PI /
                            (BOXES * STEPS * STEPS);
        expected[y / STEPS * ACROSS + x / STEPS] += part * DRAWS;
        total += part;
    }
    return total;
}

/* How many each box has; returns their part of all draws. */
static double count_in_boxes(const cs_surface *surface, const float *out, double *seen)
{
    double count = 0.0;
    memset(seen, 0, BOXES * sizeof *seen);
    for (cs_u32 i = 0; i < DRAWS; i++) {
        const cs_pair pair = {unit_number(1, i), unit_number(2, i)};
        const cs_bsdf_direction drawn = draw(surface, out, pair, unit_number(3, i));
        if (!(drawn.value.density > 0.0f)) continue;
        double angle = atan2((double)drawn.in[1], (double)drawn.in[0]) / (2.0 * (double)CS_PI);
        if (angle < 0.0) angle += 1.0;
        int x = (int)(angle * ACROSS), y = (int)((0.5 + 0.5 * (double)drawn.in[2]) * DOWN);
        x = x < ACROSS ? x : ACROSS - 1;
        y = y < DOWN ? y : DOWN - 1;
        seen[y * ACROSS + x] += 1.0;
        count += 1.0;
    }
    return count / DRAWS;
}

/* Counts of drawn directions against the integral of the density by midpoints, chi-square. 100 000
 * draws of independent numbers; boxes that expect fewer than 20 are left out. The limit, mean and 6
 * standard deviations, is a false alarm of some 1e-7 for each of the 33 cases; 1e-3 of the expected
 * counts is allowed for the midpoints. */
static void check_chi_square(const lobe *lobe, float roughness, float cosine)
{
    static double expected[BOXES], seen[BOXES];
    const cs_surface surface = surface_with(lobe, roughness);
    const float out[3] = {sqrtf(1.0f - cosine * cosine), 0.0f, cosine};
    const double total = expect_in_boxes(&surface, out, expected);
    const double drawn = count_in_boxes(&surface, out, seen);
    double square = 0.0;
    int boxes = 0;
    for (int i = 0; i < BOXES; i++) {
        if (expected[i] < 20.0) continue;
        const double off = fmax(fabs(seen[i] - expected[i]) - 1e-3 * expected[i], 0.0);
        square += off * off / expected[i];
        boxes++;
    }
    print_message("%-20s %.2f %.2f: %.1f in %d boxes, %.4f of %.4f\n", lobe->name,
                  (double)roughness, (double)cosine, square, boxes, drawn, total);
    assert_below(square, boxes + 6.0 * sqrt(2.0 * boxes));
    assert_at_most(total, 1.002); /* what is missing was mirrored to below the surface */
}

static void counts_follow_the_density(void **state)
{
    (void)state;
    for (int l = 0; l < LOBES; l++)
        for (int r = 2; r < 5; r++)
            check_chi_square(&lobes[l], roughnesses[r], r == 3 ? 0.3f : 0.8f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(drawn_directions_follow_their_density),
                                       cmocka_unit_test(white_is_white),
                                       cmocka_unit_test(values_are_symmetric),
                                       cmocka_unit_test(smooth_glass_obeys_fresnel),
                                       cmocka_unit_test(refraction_is_symmetric),
                                       cmocka_unit_test(counts_follow_the_density)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
