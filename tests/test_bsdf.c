/* The BSDFs on their own, for one lane on the host. */
#include "kernels/bsdf/bsdf.h"
#include "support.h"

enum {
    SIDE = 256 /* strata along each coordinate of the unit square */
};

static const char *const names[] = {
#define NAME(identifier, name, suffix) name,
    CS_BSDF_LIST(NAME)
#undef NAME
};

static cs_surface surface_of(int kind, const float *normal)
{
    cs_surface surface = {.hit = 1, .albedo = {0.2f, 0.5f, 0.8f}, .bsdf = kind};
    for (int axis = 0; axis < 3; axis++)
        surface.normal[axis] = surface.outward[axis] = normal[axis];
    return surface;
}

static double dot(const float *a, const float *b)
{
    return (double)a[0] * (double)b[0] + (double)a[1] * (double)b[1] + (double)a[2] * (double)b[2];
}

/* Sums over drawn directions: what is reflected of channel 0, and what a drawn direction's density
 * says of the solid angle of the hemisphere. */
static void check_draws(int kind, const float *normal)
{
    const cs_surface surface = surface_of(kind, normal);
    const float out[3] = {normal[0], normal[1], normal[2]};
    double reflected = 0.0, cosines = 0.0, evaluated = 0.0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const cs_pair pair = {((float)(i % SIDE) + 0.5f) / SIDE, ((float)(i / SIDE) + 0.5f) / SIDE};
        const cs_bsdf_direction drawn = cs_bsdf_sample(&surface, out, pair);
        const double cosine = dot(drawn.in, normal);
        assert_true(fabs(dot(drawn.in, drawn.in) - 1.0) < 1e-5 && cosine > -1e-6);
        if (!(drawn.density > 0.0f)) continue;
        const cs_bsdf_value value = cs_bsdf_eval(&surface, out, drawn.in);
        const float longer[3] = {3.0f * drawn.in[0], 3.0f * drawn.in[1], 3.0f * drawn.in[2]};
        const double density = (double)cs_bsdf_density(&surface, out, longer);
        assert_near(density, drawn.density, 1e-4 * density + 1e-6);
        const double share = cosine / (double)drawn.density / (SIDE * SIDE);
        reflected += (double)(drawn.value.scale * drawn.value.colour[0]) * share;
        evaluated += (double)(value.scale * value.colour[0]) * share;
        cosines += share;
    }
    print_message("%-10s reflects %.4f\n", names[kind], reflected);
    assert_true(fabs(cosines - acos(-1.0)) < 1e-3);
    assert_true(fabs(evaluated - reflected) < 1e-5);
    assert_true(reflected > 0.0 && reflected < 1.0);
    if (kind == CS_BSDF_LAMBERT) assert_true(fabs(reflected - 0.2) < 1e-4);
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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(drawn_directions_follow_their_density)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
