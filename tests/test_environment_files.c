/* Environments by name: files that change or go, and texts in any locale. */
#include "support.h"

#include <fcntl.h>
#include <locale.h>
#include <stdio.h>
#include <sys/stat.h>

/* Writes an image of one colour. Its size in the file is always the same. */
static void write_even_image(const char *path, float value)
{
    enum {
        WIDTH = 16,
        HEIGHT = 8
    };
    float texels[3 * WIDTH * HEIGHT];
    for (int i = 0; i < 3 * WIDTH * HEIGHT; i++)
        texels[i] = value;
    test_colours(path, WIDTH, HEIGHT, texels);
}

static double sky_of(clshear_scene *scene, const char *path, double strength)
{
    clshear_settings *settings = test_looking_down(0.0, 16);
    test_set(settings, CLSHEAR_TARGET, "0,2,0");
    test_set(settings, CLSHEAR_ENVIRONMENT, "%s", path);
    test_set_number(settings, CLSHEAR_ENVIRONMENT_STRENGTH, strength);
    return test_mean_of_render(scene, settings, "R").mean;
}

/* A file that is gone is an error, and one that has changed is read again; one that cannot be told
 * from what was read, since its times and its size were put back, is not. */
static void environment_files_are_kept(void **state)
{
    const char *path = test_path("kept.exr");
    struct stat before;
    FILE *file;
    clshear_scene *scene = test_floor(*state, 1.0f, 0.5f);
    write_even_image(path, 0.25f);
    assert_near(sky_of(scene, path, 1.0), 0.25, 1e-6);
    assert_int_equal(stat(path, &before), 0);
    file = fopen(path, "r+");
    assert_non_null(file);
    assert_int_equal(fputs("no image", file) < 0, 0);
    assert_int_equal(fclose(file), 0);
    const struct timespec times[2] = {before.st_atim, before.st_mtim};
    assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
    assert_near(sky_of(scene, path, 2.0), 0.5, 1e-6);
    write_even_image(path, 0.75f);
    assert_near(sky_of(scene, path, 1.0), 0.75, 1e-6);
    assert_int_equal(remove(path), 0);
    clshear_settings *settings = test_looking_down(0.0, 16);
    clshear_film *film = NULL;
    test_set(settings, CLSHEAR_ENVIRONMENT, "%s", path);
    test_refused(clshear_render(scene, settings, &film), CLSHEAR_BAD_FILE, "kept.exr");
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

/* Environments as text, and numbers in messages, have decimal points in a program whose locale has
 * commas. Skipped where no such locale is installed. */
static void environments_know_no_locale(void **state)
{
    clshear_scene *scene = test_floor(*state, 1.0f, 0.5f);
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL) {
        clshear_scene_free(scene);
        skip();
    }
    assert_near(sky_of(scene, "0.25,0.25, 0.25", 1.0), 0.25, 1e-6);
    assert_near(sky_of(scene, "gradient:0.5,0.5,0.5,0.5,0.5,0.5", 1.0), 0.5, 1e-6);
    clshear_settings *settings = test_looking_down(0.0, 16);
    clshear_film *film = NULL;
    test_set(settings, CLSHEAR_ENVIRONMENT, "0,25");
    test_refused(clshear_render(scene, settings, &film), CLSHEAR_BAD_FILE, "neither R,G,B");
    test_set(settings, CLSHEAR_ENVIRONMENT, "0.5,0.5,0.5");
    test_set(settings, CLSHEAR_SHUTTER_RAMPS, "0.75,0.5");
    test_refused(clshear_render(scene, settings, &film), CLSHEAR_BAD_ARGUMENT, "0.75,0.5");
    setlocale(LC_ALL, "C");
    clshear_settings_free(settings);
    clshear_scene_free(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(environment_files_are_kept),
        cmocka_unit_test(environments_know_no_locale),
    };
    return cmocka_run_group_tests(tests, test_open_context, test_close_context);
}
