/* Orthographic cameras and tilted focal planes: rays, shears, choices and means in closed form. */
#include "support.h"

#include <math.h>

#include "base/vec.h"
#include "clshear/device/hash.h"
#include "clshear/device/lens.h"
#include "render/camera_choice.h"
#include "render/focus_choice.h"
#include "scene/camera.h"
#include "settings/view.h"

static const float degrees = CS_PI / 180.0f;

static cs_f32 uniform(cs_u32 index, cs_u32 dimension)
{
    return (cs_f32)(cs_hash(cs_hash(index) + dimension) >> 8) * 0x1p-24f;
}

/* A camera at the origin that looks along +Z with +Y up: right is -X, and down is -Y. */
static cs_camera frame_of(float orthographic, float azimuth_deg, float elevation_deg)
{
    const cs_view view = {.target = {0, 0, 1},
                          .up = {0, 1, 0},
                          .fov_deg = 60.0f,
                          .orthographic = orthographic,
                          .lens_radius = 0.25f,
                          .focal_distance = 4.0f,
                          .tilt_deg = {azimuth_deg, elevation_deg},
                          .aperture = CLSHEAR_APERTURE_SQUARE};
    cs_camera camera;
    cs_error error;
    assert_int_equal(cs_camera_frame(&view, 400, 200, &camera, &error), CLSHEAR_OK);
    camera.optics.squeeze = 0.5f;
    return camera;
}

/* Where a ray is at a depth: to the right, down. */
static void follow(const cs_ray *ray, float depth, float *right, float *down)
{
    *right = -(ray->origin[0] + depth * ray->direction[0]);
    *down = -(ray->origin[1] + depth * ray->direction[1]);
    assert_near(ray->origin[2] + depth * ray->direction[2], depth, 1e-5f);
}

static const float cameras[][3] = {/* orthographic, azimuth, elevation */
                                   {0, 0, 0}, {0, 20, 0}, {0, -35, 55}, {0, 0, -80},
                                   {3, 0, 0}, {3, 20, 0}, {3, -35, 25}, {3, 0, -40}};

/* All rays of a raster position meet on the plane through (0, 0, 4) that faces azimuth and
 * elevation; those of its middle begin where the kind of camera says. The plane's normal in
 * coordinates of the picture, right, up and towards the camera, is (sin a cos e, sin e, cos a cos
 * e). Tolerances are of floats at lengths up to 20; where the plane is nearly met from the side, a
 * distance from it is divided by the cosine. */
static void rays_meet_on_the_tilted_plane(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof cameras / sizeof *cameras; k++) {
        const float a = cameras[k][1] * degrees, e = cameras[k][2] * degrees;
        const float normal[3] = {sinf(a) * cosf(e), sinf(e), cosf(a) * cosf(e)};
        const cs_camera camera = frame_of(cameras[k][0], cameras[k][1], cameras[k][2]);
        for (cs_u32 i = 0; i < 200; i++) {
            const float x = 400.0f * uniform(i, 0), y = 200.0f * uniform(i, 1);
            const float u = uniform(i, 2) - 0.5f, v = uniform(i, 3) - 0.5f;
            const cs_ray middle = cs_lens_ray(camera, x, y, 0.0f, 0.0f);
            const cs_ray ray = cs_lens_ray(camera, x, y, u, v);
            float start[2], slope[2], right, down, other_right, other_down;
            follow(&middle, 0.0f, &start[0], &start[1]);
            follow(&middle, 1.0f, &slope[0], &slope[1]);
            for (int axis = 0; axis < 2; axis++)
                slope[axis] -= start[axis];
            const float approach = normal[2] - normal[0] * slope[0] + normal[1] * slope[1];
            const float depth =
                (4.0f * normal[2] + normal[0] * start[0] - normal[1] * start[1]) / approach;
            if (fabsf(depth) > 20.0f) continue;
            follow(&middle, depth, &right, &down);
            follow(&ray, depth, &other_right, &other_down);
            assert_near(other_right, right, 2e-4f);
            assert_near(other_down, down, 2e-4f);
            if (cameras[k][0] > 0.0f)
                assert_near(right, (x - 200.0f) * 3.0f / 200.0f, 1e-4f);
            else
                assert_near(start[0], 0.0f, 1e-6f);
        }
    }
}

/* What is seen at raster (x, y) through (u, v) is seen through the middle of the lens at (x + shear
 * squeeze u, y + shear v). */
static void shears_are_those_of_the_rays(void **state)
{
    (void)state;
    static const float depths[] = {0.9f, 2.0f, 4.0f, 9.0f};
    for (size_t k = 0; k < sizeof cameras / sizeof *cameras; k++)
        for (cs_u32 i = 0; i < 200; i++) {
            const cs_camera camera = frame_of(cameras[k][0], cameras[k][1], cameras[k][2]);
            const float x = 400.0f * uniform(i, 0), y = 200.0f * uniform(i, 1);
            const float u = uniform(i, 2) - 0.5f, v = uniform(i, 3) - 0.5f, z = depths[i % 4];
            const float shear = cs_shear_at(camera, x, y, z);
            const cs_ray ray = cs_lens_ray(camera, x, y, u, v);
            const cs_ray middle =
                cs_lens_ray(camera, x + shear * 0.5f * u, y + shear * v, 0.0f, 0.0f);
            float seen[2], expected[2];
            follow(&ray, z, &seen[0], &seen[1]);
            follow(&middle, z, &expected[0], &expected[1]);
            assert_near(seen[0], expected[0], 2e-4f);
            assert_near(seen[1], expected[1], 2e-4f);
        }
}

/* The blur of parallel lines of sight grows evenly with the distance from the focal plane, and is
 * the same all over the picture: lens 0.5 wide, pixels 3 / 200 wide. */
static void telecentric_blur_is_even(void **state)
{
    (void)state;
    const cs_camera camera = frame_of(3.0f, 0.0f, 0.0f);
    for (int step = 0; step < 8; step++) {
        const float z = 1.0f + (float)step;
        const float expected = 0.5f / (3.0f / 200.0f) * (1.0f - z / 4.0f);
        assert_near(cs_shear_of_depth(camera, z), expected, 1e-4f);
        assert_near(cs_shear_at(camera, 3.0f, 190.0f, z), expected, 1e-4f);
    }
}

static void refused_where_the_plane_meets_the_lens(void **state)
{
    (void)state;
    const cs_view view = {.target = {0, 0, 1},
                          .up = {0, 1, 0},
                          .orthographic = 10.0f,
                          .focal_distance = 4.0f,
                          .tilt_deg = {60.0f, 0.0f}};
    cs_camera camera;
    cs_error error;
    assert_int_equal(cs_camera_frame(&view, 100, 100, &camera, &error), CLSHEAR_BAD_ARGUMENT);
    assert_non_null(strstr(error.message, "tilt 60,0"));
}

/* A camera 40 degrees above the floor of the fixture, which lies in its tilted focal plane. */
static clshear_settings *above_the_floor(int size, uint32_t spp, int orthographic)
{
    clshear_settings *settings = test_settings(NULL, size, size, spp);
    test_set(settings, CLSHEAR_EYE, "0,3,%.9g", (double)(3.0f / tanf(40.0f * degrees)));
    test_set(settings, CLSHEAR_TARGET, "0,0,0");
    test_set(settings, CLSHEAR_UP, "0,1,0");
    if (orthographic)
        test_set(settings, CLSHEAR_ORTHOGRAPHIC, "3");
    else
        test_set(settings, CLSHEAR_FOV, "30");
    test_set(settings, CLSHEAR_TILT, "0,50");
    test_set(settings, CLSHEAR_LENS_RADIUS, "1.5");
    test_set(settings, CLSHEAR_BOUNCES, "0");
    test_set(settings, CLSHEAR_REPLICATES, "16");
    return settings;
}

/* Light close to the floor, so that the picture has structure everywhere. */
static clshear_scene *lit_floor(clshear_context *context)
{
    clshear_scene *floor = test_floor(context, 100.0f, 0.6f);
    for (int i = 0; i < 9; i++) {
        const clshear_light light = {
            .kind = CLSHEAR_LIGHT_POINT,
            .position = {0.7f * (float)(i % 3 - 1), 0.15f, 0.7f * (float)(i / 3 - 1)},
            .colour = {1.0f, 1.0f, 1.0f}};
        test_add_light(floor, &light);
    }
    return floor;
}

/* The floor lies in the focal plane: it is sharp near and far. With a wide lens no pixel has a
 * circle of confusion, and means are those of a pinhole: within 6 standard errors of 16
 * replicates on each side, (15 degrees of freedom; false alarms about 2e-5 a pixel without the
 * allowance) and 0.1 % for rounding. Without the tilt, they are not. */
static void a_floor_in_the_focal_plane_is_sharp(void **state)
{
    clshear_scene *floor = lit_floor(((test_fixture *)*state)->context);
    enum {
        SIZE = 16
    };
    for (int orthographic = 0; orthographic < 2; orthographic++) {
        clshear_settings *settings = above_the_floor(SIZE, 4096, orthographic);
        clshear_film *tilted = test_render(floor, settings);
        test_set(settings, CLSHEAR_TILT, "0,0");
        clshear_film *plain = test_render(floor, settings);
        test_set(settings, CLSHEAR_LENS_RADIUS, "0");
        clshear_film *pinhole = test_render(floor, settings);
        int differ = 0;
        for (int p = 0; p < SIZE * SIZE; p++) {
            const double value = (double)clshear_film_channel(tilted, "R")[p];
            const double truth = (double)clshear_film_channel(pinhole, "R")[p];
            const double error = sqrt((double)clshear_film_channel(tilted, "Variance.R")[p]) +
                                 sqrt((double)clshear_film_channel(pinhole, "Variance.R")[p]);
            assert_near(value, truth, 6.0 * error + 1e-3 * truth);
            assert_near(clshear_film_channel(tilted, "CoC")[p], 0.0f, 1e-3f);
            differ += fabs((double)clshear_film_channel(plain, "R")[p] - truth) > 0.1 * truth;
        }
        assert_above(differ, SIZE * SIZE / 4);
        clshear_film_free(tilted);
        clshear_film_free(plain);
        clshear_film_free(pinhole);
        clshear_settings_free(settings);
    }
    clshear_scene_free(floor);
}

/* Out of focus under a tilted plane and under parallel lines of sight, the shears agree with no
 * shear: 7 standard errors of both means, 64 pixels, 4 cameras; with 15 degrees of freedom each,
 * false alarms are below 1e-4 in all. */
static void shears_keep_the_mean(void **state)
{
    clshear_scene *floor = lit_floor(((test_fixture *)*state)->context);
    static const char *const tilts[] = {"0,0", "-25,20"};
    enum {
        SIZE = 8
    };
    for (int k = 0; k < 4; k++) {
        clshear_settings *settings = above_the_floor(SIZE, 1024, k / 2);
        clshear_film *films[3];
        test_set(settings, CLSHEAR_TILT, "%s", tilts[k % 2]);
        test_set(settings, CLSHEAR_APERTURE, "square");
        for (int shear = 0; shear < 3; shear++) {
            test_set_number(settings, CLSHEAR_SHEAR, shear);
            test_set_number(settings, CLSHEAR_SEED, shear);
            films[shear] = test_render(floor, settings);
        }
        for (int p = 0; p < SIZE * SIZE; p++)
            for (int shear = 1; shear < 3; shear++) {
                const double square = (double)clshear_film_channel(films[0], "Variance.R")[p] +
                                      (double)clshear_film_channel(films[shear], "Variance.R")[p];
                assert_near(clshear_film_channel(films[shear], "R")[p],
                            clshear_film_channel(films[0], "R")[p], 7.0 * sqrt(square));
            }
        for (int shear = 0; shear < 3; shear++)
            clshear_film_free(films[shear]);
        clshear_settings_free(settings);
    }
    clshear_scene_free(floor);
}

/* A panel of radiance 1 that ends at x = 0, seen from the front by parallel lines of sight, out of
 * focus: the edge is blurred over a disk of radius R |1 - z / F|, so that the mean at x is the part
 * of the disk on the panel's side, 1/2 + (t sqrt(1 - t^2) + asin t) / pi with t = -x / radius.
 * Depth 6, focus 4, lens radius 0.5: blur radius 0.25, 12.5 pixels. The pixel's mean is taken
 * over 16 places. Each replicate counts whole samples of 1024, so that the error of the mean of 16
 * may be up to 0.5 / 1024 / 4 where they all agree: 6 of those, or 6 standard errors, as above. */
static void telecentric_edges_are_disks(void **state)
{
    test_fixture *made = *state;
    const float positions[12] = {-9, -9, -6, 0, -9, -6, 0, 9, -6, -9, 9, -6};
    const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const clshear_mesh mesh = {.positions = positions,
                               .indices = indices,
                               .vertex_count = 4,
                               .triangle_count = 2,
                               .emission = {1.0f, 1.0f, 1.0f}};
    clshear_scene *scene = test_meshes(made->context, &mesh, 1);
    clshear_settings *settings = test_settings(NULL, 50, 2, 16384);
    test_set(settings, CLSHEAR_EYE, "0,0,0");
    test_set(settings, CLSHEAR_TARGET, "0,0,-1");
    test_set(settings, CLSHEAR_UP, "0,1,0");
    test_set(settings, CLSHEAR_ORTHOGRAPHIC, "0.04");
    test_set(settings, CLSHEAR_FOCAL_DISTANCE, "4");
    test_set(settings, CLSHEAR_LENS_RADIUS, "0.5");
    test_set(settings, CLSHEAR_REPLICATES, "16");
    clshear_film *film = test_render(scene, settings);
    for (int p = 0; p < 100; p++) {
        double truth = 0.0;
        for (int i = 0; i < 16; i++) {
            const double x = (p % 50 - 25 + (i + 0.5) / 16) * 0.02;
            const double t = fmax(-1.0, fmin(1.0, -x / 0.25));
            truth += (0.5 + (t * sqrt(1.0 - t * t) + asin(t)) / 3.14159265358979) / 16;
        }
        const double error =
            fmax(sqrt((double)clshear_film_channel(film, "Variance.R")[p]), 0.5 / 1024 / 4);
        assert_near(clshear_film_channel(film, "R")[p], truth, 6.0 * error);
    }
    clshear_film_free(film);
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* With a tilt, the focal plane goes through what is chosen: no blur there. */
static void focus_goes_through_what_is_chosen(void **state)
{
    clshear_scene *floor = test_floor(((test_fixture *)*state)->context, 100.0f, 0.6f);
    for (int k = 0; k < 4; k++) {
        clshear_settings *settings = above_the_floor(40, 16, k / 2);
        cs_error error;
        cs_camera camera;
        float offset[3];
        test_set(settings, CLSHEAR_TILT, "-10,20");
        if (k % 2 == 0)
            test_set(settings, CLSHEAR_FOCUS_PIXEL, "8,33");
        else
            test_set(settings, CLSHEAR_FOCUS_POINT, "-0.3,0,0.4");
        test_ok(clshear_camera_complete(floor, settings));
        cs_view view;
        cs_view_of(settings, NULL, &view);
        assert_int_equal(cs_camera_frame(&view, 40, 40, &camera, &error), CLSHEAR_OK);
        float at[3] = {-0.3f, 0.0f, 0.4f}, x = 8.5f, y = 33.5f;
        if (k % 2 == 0) { /* the floor's point on that line of sight */
            const cs_ray ray = cs_lens_ray(camera, x, y, 0.0f, 0.0f);
            for (int i = 0; i < 3; i++)
                at[i] = ray.origin[i] - ray.origin[1] / ray.direction[1] * ray.direction[i];
        }
        cs_vec_subtract(at, camera.eye, offset);
        const float depth = cs_vec_dot(offset, camera.forward);
        const float spread = k / 2 ? 1.0f : depth / camera.focal_distance;
        x = camera.centre_px[0] + cs_vec_dot(offset, camera.right) / camera.pixel_width / spread;
        y = camera.centre_px[1] + cs_vec_dot(offset, camera.down) / camera.pixel_width / spread;
        if (k % 2 == 0) assert_near(x, 8.5f, 1e-3f);
        assert_near(cs_shear_at(camera, x, y, depth), 0.0f, 2e-4f);
        clshear_settings_free(settings);
    }
    clshear_scene_free(floor);
}

/* A width of 0 shows the whole floor inside the margin, whether the camera is placed or not; the
 * lens blurs the corner that is blurred most as much as asked for. */
static void width_and_blur_are_chosen(void **state)
{
    clshear_scene *floor = test_floor(((test_fixture *)*state)->context, 2.0f, 0.6f);
    for (int placed = 0; placed < 2; placed++) {
        clshear_settings *settings = test_settings(NULL, 300, 200, 16);
        cs_error error;
        cs_camera camera;
        cs_view view;
        float reach = 0.0f, blur = 0.0f;
        test_set(settings, CLSHEAR_ORTHOGRAPHIC, "0");
        test_set(settings, CLSHEAR_BLUR, "12");
        if (placed) test_set(settings, CLSHEAR_EYE, "1,4,5");
        if (placed) test_set(settings, CLSHEAR_TARGET, "1,0,0");
        test_ok(clshear_camera_complete(floor, settings));
        assert_false(clshear_settings_is_set(settings, CLSHEAR_FOV));
        cs_view_of(settings, NULL, &view);
        assert_int_equal(cs_camera_frame(&view, 300, 200, &camera, &error), CLSHEAR_OK);
        for (int corner = 0; corner < 4; corner++) {
            const float at[3] = {corner & 1 ? 2.0f : -2.0f, 0.0f, corner & 2 ? 2.0f : -2.0f};
            float offset[3];
            cs_vec_subtract(at, camera.eye, offset);
            const float depth = cs_vec_dot(offset, camera.forward);
            reach =
                fmaxf(reach, fabsf(cs_vec_dot(offset, camera.right)) / camera.pixel_width / 150);
            reach = fmaxf(reach, fabsf(cs_vec_dot(offset, camera.down)) / camera.pixel_width / 100);
            blur = fmaxf(blur, fabsf(1.0f - depth / view.focal_distance));
        }
        assert_near(reach, 1.0f / 1.08f, 1e-3f);
        assert_near(blur * 2.0f * view.lens_radius / camera.pixel_width, 12.0f, 1e-3f);
        clshear_settings_free(settings);
    }
    clshear_scene_free(floor);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_on_the_tilted_plane),
        cmocka_unit_test(shears_are_those_of_the_rays),
        cmocka_unit_test(telecentric_blur_is_even),
        cmocka_unit_test(refused_where_the_plane_meets_the_lens),
        cmocka_unit_test(a_floor_in_the_focal_plane_is_sharp),
        cmocka_unit_test(shears_keep_the_mean),
        cmocka_unit_test(telecentric_edges_are_disks),
        cmocka_unit_test(focus_goes_through_what_is_chosen),
        cmocka_unit_test(width_and_blur_are_chosen),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
