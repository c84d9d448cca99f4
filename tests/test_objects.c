/* Public objects: lifetimes, messages and refusals. */
#define _GNU_SOURCE /* feenableexcept */
#include "support.h"

#include <fenv.h>
#include <pthread.h>
#include <sys/stat.h>

#include "clshear/opencl.h"

enum {
    SIZE = 16,
    PIXELS = SIZE * SIZE
};

static clshear_settings *small(test_fixture *made)
{
    return test_settings(made->settings, SIZE, SIZE, 16);
}

static void expect_same_picture(const clshear_film *a, const clshear_film *b)
{
    static const char *const names[] = {"R", "G", "B"};
    for (int c = 0; c < 3; c++)
        assert_memory_equal(clshear_film_channel(a, names[c]), clshear_film_channel(b, names[c]),
                            PIXELS * sizeof(float));
}

/* A scene keeps its context alive, and a film needs neither. NULL can be freed too. */
static void any_order_of_freeing_is_fine(void **state)
{
    test_fixture *made = *state;
    clshear_context *context = test_context();
    clshear_scene *scene = test_cornell(context);
    clshear_settings *settings = small(made);
    clshear_context_free(context);
    clshear_film *film = test_render(scene, settings);
    clshear_settings_free(settings);
    clshear_scene_free(scene);
    assert_non_null(clshear_film_channel(film, "R"));
    test_ok(clshear_film_write(film, test_path("orphan.exr")));
    clshear_film_free(film);
    clshear_context_free(NULL);
    clshear_scene_free(NULL);
    clshear_film_free(NULL);
    clshear_settings_free(NULL);
}

/* Rounding upwards, and traps where there are such, as hosts of numerical work set them: the
 * picture has the same bits, and the caller's environment is back. */
static void the_callers_floats_do_not_matter(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = small(made);
    clshear_film *plain = test_render(made->scene, settings);
    fenv_t given;
    assert_int_equal(fegetenv(&given), 0);
#ifdef __GLIBC__
    feenableexcept(FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
#endif
    fesetround(FE_UPWARD);
    clshear_context *context = test_context();
    clshear_scene *scene = test_cornell(context);
    clshear_film *film = test_render(scene, settings);
    const int rounding = fegetround();
#ifdef __GLIBC__
    const int traps = fegetexcept();
#endif
    fesetenv(&given);
    assert_int_equal(rounding, FE_UPWARD);
#ifdef __GLIBC__
    assert_int_equal(traps, FE_DIVBYZERO | FE_INVALID | FE_OVERFLOW);
#endif
    expect_same_picture(plain, film);
    clshear_film_free(plain);
    clshear_film_free(film);
    clshear_scene_free(scene);
    clshear_context_free(context);
    clshear_settings_free(settings);
}

/* A file that a picture replaces hands on who may read it. */
static void permissions_are_kept(void **state)
{
    test_fixture *made = *state;
    static const mode_t modes[] = {0600, 0664, 0640};
    struct stat about;
    clshear_settings *settings = small(made);
    clshear_film *film = test_render(made->scene, settings);
    const char *path = test_file("private.exr", "old");
    for (size_t i = 0; i < sizeof modes / sizeof *modes; i++) {
        assert_int_equal(chmod(path, modes[i]), 0);
        test_ok(clshear_film_write(film, path));
        assert_int_equal(stat(path, &about), 0);
        assert_int_equal(about.st_mode & 0777, modes[i]);
    }
    clshear_film_free(film);
    clshear_settings_free(settings);
}

#define expect_nameless(call) test_refused((call), CLSHEAR_BAD_ARGUMENT, "path is empty: give ")

/* A file without a name is refused as such, not as one that is not there. */
static void empty_names_are_refused(void **state)
{
    test_fixture *made = *state;
    clshear_scene *scene = NULL;
    clshear_settings *settings = small(made);
    clshear_film *read = NULL, *film = test_render(made->scene, settings);
    expect_nameless(clshear_scene_load(made->context, "", NULL, &scene));
    expect_nameless(clshear_settings_read(settings, "", NULL, NULL));
    expect_nameless(clshear_film_read("", &read));
    expect_nameless(clshear_film_write(film, ""));
    expect_nameless(clshear_film_write_ratio(film, "R", ""));
    expect_nameless(clshear_film_check_path("", SIZE, SIZE));
    expect_nameless(clshear_file_write("", "a", 1));
    assert_true(scene == NULL && read == NULL);
    clshear_film_free(film);
    clshear_settings_free(settings);
}

static void *fail_elsewhere(void *argument)
{
    clshear_scene *scene = NULL;
    assert_string_equal(clshear_message(), "");
    clshear_scene_load(argument, "/no/such/elsewhere.obj", NULL, &scene);
    return (void *)(uintptr_t)(strstr(clshear_message(), "elsewhere.obj") != NULL);
}

/* A thread sees its own last failure. An object has the last failure of any thread on it, but not
 * of other objects. */
static void messages_have_owners(void **state)
{
    test_fixture *made = *state;
    clshear_context *context = test_context();
    clshear_scene *scene = NULL, *empty = NULL;
    pthread_t thread;
    void *seen;
    assert_string_equal(clshear_context_message(context), "");
    assert_int_equal(clshear_scene_load(context, "/no/such/here.obj", NULL, &scene),
                     CLSHEAR_BAD_FILE);
    assert_int_equal(pthread_create(&thread, NULL, fail_elsewhere, context), 0);
    assert_int_equal(pthread_join(thread, &seen), 0);
    assert_non_null(seen);
    assert_non_null(strstr(clshear_message(), "here.obj"));
    assert_non_null(strstr(clshear_context_message(context), "elsewhere.obj"));
    assert_null(strstr(clshear_context_message(made->context), "elsewhere.obj"));
    test_ok(clshear_scene_create(context, &empty));
    assert_string_equal(clshear_scene_message(empty), "");
    test_refused(clshear_scene_complete(empty), CLSHEAR_BAD_ARGUMENT, "no triangles");
    assert_non_null(strstr(clshear_scene_message(empty), "no triangles"));
    assert_non_null(strstr(clshear_context_message(context), "elsewhere.obj"));
    clshear_scene_free(empty);
    clshear_context_free(context);
}

static void scenes_must_be_complete(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = small(made);
    clshear_scene *scene = NULL;
    clshear_film *film = NULL;
    clshear_mesh mesh = {.struct_size = sizeof mesh};
    test_ok(clshear_scene_create(made->context, &scene));
    test_refused(clshear_render(scene, settings, &film), CLSHEAR_BAD_ARGUMENT, "not complete");
    test_refused(clshear_camera_complete(scene, settings), CLSHEAR_BAD_ARGUMENT, "not complete");
    test_refused(clshear_camera_focus(scene, settings, 0, 0), CLSHEAR_BAD_ARGUMENT, "not complete");
    test_refused(clshear_scene_complete(made->scene), CLSHEAR_BAD_ARGUMENT, "complete already");
    test_refused(clshear_scene_add_mesh(made->scene, &mesh), CLSHEAR_BAD_ARGUMENT,
                 "complete already");
    assert_null(film);
    clshear_scene_free(scene);
    clshear_settings_free(settings);
}

/* Accepts a mesh from a program compiled with fewer or more members than the library has. */
static void meshes_of_other_versions_are_taken(void **state)
{
    test_fixture *made = *state;
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const uint32_t indices[3] = {0, 1, 2};
    struct {
        clshear_mesh mesh;
        unsigned char newer[64];
    } given = {.mesh = {.positions = positions,
                        .indices = indices,
                        .vertex_count = 3,
                        .triangle_count = 1,
                        .diffuse = {0.5f, 0.5f, 0.5f},
                        .emission = {1, 1, 1}}};
    const size_t sizes[] = {offsetof(clshear_mesh, emission), sizeof given.mesh, sizeof given};
    const size_t emitters[] = {0, 1, 1};
    memset(given.newer, 0xff, sizeof given.newer);
    for (int i = 0; i < 3; i++) {
        clshear_scene *scene = NULL;
        test_ok(clshear_scene_create(made->context, &scene));
        given.mesh.struct_size = sizes[i];
        test_ok(clshear_scene_add_mesh(scene, &given.mesh));
        test_ok(clshear_scene_complete(scene));
        assert_int_equal(test_scene_info(scene).emitters, emitters[i]);
        clshear_scene_free(scene);
    }
    clshear_scene *scene = NULL;
    clshear_light light = {.kind = CLSHEAR_LIGHT_POINT};
    given.mesh.struct_size = 0;
    test_ok(clshear_scene_create(made->context, &scene));
    test_refused(clshear_scene_add_mesh(scene, &given.mesh), CLSHEAR_BAD_ARGUMENT, "struct_size");
    test_refused(clshear_scene_add_light(scene, &light), CLSHEAR_BAD_ARGUMENT, "struct_size");
    clshear_scene_free(scene);
}

static int stop_at_once(void *user, const clshear_progress *state)
{
    (void)state;
    ++*(int *)user;
    return 1;
}

/* A stopped render succeeds, and its film can be used. */
static void stopped_renders_succeed(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = small(made);
    int calls = 0;
    test_set(settings, CLSHEAR_SPP, "100000");
    test_set(settings, CLSHEAR_ORACLE, "centre");
    clshear_settings_set_progress(settings, stop_at_once, &calls);
    clshear_film *film = test_render(made->scene, settings);
    assert_int_equal(calls, 1);
    assert_int_equal(test_film_info(film).complete, 0);
    for (int i = 0; i < PIXELS; i++)
        assert_at_least(clshear_film_channel(film, "Samples")[i], 0.0f);
    test_ok(clshear_film_write(film, test_path("stopped.exr")));
    clshear_film_free(film);
    clshear_settings_free(settings);
}

/* Counts questions before the first samples; `user` is two numbers: of questions, and the one that
 * is answered by "stop". */
static int stop_before_samples(void *user, const clshear_progress *state)
{
    int *counts = user;
    if (state->samples_per_s > 0.0) return 0;
    return ++counts[0] == counts[1];
}

/* While depths are found, the caller is asked about every 4 million rays, and what it stops has no
 * samples. 256 x 256 pixels with 257 rays each are 16.8 million: four bands of rows. */
static void depths_can_be_stopped(void **state)
{
    test_fixture *made = *state;
    for (int stop = 0; stop <= 2; stop += 2) {
        clshear_settings *settings = test_settings(made->settings, 256, 256, 1);
        int counts[2] = {0, stop};
        test_set(settings, CLSHEAR_LENS_RAYS, "256");
        test_set(settings, CLSHEAR_ORACLE, "centre");
        clshear_settings_set_progress(settings, stop_before_samples, counts);
        clshear_film *film = test_render(made->scene, settings);
        const float *samples = clshear_film_channel(film, "Samples");
        assert_int_equal(test_film_info(film).complete, stop == 0);
        assert_int_equal(counts[0], stop == 0 ? 4 : 2);
        for (int i = 0; i < 256 * 256; i++)
            assert_int_equal((int)samples[i], stop == 0 ? 1 : 0);
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
}

static void failures_leave_results_alone(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = small(made);
    clshear_film *film = test_render(made->scene, settings), *before = film;
    clshear_scene *scene = made->scene;
    test_set(settings, CLSHEAR_REPLICATES, "17");
    assert_int_equal(clshear_render(made->scene, settings, &film), CLSHEAR_BAD_ARGUMENT);
    assert_int_equal(clshear_film_read(test_path("none.exr"), &film), CLSHEAR_BAD_FILE);
    assert_int_equal(clshear_scene_load(made->context, "/none.obj", NULL, &scene),
                     CLSHEAR_BAD_FILE);
    assert_ptr_equal(film, before);
    assert_ptr_equal(scene, made->scene);
    clshear_film_free(film);
    clshear_settings_free(settings);
}

/* Interleaved RGB with a gap in front of each pixel and after each row. */
static void channels_are_copied_with_strides(void **state)
{
    enum {
        ROW = 5 * SIZE + 3
    };
    static const char *const names[] = {"R", "G", "B", "Z"}, *const wrong[] = {"R", "W"};
    test_fixture *made = *state;
    clshear_settings *settings = small(made);
    clshear_film *film = test_render(made->scene, settings);
    float target[ROW * SIZE];
    for (int i = 0; i < ROW * SIZE; i++)
        target[i] = -7.0f;
    test_ok(clshear_film_copy(film, names, 4, target + 1, 5 * sizeof(float), ROW * sizeof(float)));
    for (int y = 0; y < SIZE; y++) {
        const float *row = target + ROW * y;
        for (int x = 0; x < SIZE; x++) {
            assert_near(row[5 * x], -7.0f, 0);
            for (int c = 0; c < 4; c++)
                assert_memory_equal(&row[5 * x + 1 + c],
                                    &clshear_film_channel(film, names[c])[SIZE * y + x],
                                    sizeof(float));
        }
        for (int i = 5 * SIZE + 1; i < ROW; i++)
            assert_near(row[i], -7.0f, 0);
    }
    test_refused(clshear_film_copy(film, wrong, 2, target, 8, 8 * SIZE), CLSHEAR_BAD_ARGUMENT, "W");
    clshear_film_free(film);
    clshear_settings_free(settings);
}

/* A context on the caller's OpenCL objects renders the same bits, and films can be copied to the
 * caller's buffers. */
static void foreign_contexts_render_the_same(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = small(made);
    cl_device_id device;
    cl_int code;
    clshear_context *context = NULL;
    clshear_context_objects(made->context, NULL, &device, NULL);
    cl_context cl = clCreateContext(NULL, 1, &device, NULL, NULL, &code);
    cl_command_queue queue = clCreateCommandQueue(cl, device, 0, &code);
    test_ok(clshear_context_create_from(cl, device, queue, NULL, &context));
    clshear_scene *scene = test_cornell(context);
    clshear_film *own = test_render(made->scene, settings), *foreign = test_render(scene, settings);
    expect_same_picture(own, foreign);
    float values[PIXELS + 2];
    cl_mem buffer = clCreateBuffer(cl, CL_MEM_READ_WRITE, sizeof values, NULL, &code);
    test_ok(clshear_film_copy_to_buffer(foreign, context, "G", buffer, 2 * sizeof(float)));
    clEnqueueReadBuffer(queue, buffer, CL_TRUE, 0, sizeof values, values, 0, NULL, NULL);
    assert_memory_equal(values + 2, clshear_film_channel(foreign, "G"), PIXELS * sizeof(float));
    test_refused(clshear_film_copy_to_buffer(foreign, context, "W", buffer, 0),
                 CLSHEAR_BAD_ARGUMENT, "no channel W");
    test_refused(clshear_film_copy_to_buffer(foreign, context, "G", buffer, 16),
                 CLSHEAR_BAD_ARGUMENT, "bytes; channel G takes");
    clReleaseMemObject(buffer);
    clReleaseCommandQueue(queue);
    clReleaseContext(cl);
    clshear_film_free(own);
    clshear_film_free(foreign);
    clshear_context_free(context);
    clshear_scene_free(scene);
    clshear_settings_free(settings);
}

/* Queues that would race, or are of something else, are refused. */
static void foreign_queues_are_checked(void **state)
{
    test_fixture *made = *state;
    cl_device_id device;
    cl_int code;
    clshear_context *context = NULL;
    clshear_context_objects(made->context, NULL, &device, NULL);
    cl_context cl = clCreateContext(NULL, 1, &device, NULL, NULL, &code);
    cl_context other = clCreateContext(NULL, 1, &device, NULL, NULL, &code);
    cl_command_queue stray = clCreateCommandQueue(other, device, 0, &code);
    cl_command_queue races =
        clCreateCommandQueue(cl, device, CL_QUEUE_OUT_OF_ORDER_EXEC_MODE_ENABLE, &code);
    test_refused(clshear_context_create_from(cl, device, stray, NULL, &context),
                 CLSHEAR_BAD_ARGUMENT, "the queue is of another context or device");
    if (code == CL_SUCCESS) { /* not every driver has such queues */
        test_refused(clshear_context_create_from(cl, device, races, NULL, &context),
                     CLSHEAR_BAD_ARGUMENT, "the queue is out of order");
        clReleaseCommandQueue(races);
    }
    assert_null(context);
    clReleaseCommandQueue(stray);
    clReleaseContext(other);
    clReleaseContext(cl);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(any_order_of_freeing_is_fine),
        cmocka_unit_test(the_callers_floats_do_not_matter),
        cmocka_unit_test(permissions_are_kept),
        cmocka_unit_test(empty_names_are_refused),
        cmocka_unit_test(messages_have_owners),
        cmocka_unit_test(scenes_must_be_complete),
        cmocka_unit_test(meshes_of_other_versions_are_taken),
        cmocka_unit_test(stopped_renders_succeed),
        cmocka_unit_test(depths_can_be_stopped),
        cmocka_unit_test(failures_leave_results_alone),
        cmocka_unit_test(channels_are_copied_with_strides),
        cmocka_unit_test(foreign_contexts_render_the_same),
        cmocka_unit_test(foreign_queues_are_checked),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
