/* Cameras that are chosen for the user. */
#include "support.h"

#include <math.h>

typedef struct fixture {
    clshear_context *context;
    clshear_scene *scene;
} fixture;

static int set_up(void **state)
{
    fixture *made = calloc(1, sizeof *made);
    made->context = test_context();
    test_ok(made->context, clshear_scene_load(made->context, SCENES "/cornell.obj", &made->scene));
    *state = made;
    return 0;
}

static int tear_down(void **state)
{
    fixture *made = *state;
    clshear_scene_free(made->scene);
    clshear_context_free(made->context);
    free(made);
    return 0;
}

/* The box fills the picture's shorter side but for a margin, seen through its open side. */
static void framing_shows_the_open_side(void **state)
{
    fixture *made = *state;
    const int sizes[][2] = {{512, 512}, {800, 400}, {300, 900}};
    for (int k = 0; k < 3; k++) {
        clshear_camera camera;
        test_ok(made->context,
                clshear_scene_camera(made->scene, sizes[k][0], sizes[k][1], &camera));
        assert_true(camera.eye[2] > 0.0f && camera.target[2] < camera.eye[2]);
        assert_true(camera.lens_radius < 0.0f && !(camera.focal_distance > 0.0f));
        test_ok(made->context,
                clshear_camera_complete(made->scene, sizes[k][0], sizes[k][1], &camera));
        /* In the middle is the tall box or the back wall, inside the scene. */
        assert_true(camera.focal_distance > camera.eye[2]);
        assert_true(camera.focal_distance < camera.eye[2] + 560.0f);
        /* 3 % of the shorter axis at infinity. */
        float extent = 2.0f * camera.focal_distance * tanf(camera.fov_deg * 3.14159265f / 360.0f);
        assert_true(fabsf(2.0f * camera.lens_radius / extent - 0.03f) < 1e-4f);
    }
}

static void focus_goes_to_what_a_pixel_sees(void **state)
{
    fixture *made = *state;
    clshear_camera camera = {
        .eye = {274.8f, 273, 800}, .target = {274.8f, 273, 0}, .up = {0, 1, 0}, .fov_deg = 39.3f};
    test_ok(made->context, clshear_camera_focus(made->scene, 512, 512, 256, 140, &camera));
    assert_true(fabsf(camera.focal_distance - 1359.2f) < 0.1f); /* the back wall */
    camera.target[0] = 5000.0f;
    assert_int_equal(clshear_camera_focus(made->scene, 512, 512, 511, 0, &camera),
                     CLSHEAR_BAD_ARGUMENT);
    assert_non_null(strstr(clshear_message(made->context), "511,0"));
    assert_int_equal(clshear_camera_focus(made->scene, 512, 512, 512, 0, &camera),
                     CLSHEAR_BAD_ARGUMENT);
}

/* f/2 at 24 mm over 53.13 degrees (tan of the half is 1/2): focal length 24 mm, radius 6 mm. */
static void f_numbers_become_radii(void **state)
{
    (void)state;
    const clshear_camera camera = {.fov_deg = 53.130102f};
    assert_true(fabsf(clshear_lens_radius(&camera, 2.0f, 1.0f) - 0.006f) < 1e-6f);
    assert_true(fabsf(clshear_lens_radius(&camera, 2.0f, 0.001f) - 6.0f) < 1e-3f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(framing_shows_the_open_side),
        cmocka_unit_test(focus_goes_to_what_a_pixel_sees),
        cmocka_unit_test(f_numbers_become_radii),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
