/* Each public function that returns a status refuses each pointer that it needs, by its name. */
#include "support.h"

#include "clshear/analysis.h"
#include "clshear/kernels.h"
#include "clshear/opencl.h"

#define REFUSES_NULL(call) test_refused((call), CLSHEAR_BAD_ARGUMENT, " is NULL")

static void settings_need_their_pointers(void **state)
{
    const test_fixture *made = *state;
    clshear_settings *s = made->settings;
    double low;
    char text[8];
    clshear_setting setting;
    REFUSES_NULL(clshear_settings_create(NULL));
    REFUSES_NULL(clshear_settings_copy(NULL, &s));
    REFUSES_NULL(clshear_settings_copy(s, NULL));
    REFUSES_NULL(clshear_settings_set_integer(NULL, CLSHEAR_SPP, 1));
    REFUSES_NULL(clshear_settings_set_number(NULL, CLSHEAR_FOV, 1.0));
    REFUSES_NULL(clshear_settings_set_numbers(NULL, CLSHEAR_FOV, &low, 1));
    REFUSES_NULL(clshear_settings_set_numbers(s, CLSHEAR_FOV, NULL, 1));
    REFUSES_NULL(clshear_settings_set_text(NULL, CLSHEAR_SPP, "1"));
    REFUSES_NULL(clshear_settings_set_text(s, CLSHEAR_SPP, NULL));
    REFUSES_NULL(clshear_settings_set_aperture(NULL, (const float[1]){1.0f}, 1, 1));
    REFUSES_NULL(clshear_settings_set_aperture(s, NULL, 1, 1));
    REFUSES_NULL(clshear_settings_override(NULL, s));
    REFUSES_NULL(clshear_settings_override(s, NULL));
    REFUSES_NULL(clshear_settings_get_integer(NULL, CLSHEAR_SPP, &(int64_t){0}));
    REFUSES_NULL(clshear_settings_get_integer(s, CLSHEAR_SPP, NULL));
    REFUSES_NULL(clshear_settings_get_number(NULL, CLSHEAR_FOV, &low));
    REFUSES_NULL(clshear_settings_get_number(s, CLSHEAR_FOV, NULL));
    REFUSES_NULL(clshear_settings_get_numbers(NULL, CLSHEAR_FOV, &low, 1, &(size_t){0}));
    REFUSES_NULL(clshear_settings_get_numbers(s, CLSHEAR_FOV, NULL, 1, &(size_t){0}));
    REFUSES_NULL(clshear_settings_get_numbers(s, CLSHEAR_FOV, &low, 1, NULL));
    REFUSES_NULL(clshear_settings_get_text(NULL, CLSHEAR_SPP, text, sizeof text));
    REFUSES_NULL(clshear_settings_get_text(s, CLSHEAR_SPP, NULL, 1));
    REFUSES_NULL(clshear_settings_read(NULL, "file", NULL, NULL));
    REFUSES_NULL(clshear_settings_read(s, NULL, NULL, NULL));
    REFUSES_NULL(clshear_setting_find(NULL, &setting));
    REFUSES_NULL(clshear_setting_find("spp", NULL));
    REFUSES_NULL(clshear_setting_bounds(CLSHEAR_SPP, NULL, &low));
    REFUSES_NULL(clshear_setting_bounds(CLSHEAR_SPP, &low, NULL));
}

static void scenes_need_their_pointers(void **state)
{
    const test_fixture *made = *state;
    clshear_scene *scene = made->scene;
    clshear_settings *s = made->settings;
    const clshear_mesh mesh = {.struct_size = sizeof mesh};
    const clshear_light light = {.struct_size = sizeof light};
    const clshear_material material = {.struct_size = sizeof material};
    uint32_t number;
    REFUSES_NULL(clshear_context_create(NULL, NULL));
    REFUSES_NULL(clshear_list_devices(NULL, NULL));
    REFUSES_NULL(clshear_context_create_from(NULL, NULL, NULL, NULL, &(clshear_context *){NULL}));
    REFUSES_NULL(clshear_scene_load(NULL, "file", NULL, &scene));
    REFUSES_NULL(clshear_scene_load(made->context, NULL, NULL, &scene));
    REFUSES_NULL(clshear_scene_load(made->context, "file", NULL, NULL));
    REFUSES_NULL(clshear_scene_create(NULL, &scene));
    REFUSES_NULL(clshear_scene_create(made->context, NULL));
    REFUSES_NULL(clshear_scene_add_mesh(NULL, &mesh));
    REFUSES_NULL(clshear_scene_add_mesh(scene, NULL));
    REFUSES_NULL(clshear_scene_add_material(NULL, &material, &number));
    REFUSES_NULL(clshear_scene_add_material(scene, NULL, &number));
    REFUSES_NULL(clshear_scene_add_material(scene, &material, NULL));
    REFUSES_NULL(clshear_scene_add_light(NULL, &light));
    REFUSES_NULL(clshear_scene_add_light(scene, NULL));
    REFUSES_NULL(clshear_scene_complete(NULL));
    REFUSES_NULL(clshear_camera_complete(NULL, s));
    REFUSES_NULL(clshear_camera_complete(scene, NULL));
    REFUSES_NULL(clshear_light_complete(NULL, s));
    REFUSES_NULL(clshear_light_complete(scene, NULL));
    REFUSES_NULL(clshear_camera_focus(NULL, s, 0, 0));
    REFUSES_NULL(clshear_camera_focus(scene, NULL, 0, 0));
    assert_true(clshear_lens_extent(NULL) == 0.0f);
}

static void films_need_their_pointers(void **state)
{
    const test_fixture *made = *state;
    clshear_settings *settings = test_settings(made->settings, 2, 2, 4);
    clshear_film *film = test_render(made->scene, settings), *other = NULL;
    const char *const names[] = {"R", NULL};
    float pixels[2 * 2 * 2];
    REFUSES_NULL(clshear_render(NULL, settings, &other));
    REFUSES_NULL(clshear_render(made->scene, settings, NULL));
    REFUSES_NULL(clshear_render_extend(NULL, settings, film, &other));
    REFUSES_NULL(clshear_render_extend(made->scene, settings, NULL, &other));
    REFUSES_NULL(clshear_render_extend(made->scene, settings, film, NULL));
    REFUSES_NULL(clshear_film_copy(NULL, names, 1, pixels, 4, 8));
    REFUSES_NULL(clshear_film_copy(film, NULL, 1, pixels, 4, 8));
    REFUSES_NULL(clshear_film_copy(film, names, 1, NULL, 4, 8));
    REFUSES_NULL(clshear_film_copy(film, names, 2, pixels, 8, 16));
    REFUSES_NULL(clshear_film_annotate(NULL, "name", "text"));
    REFUSES_NULL(clshear_film_annotate(film, NULL, "text"));
    REFUSES_NULL(clshear_film_annotate(film, "name", NULL));
    REFUSES_NULL(clshear_film_merge(NULL, 1, &other));
    REFUSES_NULL(clshear_film_merge((const clshear_film *const[]){NULL}, 1, &other));
    REFUSES_NULL(clshear_film_merge((const clshear_film *const[]){film}, 1, NULL));
    REFUSES_NULL(clshear_film_read(NULL, &other));
    REFUSES_NULL(clshear_film_read("file", NULL));
    REFUSES_NULL(clshear_film_write(NULL, "file"));
    REFUSES_NULL(clshear_film_write(film, NULL));
    REFUSES_NULL(clshear_film_check_path(NULL, 1, 1));
    REFUSES_NULL(clshear_film_write_ratio(NULL, "Gain", "file"));
    REFUSES_NULL(clshear_film_write_ratio(film, NULL, "file"));
    REFUSES_NULL(clshear_film_write_ratio(film, "Gain", NULL));
    REFUSES_NULL(clshear_film_copy_to_buffer(NULL, made->context, "R", NULL, 0));
    REFUSES_NULL(clshear_film_copy_to_buffer(film, NULL, "R", NULL, 0));
    REFUSES_NULL(clshear_film_copy_to_buffer(film, made->context, NULL, NULL, 0));
    REFUSES_NULL(clshear_film_copy_to_buffer(film, made->context, "R", NULL, 0));
    REFUSES_NULL(clshear_file_write(NULL, "", 0));
    REFUSES_NULL(clshear_file_write("file", NULL, 0));
    clshear_film_free(film);
    clshear_settings_free(settings);
}

static void kernels_need_their_pointers(void **state)
{
    const test_fixture *made = *state;
    clshear_pattern *pattern = NULL;
    clshear_lens *lens = NULL;
    uint32_t count;
    char words[8];
    test_ok(clshear_pattern_create("sz", 16, CLSHEAR_ORDER_COHERENT, &pattern));
    test_ok(clshear_lens_create(made->settings, &lens));
    test_ok(clshear_sampler_count(NULL, 16, &count)); /* the default one */
    REFUSES_NULL(clshear_sampler_count("sz", 16, NULL));
    REFUSES_NULL(clshear_pattern_create("sz", 16, CLSHEAR_ORDER_COHERENT, NULL));
    REFUSES_NULL(clshear_pattern_constants(NULL, words, sizeof words));
    REFUSES_NULL(clshear_pattern_constants(pattern, NULL, sizeof words));
    REFUSES_NULL(clshear_lens_create(NULL, &lens));
    REFUSES_NULL(clshear_lens_create(made->settings, NULL));
    REFUSES_NULL(clshear_lens_optics(NULL, words, sizeof words));
    REFUSES_NULL(clshear_lens_optics(lens, NULL, sizeof words));
    REFUSES_NULL(clshear_lens_camera(NULL, words, sizeof words));
    REFUSES_NULL(clshear_lens_camera(lens, NULL, sizeof words));
    clshear_lens_free(lens);
    clshear_pattern_free(pattern);
}

static clshear_status no_function(void *user, const float *points, size_t count, float *values)
{
    (void)user;
    (void)points;
    (void)count;
    (void)values;
    return CLSHEAR_OK;
}

static void points_need_their_pointers(void **state)
{
    const test_fixture *made = *state;
    clshear_points *points = NULL, *other = NULL;
    clshear_spectrum *spectrum = NULL;
    float values[4] = {0.0f};
    double means[1];
    test_ok(clshear_points_draw(NULL, 16, 1, 0, &points)); /* of the default sampler */
    REFUSES_NULL(clshear_points_draw("sz", 16, 1, 0, NULL));
    REFUSES_NULL(clshear_points_draw_fresh("sz", 16, 1, 0, NULL));
    REFUSES_NULL(clshear_points_draw_moving("sz", 16, 1, 0, 0, NULL));
    REFUSES_NULL(clshear_points_create(NULL, 1, 2, "xy", &other));
    REFUSES_NULL(clshear_points_create(values, 1, 2, NULL, &other));
    REFUSES_NULL(clshear_points_create(values, 1, 2, "xy", NULL));
    REFUSES_NULL(clshear_points_read(NULL, &other));
    REFUSES_NULL(clshear_points_read("file", NULL));
    REFUSES_NULL(clshear_points_shear(NULL, CLSHEAR_SHEAR_NONE, 0.0f));
    REFUSES_NULL(clshear_points_shear_moving(NULL, CLSHEAR_SHEAR_NONE, 0.0f, values));
    REFUSES_NULL(clshear_points_shear_moving(points, CLSHEAR_SHEAR_NONE, 0.0f, NULL));
    REFUSES_NULL(clshear_points_select(NULL, "xy"));
    REFUSES_NULL(clshear_points_select(points, NULL));
    REFUSES_NULL(clshear_points_write(NULL, "file"));
    REFUSES_NULL(clshear_points_write(points, NULL));
    REFUSES_NULL(clshear_points_integrate_4d(NULL, no_function, NULL, 0, 0, means));
    REFUSES_NULL(clshear_points_integrate_4d(points, NULL, NULL, 0, 0, means));
    REFUSES_NULL(clshear_points_integrate_4d(points, no_function, NULL, 0, 0, NULL));
    REFUSES_NULL(clshear_spectrum_measure(NULL, points, 8, 8, &spectrum));
    REFUSES_NULL(clshear_spectrum_measure(made->context, NULL, 8, 8, &spectrum));
    REFUSES_NULL(clshear_spectrum_measure(made->context, points, 8, 8, NULL));
    REFUSES_NULL(clshear_spectrum_of_grid(NULL, 2, 2, &spectrum));
    REFUSES_NULL(clshear_spectrum_of_grid(values, 2, 2, NULL));
    REFUSES_NULL(clshear_spectrum_of_slice(NULL, 2, 2, &spectrum));
    REFUSES_NULL(clshear_spectrum_of_slice(values, 2, 2, NULL));
    REFUSES_NULL(clshear_spectrum_write(NULL, 0, "file"));
    clshear_points_free(points);
}

static void predictions_need_their_pointers(void **state)
{
    const test_fixture *made = *state;
    const clshear_reach reach = {.struct_size = sizeof reach, .axis = 4, .plane = 2, .block = 1};
    clshear_integrand disk = {.struct_size = sizeof disk};
    clshear_points *points = NULL;
    clshear_spectrum *spectrum = NULL;
    clshear_prediction *result = NULL;
    float cells[16] = {0.0f};
    double square;
    test_ok(clshear_points_draw("sz", 16, 1, 0, &points));
    test_ok(clshear_spectrum_of_grid(cells, 4, 4, &spectrum));
    test_ok(clshear_integrand_find("disk", &disk));
    REFUSES_NULL(clshear_spectrum_write(spectrum, 0, NULL));
    REFUSES_NULL(clshear_integrand_find(NULL, &disk));
    REFUSES_NULL(clshear_integrand_find("disk", NULL));
    REFUSES_NULL(clshear_integrand_tabulate(NULL, 4, cells, &square));
    REFUSES_NULL(clshear_integrand_tabulate(&disk, 4, NULL, &square));
    REFUSES_NULL(clshear_integrand_tabulate(&disk, 4, cells, NULL));
    REFUSES_NULL(clshear_predict_variance(NULL, cells, 4, 1.0, &result));
    REFUSES_NULL(clshear_predict_variance(spectrum, NULL, 4, 1.0, &result));
    REFUSES_NULL(clshear_predict_variance(spectrum, cells, 4, 1.0, NULL));
#define PREDICT(context, points, function, reach, result) \
    REFUSES_NULL(                                         \
        clshear_predict_variance_4d((context), (points), (function), NULL, (reach), (result)))
    PREDICT(NULL, points, no_function, &reach, &result);
    PREDICT(made->context, NULL, no_function, &reach, &result);
    PREDICT(made->context, points, NULL, &reach, &result);
    PREDICT(made->context, points, no_function, NULL, &result);
    PREDICT(made->context, points, no_function, &reach, NULL);
#undef PREDICT
    clshear_spectrum_free(spectrum);
    clshear_points_free(points);
}

static void pixels_need_their_pointers(void **state)
{
    const test_fixture *made = *state;
    clshear_scene *scene = made->scene;
    const clshear_settings *s = made->settings;
    const char *const names[] = {"R", NULL};
    const float points[5] = {0.0f}, *const planes[] = {points, NULL};
    float rgb[3], shear_px, velocity_px[2];
    int moves;
    REFUSES_NULL(clshear_radiance(NULL, s, 0, 0, points, 1, rgb));
    REFUSES_NULL(clshear_radiance(scene, s, 0, 0, NULL, 1, rgb));
    REFUSES_NULL(clshear_radiance(scene, s, 0, 0, points, 1, NULL));
    REFUSES_NULL(clshear_moving_radiance(scene, s, 0, 0, NULL, 1, rgb));
    REFUSES_NULL(clshear_radiance_of_samples(NULL, s, 0, 0, 0.0f, points, 1, rgb));
    REFUSES_NULL(clshear_radiance_of_samples(scene, s, 0, 0, 0.0f, NULL, 1, rgb));
    REFUSES_NULL(clshear_radiance_of_samples(scene, s, 0, 0, 0.0f, points, 1, NULL));
    REFUSES_NULL(clshear_moving_radiance_of_samples(scene, s, 0, 0, 0, NULL, points, 1, rgb));
    REFUSES_NULL(clshear_pixel_motion(NULL, s, 0, 0, &moves, velocity_px));
    REFUSES_NULL(clshear_pixel_motion(scene, s, 0, 0, NULL, velocity_px));
    REFUSES_NULL(clshear_pixel_motion(scene, s, 0, 0, &moves, NULL));
    REFUSES_NULL(clshear_pixel_shear(NULL, s, 0, 0, &shear_px));
    REFUSES_NULL(clshear_pixel_shear(scene, s, 0, 0, NULL));
    REFUSES_NULL(clshear_image_write(NULL, 1, 1, 1, names, planes));
    REFUSES_NULL(clshear_image_write("a.exr", 1, 1, 1, NULL, planes));
    REFUSES_NULL(clshear_image_write("a.exr", 1, 1, 1, names, NULL));
    REFUSES_NULL(clshear_image_write("a.exr", 1, 1, 1, names + 1, planes));
    REFUSES_NULL(clshear_image_write("a.exr", 1, 1, 1, names, planes + 1));
}

static void studies_need_their_pointers(void **state)
{
    const test_fixture *made = *state;
    clshear_scene *scene = made->scene;
    clshear_settings *s = test_settings(made->settings, 2, 2, 4);
    const uint32_t n[2] = {4, 16};
    const double means[4] = {1.0, 2.0, 3.0, 4.0};
    clshear_integrand disk = {.struct_size = sizeof disk};
    clshear_convergence *result = NULL;
    clshear_fit fit = {.struct_size = sizeof fit};
    double a, errors[2];
    test_ok(clshear_integrand_find("disk", &disk));
    REFUSES_NULL(clshear_variance_of(NULL, 2, &a, errors));
    REFUSES_NULL(clshear_variance_of(means, 2, NULL, errors));
    REFUSES_NULL(clshear_variance_of(means, 2, &a, NULL));
    REFUSES_NULL(clshear_fit_slope(NULL, 2, means, 2, NULL, errors, &fit));
    REFUSES_NULL(clshear_fit_slope(n, 2, NULL, 2, NULL, errors, &fit));
    REFUSES_NULL(clshear_fit_slope(n, 2, means, 2, NULL, NULL, &fit));
    REFUSES_NULL(clshear_fit_slope(n, 2, means, 2, NULL, errors, NULL));
    REFUSES_NULL(clshear_fit_slope_of_parts(NULL, 2, means, 2, errors, &fit));
    REFUSES_NULL(clshear_fit_slope_of_parts(n, 2, NULL, 2, errors, &fit));
    REFUSES_NULL(clshear_fit_slope_of_parts(n, 2, means, 2, NULL, &fit));
    REFUSES_NULL(clshear_fit_slope_of_parts(n, 2, means, 2, errors, NULL));
    REFUSES_NULL(clshear_converge_integrand(NULL, "sz", 0, n, 2, 4, NULL, &result));
    REFUSES_NULL(clshear_converge_integrand(&disk, "sz", 0, NULL, 2, 4, NULL, &result));
    REFUSES_NULL(clshear_converge_integrand(&disk, "sz", 0, n, 2, 4, NULL, NULL));
    REFUSES_NULL(clshear_converge_pixel(NULL, s, 0, 0, n, 2, 4, NULL, &result));
    REFUSES_NULL(clshear_converge_pixel(scene, s, 0, 0, NULL, 2, 4, NULL, &result));
    REFUSES_NULL(clshear_converge_pixel(scene, s, 0, 0, n, 2, 4, NULL, NULL));
    REFUSES_NULL(clshear_converge_image(NULL, s, n, 2, 4, NULL, &result));
    REFUSES_NULL(clshear_converge_image(scene, s, NULL, 2, 4, NULL, &result));
    REFUSES_NULL(clshear_converge_image(scene, s, n, 2, 4, NULL, NULL));
    clshear_film *film = test_render(scene, s);
    test_refused(clshear_converge_image(scene, NULL, n, 2, 4, film, &result), CLSHEAR_BAD_ARGUMENT,
                 "needs the image's size, 512 x 512"); /* of the fallbacks */
    clshear_film_free(film);
    clshear_settings_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(settings_need_their_pointers),
        cmocka_unit_test(scenes_need_their_pointers),
        cmocka_unit_test(films_need_their_pointers),
        cmocka_unit_test(kernels_need_their_pointers),
        cmocka_unit_test(points_need_their_pointers),
        cmocka_unit_test(predictions_need_their_pointers),
        cmocka_unit_test(pixels_need_their_pointers),
        cmocka_unit_test(studies_need_their_pointers),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
