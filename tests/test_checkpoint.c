/* Checkpoints: a render goes on to the same bits, and only as itself. */
#include "support.h"

#include <errno.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

static clshear_settings *settings_of(test_fixture *made, uint32_t spp)
{
    return test_settings(made->settings, 24, 24, spp);
}

typedef struct count {
    int calls;
    int most;        /* calls after which the render is stopped; 0: never */
    double fraction; /* of the first call after the start of the samples */
} count;

static int stop_after(void *user, const clshear_progress *progress)
{
    count *c = user;
    assert_int_equal(progress->struct_size, sizeof *progress);
    if (c->fraction <= 0.0) c->fraction = progress->fraction;
    if (progress->fraction > 0.0) c->calls++;
    return c->most > 0 && c->calls >= c->most;
}

static void expect_same(const clshear_film *a, const clshear_film *b)
{
    const clshear_film_info info = test_film_info(a);
    const char *name;
    for (size_t c = 0; (name = clshear_film_channel_name(a, c)) != NULL; c++) {
        assert_non_null(clshear_film_channel(b, name));
        assert_memory_equal(clshear_film_channel(a, name), clshear_film_channel(b, name),
                            (size_t)info.width * (size_t)info.height * sizeof(float));
    }
}

/* Renders in pieces of a few launches, each from the checkpoint of the piece before. */
static clshear_film *render_in_pieces(test_fixture *made, clshear_settings *settings,
                                      const clshear_film *base, const char *path, int *pieces)
{
    clshear_film *film = NULL;
    double reached = 0.0;
    remove(path);
    test_set(settings, CLSHEAR_CHECKPOINT, "%s", path);
    test_set(settings, CLSHEAR_RESUME, "1");
    for (*pieces = 0; *pieces < 100; ++*pieces) {
        count c = {.most = 3};
        clshear_settings_set_progress(settings, stop_after, &c);
        test_ok(base != NULL ? clshear_render_extend(made->scene, settings, base, &film)
                             : clshear_render(made->scene, settings, &film));
        if (c.calls > 0) assert_at_least(c.fraction, reached); /* nothing is drawn twice */
        reached = c.fraction;
        if (test_film_info(film).complete) break;
        clshear_film_free(film);
    }
    clshear_settings_set_progress(settings, NULL, NULL);
    clshear_settings_unset(settings, CLSHEAR_CHECKPOINT);
    clshear_settings_unset(settings, CLSHEAR_RESUME);
    remove(path);
    return film;
}

/* Every kind of state: plain, adaptive with planes, patterns that are kept, continued. */
static void resumed_equals_whole(void **state)
{
    test_fixture *made = *state;
    static const clshear_setting kinds[] = {CLSHEAR_SPP, CLSHEAR_ADAPTIVE, CLSHEAR_KEEP_PATTERNS,
                                            CLSHEAR_EXTENDABLE};
    const char *path = test_path("state");
    for (size_t k = 0; k < sizeof kinds / sizeof *kinds; k++) {
        clshear_settings *settings = settings_of(made, 512);
        clshear_film *base = NULL;
        int pieces = 0;
        test_set(settings, CLSHEAR_REPLICATES, "4");
        test_set(settings, CLSHEAR_AOV, "albedo,depth");
        if (kinds[k] != CLSHEAR_SPP) test_set(settings, kinds[k], "1");
        if (kinds[k] == CLSHEAR_EXTENDABLE) base = test_render(made->scene, settings);
        test_set(settings, CLSHEAR_SPP, "4096");
        clshear_film *whole = NULL;
        test_ok(base != NULL ? clshear_render_extend(made->scene, settings, base, &whole)
                             : clshear_render(made->scene, settings, &whole));
        clshear_film *film = render_in_pieces(made, settings, base, path, &pieces);
        assert_at_least(pieces, 2);
        expect_same(whole, film);
        clshear_film_free(whole);
        clshear_film_free(film);
        clshear_film_free(base);
        clshear_settings_free(settings);
    }
}

/* Expects that a render with one setting changed does not go on, and says why. */
static void refuse(test_fixture *made, const clshear_settings *settings, clshear_setting changed,
                   const char *value, const char *words)
{
    clshear_settings *other = NULL;
    clshear_film *film = NULL;
    test_ok(clshear_settings_copy(settings, &other));
    test_set(other, changed, "%s", value);
    test_refused(clshear_render(made->scene, other, &film), CLSHEAR_BAD_ARGUMENT, words);
    assert_null(film);
    clshear_settings_free(other);
}

static void other_renders_do_not_go_on(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 4096);
    clshear_film *film = NULL;
    count c = {.most = 2};
    const char *path = test_path("other");
    remove(path);
    test_set(settings, CLSHEAR_RESUME, "1");
    test_refused(clshear_render(made->scene, settings, &film), CLSHEAR_BAD_ARGUMENT,
                 "resume: needs a checkpoint");
    test_set(settings, CLSHEAR_CHECKPOINT, "%s", path);
    clshear_settings_set_progress(settings, stop_after, &c);
    test_ok(clshear_render(made->scene, settings, &film));
    clshear_film_free(film);
    film = NULL;
    assert_int_equal(access(path, R_OK), 0);
    refuse(made, settings, CLSHEAR_SPP, "8192", "another spp");
    refuse(made, settings, CLSHEAR_SEED, "5", "another seed");
    refuse(made, settings, CLSHEAR_ADAPTIVE, "1", "another adaptive");
    refuse(made, settings, CLSHEAR_CROP, "0,8,0,8", "another crop");
    refuse(made, settings, CLSHEAR_AOV, "depth", "another aov");
    refuse(made, settings, CLSHEAR_FOCAL_DISTANCE, "931", "another focal-distance");
    refuse(made, settings, CLSHEAR_LIGHT, "1,2,3,4,5,6", "another lights");
    refuse(made, settings, CLSHEAR_NOISE, "0.5", "another noise");
    refuse(made, settings, CLSHEAR_RESUME, "0", "is there already");
    clshear_settings_free(settings);
    remove(path);
}

/* Every byte counts: a checkpoint with one changed, or without its end, is refused. */
static void damaged_checkpoints_are_refused(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 4096);
    clshear_film *film = NULL;
    count c = {.most = 2};
    const char *path = test_path("damaged");
    remove(path);
    test_set(settings, CLSHEAR_CHECKPOINT, "%s", path);
    clshear_settings_set_progress(settings, stop_after, &c);
    test_ok(clshear_render(made->scene, settings, &film));
    clshear_film_free(film);
    film = NULL;
    test_set(settings, CLSHEAR_RESUME, "1");
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    const long size = ftell(file);
    for (int i = 0; i < 12; i++) {
        const long place = i < 6 ? size * i / 6 : size - 1 - (i - 6);
        fseek(file, place, SEEK_SET);
        const int byte = fgetc(file);
        fseek(file, place, SEEK_SET);
        fputc(byte ^ 16, file);
        fflush(file);
        const clshear_status status = clshear_render(made->scene, settings, &film);
        assert_int_not_equal(status, CLSHEAR_OK);
        fseek(file, place, SEEK_SET);
        fputc(byte, file);
        fflush(file);
    }
    for (int i = 0; i < 6; i++) {
        assert_int_equal(ftruncate(fileno(file), size * (5 - i) / 6), 0);
        test_refused(clshear_render(made->scene, settings, &film), CLSHEAR_BAD_FILE,
                     "no whole checkpoint");
    }
    fclose(file);
    remove(path);
    clshear_settings_free(settings);
}

typedef struct gallery {
    int shown;
    int asked;
} gallery;

static int want_third(void *user)
{
    gallery *g = user;
    return ++g->asked % 3 == 0;
}

static void show(void *user, clshear_film *film)
{
    gallery *g = user;
    const clshear_film_info info = test_film_info(film);
    assert_int_equal(info.complete, 0);
    assert_at_least(info.samples, 1);
    assert_non_null(clshear_film_channel(film, "G"));
    g->shown++;
}

/* Previews change nothing of the render that they show. */
static void previews_do_not_disturb(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 2048);
    for (int rule = 0; rule < 2; rule++) {
        gallery g = {0};
        if (rule) test_set(settings, CLSHEAR_NOISE, "0.004");
        clshear_film *plain = test_render(made->scene, settings);
        clshear_settings_set_preview(settings, want_third, show, &g);
        clshear_film *film = test_render(made->scene, settings);
        clshear_settings_set_preview(settings, NULL, NULL, NULL);
        assert_at_least(g.shown, 1);
        expect_same(plain, film);
        clshear_film_free(plain);
        clshear_film_free(film);
    }
    clshear_settings_free(settings);
}

static void count_line(void *user, const char *line)
{
    int *count = user;
    assert_non_null(strstr(line, "the render goes on"));
    ++*count;
}

/* A checkpoint that cannot be written is an alarm, told once; without one it is a warning. */
static void lost_work_is_an_alarm(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 4096);
    int alarms = 0;
    test_set(settings, CLSHEAR_CHECKPOINT, "%s", test_path("no/such/folder/state"));
    test_set(settings, CLSHEAR_EVERY, "0");
    clshear_context_set_alarm(made->context, count_line, &alarms);
    test_warnings();
    clshear_film_free(test_render(made->scene, settings));
    assert_int_equal(alarms, 1);
    assert_string_equal(test_warnings(), "");
    clshear_context_set_alarm(made->context, NULL, NULL);
    clshear_film_free(test_render(made->scene, settings));
    assert_non_null(strstr(test_warnings(), "the render goes on"));
    clshear_settings_free(settings);
}

static int disk_fails;

/* In the place of the C library's. */
int fsync(int file)
{
    (void)file;
    errno = EIO;
    return disk_fails ? -1 : 0;
}

/* What does not reach the disk does not replace the checkpoint that is there. */
static void the_last_good_checkpoint_stays(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made, 512);
    count stop = {.most = 2}, again = {.most = 2};
    struct stat before, after;
    clshear_film *film = NULL;
    int alarms = 0;
    const char *path = test_path("kept-state");
    remove(path);
    test_set(settings, CLSHEAR_CHECKPOINT, "%s", path);
    test_set(settings, CLSHEAR_RESUME, "1");
    clshear_settings_set_progress(settings, stop_after, &stop);
    test_ok(clshear_render(made->scene, settings, &film));
    clshear_film_free(film);
    assert_int_equal(stat(path, &before), 0);
    disk_fails = 1;
    clshear_context_set_alarm(made->context, count_line, &alarms);
    clshear_settings_set_progress(settings, stop_after, &again);
    test_ok(clshear_render(made->scene, settings, &film));
    clshear_film_free(film);
    disk_fails = 0;
    clshear_context_set_alarm(made->context, NULL, NULL);
    assert_int_equal(alarms, 1);
    assert_int_equal(stat(path, &after), 0);
    assert_int_equal(after.st_ino, before.st_ino);
    remove(path);
    clshear_settings_free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(resumed_equals_whole),
        cmocka_unit_test(other_renders_do_not_go_on),
        cmocka_unit_test(damaged_checkpoints_are_refused),
        cmocka_unit_test(previews_do_not_disturb),
        cmocka_unit_test(lost_work_is_an_alarm),
        cmocka_unit_test(the_last_good_checkpoint_stays),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
