/* What a render says that it takes of memory, against what it takes. */
#include "support.h"

#include <stdatomic.h>
#include <stdio.h>

#include "context/context.h"
#include "kernels/features.h"
#include "meshes.h"
#include "render/memory.h"
#include "render/objects.h"
#include "render/rounds.h"

/* How far an estimate may be off. It is an upper bound for what depends on the picture. */
#define LEAST 0.95
#define MOST 1.25

/* The heap of the process, counted where glibc lets a program stand in for its allocator. Devices
 * that share the host's memory have their buffers in it. */
static atomic_size_t held, most;

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <errno.h>
#include <malloc.h>

#define COUNTS_HEAP 1
#define PUBLIC __attribute__((visibility("default")))

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *old, size_t size);
void *__libc_memalign(size_t alignment, size_t size);
void __libc_free(void *memory);

static void *counted(void *memory)
{
    const size_t size = malloc_usable_size(memory);
    const size_t now = atomic_fetch_add(&held, size) + size;
    size_t before = atomic_load(&most);
    while (now > before && !atomic_compare_exchange_weak(&most, &before, now))
        continue;
    return memory;
}

PUBLIC void *malloc(size_t size)
{
    return counted(__libc_malloc(size));
}

PUBLIC void *calloc(size_t count, size_t size)
{
    return counted(__libc_calloc(count, size));
}

PUBLIC void *realloc(void *old, size_t size)
{
    const size_t before = malloc_usable_size(old);
    void *memory = __libc_realloc(old, size);
    if (memory == NULL && size > 0) return NULL;
    atomic_fetch_sub(&held, before);
    return counted(memory);
}

PUBLIC void *memalign(size_t alignment, size_t size)
{
    return counted(__libc_memalign(alignment, size));
}

PUBLIC void *aligned_alloc(size_t alignment, size_t size)
{
    return memalign(alignment, size);
}

PUBLIC int posix_memalign(void **memory, size_t alignment, size_t size)
{
    *memory = memalign(alignment, size);
    return *memory != NULL ? 0 : ENOMEM;
}

PUBLIC void free(void *memory)
{
    atomic_fetch_sub(&held, malloc_usable_size(memory));
    __libc_free(memory);
}
#else
#define COUNTS_HEAP 0
#endif

/* What a render with these settings will take, as cs_render finds it. */
static cs_memory expected(clshear_scene *scene, const clshear_settings *settings)
{
    cs_error error;
    cs_job job = {0};
    test_ok(cs_job_begin(&job, scene, settings, NULL, &error));
    test_ok(cs_job_choose_samples(&job, &error));
    test_ok(cs_rounds_check(&job, &error));
    const cs_memory memory = cs_memory_of(&job);
    cs_job_free(&job);
    return memory;
}

static void compare(const char *what, double wanted, double taken)
{
    print_message("    %-22s %7.2f MB of %7.2f MB\n", what, 1e-6 * wanted, 1e-6 * taken);
    assert_at_least(wanted, LEAST * taken);
    assert_at_most(wanted, MOST * taken);
}

/* Renders a small picture, so that all is there that pictures have in common, and then the picture.
 * Compares what it takes with what was expected. */
static void check(const char *kind, clshear_scene *scene, clshear_settings *settings)
{
    const cs_device *device = scene->context->device;
    clshear_settings *small = test_settings(settings, 16, 16, 64);
    clshear_film_free(test_render(scene, small));
    const cs_memory wanted = expected(scene, settings);
    const size_t device_before = cs_device_held(device), before = atomic_load(&held);
    atomic_store(&most, before);
    clshear_film *film = test_render(scene, settings);
    const size_t most_at_once = atomic_load(&most);
    const clshear_film_info info = test_film_info(film);
    print_message("%s:\n", kind);
    compare("on the device", wanted.device, (double)(cs_device_most_held(device) - device_before));
    if (COUNTS_HEAP && cs_device_shares_memory(device))
        compare("on host and device", wanted.both, (double)(most_at_once - before));
    assert_at_most(wanted.both, wanted.host + wanted.device);
    assert_int_equal(info.host_bytes, (uint64_t)wanted.host);
    assert_int_equal(info.device_bytes, (uint64_t)wanted.device);
    clshear_film_free(film);
    clshear_settings_free(small);
    clshear_settings_free(settings);
}

/* Pictures of rising size, so that the most that the device has held is that of the last one. Each
 * is a single page: of a film that fills while pages are given back, the heap counts what is not
 * touched yet. */
static void kinds_of_renders(void **state)
{
    test_fixture *box = *state;
    clshear_settings *equal = test_settings(box->settings, 400, 300, 16);
    test_set_number(equal, CLSHEAR_ADAPTIVE, 0);
    check("equal samples", box->scene, equal);

    clshear_settings *shared = test_settings(box->settings, 440, 330, 64);
    test_set_number(shared, CLSHEAR_ADAPTIVE, 1);
    check("shared out", box->scene, shared);

    clshear_settings *rounds = test_settings(box->settings, 460, 340, 32);
    test_set_number(rounds, CLSHEAR_NOISE_PIXEL, 0.1);
    test_set_number(rounds, CLSHEAR_REPLICATES, 4);
    test_set_number(rounds, CLSHEAR_ADAPTIVE, 0);
    check("in rounds", box->scene, rounds);

    clshear_settings *moving = test_settings(box->settings, 480, 360, 64);
    test_set(moving, CLSHEAR_CAMERA_TO, "0.1,1,3.4,0,1,0");
    test_set_number(moving, CLSHEAR_ADAPTIVE, 1);
    check("of a moving camera", box->scene, moving);

    clshear_settings *channels = test_settings(box->settings, 500, 370, 16);
    test_set(channels, CLSHEAR_AOV, "albedo,normal,position,direct");
    test_set_number(channels, CLSHEAR_EXTENDABLE, 1);
    test_set_number(channels, CLSHEAR_GAIN, 1);
    check("with more channels", box->scene, channels);

    clshear_settings *both = test_settings(box->settings, 640, 480, 64);
    test_set(both, CLSHEAR_AOV, "albedo,normal,position,direct");
    test_set_number(both, CLSHEAR_ADAPTIVE, 1);
    check("with more channels, shared out", box->scene, both);
}

/* The wide hierarchy: expected, made as by the first render with bounces, and then described. */
static void wide_hierarchy(void **state)
{
    test_fixture *box = *state;
    static const struct {
        const char *name;
        size_t triangles;
    } meshes[] = {{"spheres", 10000}, {"spheres", 80000}, {"terrain", 40000}};
    for (size_t m = 0; m < sizeof meshes / sizeof *meshes; m++) {
        cs_error error;
        cs_u32 features = CS_FEATURE_PATHS | CS_FEATURE_WIDE;
        clshear_scene *scene = NULL;
        test_ok(clshear_scene_create(box->context, &scene));
        test_ok(test_make_mesh(meshes[m].name, meshes[m].triangles, &scene->scene, &error));
        test_ok(clshear_scene_complete(scene));
        const double wanted = cs_wide_scene_expected(scene, features);
        const double making = cs_footprint_total(cs_wide_scene_making(scene, features));
        const size_t geometry = test_scene_info(scene).device_bytes;
        const size_t before = atomic_load(&held);
        atomic_store(&most, before);
        assert_true(cs_wide_scene_expected(scene, CS_FEATURE_PATHS) == 0.0);
        test_ok(cs_wide_scene_make(scene, &features, &error));
        const size_t made = cs_wide_scene_bytes(scene->wide);
        print_message("%s, %zu triangles in leaves:\n", meshes[m].name, scene->info.references);
        compare("wide hierarchy", wanted, (double)made);
        if (COUNTS_HEAP && cs_device_shares_memory(box->context->device))
            compare("while it is made", making, (double)(atomic_load(&most) - before));
        assert_int_equal(test_scene_info(scene).device_bytes, geometry + made);
        assert_true(cs_wide_scene_expected(scene, features) == 0.0);
        clshear_scene_free(scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(kinds_of_renders, test_open_cornell, test_close),
        cmocka_unit_test_setup_teardown(wide_hierarchy, test_open_cornell, test_close),
    };
    return cmocka_run_group_tests_name("memory", tests, NULL, NULL);
}
