/* Concurrent work gives the same results as sequential work, bit for bit. scripts/tsan runs this
 * test under ThreadSanitizer. */
#define _GNU_SOURCE /* sched_setaffinity */
#include "support.h"

#include <pthread.h>
#include <sched.h>
#include <stdio.h>

#include "base/parallel.h"

enum {
    SIZE = 32,
    PIXELS = SIZE * SIZE,
    ROUNDS = 4,
    THREADS = 2
};

/* A thread's task. Threads return failures as text, because cmocka's assertions only work in the
 * thread of the test. */
typedef struct task {
    clshear_context *context;
    clshear_scene *scene;
    clshear_settings *settings;
    clshear_film *expected; /* the same render in one thread */
    clshear_film *written;
    const char *path;
    const char *wrong; /* a failure as text, or NULL */
} task;

static int is_same(const clshear_film *a, const clshear_film *b)
{
    const char *name;
    for (size_t i = 0; (name = clshear_film_channel_name(a, i)) != NULL; i++) {
        const float *other = clshear_film_channel(b, name);
        if (other == NULL ||
            memcmp(clshear_film_channel(a, name), other, PIXELS * sizeof(float)) != 0)
            return 0;
    }
    return 1;
}

static void *render(void *argument)
{
    task *task = argument;
    for (int round = 0; round < ROUNDS && task->wrong == NULL; round++) {
        clshear_film *film = NULL;
        if (clshear_render(task->scene, task->settings, &film) != CLSHEAR_OK)
            task->wrong = "a render failed";
        else if (!is_same(task->expected, film))
            task->wrong = "a picture differs";
        clshear_film_free(film);
    }
    return NULL;
}

/* Runs both tasks at the same time and fails the test if either fails. */
static void run_both(void *(*first)(void *), void *(*second)(void *), task *tasks)
{
    pthread_t threads[THREADS];
    assert_int_equal(pthread_create(&threads[0], NULL, first, &tasks[0]), 0);
    assert_int_equal(pthread_create(&threads[1], NULL, second, &tasks[1]), 0);
    for (int i = 0; i < THREADS; i++)
        assert_int_equal(pthread_join(threads[i], NULL), 0);
    for (int i = 0; i < THREADS; i++)
        if (tasks[i].wrong != NULL) fail_msg("thread %d: %s", i, tasks[i].wrong);
}

static clshear_settings *small(test_fixture *made, const char *sampler)
{
    clshear_settings *settings = test_settings(made->settings, SIZE, SIZE, 64);
    test_set(settings, CLSHEAR_SAMPLER, "%s", sampler);
    return settings;
}

static void expect_alone(task *tasks)
{
    for (int i = 0; i < THREADS; i++)
        tasks[i].expected = test_render(tasks[i].scene, tasks[i].settings);
}

static void close_tasks(task *tasks)
{
    for (int i = 0; i < THREADS; i++) {
        clshear_film_free(tasks[i].expected);
        clshear_settings_free(tasks[i].settings);
    }
}

static void two_contexts(void **state)
{
    test_fixture *made = *state;
    clshear_context *context = test_context();
    clshear_scene *scene = test_cornell(context);
    task tasks[THREADS] = {{.scene = made->scene, .settings = small(made, "mj")},
                           {.scene = scene, .settings = small(made, "sz")}};
    expect_alone(tasks);
    run_both(render, render, tasks);
    close_tasks(tasks);
    clshear_scene_free(scene);
    clshear_context_free(context);
}

static void two_scenes_of_one_context(void **state)
{
    test_fixture *made = *state;
    clshear_scene *floor = test_floor(made->context, 300.0f, 0.5f);
    task tasks[THREADS] = {{.scene = made->scene, .settings = small(made, "sz")},
                           {.scene = floor, .settings = small(made, "sobol")}};
    expect_alone(tasks);
    run_both(render, render, tasks);
    close_tasks(tasks);
    clshear_scene_free(floor);
}

/* The settings have lights of their own, which each render uploads for itself. */
static void one_scene_two_settings(void **state)
{
    test_fixture *made = *state;
    task tasks[THREADS] = {{.scene = made->scene, .settings = small(made, "sz")},
                           {.scene = made->scene, .settings = small(made, "halton")}};
    test_set(tasks[0].settings, CLSHEAR_ADAPTIVE, "1");
    test_set(tasks[1].settings, CLSHEAR_LIGHT, "100,400,100,1e5,2e5,1e5");
    test_set(tasks[1].settings, CLSHEAR_GAIN, "1");
    expect_alone(tasks);
    run_both(render, render, tasks);
    close_tasks(tasks);
}

static void *write_film(void *argument)
{
    task *task = argument;
    for (int round = 0; round < 8 * ROUNDS && task->wrong == NULL; round++) {
        clshear_film *read = NULL;
        if (clshear_film_write(task->written, task->path) != CLSHEAR_OK ||
            clshear_film_read(task->path, &read) != CLSHEAR_OK)
            task->wrong = "a film cannot be written and read";
        else if (!is_same(task->written, read))
            task->wrong = "a film is read differently";
        clshear_film_free(read);
    }
    return NULL;
}

static void a_film_is_written_meanwhile(void **state)
{
    test_fixture *made = *state;
    char path[1024];
    snprintf(path, sizeof path, "%s", test_path("meanwhile.exr"));
    task tasks[THREADS] = {{.scene = made->scene, .settings = small(made, "sz")},
                           {.scene = made->scene, .settings = small(made, "mj"), .path = path}};
    expect_alone(tasks);
    tasks[1].written = tasks[1].expected;
    run_both(render, write_film, tasks);
    close_tasks(tasks);
}

static void *load_good(void *argument)
{
    task *task = argument;
    for (int round = 0; round < 2 * ROUNDS && task->wrong == NULL; round++) {
        clshear_scene *scene = NULL;
        if (clshear_scene_load(task->context, task->path, NULL, &scene) != CLSHEAR_OK)
            task->wrong = "a good file is refused";
        else if (strcmp(clshear_message(), "") != 0 ||
                 strcmp(clshear_scene_message(scene), "") != 0)
            task->wrong = "another thread's message is seen";
        const char *last = clshear_context_message(task->context);
        if (*last != '\0' && strstr(last, "broken_thread.obj") == NULL)
            task->wrong = "the context's message is torn";
        clshear_scene_free(scene);
    }
    return NULL;
}

static void *load_broken(void *argument)
{
    task *task = argument;
    for (int round = 0; round < 8 * ROUNDS && task->wrong == NULL; round++) {
        clshear_scene *scene = NULL;
        if (clshear_scene_load(task->context, task->path, NULL, &scene) != CLSHEAR_BAD_FILE)
            task->wrong = "a broken file is not refused";
        else if (strstr(clshear_message(), "broken_thread.obj") == NULL ||
                 strstr(clshear_context_message(task->context), "broken_thread.obj") == NULL)
            task->wrong = "the message is not that of the broken file";
    }
    return NULL;
}

static void broken_and_good_files(void **state)
{
    test_fixture *made = *state;
    char path[1024];
    snprintf(path, sizeof path, "%s",
             test_file("broken_thread.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n"));
    task tasks[THREADS] = {{.context = made->context, .path = SCENES "/cornell.obj"},
                           {.context = made->context, .path = path}};
    run_both(load_good, load_broken, tasks);
}

/* A process that may use one core has one. */
static void affinity_counts(void **state)
{
    cpu_set_t allowed, first;
    size_t core = 0;
    (void)state;
    if (sched_getaffinity(0, sizeof allowed, &allowed) != 0) skip(); /* more than 1024 cores */
    assert_int_equal(cs_core_count(), CPU_COUNT(&allowed) < 256 ? CPU_COUNT(&allowed) : 256);
    while (!CPU_ISSET(core, &allowed))
        core++;
    CPU_ZERO(&first);
    CPU_SET(core, &first);
    assert_int_equal(sched_setaffinity(0, sizeof first, &first), 0);
    assert_int_equal(cs_core_count(), 1);
    assert_int_equal(sched_setaffinity(0, sizeof allowed, &allowed), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_contexts),           cmocka_unit_test(two_scenes_of_one_context),
        cmocka_unit_test(one_scene_two_settings), cmocka_unit_test(a_film_is_written_meanwhile),
        cmocka_unit_test(broken_and_good_files),  cmocka_unit_test(affinity_counts),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
