/* Data for other programs' kernels equal the renderer's own, and bad requests are refused without
 * harm. */
#include "support.h"

#include "clshear/device/lens.h"
#include "clshear/device/sampler/sampler.h"
#include "clshear/device/shear.h"
#include "clshear/kernels.h"

static void patterns_are_the_renderers(void **state)
{
    (void)state;
    for (cs_u32 number = 0; number < CS_SAMPLER_COUNT; number++)
        for (int order = 0; order < 2; order++) {
            test_pattern expected = test_pattern_of(number, 100, (cs_sample_order)order);
            clshear_pattern *pattern = NULL;
            cs_pattern constants;
            uint32_t count;
            size_t words;
            const char *name = cs_sampler_name(number);
            assert_int_equal(clshear_sampler_count(name, 100, &count), CLSHEAR_OK);
            assert_int_equal(
                clshear_pattern_create(name, 100, (clshear_sample_order)order, &pattern),
                CLSHEAR_OK);
            assert_int_equal(clshear_pattern_constants(pattern, &constants, sizeof constants),
                             CLSHEAR_OK);
            assert_int_equal(constants.grid.count, count);
            assert_memory_equal(&constants, &expected.pattern, sizeof constants);
            const uint32_t *table = clshear_pattern_table(pattern, &words);
            assert_non_null(table);
            assert_true(words > 0 && words >= expected.rows.count);
            if (expected.rows.count > 0)
                assert_memory_equal(table, expected.rows.items,
                                    expected.rows.count * sizeof *table);
            clshear_pattern_free(pattern);
            test_pattern_free(&expected);
        }
}

static void bad_patterns_are_refused(void **state)
{
    clshear_pattern *pattern = NULL;
    cs_pattern constants;
    uint32_t count = 7;
    (void)state;
    test_refused(clshear_pattern_create("nothing", 16, CLSHEAR_ORDER_COHERENT, &pattern),
                 CLSHEAR_BAD_ARGUMENT, "nothing");
    test_refused(clshear_pattern_create("sz", 0, CLSHEAR_ORDER_COHERENT, &pattern),
                 CLSHEAR_BAD_ARGUMENT, "0 samples");
    test_refused(clshear_pattern_create("sz", 16, (clshear_sample_order)2, &pattern),
                 CLSHEAR_BAD_ARGUMENT, "order 2");
    test_refused(clshear_sampler_count("sz", 1u << 30, &count), CLSHEAR_BAD_ARGUMENT,
                 "must be 1 to");
    assert_null(pattern);
    assert_int_equal(count, 7);
    assert_int_equal(clshear_pattern_create(NULL, 16, CLSHEAR_ORDER_COHERENT, &pattern),
                     CLSHEAR_OK);
    test_refused(clshear_pattern_constants(pattern, &constants, sizeof constants - 4),
                 CLSHEAR_BAD_ARGUMENT, "different versions");
    clshear_pattern_free(pattern);
    clshear_pattern_free(NULL);
}

/* Expects the lens of these settings to be that of a view. */
static void expect_optics(const clshear_settings *settings, const cs_view *view,
                          clshear_filter filter, float width_px)
{
    cs_optics_tables expected = test_optics(view, filter, width_px);
    clshear_lens *lens = NULL;
    cs_optics optics;
    size_t floats;
    test_ok(clshear_lens_create(settings, &lens));
    test_ok(clshear_lens_optics(lens, &optics, sizeof optics));
    assert_memory_equal(&optics, &expected.optics, sizeof optics);
    const float *table = clshear_lens_table(lens, &floats);
    assert_int_equal(floats, expected.table.count);
    assert_memory_equal(table, expected.table.items, floats * sizeof *table);
    test_refused(clshear_lens_optics(lens, &optics, sizeof optics + 4), CLSHEAR_BAD_ARGUMENT,
                 "different versions");
    clshear_lens_free(lens);
    cs_optics_free(&expected);
}

static void lenses_are_the_renderers(void **state)
{
    const cs_aperture_image *image = test_aperture_image();
    clshear_settings *settings = test_settings(NULL, 8, 8, 1);
    cs_view view = {.aperture = CLSHEAR_APERTURE_DISK, .anamorphic = 1.0f};
    clshear_lens *lens = NULL;
    (void)state;
    expect_optics(settings, &view, CLSHEAR_FILTER_BOX, 0.0f);
    test_ok(clshear_settings_set_aperture(settings, image->luminance, image->width, image->height));
    test_set(settings, CLSHEAR_ANAMORPHIC, "2");
    test_set(settings, CLSHEAR_FILTER, "tent");
    test_set(settings, CLSHEAR_FILTER_WIDTH, "3");
    view.aperture = CLSHEAR_APERTURE_IMAGE;
    view.image = image;
    view.anamorphic = 2.0f;
    expect_optics(settings, &view, CLSHEAR_FILTER_TENT, 3.0f);
    test_set(settings, CLSHEAR_BLADES, "5");
    test_set(settings, CLSHEAR_BLADE_ROTATION, "11");
    view.aperture = CLSHEAR_APERTURE_POLYGON;
    view.blades = 5;
    view.blade_rotation_deg = 11.0f;
    expect_optics(settings, &view, CLSHEAR_FILTER_TENT, 3.0f);
    test_refused(clshear_lens_create(NULL, &lens), CLSHEAR_BAD_ARGUMENT, "settings is NULL");
    clshear_lens_free(NULL);
    clshear_settings_free(settings);
}

/* The ray through the middles of image and lens is the line of sight. Rays through one point of the
 * film meet on the focal plane, 4 units away. */
static void cameras_look_and_focus(void **state)
{
    static const float eye[3] = {1, 2, 3};
    clshear_settings *settings = test_settings(NULL, 30, 20, 1);
    clshear_lens *lens = NULL;
    cs_camera camera;
    (void)state;
    test_ok(clshear_lens_create(settings, &lens));
    test_refused(clshear_lens_camera(lens, &camera, sizeof camera), CLSHEAR_BAD_ARGUMENT,
                 "eye, target and fov");
    clshear_lens_free(lens);
    test_set(settings, CLSHEAR_EYE, "1,2,3");
    test_set(settings, CLSHEAR_TARGET, "1,2,3");
    test_set(settings, CLSHEAR_FOV, "40");
    test_set(settings, CLSHEAR_LENS_RADIUS, "0.5");
    test_set(settings, CLSHEAR_FOCAL_DISTANCE, "4");
    test_ok(clshear_lens_create(settings, &lens));
    test_refused(clshear_lens_camera(lens, &camera, sizeof camera), CLSHEAR_BAD_ARGUMENT,
                 "same point");
    clshear_lens_free(lens);
    test_set(settings, CLSHEAR_TARGET, "1,2,-7");
    test_ok(clshear_lens_create(settings, &lens));
    test_refused(clshear_lens_camera(lens, &camera, 4), CLSHEAR_BAD_ARGUMENT, "cs_camera");
    test_ok(clshear_lens_camera(lens, &camera, sizeof camera));
    const cs_ray middle = cs_lens_ray(camera, 15.0f, 10.0f, 0.0f, 0.0f);
    for (int axis = 0; axis < 3; axis++) {
        assert_near(middle.origin[axis], eye[axis], 1e-6);
        assert_near(middle.direction[axis], axis == 2 ? -1.0f : 0.0f, 1e-6);
    }
    const cs_ray one = cs_lens_ray(camera, 3.0f, 4.0f, 0.2f, -0.3f);
    const cs_ray other = cs_lens_ray(camera, 3.0f, 4.0f, -0.4f, 0.1f);
    for (int axis = 0; axis < 3; axis++)
        assert_near(one.origin[axis] + 4.0f * one.direction[axis],
                    other.origin[axis] + 4.0f * other.direction[axis], 1e-5);
    assert_near(cs_shear_of_depth(camera, 4.0f), 0.0, 1e-6);
    clshear_lens_free(lens);
    clshear_settings_free(settings);
}

/* A setting that another one has unset leaves nothing behind, and what needs a scene is refused. */
static void lenses_have_what_is_set(void **state)
{
    static const clshear_setting by_scene[] = {CLSHEAR_F_STOP, CLSHEAR_BLUR, CLSHEAR_FOCUS_PIXEL,
                                               CLSHEAR_FOCUS_POINT};
    static const char *const values[] = {"8", "20", "1,2", "1,2,3"};
    clshear_settings *settings = test_settings(NULL, 30, 20, 1);
    clshear_lens *lens = NULL;
    cs_camera camera;
    (void)state;
    test_set(settings, CLSHEAR_EYE, "1,2,3");
    test_set(settings, CLSHEAR_TARGET, "1,2,-7");
    test_set(settings, CLSHEAR_ORTHOGRAPHIC, "600");
    test_set(settings, CLSHEAR_FOV, "40");
    test_set(settings, CLSHEAR_LENS_RADIUS, "0.2");
    for (int i = 0; i < 4; i++) {
        test_set(settings, by_scene[i], "%s", values[i]);
        test_refused(clshear_lens_create(settings, &lens), CLSHEAR_BAD_ARGUMENT, "needs a scene");
        clshear_settings_unset(settings, by_scene[i]);
    }
    test_ok(clshear_lens_create(settings, &lens));
    test_ok(clshear_lens_camera(lens, &camera, sizeof camera));
    assert_false(camera.orthographic);
    assert_true(camera.aperture_width == 0.0f);
    clshear_lens_free(lens);
    clshear_settings_free(settings);
}

static void source_is_the_headers(void **state)
{
    const char *text = clshear_device_source();
    (void)state;
    assert_non_null(strstr(text, "#line 1 \"cl/clshear/device/shear.h\""));
    assert_non_null(strstr(text, "cs_draw_extra("));
    assert_null(strstr(text, "#include \""));
    assert_null(strstr(text, "__kernel"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(patterns_are_the_renderers), cmocka_unit_test(bad_patterns_are_refused),
        cmocka_unit_test(lenses_are_the_renderers),   cmocka_unit_test(cameras_look_and_focus),
        cmocka_unit_test(lenses_have_what_is_set),    cmocka_unit_test(source_is_the_headers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
