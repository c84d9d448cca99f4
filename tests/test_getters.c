/* Public functions that return no status: what they answer without an object, and past the last
 * element. */
#include "support.h"

#include <math.h>

#include "clshear/analysis.h"
#include "clshear/kernels.h"
#include "clshear/opencl.h"

/* What returns no status answers with NULL, 0 or NaN without an object. */
static void getters_need_no_object(void **state)
{
    (void)state;
    char text[8] = "kept";
    size_t words = 7;
    clshear_film_info info = {.struct_size = sizeof info, .width = 7};
    clshear_film_describe(NULL, &info);
    assert_int_equal(info.width, 7);
    assert_null(clshear_film_channel_name(NULL, 0));
    assert_null(clshear_film_channel(NULL, "R"));
    assert_true(isnan(clshear_film_mean_variance(NULL)));
    clshear_film_missing(NULL, text, sizeof text);
    assert_string_equal(text, "");
    clshear_scene_describe(NULL, NULL);
    assert_null(clshear_scene_camera(NULL, 0));
    assert_null(clshear_device_name(NULL));
    assert_null(clshear_driver_name(NULL));
    clshear_context_objects(NULL, NULL, NULL, NULL);
    assert_null(clshear_pattern_table(NULL, &words));
    assert_int_equal(words, 0);
    assert_null(clshear_lens_table(NULL, NULL));
    test_refused(clshear_pattern_constants(NULL, text, sizeof text), CLSHEAR_BAD_ARGUMENT,
                 "clshear_pattern_constants: ");
    clshear_material_init(NULL);
    assert_string_equal(clshear_context_message(NULL), "");
    assert_string_equal(clshear_scene_message(NULL), "");
    assert_string_equal(clshear_film_message(NULL), "");
}

/* The same of the results of the analysis. */
static void getters_need_no_result(void **state)
{
    (void)state;
    clshear_fit fit = {.struct_size = sizeof fit, .slope = 7.0};
    float power = 7.0f;
    assert_null(clshear_points_values(NULL));
    assert_null(clshear_points_names(NULL));
    assert_int_equal(clshear_points_sets(NULL), 0);
    clshear_points_integrate(NULL, NULL, 0, 0, NULL);
    assert_null(clshear_spectrum_power(NULL));
    assert_int_equal(clshear_spectrum_radius(NULL), 0);
    clshear_spectrum_radial(NULL, &power, NULL);
    clshear_spectrum_along(NULL, 1.0, 0.0, &power);
    assert_true(power == 7.0f);
    assert_int_equal(clshear_prediction_parts(NULL), 0);
    assert_null(clshear_prediction_part_name(NULL, 0));
    assert_true(clshear_prediction_isotropic(NULL) == 0.0);
    assert_true(clshear_prediction_in_cones(NULL, 0) == 0.0);
    assert_true(clshear_integrand_at(NULL, 0.5, 0.5) == 0.0);
    assert_int_equal(clshear_convergence_count(NULL, 0), 0);
    assert_null(clshear_convergence_map(NULL, 0, NULL));
    clshear_convergence_fit(NULL, &fit);
    clshear_convergence_local_fit(NULL, 0, &fit);
    assert_true(fit.slope == 7.0);
}

/* Indices past the last element of a result. */
static void indices_end_at_the_last(void **state)
{
    (void)state;
    const uint32_t counts[] = {16, 64};
    clshear_integrand disk = {.struct_size = sizeof disk};
    clshear_convergence *result = NULL;
    clshear_fit fit = {.struct_size = sizeof fit, .slope = 7.0};
    test_ok(clshear_integrand_find("disk", &disk));
    test_ok(clshear_converge_integrand(&disk, "sobol", 0, counts, 2, 10, NULL, &result));
    assert_int_equal(clshear_convergence_count(result, 1), 64);
    assert_int_equal(clshear_convergence_count(result, 2), 0);
    assert_true(clshear_convergence_error(result, 1) > 0.0);
    assert_true(clshear_convergence_error(result, SIZE_MAX) == 0.0);
    clshear_convergence_local_fit(result, 1, &fit);
    clshear_convergence_local_fit(result, SIZE_MAX, &fit);
    assert_true(fit.slope == 7.0);
    clshear_convergence_local_fit(result, 0, &fit);
    assert_true(fit.slope < 0.0);
    clshear_convergence_free(result);
}

/* An integrand whose size is not set is none: it may have been made for another library. */
static void integrands_have_a_size(void **state)
{
    clshear_integrand disk = {.struct_size = sizeof disk};
    clshear_convergence *result = NULL;
    clshear_points *points = NULL;
    const uint32_t counts[] = {4, 16};
    float cells[16];
    double square, mean = 7.0;
    (void)state;
    test_ok(clshear_integrand_find("disk", &disk));
    test_ok(clshear_points_draw("sz", 16, 1, 0, &points));
    assert_true(clshear_integrand_at(&disk, 0.5, 0.5) == 1.0);
    disk.struct_size = 0;
    assert_true(clshear_integrand_at(&disk, 0.5, 0.5) == 0.0);
    clshear_points_integrate(points, &disk, 0, 0, &mean);
    assert_true(mean == 7.0);
    test_refused(clshear_integrand_tabulate(&disk, 4, cells, &square), CLSHEAR_BAD_ARGUMENT,
                 "integrand: struct_size is not set");
    test_refused(clshear_converge_integrand(&disk, "sz", 0, counts, 2, 4, NULL, &result),
                 CLSHEAR_BAD_ARGUMENT, "integrand: struct_size is not set");
    clshear_points_free(points);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(getters_need_no_object),
        cmocka_unit_test(getters_need_no_result),
        cmocka_unit_test(indices_end_at_the_last),
        cmocka_unit_test(integrands_have_a_size),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
