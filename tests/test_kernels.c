/* The words made for other programs are those that the renderer uses, and bad requests are refused
 * without harm. */
#include "support.h"

#include "clshear/device/lens.h"
#include "clshear/device/sampler/sampler.h"
#include "clshear/device/shear.h"
#include "clshear/kernels.h"
#include "scene/camera.h"

static void expect_message(clshear_status status, const char *part)
{
    assert_int_equal(status, CLSHEAR_BAD_ARGUMENT);
    if (strstr(clshear_message(NULL), part) == NULL)
        fail_msg("\"%s\" does not say \"%s\"", clshear_message(NULL), part);
}

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
    expect_message(clshear_pattern_create("nothing", 16, CLSHEAR_ORDER_COHERENT, &pattern),
                   "nothing");
    expect_message(clshear_pattern_create("sz", 0, CLSHEAR_ORDER_COHERENT, &pattern), "0 samples");
    expect_message(clshear_pattern_create("sz", 16, (clshear_sample_order)2, &pattern), "order 2");
    expect_message(clshear_sampler_count("sz", 1u << 30, &count), "must be 1 to");
    assert_null(pattern);
    assert_int_equal(count, 7);
    assert_int_equal(clshear_pattern_create(NULL, 16, CLSHEAR_ORDER_COHERENT, &pattern),
                     CLSHEAR_OK);
    expect_message(clshear_pattern_constants(pattern, &constants, sizeof constants - 4),
                   "different versions");
    clshear_pattern_free(pattern);
    clshear_pattern_free(NULL);
}

static void expect_optics(const clshear_lens *lens, const clshear_camera *camera,
                          clshear_filter filter, float width_px)
{
    cs_optics_tables expected = test_optics(camera, filter, width_px);
    cs_optics optics;
    size_t floats;
    assert_int_equal(clshear_lens_optics(lens, &optics, sizeof optics), CLSHEAR_OK);
    assert_memory_equal(&optics, &expected.optics, sizeof optics);
    const float *table = clshear_lens_table(lens, &floats);
    assert_int_equal(floats, expected.table.count);
    assert_memory_equal(table, expected.table.items, floats * sizeof *table);
    cs_optics_free(&expected);
}

/* A refused change leaves the lens as it was; an image stays when something else changes. */
static void lenses_are_the_renderers(void **state)
{
    const clshear_aperture_image *image = test_aperture_image();
    clshear_camera camera = {.aperture = CLSHEAR_APERTURE_DISK};
    clshear_lens *lens = NULL;
    (void)state;
    assert_int_equal(clshear_lens_create(&lens), CLSHEAR_OK);
    expect_optics(lens, &camera, CLSHEAR_FILTER_BOX, 0.0f);
    assert_int_equal(clshear_lens_set_image(lens, image->luminance, image->width, image->height),
                     CLSHEAR_OK);
    expect_message(clshear_lens_set_aperture(lens, "heart", 0, 0.0f), "heart");
    expect_message(clshear_lens_set_aperture(lens, "polygon", 2, 0.0f), "2 blades");
    expect_message(clshear_lens_set_image(lens, NULL, 4, 4), "image");
    expect_message(clshear_lens_set_image(lens, image->luminance, 0, 4), "0 x 4");
    expect_message(clshear_lens_set_anamorphic(lens, 0.0f), "anamorphic");
    expect_message(clshear_lens_set_filter(lens, "sinc", 0.0f), "sinc");
    expect_message(clshear_lens_set_focus(lens, -1.0f, 1.0f), "-1");
    expect_message(clshear_lens_set_focus(lens, 1.0f, 0.0f), "distance 0");
    camera.aperture = CLSHEAR_APERTURE_IMAGE;
    camera.image = image;
    camera.anamorphic = 2.0f;
    assert_int_equal(clshear_lens_set_anamorphic(lens, 2.0f), CLSHEAR_OK);
    assert_int_equal(clshear_lens_set_filter(lens, "tent", 3.0f), CLSHEAR_OK);
    expect_optics(lens, &camera, CLSHEAR_FILTER_TENT, 3.0f);
    assert_int_equal(clshear_lens_set_image(lens, image->luminance, 2, 2), CLSHEAR_OK);
    assert_int_equal(clshear_lens_set_image(lens, image->luminance, image->width, image->height),
                     CLSHEAR_OK);
    expect_optics(lens, &camera, CLSHEAR_FILTER_TENT, 3.0f);
    assert_int_equal(clshear_lens_set_aperture(lens, "polygon", 5, 11.0f), CLSHEAR_OK);
    camera.aperture = CLSHEAR_APERTURE_POLYGON;
    camera.blades = 5;
    camera.blade_rotation_deg = 11.0f;
    expect_optics(lens, &camera, CLSHEAR_FILTER_TENT, 3.0f);
    clshear_lens_free(lens);
    clshear_lens_free(NULL);
}

/* The ray through the middles of image and lens is the line of sight; rays through one place of the
 * film meet on the focal plane, 4 units away. */
static void cameras_look_and_focus(void **state)
{
    static const float look_at[9] = {1, 2, 3, 1, 2, -7, 0, 1, 0};
    static const float nowhere[9] = {1, 2, 3, 1, 2, 3, 0, 1, 0};
    clshear_lens *lens = NULL;
    cs_camera camera;
    (void)state;
    assert_int_equal(clshear_lens_create(&lens), CLSHEAR_OK);
    assert_int_equal(clshear_lens_set_focus(lens, 0.5f, 4.0f), CLSHEAR_OK);
    expect_message(clshear_lens_camera(lens, look_at, 40.0f, 0, 10, &camera, sizeof camera),
                   "0 x 10");
    expect_message(clshear_lens_camera(lens, look_at, 180.0f, 9, 10, &camera, sizeof camera),
                   "180");
    expect_message(clshear_lens_camera(lens, nowhere, 40.0f, 9, 10, &camera, sizeof camera),
                   "same point");
    expect_message(clshear_lens_camera(lens, look_at, 40.0f, 9, 10, &camera, 4), "cs_camera");
    assert_int_equal(clshear_lens_camera(lens, look_at, 40.0f, 30, 20, &camera, sizeof camera),
                     CLSHEAR_OK);
    const cs_ray middle = cs_lens_ray(camera, 15.0f, 10.0f, 0.0f, 0.0f);
    for (int axis = 0; axis < 3; axis++) {
        assert_float_equal(middle.origin[axis], look_at[axis], 1e-6f);
        assert_float_equal(middle.direction[axis], axis == 2 ? -1.0f : 0.0f, 1e-6f);
    }
    const cs_ray one = cs_lens_ray(camera, 3.0f, 4.0f, 0.2f, -0.3f);
    const cs_ray other = cs_lens_ray(camera, 3.0f, 4.0f, -0.4f, 0.1f);
    for (int axis = 0; axis < 3; axis++)
        assert_float_equal(one.origin[axis] + 4.0f * one.direction[axis],
                           other.origin[axis] + 4.0f * other.direction[axis], 1e-5f);
    assert_float_equal(cs_shear_of_depth(camera, 4.0f), 0.0f, 1e-6f);
    clshear_lens_free(lens);
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
        cmocka_unit_test(source_is_the_headers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
