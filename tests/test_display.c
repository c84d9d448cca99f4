/* Pictures that are shown while they are rendered: in a viewer, and in a file. */
#include "support.h"

#include <math.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "receiver.h"

enum {
    WIDTH = 150, /* three columns and two rows of tiles, of which the last are not whole */
    HEIGHT = 100
};

static clshear_settings *settings_of(test_fixture *made, uint32_t spp)
{
    return test_settings(made->settings, WIDTH, HEIGHT, spp);
}

static void show_in(clshear_settings *settings, const receiver *r)
{
    test_set(settings, CLSHEAR_DISPLAY, "127.0.0.1:%d", r->port);
}

/* Whether a channel of the film is the viewer's within the window, which lies at (x0, y0), and
 * nothing is outside. */
static void expect_channel(const receiver *r, const clshear_film *film, const char *name, int x0,
                           int y0)
{
    const clshear_film_info info = test_film_info(film);
    const float *theirs = receiver_pixels(r, name), *mine = clshear_film_channel(film, name);
    if (theirs == NULL) fail_msg("%s is not there", name);
    for (int y = 0; y < r->height; y++)
        for (int x = 0; x < r->width; x++) {
            const int inside = x >= x0 && y >= y0 && x < x0 + info.width && y < y0 + info.height;
            const float zero = 0.0f;
            const float *right = inside ? &mine[(y - y0) * info.width + x - x0] : &zero;
            if (memcmp(right, &theirs[y * r->width + x], sizeof *right) != 0)
                fail_msg("%s differs at %d, %d", name, x, y);
        }
}

static void expect_film(const receiver *r, const clshear_film *film, int x0, int y0)
{
    const char *name;
    assert_string_equal(r->wrong, "");
    assert_int_equal(r->width, WIDTH);
    assert_int_equal(r->height, HEIGHT);
    for (size_t c = 0; (name = clshear_film_channel_name(film, c)) != NULL; c++)
        expect_channel(r, film, name, x0, y0);
}

/* In the end the viewer has every bit of every channel; those of the replicates, which come last,
 * in a picture made anew. */
static void a_viewer_has_the_film(void **state)
{
    test_fixture *made = *state;
    for (int crops = 0; crops < 2; crops++) {
        clshear_settings *settings = settings_of(made, 8);
        receiver r = {0};
        receiver_start(&r);
        show_in(settings, &r);
        test_set(settings, CLSHEAR_AOV, "albedo,normal,depth");
        test_set(settings, CLSHEAR_KEEP_PATTERNS, "1");
        if (crops) test_set(settings, CLSHEAR_CROP, "31,120,17,90");
        clshear_film *film = test_render(made->scene, settings);
        receiver_stop(&r);
        expect_film(&r, film, crops ? 31 : 0, crops ? 17 : 0);
        assert_int_equal(r.connections, 1);
        assert_string_equal(r.name, "clshear");
        assert_int_equal(r.creates, r.closes);
        receiver_free(&r);
        clshear_film_free(film);
        clshear_settings_free(settings);
    }
}

/* Ends a render when the viewer has had the picture twice, or has left. */
static int until_shown(void *user, const clshear_progress *progress)
{
    receiver *r = user;
    (void)progress;
    return r->updates >= 12 || r->has_left;
}

/* Tiles come before the end, as they change, and without changing a bit of the render. */
static void tiles_come_as_they_are_rendered(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 1 << 20);
    receiver r = {0};
    receiver_start(&r);
    show_in(settings, &r);
    clshear_settings_set_progress(settings, until_shown, &r);
    clshear_film *film = test_render(made->scene, settings);
    receiver_stop(&r);
    assert_int_equal(test_film_info(film).complete, 0);
    expect_film(&r, film, 0, 0);
    assert_at_least(r.updates, 12 + 6);
    receiver_free(&r);
    clshear_film_free(film);
    clshear_settings_free(settings);
}

static int occurrences(const char *text, const char *words)
{
    int count = 0;
    for (const char *at = strstr(text, words); at != NULL; at = strstr(at + 1, words))
        count++;
    return count;
}

/* Renders in a viewer that is lost; returns what is told, of which one line is about that. */
static const char *render_without(test_fixture *made, clshear_settings *settings, receiver *r,
                                  const clshear_film *plain)
{
    const clshear_film_info info = test_film_info(plain);
    show_in(settings, r);
    test_warnings();
    clshear_film *film = test_render(made->scene, settings);
    const char *told = test_warnings();
    assert_int_equal(occurrences(told, "goes on without it"), *told != '\0');
    assert_memory_equal(clshear_film_channel(plain, "G"), clshear_film_channel(film, "G"),
                        (size_t)info.width * (size_t)info.height * sizeof(float));
    clshear_film_free(film);
    return told;
}

/* A viewer that hangs up or was never there: the picture is the same, and one line says it. */
static void a_lost_viewer_stops_nothing(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 64);
    clshear_film *plain = test_render(made->scene, settings);
    receiver leaves = {.hangs_up_after = 3}, absent = {0};
    receiver_start(&leaves);
    const char *told = render_without(made, settings, &leaves, plain);
    /* It may have taken all before this side can know that it has gone. */
    if (*told != '\0') assert_non_null(strstr(told, "viewer is gone"));
    receiver_stop(&leaves);
    assert_string_equal(leaves.wrong, "");
    receiver_start(&absent);
    receiver_stop(&absent);
    assert_non_null(strstr(render_without(made, settings, &absent, plain), "no viewer"));
    clshear_film_free(plain);
    clshear_settings_free(settings);
    receiver_free(&leaves);
}

/* Nor does one that takes nothing: 14 channels of 640 x 480 floats are 17 MB, and Linux keeps 4 MB
 * of them for the other side. */
static void a_frozen_viewer_stops_nothing(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = test_settings(made->settings, 640, 480, 2);
    test_set(settings, CLSHEAR_ORACLE, "centre");
    clshear_film *plain = test_render(made->scene, settings);
    receiver frozen = {.never_reads = 1};
    receiver_start(&frozen);
    assert_non_null(
        strstr(render_without(made, settings, &frozen, plain), "taken nothing for 5 s"));
    receiver_stop(&frozen);
    clshear_film_free(plain);
    clshear_settings_free(settings);
}

static void addresses_are_checked(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 1);
    clshear_film *film = NULL;
    static const char *const bad[] = {"localhost", ":14158", "localhost:", "a:0",      "a:65536",
                                      "a:1x",      "a:-1",   "::1:14158",  "a:999999", "[]:14158"};
    test_refused(clshear_settings_set_text(settings, CLSHEAR_DISPLAY, ""), CLSHEAR_BAD_ARGUMENT,
                 "display is empty");
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        test_set(settings, CLSHEAR_DISPLAY, "%s", bad[i]);
        test_refused(clshear_render(made->scene, settings, &film), CLSHEAR_BAD_ARGUMENT,
                     "is not HOST:PORT");
    }
    clshear_settings_free(settings);
}

/* What the fixture's context has been alarmed of. */
typedef struct alarms {
    int count;
    char last[512];
} alarms;

static void note_alarm(void *user, const char *line)
{
    alarms *told = user;
    told->count++;
    snprintf(told->last, sizeof told->last, "%s", line);
}

/* Renders with a viewer or a preview that is lost, which is told once, as an alarm and not as a
 * warning. */
static void expect_alarm(test_fixture *made, const clshear_settings *settings, const char *words)
{
    alarms told = {0};
    test_warnings();
    clshear_context_set_alarm(made->context, note_alarm, &told);
    clshear_film_free(test_render(made->scene, settings));
    clshear_context_set_alarm(made->context, NULL, NULL);
    assert_int_equal(told.count, 1);
    assert_non_null(strstr(told.last, words));
    assert_string_equal(test_warnings(), "");
}

/* Those who want to hear nothing hear of it: the program prints alarms even with --quiet. */
static void what_is_lost_is_an_alarm(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 1);
    test_set(settings, CLSHEAR_DISPLAY, "[::1]:1"); /* right, and nobody is there */
    expect_alarm(made, settings, "display ::1:1: no viewer");
    clshear_settings_free(settings);
    settings = settings_of(made, 64);
    test_set(settings, CLSHEAR_PREVIEW, "%s", test_path("no/such/folder.png"));
    test_set(settings, CLSHEAR_EVERY, "0"); /* each try fails, and one line is told */
    expect_alarm(made, settings, "preview: ");
    clshear_settings_free(settings);
}

typedef struct file_watch {
    const char *path;
    ino_t last;
    int versions;
} file_watch;

/* Each version is another file, so that no reader meets half of one. */
static int watch_file(void *user, const clshear_progress *progress)
{
    file_watch *watch = user;
    struct stat about;
    (void)progress;
    if (stat(watch->path, &about) != 0) return 0;
    assert_at_least(about.st_size, 67); /* the smallest PNG */
    if (about.st_ino != watch->last) watch->versions++;
    watch->last = about.st_ino;
    return watch->versions >= 3;
}

static void a_file_is_rewritten(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 1 << 20);
    file_watch watch = {.path = test_path("preview.png")};
    clshear_film *film = NULL;
    remove(watch.path);
    test_set(settings, CLSHEAR_PREVIEW, "%s", watch.path);
    test_set(settings, CLSHEAR_EVERY, "0");
    clshear_settings_set_progress(settings, watch_file, &watch);
    film = test_render(made->scene, settings);
    assert_int_equal(watch.versions, 3);
    /* The last version is the picture. */
    const char *right = test_path("right.png");
    test_ok(clshear_film_write(film, right));
    FILE *files[2] = {fopen(watch.path, "rb"), fopen(right, "rb")};
    int bytes[2];
    do {
        for (int i = 0; i < 2; i++)
            bytes[i] = fgetc(files[i]);
        assert_int_equal(bytes[0], bytes[1]);
    } while (bytes[0] != EOF);
    fclose(files[0]);
    fclose(files[1]);
    clshear_film_free(film);
    clshear_settings_set_progress(settings, NULL, NULL);
    test_set(settings, CLSHEAR_SPP, "4096");
    test_set(settings, CLSHEAR_PREVIEW, "%s", test_path("no/such/folder.png"));
    test_warnings();
    clshear_film_free(test_render(made->scene, settings));
    assert_int_equal(occurrences(test_warnings(), "the render goes on"), 1);
    test_set(settings, CLSHEAR_PREVIEW, "preview.gif");
    test_refused(clshear_render(made->scene, settings, &film), CLSHEAR_BAD_FILE, ".gif");
    clshear_settings_free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_viewer_has_the_film),
        cmocka_unit_test(tiles_come_as_they_are_rendered),
        cmocka_unit_test(a_lost_viewer_stops_nothing),
        cmocka_unit_test(a_frozen_viewer_stops_nothing),
        cmocka_unit_test(addresses_are_checked),
        cmocka_unit_test(what_is_lost_is_an_alarm),
        cmocka_unit_test(a_file_is_rewritten),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
