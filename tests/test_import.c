/* What all formats have in common, and the wall behind which they are read. */
#include "import_support.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/number.h"
#include "image/image_io.h"

#define SQUARE "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"

/* ----- All formats ----- */

static void far_scenes_keep_their_digits(void **state)
{
    (void)state;
    cs_scene scene = import_text("far.obj", "v 500000.125 4649776.5 0\nv 500001.125 4649776.5 0\n"
                                            "v 500000.125 4649777.25 0\nf 1 2 3\n");
    assert_true(scene.origin[0] == 500001.0 && scene.origin[1] == 4649777.0);
    expect_close(import_position(&scene, 0, 0), -0.875f, -0.5f, 0);
    expect_close(import_position(&scene, 0, 2), -0.875f, 0.25f, 0);
    import_warned("lies far from the origin, at 500001,4649777,0;");
    cs_scene_free(&scene);
    scene = import_text("near.obj", "v 100 0 0\nv 101 0 0\nv 100 1 0\nf 1 2 3\n");
    assert_true(scene.origin[0] == 0.0);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
}

static void alpha_does_not_darken(void **state)
{
    const unsigned char tga[] = {0, 0, 2, 0, 0,  0, 0, 0,   0,   0, 0, 0,
                                 1, 0, 1, 0, 32, 8, 0, 128, 255, 64}; /* blue, green, red, alpha */
    const cs_texel_use use = {.kind = CS_TEXELS_COLOUR, .gain = 1.0f};
    cs_texels texels;
    cs_error error;
    (void)state;
    const char *path = test_bytes("alpha.tga", tga, sizeof tga);
    assert_int_equal(cs_image_read_texels(path, path, NULL, 0, &use, &texels, &error), CLSHEAR_OK);
    assert_int_equal(texels.halves[0], 0x3c00);                            /* 1 */
    assert_true(texels.halves[1] >= 0x32e0 && texels.halves[1] <= 0x3300); /* 0.2158 */
    assert_true(texels.halves[3] >= 0x3400 && texels.halves[3] <= 0x3408); /* 64 / 255 */
    free(texels.halves);
}

static void jpeg_has_its_limit(void **state)
{
    static float plane[70000];
    const char *names[] = {"R", "G", "B"};
    const float *planes[] = {plane, plane, plane};
    const cs_picture picture = {.width = 70000,
                                .height = 1,
                                .full_width = 70000,
                                .full_height = 1,
                                .channel_count = 3,
                                .names = names,
                                .planes = planes};
    cs_error error;
    (void)state;
    assert_int_equal(cs_image_write(test_path("wide.jpg"), &picture, &error), CLSHEAR_BAD_FILE);
    assert_non_null(strstr(error.message, "JPEG holds at most 65500"));
}

static void numbers_know_no_locale(void **state)
{
    char text[32];
    double value = 0.0;
    (void)state;
    setlocale(LC_ALL, "de_DE.UTF-8"); /* where it is installed */
    cs_scene scene = import_text("comma.obj", "v 0.5 0 0\nv 1.5 0 0\nv 0.5 1 0\nf 1 2 3\n");
    expect_close(import_position(&scene, 0, 0), 0.5f, 0, 0);
    cs_scene_free(&scene);
    assert_string_equal(cs_format_number(text, sizeof text, 0.329327822, 9), "0.329327822");
    assert_string_equal(cs_format_number(text, sizeof text, 1e-7, 9), "1e-07");
    setlocale(LC_ALL, "C");
    const char *odd = "+1.5e3,";
    assert_ptr_equal(cs_parse_number(odd, odd + 7, &value), odd + 6);
    assert_true(value == 1500.0);
    const char *large = "-1e999", *tiny = "1e-999";
    cs_parse_number(large, large + 6, &value);
    assert_true(isinf(value) && value < 0.0);
    cs_parse_number(tiny, tiny + 6, &value);
    assert_true(value == 0.0);
}

/* ----- The wall ----- */

static void fake_helper(const char *body)
{
    char text[512];
    snprintf(text, sizeof text, "#!/bin/sh\n%s\n", body);
    const char *path = test_file("fake-import", text);
    chmod(path, 0700);
    setenv("CLSHEAR_IMPORT", path, 1);
}

static void expect_wall(const char *body, const char *words)
{
    const cs_log log = {.warn = import_collect};
    const cs_import_options options = {.smooth_degrees = -1.0};
    const char *path = test_file("wall.obj", SQUARE "f 1 2 3 4\n");
    cs_scene scene;
    cs_error error;
    fake_helper(body);
    cs_scene_init(&scene);
    assert_int_equal(cs_scene_import(path, &options, &scene, &log, &error), CLSHEAR_BAD_FILE);
    if (strstr(error.message, words) == NULL)
        fail_msg("\"%s\" does not contain \"%s\"", error.message, words);
    cs_scene_free(&scene);
    unsetenv("CLSHEAR_IMPORT");
}

static void the_wall_holds(void **state)
{
    (void)state;
    expect_wall("kill -SEGV $$", "the importer crashed (Segmentation fault)");
    expect_wall("kill -XCPU $$", "took longer than");
    expect_wall("exit 3", "ended before it was done");
    expect_wall("head -c 100000 /dev/zero; exit 0", "ended before it was done");
    expect_wall("printf 'AYRA\\014\\0\\0\\0\\377\\377\\377\\377\\377\\377\\377\\17'",
                "ended before");
}

/* The same scene through the real program, where it is built. */
static void the_wall_lets_scenes_through(void **state)
{
    const cs_log log = {.warn = import_collect};
    const cs_import_options options = {.smooth_degrees = -1.0};
    const char *path = test_file("through.obj", "mtllib gone.mtl\n" SQUARE "f 1 2 3 4\n");
    cs_scene here = import_load(path), there;
    cs_error error;
    (void)state;
    import_warnings[0] = '\0';
    cs_scene_init(&there);
    assert_int_equal(cs_scene_import(path, &options, &there, &log, &error), CLSHEAR_OK);
    assert_int_equal(there.indices.count, here.indices.count);
    assert_int_equal(there.positions.count, here.positions.count);
    assert_memory_equal(there.positions.items, here.positions.items, 3 * 4 * here.positions.count);
    assert_memory_equal(there.bounds, here.bounds, sizeof here.bounds);
    import_warned("material file gone.mtl not found");
    cs_scene_free(&here);
    cs_scene_free(&there);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(far_scenes_keep_their_digits),
        cmocka_unit_test(alpha_does_not_darken),
        cmocka_unit_test(jpeg_has_its_limit),
        cmocka_unit_test(numbers_know_no_locale),
        cmocka_unit_test(the_wall_holds),
        cmocka_unit_test(the_wall_lets_scenes_through),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
