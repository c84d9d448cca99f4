/* Automatic choice of the camera. */
#include "support.h"

#include <math.h>

#include "base/vec.h"
#include "render/camera_choice.h"
#include "scene/camera.h"
#include "settings/view.h"

static cs_view view_of(const clshear_settings *settings)
{
    cs_view view;
    cs_view_of(settings, NULL, &view);
    return view;
}

/* The bounding box fills the picture's shorter side up to a margin, with its open side in front. */
static void framing_shows_the_open_side(void **state)
{
    test_fixture *made = *state;
    const int sizes[][2] = {{512, 512}, {800, 400}, {300, 900}};
    for (int k = 0; k < 3; k++) {
        clshear_settings *settings = test_settings(NULL, sizes[k][0], sizes[k][1], 16);
        cs_error error;
        assert_int_equal(cs_camera_pose(made->scene, settings, &error), CLSHEAR_OK);
        assert_false(clshear_settings_is_set(settings, CLSHEAR_LENS_RADIUS));
        assert_false(clshear_settings_is_set(settings, CLSHEAR_FOCAL_DISTANCE));
        test_ok(clshear_camera_complete(made->scene, settings));
        const cs_view view = view_of(settings);
        assert_above(view.eye[2], 0.0f);
        assert_below(view.target[2], view.eye[2]);
        /* The middle ray hits the tall box or the back wall, inside the scene. */
        assert_above(view.focal_distance, view.eye[2]);
        assert_below(view.focal_distance, view.eye[2] + 560.0f);
        /* A point at infinity blurs over 3 % of the shorter axis. */
        float extent = 2.0f * view.focal_distance * tanf(view.fov_deg * 3.14159265f / 360.0f);
        assert_near(2.0f * view.lens_radius / extent, 0.03f, 1e-4f);
        clshear_settings_free(settings);
    }
}

static void focus_is_the_depth_of_a_pixel(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = test_settings(NULL, 512, 512, 16);
    test_set(settings, CLSHEAR_EYE, "274.8,273,800");
    test_set(settings, CLSHEAR_TARGET, "274.8,273,0");
    test_set(settings, CLSHEAR_FOV, "39.3");
    test_ok(clshear_camera_focus(made->scene, settings, 256, 140));
    assert_near(view_of(settings).focal_distance, 1359.2f, 0.1f); /* the back wall */
    test_set(settings, CLSHEAR_TARGET, "5000,273,0");
    test_refused(clshear_camera_focus(made->scene, settings, 511, 0), CLSHEAR_BAD_ARGUMENT,
                 "pixel 511,0 sees nothing");
    test_refused(clshear_camera_focus(made->scene, settings, 512, 0), CLSHEAR_BAD_ARGUMENT,
                 "pixel 512,0 is outside");
    clshear_settings_free(settings);
}

/* A completed camera replaces the focus pixel by a focal distance. */
static void focus_pixels_become_distances(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = test_settings(made->settings, 512, 512, 16);
    test_set(settings, CLSHEAR_EYE, "274.8,273,800");
    test_set(settings, CLSHEAR_TARGET, "274.8,273,0");
    test_set(settings, CLSHEAR_FOV, "39.3");
    test_set(settings, CLSHEAR_FOCUS_PIXEL, "256,140");
    test_ok(clshear_camera_complete(made->scene, settings));
    assert_near(view_of(settings).focal_distance, 1359.2f, 0.1f);
    assert_true(clshear_settings_is_set(settings, CLSHEAR_FOCAL_DISTANCE));
    assert_false(clshear_settings_is_set(settings, CLSHEAR_FOCUS_PIXEL));
    clshear_settings_free(settings);
}

/* f/2 with a field of view of 53.13 degrees, half of which has the tangent 1/2: focal length 24 mm,
 * radius 6 mm. */
static void f_numbers_become_radii(void **state)
{
    test_fixture *made = *state;
    static const char *const units[] = {"1", "0.001"};
    static const float radii[] = {0.006f, 6.0f};
    for (int i = 0; i < 2; i++) {
        clshear_settings *settings = test_settings(made->settings, 512, 512, 16);
        test_set(settings, CLSHEAR_FOV, "53.130102");
        test_set(settings, CLSHEAR_F_STOP, "2");
        test_set(settings, CLSHEAR_UNIT, "%s", units[i]);
        test_ok(clshear_camera_complete(made->scene, settings));
        assert_near(view_of(settings).lens_radius / radii[i], 1.0f, 1.6e-4f);
        clshear_settings_free(settings);
    }
}

/* From every side, the picture shows all corners of the scene's bounding box that the scene
 * touches, and its farthest ones reach the margin. The floor of test_floor is its own corners. */
static void framing_fits_every_vertex(void **state)
{
    test_fixture *made = *state;
    static const int sizes[][2] = {{400, 400}, {640, 200}, {200, 500}};
    static const char *const orbits[] = {"0,0.5", "35,20", "-120,60", "180,-30", "90,90"};
    clshear_scene *floor = test_floor(made->context, 3.0f, 0.5f);
    for (int k = 0; k < 15; k++) {
        const int width = sizes[k % 3][0], height = sizes[k % 3][1];
        clshear_settings *settings = test_settings(NULL, width, height, 16);
        cs_error error;
        cs_camera frame;
        float reach = 0.0f;
        test_set(settings, CLSHEAR_ORBIT, "%s", orbits[k / 3]);
        assert_int_equal(cs_camera_pose(floor, settings, &error), CLSHEAR_OK);
        const cs_view view = view_of(settings);
        assert_int_equal(cs_camera_frame(&view, width, height, &frame, &error), CLSHEAR_OK);
        for (int corner = 0; corner < 4; corner++) {
            const float point[3] = {corner & 1 ? 3.0f : -3.0f, 0.0f, corner & 2 ? 3.0f : -3.0f};
            float offset[3];
            cs_vec_subtract(point, view.eye, offset);
            const float depth = cs_vec_dot(offset, frame.forward);
            assert_above(depth, 0.0f);
            const float scale = frame.focal_distance / (depth * frame.pixel_width);
            const float x = fabsf(cs_vec_dot(offset, frame.right) * scale) / (0.5f * (float)width);
            const float y = fabsf(cs_vec_dot(offset, frame.down) * scale) / (0.5f * (float)height);
            reach = fmaxf(reach, fmaxf(x, y));
        }
        assert_near(reach, 1.0f / 1.08f, 1e-3f);
        clshear_settings_free(settings);
    }
    clshear_scene_free(floor);
}

/* An orbit stands on the side that its angles name, whatever is up. */
static void orbits_name_the_side(void **state)
{
    test_fixture *made = *state;
    clshear_scene *floor = test_floor(made->context, 3.0f, 0.5f);
    static const struct {
        const char *orbit, *z_up;
        float towards[3];
    } sides[] = {{"0,0", "0", {0, 0, 1}},  {"90,0", "0", {1, 0, 0}}, {"0,90", "0", {0, 1, 0}},
                 {"0,0", "1", {0, -1, 0}}, {"90,0", "1", {1, 0, 0}}, {"0,90", "1", {0, 0, 1}}};
    for (size_t k = 0; k < sizeof sides / sizeof *sides; k++) {
        clshear_settings *settings = test_settings(NULL, 100, 100, 16);
        cs_error error;
        float towards[3];
        test_set(settings, CLSHEAR_ORBIT, "%s", sides[k].orbit);
        test_set(settings, CLSHEAR_Z_UP, "%s", sides[k].z_up);
        assert_int_equal(cs_camera_pose(floor, settings, &error), CLSHEAR_OK);
        const cs_view view = view_of(settings);
        cs_vec_subtract(view.eye, view.target, towards);
        const float length = sqrtf(cs_vec_dot(towards, towards));
        assert_near(cs_vec_dot(towards, sides[k].towards) / length, 1.0f, 1e-5f);
        clshear_settings_free(settings);
    }
    clshear_scene_free(floor);
}

/* A camera that only the settings place stands upright: its picture's right is level, and its up
 * points upward; straight down, the front is at the bottom. */
static void placed_cameras_stand_upright(void **state)
{
    test_fixture *made = *state;
    static const struct {
        const char *eye, *target, *z_up;
        float up[3]; /* of the file */
        float least; /* of the cosine to the picture's up */
    } sides[] = {{"0,0,900", NULL, "0", {0, 1, 0}, 0.5f},
                 {"0,0,900", "0,0,0", "0", {0, 1, 0}, 0.999f},
                 {NULL, "700,100,-60", "0", {0, 1, 0}, 0.5f},
                 {"-310,820,77", "100,-40,-200", "0", {0, 1, 0}, 0.1f},
                 {"-310,-820,77", "100,40,-20", "1", {0, 0, 1}, 0.1f},
                 {"9,900,8", "9,0,8", "0", {0, 0, -1}, 0.999f},
                 {"9,-900,8", "9,0,8", "0", {0, 0, 1}, 0.999f},
                 {"9,8,900", "9,8,0", "1", {0, 1, 0}, 0.999f}};
    for (size_t k = 0; k < sizeof sides / sizeof *sides; k++) {
        clshear_settings *settings = test_settings(NULL, 100, 100, 16);
        cs_error error;
        cs_camera frame;
        if (sides[k].eye != NULL) test_set(settings, CLSHEAR_EYE, "%s", sides[k].eye);
        if (sides[k].target != NULL) test_set(settings, CLSHEAR_TARGET, "%s", sides[k].target);
        test_set(settings, CLSHEAR_Z_UP, "%s", sides[k].z_up);
        test_ok(clshear_camera_complete(made->scene, settings));
        const cs_view view = view_of(settings);
        assert_int_equal(cs_camera_frame(&view, 100, 100, &frame, &error), CLSHEAR_OK);
        assert_near(cs_vec_dot(frame.right, sides[k].up), 0.0f, 1e-5f);
        assert_below(cs_vec_dot(frame.down, sides[k].up), -sides[k].least);
        clshear_settings_free(settings);
    }
}

/* A camera of the file that --eye moves before what it looks at keeps looking at the scene: its
 * target is beside the scene's middle, not a step in front of where it was. */
static void moved_cameras_look_at_the_scene(void **state)
{
    test_fixture *made = *state;
    const char *path = test_file(
        "far.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
        "\"nodes\":[{\"mesh\":0},{\"camera\":0,\"translation\":[0.5,0.25,300]}],"
        "\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":0.6,\"znear\":0.1}}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
        "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
        "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAAgD8AAAAA\"}]}");
    static const float beside_middle[3] = {0.5f, 0.25f, 0.0f}, ahead[3] = {0.5f, 0.25f, 299.0f};
    static const char *const eyes[] = {"0,0,5", NULL};
    clshear_scene *scene = test_load(made->context, path);
    for (size_t k = 0; k < 2; k++) {
        clshear_settings *settings = test_settings(NULL, 100, 100, 16);
        if (eyes[k] != NULL) test_set(settings, CLSHEAR_EYE, "%s", eyes[k]);
        test_ok(clshear_camera_complete(scene, settings));
        for (int axis = 0; axis < 3; axis++)
            assert_near(view_of(settings).target[axis],
                        eyes[k] != NULL ? beside_middle[axis] : ahead[axis], 1e-4f);
        clshear_settings_free(settings);
    }
    clshear_scene_free(scene);
}

/* The blur of points at infinity, A / w, is what was asked for; the focus is the point's depth. */
static void blur_and_focus_point_do_what_they_say(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = test_settings(NULL, 300, 200, 16);
    cs_error error;
    cs_camera frame;
    test_set(settings, CLSHEAR_EYE, "274.8,273,800");
    test_set(settings, CLSHEAR_TARGET, "274.8,273,0");
    test_set(settings, CLSHEAR_FOCUS_POINT, "10,500,-200");
    test_set(settings, CLSHEAR_F_STOP, "2");
    test_set(settings, CLSHEAR_BLUR, "12");
    assert_false(clshear_settings_is_set(settings, CLSHEAR_F_STOP));
    test_ok(clshear_camera_complete(made->scene, settings));
    const cs_view view = view_of(settings);
    assert_near(view.focal_distance, 1000.0f, 1e-2f);
    assert_int_equal(cs_camera_frame(&view, 300, 200, &frame, &error), CLSHEAR_OK);
    assert_near(2.0f * view.lens_radius / frame.pixel_width, 12.0f, 1e-3f);
    clshear_settings_free(settings);
    settings = test_settings(NULL, 300, 200, 16);
    test_set(settings, CLSHEAR_EYE, "274.8,273,800");
    test_set(settings, CLSHEAR_TARGET, "274.8,273,0");
    test_set(settings, CLSHEAR_FOCUS_POINT, "0,0,900");
    test_refused(clshear_camera_complete(made->scene, settings), CLSHEAR_BAD_ARGUMENT,
                 "lies behind the camera");
    clshear_settings_free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(framing_shows_the_open_side),
        cmocka_unit_test(focus_is_the_depth_of_a_pixel),
        cmocka_unit_test(focus_pixels_become_distances),
        cmocka_unit_test(f_numbers_become_radii),
        cmocka_unit_test(framing_fits_every_vertex),
        cmocka_unit_test(orbits_name_the_side),
        cmocka_unit_test(placed_cameras_stand_upright),
        cmocka_unit_test(moved_cameras_look_at_the_scene),
        cmocka_unit_test(blur_and_focus_point_do_what_they_say),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
