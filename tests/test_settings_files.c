/* Settings from files: flags, and images of apertures. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/analysis.h"

static int take_other(void *user, const char *file, int line, const char *name, const char *value)
{
    char *seen = user;
    const size_t used = strlen(seen);
    snprintf(seen + used, 256 - used, "%s:%d %s=%s;", strrchr(file, '/') + 1, line, name,
             value != NULL ? value : "NULL");
    return strcmp(name, "bad") == 0;
}

static void files_are_read(void **state)
{
    clshear_settings *settings = *state;
    const char *path =
        test_file("good.flags", "\xef\xbb\xbf# a comment\n\n  --spp 64   # behind a value\n"
                                "width=32\nheight 16\r\n--adaptive\n"
                                "eye 1,2,3\nlight 0,0,0,1,1,1\nlight 1,0,0,1,1,1\n"
                                "aperture-radius\t2");
    double eye[3], lights[12];
    int64_t spp, width, height, adaptive;
    size_t count;
    test_ok(clshear_settings_read(settings, path, NULL, NULL));
    test_ok(clshear_settings_get_integer(settings, CLSHEAR_SPP, &spp));
    test_ok(clshear_settings_get_integer(settings, CLSHEAR_WIDTH, &width));
    test_ok(clshear_settings_get_integer(settings, CLSHEAR_HEIGHT, &height));
    test_ok(clshear_settings_get_integer(settings, CLSHEAR_ADAPTIVE, &adaptive));
    assert_int_equal(spp, 64);
    assert_int_equal(width, 32);
    assert_int_equal(height, 16);
    assert_int_equal(adaptive, 1);
    test_ok(clshear_settings_get_numbers(settings, CLSHEAR_EYE, eye, 3, &count));
    assert_near(eye[0], 1.0, 0);
    assert_near(eye[1], 2.0, 0);
    assert_near(eye[2], 3.0, 0);
    test_ok(clshear_settings_get_numbers(settings, CLSHEAR_LIGHT, lights, 12, &count));
    assert_int_equal(count, 12);
    assert_near(lights[6], 1.0, 0);
    assert_true(clshear_settings_is_set(settings, CLSHEAR_LENS_RADIUS));
}

static void errors_in_files_have_a_place(void **state)
{
    static const struct {
        const char *text, *words;
    } cases[] = {{"spp 4\nspp none\n", "case.flags:2: spp none: must be a whole number"},
                 {"\n\nfov\n", "case.flags:3: fov needs a value"},
                 {"spq 4\n", "case.flags:1: unknown setting spq"}};
    clshear_settings *settings = *state;
    char seen[256] = "";
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        test_refused(
            clshear_settings_read(settings, test_file("case.flags", cases[i].text), NULL, NULL),
            CLSHEAR_BAD_ARGUMENT, cases[i].words);
    test_refused(clshear_settings_read(settings, test_path("none.flags"), NULL, NULL),
                 CLSHEAR_BAD_FILE, "none.flags");
    test_refused(clshear_settings_read(settings, SCENES, NULL, NULL), CLSHEAR_BAD_FILE, "scenes");
    const char *path = test_file("other.flags", "spp 8\n--out a b.exr\nquiet\nbad 1\n");
    test_refused(clshear_settings_read(settings, path, take_other, seen), CLSHEAR_BAD_ARGUMENT,
                 "other.flags:4");
    assert_string_equal(seen, "other.flags:2 out=a b.exr;other.flags:3 quiet=NULL;"
                              "other.flags:4 bad=1;");
}

/* Pictures, text in UTF-16 and streams without an end are no settings, and are told so. */
static void what_is_no_text_is_refused(void **state)
{
    static const char words[] = "is no settings file: it must be text";
    clshear_settings *settings = *state;
    test_refused(clshear_settings_read(settings, test_bytes("wide.flags", "s\0p\0p\0 \0004\0", 10),
                                       NULL, NULL),
                 CLSHEAR_BAD_FILE, words);
    test_refused(
        clshear_settings_read(settings, test_bytes("zeros.flags", "spp 4\n\0\0", 8), NULL, NULL),
        CLSHEAR_BAD_FILE, words);
    test_refused(clshear_settings_read(settings, "/dev/zero", NULL, NULL), CLSHEAR_BAD_FILE, words);
}

static void apertures_are_checked(void **state)
{
    clshear_settings *settings = *state;
    const float dark[4] = {0}, good[4] = {0, 1, 2, 0}, wrong[4] = {1, NAN, 0, 0};
    int64_t aperture;
    test_bytes("aperture.pgm", "P5\n2 2\n255\n\0\377\200\0", 15);
    test_refused(clshear_settings_set_aperture(settings, dark, 2, 2), CLSHEAR_BAD_ARGUMENT,
                 "black");
    test_refused(clshear_settings_set_aperture(settings, wrong, 2, 2), CLSHEAR_BAD_ARGUMENT,
                 "luminance");
    test_refused(clshear_settings_set_aperture(settings, good, 257, 1), CLSHEAR_BAD_ARGUMENT,
                 "257 x 1");
    test_refused(clshear_settings_set_aperture(settings, NULL, 2, 2), CLSHEAR_BAD_ARGUMENT, "NULL");
    test_refused(clshear_settings_set_text(settings, CLSHEAR_APERTURE, test_path("none.png")),
                 CLSHEAR_BAD_FILE, "none.png");
    test_refused(clshear_settings_set_text(settings, CLSHEAR_APERTURE, "round"),
                 CLSHEAR_BAD_ARGUMENT, "disk, square, polygon or an image file");
    assert_false(clshear_settings_is_set(settings, CLSHEAR_APERTURE));
    test_ok(clshear_settings_set_aperture(settings, good, 2, 2));
    test_set(settings, CLSHEAR_APERTURE, "%s", test_path("aperture.pgm"));
    test_ok(clshear_settings_get_integer(settings, CLSHEAR_APERTURE, &aperture));
    assert_int_equal(aperture, CLSHEAR_APERTURE_IMAGE);
    assert_near(clshear_lens_extent(settings), 1.0f, 0);
}

int main(void)
{
#define WITH_SETTINGS(test) \
    cmocka_unit_test_setup_teardown(test, test_open_settings, test_close_settings)
    const struct CMUnitTest tests[] = {
        WITH_SETTINGS(files_are_read),
        WITH_SETTINGS(errors_in_files_have_a_place),
        WITH_SETTINGS(what_is_no_text_is_refused),
        WITH_SETTINGS(apertures_are_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
