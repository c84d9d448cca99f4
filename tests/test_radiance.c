/* Radiance against closed forms. */
#include "support.h"

#include <math.h>

#include "clshear/analysis.h"

static const double pi = 3.14159265358979;

typedef struct fixture {
    clshear_context *context;
    clshear_scene *floor;
} fixture;

static int set_up(void **state)
{
    fixture *made = calloc(1, sizeof *made);
    made->context = test_context();
    made->floor = test_floor(made->context, 1000.0f, 0.6f);
    *state = made;
    return 0;
}

static int tear_down(void **state)
{
    fixture *made = *state;
    clshear_scene_free(made->floor);
    clshear_context_free(made->context);
    free(made);
    return 0;
}

/* Looks straight down at the plane from height 3. */
static cs_view looking_down(float lens_radius, float focal_distance, clshear_aperture aperture)
{
    return (cs_view){.eye = {0.2f, 3.0f, -0.1f},
                     .target = {0.2f, 0.0f, -0.1f},
                     .up = {0, 0, -1},
                     .fov_deg = 60.0f,
                     .lens_radius = lens_radius,
                     .focal_distance = focal_distance,
                     .aperture = aperture};
}

static const float light_position[3] = {0.7f, 1.5f, 0.4f};
static const float intensity = 5.0f;

/* Radiance of the plane at (x, z) under the point light: albedo / pi * I cos / r^2. */
static double plane_radiance(double x, double z)
{
    double dx = light_position[0] - x, dy = light_position[1], dz = light_position[2] - z;
    double square = dx * dx + dy * dy + dz * dz;
    return 0.6 / pi * intensity * dy / (square * sqrt(square));
}

/* Mean over pixel (px, py) and the lens, by midpoint quadrature of the thin lens. A ray from lens
 * point l through point f of the focal plane hits the plane at l + (f - l) * depth / focal
 * distance. */
static double expected_pixel(const cs_view *view, int size, int px, int py)
{
    enum {
        STEPS = 12
    };
    const double depth = 3.0, focus = view->focal_distance, radius = view->lens_radius;
    const double width = 2.0 * focus * tan(0.5 * view->fov_deg * pi / 180.0) / size;
    double sum = 0.0, weight = 0.0;
    for (int i = 0; i < STEPS * STEPS * STEPS * STEPS; i++) {
        double c[4];
        for (int k = 0, rest = i; k < 4; k++, rest /= STEPS)
            c[k] = (rest % STEPS + 0.5) / STEPS;
        double u = (2.0 * c[2] - 1.0) * radius, v = (2.0 * c[3] - 1.0) * radius;
        if (view->aperture == CLSHEAR_APERTURE_DISK && u * u + v * v > radius * radius) continue;
        double fx = (px + c[0] - 0.5 * size) * width, fz = (py + c[1] - 0.5 * size) * width;
        double x = view->eye[0] + u + (fx - u) * depth / focus;
        double z = view->eye[2] + v + (fz - v) * depth / focus;
        sum += plane_radiance(x, z);
        weight += 1.0;
    }
    return sum / weight;
}

static void set_vector(clshear_settings *settings, clshear_setting setting, const float *vector)
{
    const double numbers[3] = {(double)vector[0], (double)vector[1], (double)vector[2]};
    test_ok(clshear_settings_set_numbers(settings, setting, numbers, 3));
}

static clshear_settings *settings_of(const cs_view *view, int size)
{
    clshear_settings *settings = test_settings(NULL, size, size, 4096);
    set_vector(settings, CLSHEAR_EYE, view->eye);
    set_vector(settings, CLSHEAR_TARGET, view->target);
    set_vector(settings, CLSHEAR_UP, view->up);
    test_set_number(settings, CLSHEAR_FOV, (double)view->fov_deg);
    test_set_number(settings, CLSHEAR_BOUNCES, 0.0);
    test_set_number(settings, CLSHEAR_LENS_RADIUS, (double)view->lens_radius);
    test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, (double)view->focal_distance);
    test_set_number(settings, CLSHEAR_APERTURE, view->aperture);
    return settings;
}

static clshear_film *render(clshear_scene *scene, const cs_view *view, int size,
                            clshear_shear shear)
{
    clshear_settings *settings = settings_of(view, size);
    test_set(settings, CLSHEAR_REPLICATES, "16");
    test_set_number(settings, CLSHEAR_SHEAR, shear);
    clshear_film *film = test_render(scene, settings);
    clshear_settings_free(settings);
    return film;
}

/* In focus, out of focus in front and behind, pinhole; both apertures, all shears. 29 of 12 x 12
 * pixels. A standard error from 16 replicates has 15 degrees of freedom. The
 * quadrature is within 2e-4 of one with 30 steps. */
static void point_light_over_a_plane(void **state)
{
    fixture *made = *state;
    const float lenses[][2] = {{0.0f, 3.0f}, {0.3f, 3.0f}, {0.3f, 2.0f}, {0.2f, 5.0f}};
    const int size = 12;
    const clshear_light light = {
        .kind = CLSHEAR_LIGHT_POINT, .position = {0.7f, 1.5f, 0.4f}, .colour = {5.0f, 5.0f, 5.0f}};
    test_add_light(made->floor, &light);
    for (int k = 0; k < 4; k++)
        for (int variant = 0; variant < 6; variant++) {
            cs_view view =
                looking_down(lenses[k][0], lenses[k][1], (clshear_aperture)(variant % 2));
            clshear_film *film = render(made->floor, &view, size, (clshear_shear)(variant / 2));
            const float *red = clshear_film_channel(film, "R");
            const float *variance = clshear_film_channel(film, "Variance.R");
            for (int p = 0; p < size * size; p += 5) {
                double truth = expected_pixel(&view, size, p % size, p / size);
                double error = sqrt((double)variance[p]);
                assert_near_estimate(red[p], truth, error, 15, 4 * 6 * 29, 4e-4 * truth);
            }
            clshear_film_free(film);
        }
}

/* A distant camera and a light close to the surface: the shadow ray starts 0.03 above the surface,
 * and this offset must not bring the light nearer. The tolerance of 1e-4 is far below the resulting
 * error of 6e-4 and above rounding. */
static void light_stays_where_it_is(void **state)
{
    fixture *made = *state;
    clshear_scene *floor = test_floor(made->context, 1000.0f, 0.5f);
    const clshear_light light = {
        .kind = CLSHEAR_LIGHT_POINT, .position = {0, 100, 0}, .colour = {1e4f, 1e4f, 1e4f}};
    const cs_view view = {.eye = {0, 1000, 0},
                          .target = {0, 0, 0},
                          .up = {0, 0, -1},
                          .fov_deg = 0.01f,
                          .focal_distance = 1000.0f};
    test_add_light(floor, &light);
    clshear_film *film = render(floor, &view, 2, CLSHEAR_SHEAR_EQUAL_AREA);
    const double truth = 0.5 / pi;
    for (int p = 0; p < 4; p++)
        assert_near(clshear_film_channel(film, "R")[p], truth, 1e-4 * truth);
    clshear_film_free(film);
    clshear_scene_free(floor);
}

/* Directional light is the same everywhere: albedo / pi * E * cos. */
static void directional_light(void **state)
{
    fixture *made = *state;
    clshear_scene *floor = test_floor(made->context, 10.0f, 0.5f);
    const clshear_light light = {.kind = CLSHEAR_LIGHT_DIRECTIONAL,
                                 .direction = {3.0f, 4.0f, 0.0f},
                                 .colour = {1.0f, 2.0f, 3.0f}};
    test_add_light(floor, &light);
    cs_view view = looking_down(0.1f, 2.0f, CLSHEAR_APERTURE_DISK);
    clshear_film *film = render(floor, &view, 4, CLSHEAR_SHEAR_EQUAL_AREA);
    const char *const names[3] = {"R", "G", "B"};
    for (int c = 0; c < 3; c++)
        for (int p = 0; p < 16; p++)
            assert_near(clshear_film_channel(film, names[c])[p], 0.5 / pi * (c + 1) * 0.8, 1e-5);
    clshear_film_free(film);
    clshear_scene_free(floor);
}

/* A square emitter above the floor. */
static clshear_scene *panel_over_floor(clshear_context *context)
{
    const float floor_y[12] = {-50, 0, -50, 50, 0, -50, 50, 0, 50, -50, 0, 50};
    const float panel[12] = {-1, 2, -1, 1, 2, -1, 1, 2, 1, -1, 2, 1};
    const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const clshear_mesh meshes[2] = {{.positions = floor_y,
                                     .indices = indices,
                                     .vertex_count = 4,
                                     .triangle_count = 2,
                                     .diffuse = {0.5f, 0.5f, 0.5f}},
                                    {.positions = panel,
                                     .indices = indices,
                                     .vertex_count = 4,
                                     .triangle_count = 2,
                                     .emission = {3.0f, 3.0f, 3.0f}}};
    return test_meshes(context, meshes, 2);
}

/* Below its centre, the form factor of a parallel rectangle (Howell, catalogue C-11) gives the
 * reflected radiance albedo * L * F. */
static void area_light_over_a_plane(void **state)
{
    fixture *made = *state;
    clshear_scene *scene = panel_over_floor(made->context);
    assert_int_equal(test_scene_info(scene).emitters, 2);
    /* A narrow view along the floor, below the panel, at the point under its centre. */
    cs_view view = {.eye = {4.0f, 0.5f, 0},
                    .target = {0, 0, 0},
                    .up = {0, 1, 0},
                    .fov_deg = 0.2f,
                    .lens_radius = 0.0f,
                    .focal_distance = 4.0f};
    clshear_film *film = render(scene, &view, 3, CLSHEAR_SHEAR_EQUAL_AREA);
    const double x = 0.5, root = sqrt(1.0 + x * x); /* half side over height, both ways */
    const double factor = 4.0 / (2.0 * pi) * 2.0 * x / root * atan(x / root);
    double error = sqrt((double)clshear_film_channel(film, "Variance.R")[4]);
    double value = clshear_film_channel(film, "R")[4];
    assert_near_estimate(value, 0.5 * 3.0 * factor, error, 15, 1, 1e-4); /* the pixel's width */
    assert_below(error, 0.01);
    clshear_film_free(film);
    /* Seen directly, the panel shows its own radiance and reflects nothing. */
    view.eye[0] = 0.3f;
    view.eye[1] = 1.0f;
    view.target[0] = 0.3f;
    view.target[1] = 2.0f;
    view.up[1] = 0.0f;
    view.up[2] = 1.0f;
    film = render(scene, &view, 3, CLSHEAR_SHEAR_EQUAL_AREA);
    assert_near(clshear_film_channel(film, "G")[4], 3.0f, 1e-5f);
    clshear_film_free(film);
    clshear_scene_free(scene);
}

/* A panel under the light shadows the floor below it, and nothing else. */
static void shadows_fall(void **state)
{
    fixture *made = *state;
    const float floor_y[12] = {-9, 0, -9, 9, 0, -9, 9, 0, 9, -9, 0, 9};
    const float panel[12] = {-0.5f, 1, -0.5f, 0.5f, 1, -0.5f, 0.5f, 1, 0.5f, -0.5f, 1, 0.5f};
    const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    clshear_mesh meshes[2] = {{.positions = floor_y,
                               .indices = indices,
                               .vertex_count = 4,
                               .triangle_count = 2,
                               .diffuse = {1, 1, 1}}};
    meshes[1] = meshes[0];
    meshes[1].positions = panel;
    clshear_scene *scene = test_meshes(made->context, meshes, 2);
    const clshear_light light = {.position = {0, 2, 0}, .colour = {1, 1, 1}};
    test_add_light(scene, &light);
    const float places[][2] = {{0.0f, 0.0f}, {0.9f, 0.0f}, {1.1f, 1.0f}, {3.0f, 1.0f}};
    for (int k = 0; k < 4; k++) {
        const float x = places[k][0];
        const cs_view view = {.eye = {x, 0.5f, 0},
                              .target = {x, 0, 0},
                              .up = {0, 0, 1},
                              .fov_deg = 1.0f,
                              .focal_distance = 0.5f};
        clshear_film *film = render(scene, &view, 2, CLSHEAR_SHEAR_EQUAL_AREA);
        double square = (double)(x * x) + 4.0;
        double lit = places[k][1] / pi * 2.0 / (square * sqrt(square));
        assert_near(clshear_film_channel(film, "R")[0], lit, 0.01 * lit + 1e-6);
        clshear_film_free(film);
    }
    clshear_scene_free(scene);
}

/* Surfaces do not shadow themselves: a plane in grazing light far from the origin has neither black
 * nor bright pixels. */
static void no_acne_far_from_the_origin(void **state)
{
    fixture *made = *state;
    const float base = 5000.0f;
    const float positions[12] = {base - 50, base, base - 50, base + 50, base, base - 50,
                                 base + 50, base, base + 50, base - 50, base, base + 50};
    const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const clshear_mesh mesh = {.positions = positions,
                               .indices = indices,
                               .vertex_count = 4,
                               .triangle_count = 2,
                               .diffuse = {1.0f, 1.0f, 1.0f}};
    clshear_scene *scene = test_meshes(made->context, &mesh, 1);
    const clshear_light light = {.kind = CLSHEAR_LIGHT_DIRECTIONAL,
                                 .direction = {1.0f, 0.05f, 0.0f},
                                 .colour = {1.0f, 1.0f, 1.0f}};
    test_add_light(scene, &light);
    cs_view view = {.eye = {base, base + 5, base + 8},
                    .target = {base, base, base},
                    .up = {0, 1, 0},
                    .fov_deg = 40.0f,
                    .lens_radius = 0.2f,
                    .focal_distance = 9.0f};
    clshear_film *film = render(scene, &view, 8, CLSHEAR_SHEAR_EQUAL_AREA);
    const double truth = 0.05 / sqrt(1.0 + 0.05 * 0.05) / pi;
    for (int p = 0; p < 64; p++)
        assert_near(clshear_film_channel(film, "R")[p], truth, 1e-3 * truth);
    clshear_film_free(film);
    clshear_scene_free(scene);
}

/* Integrands refuse the same arguments as a render. */
static void integrands_check_their_arguments(void **state)
{
    fixture *made = *state;
    const cs_view view = looking_down(0.1f, 3.0f, CLSHEAR_APERTURE_DISK);
    clshear_settings *settings = settings_of(&view, 8);
    const float point[4] = {0.5f, 0.5f, 0.5f, 0.5f};
    float rgb[3];
    static const int places[][2] = {{-1, 0}, {0, 8}, {8, 0}, {0, -1}, {1000000, 0}};
    static const char *const words[] = {"-1,0", "0,8", "8,0", "0,-1", "1000000,0"};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const int x = places[i][0], y = places[i][1];
        test_refused(clshear_radiance(made->floor, settings, x, y, point, 1, rgb),
                     CLSHEAR_BAD_ARGUMENT, words[i]);
        test_refused(clshear_radiance_of_samples(made->floor, settings, x, y, 0.0f, point, 1, rgb),
                     CLSHEAR_BAD_ARGUMENT, words[i]);
    }
    test_ok(clshear_radiance(made->floor, settings, 7, 7, point, 1, rgb));
    test_ok(clshear_radiance_of_samples(made->floor, settings, 7, 7, 0.0f, point, 1, rgb));
    test_set(settings, CLSHEAR_LENS_RADIUS, "1e9");
    test_refused(clshear_radiance(made->floor, settings, 0, 0, point, 1, rgb), CLSHEAR_BAD_ARGUMENT,
                 "lens radius 1e+09");
    clshear_settings_free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(point_light_over_a_plane),
        cmocka_unit_test(directional_light),
        cmocka_unit_test(light_stays_where_it_is),
        cmocka_unit_test(area_light_over_a_plane),
        cmocka_unit_test(shadows_fall),
        cmocka_unit_test(no_acne_far_from_the_origin),
        cmocka_unit_test(integrands_check_their_arguments),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
