/* Shards of a render: merged they are the render. */
#include "support.h"

#include <math.h>

enum {
    SIZE = 24,
    SHARDS = 7
};

static clshear_settings *settings_of(test_fixture *made)
{
    clshear_settings *settings = test_settings(made->settings, SIZE, SIZE, SHARDS * 64);
    test_set(settings, CLSHEAR_AOV, "albedo,position,depth");
    test_set(settings, CLSHEAR_ORACLE, "centre"); /* no pilot: less work */
    return settings;
}

static clshear_film *shard(clshear_scene *scene, clshear_settings *settings, int number)
{
    test_set(settings, CLSHEAR_SHARD, "%d/%d", number, SHARDS);
    clshear_film *film = test_render(scene, settings);
    clshear_settings_unset(settings, CLSHEAR_SHARD);
    return film;
}

static clshear_film *merge(clshear_film *const *films, size_t count)
{
    const clshear_film *list[SHARDS];
    clshear_film *merged = NULL;
    for (size_t i = 0; i < count; i++)
        list[i] = films[i];
    test_ok(clshear_film_merge(list, count, &merged));
    return merged;
}

/* Compares channels up to `part` of the largest finite value; what is infinite in one is in both.
 */
static void expect_same(const clshear_film *a, const clshear_film *b, double part)
{
    const char *name;
    for (size_t c = 0; (name = clshear_film_channel_name(a, c)) != NULL; c++) {
        const float *pa = clshear_film_channel(a, name), *pb = clshear_film_channel(b, name);
        double most = 0.0, off = 0.0;
        assert_non_null(pb);
        for (int i = 0; i < SIZE * SIZE; i++) {
            assert_int_equal(isfinite(pa[i]), isfinite(pb[i]));
            if (!isfinite(pa[i])) continue;
            most = fmax(most, fabs((double)pa[i]));
            off = fmax(off, fabs((double)pa[i] - (double)pb[i]));
        }
        if (off > part * most) fail_msg("%s differs by %g of %g", name, off, most);
    }
}

/* Renders the shards and reads them back from files. */
static void read_shards(clshear_scene *scene, clshear_settings *settings, clshear_film **films)
{
    for (int i = 0; i < SHARDS; i++) {
        clshear_film *film = shard(scene, settings, i + 1);
        const char *path = test_path("shard.exr");
        test_ok(clshear_film_write(film, path));
        clshear_film_free(film);
        test_ok(clshear_film_read(path, &films[i]));
    }
}

/* In two orders and as a tree. Floats in the files round means to 6e-8, and variances of seven
 * values that are a fraction of these to 1e-4 of the largest. */
static void expect_merged(clshear_film **films, const clshear_film *whole)
{
    clshear_film *turned[SHARDS];
    char missing[64] = "unset";
    for (int i = 0; i < SHARDS; i++)
        turned[(3 * i + 2) % SHARDS] = films[i];
    clshear_film *merged = merge(films, SHARDS), *again = merge(turned, SHARDS);
    expect_same(merged, again, 0.0);
    expect_same(whole, merged, 1e-4);
    assert_int_equal(test_film_info(merged).samples, test_film_info(whole).samples);
    clshear_film_missing(merged, missing, sizeof missing);
    assert_string_equal(missing, "");
    assert_int_equal(test_film_info(merged).complete, 1);
    clshear_film *some = merge(turned, 3), *others = merge(turned + 3, 4);
    clshear_film *pair[2] = {others, some};
    clshear_film *tree = merge(pair, 2);
    expect_same(merged, tree, 1e-4);
    clshear_film_free(tree);
    clshear_film_free(some);
    clshear_film_free(others);
    clshear_film_free(again);
    clshear_film_free(merged);
}

/* Seven shards, through files; with one and with two replicates each, and adaptive. */
static void merged_shards_are_the_render(void **state)
{
    test_fixture *made = *state;
    static const struct {
        const char *replicates;
        const char *adaptive;
    } cases[] = {{"7", "0"}, {"14", "0"}, {"9", "0"}, {"7", "1"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        clshear_settings *settings = settings_of(made);
        clshear_film *films[SHARDS];
        test_set(settings, CLSHEAR_REPLICATES, "%s", cases[k].replicates);
        test_set(settings, CLSHEAR_ADAPTIVE, "%s", cases[k].adaptive);
        clshear_film *whole = test_render(made->scene, settings);
        read_shards(made->scene, settings, films);
        expect_merged(films, whole);
        clshear_film_free(whole);
        for (int i = 0; i < SHARDS; i++)
            clshear_film_free(films[i]);
        clshear_settings_free(settings);
    }
}

/* Shards that are missing are named. */
static void missing_shards_are_named(void **state)
{
    test_fixture *made = *state;
    clshear_settings *settings = settings_of(made);
    clshear_film *films[3] = {shard(made->scene, settings, 6), shard(made->scene, settings, 1),
                              shard(made->scene, settings, 2)};
    char missing[64];
    clshear_film *merged = merge(films, 3);
    clshear_film_missing(merged, missing, sizeof missing);
    assert_string_equal(missing, "3-5,7");
    assert_int_equal(test_film_info(merged).complete, 0);
    assert_int_equal(test_film_info(merged).samples, SIZE * SIZE * 64 * 3);
    assert_non_null(clshear_film_channel(merged, "Variance.G"));
    clshear_film_missing(merged, missing, 4);
    assert_int_equal(strlen(missing), 3);
    test_ok(clshear_film_annotate(merged, "clshear.shard", "damaged"));
    clshear_film_missing(merged, missing, sizeof missing);
    assert_string_equal(missing, "?");
    for (int i = 0; i < 3; i++)
        clshear_film_free(films[i]);
    clshear_film_free(merged);
    clshear_settings_free(settings);
}

static void refuse(const clshear_film *a, const clshear_film *b, const char *words)
{
    const clshear_film *list[2] = {a, b};
    clshear_film *merged = NULL;
    test_refused(clshear_film_merge(list, 2, &merged), CLSHEAR_BAD_ARGUMENT, words);
    assert_null(merged);
}

/* The same shard twice, films of other renders, and films that are no shards. */
static void foreign_shards_are_refused(void **state)
{
    test_fixture *made = *state;
    static const struct {
        clshear_setting changed;
        const char *value;
        const char *words;
    } others[] = {{CLSHEAR_SEED, "5", "another seed"},
                  {CLSHEAR_SPP, "896", "another spp"},
                  {CLSHEAR_ADAPTIVE, "1", "another adaptive"},
                  {CLSHEAR_FOV, "12", "another fov"},
                  {CLSHEAR_REPLICATES, "14", "another replicates"},
                  {CLSHEAR_CROP, "0,8,0,8", "another crop"},
                  {CLSHEAR_LIGHT, "1,2,3,4,5,6", "another lights"},
                  {CLSHEAR_AOV, "albedo", "another set of channels"}};
    clshear_settings *settings = settings_of(made);
    clshear_film *one = shard(made->scene, settings, 1), *two = shard(made->scene, settings, 2);
    clshear_film *whole = test_render(made->scene, settings);
    refuse(one, one, "shard 1 is in another of the films, too");
    refuse(one, whole, "film 2: is no complete EXR of a shard");
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        clshear_settings *changed = NULL;
        test_ok(clshear_settings_copy(settings, &changed));
        if (others[i].changed == CLSHEAR_AOV) clshear_settings_unset(changed, CLSHEAR_AOV);
        test_set(changed, others[i].changed, "%s", others[i].value);
        clshear_film *other = shard(made->scene, changed, 2);
        refuse(one, other, others[i].words);
        clshear_film_free(other);
        clshear_settings_free(changed);
    }
    static const char *const texts[] = {"",     "3",     "0/7",   "8/7",     "1-2-3/7", "2,/7",
                                        "2/7x", "2,2/7", "5-3/7", "1/99999", "-1/7",    "2/"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        test_ok(clshear_film_annotate(two, "clshear.shard", texts[i]));
        refuse(one, two, "film 2: says that it is of shard");
    }
    clshear_film_free(one);
    clshear_film_free(two);
    clshear_film_free(whole);
    clshear_settings_free(settings);
}

/* Settings that no shard can have. */
static void impossible_shards_are_refused(void **state)
{
    test_fixture *made = *state;
    static const struct {
        clshear_setting changed;
        const char *value;
        const char *words;
    } cases[] = {{CLSHEAR_SHARD, "3/2", "shard 3/2: must be K/N"},
                 {CLSHEAR_SHARD, "1-2/3", "shard 1-2/3: a render is one of them"},
                 {CLSHEAR_REPLICATES, "6", "7 shards of 6 replicates"},
                 {CLSHEAR_NOISE, "0.1", "a shard cannot have noise"},
                 {CLSHEAR_TIME, "1", "a shard cannot have time"},
                 {CLSHEAR_EXTENDABLE, "1", "a shard cannot have extendable"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        clshear_settings *settings = settings_of(made);
        clshear_film *film = NULL;
        test_set(settings, CLSHEAR_SHARD, "1/7");
        test_set(settings, cases[i].changed, "%s", cases[i].value);
        test_refused(clshear_render(made->scene, settings, &film), CLSHEAR_BAD_ARGUMENT,
                     cases[i].words);
        clshear_settings_free(settings);
    }
}

/* Machines whose packets differ draw the same samples, and sum them in another order: single
 * precision leaves 1e-4 of the largest value, and a few samples at edges that fall to the other
 * side. A hundredth of the pixels may differ by more. */
static void packets_of_other_widths_merge(void **state)
{
    test_fixture *made = *state;
    clshear_settings *narrow = NULL, *settings = settings_of(made);
    clshear_context *context = NULL;
    int off = 0;
    test_set(settings, CLSHEAR_REPLICATES, "%d", SHARDS);
    test_ok(clshear_settings_create(&narrow));
    test_set(narrow, CLSHEAR_PACKET, "4");
    test_ok(clshear_context_create(narrow, &context));
    clshear_scene *scene = test_cornell(context);
    clshear_film *films[SHARDS];
    for (int i = 0; i < SHARDS; i++)
        films[i] = shard(i % 2 ? scene : made->scene, settings, i + 1);
    clshear_film *merged = merge(films, SHARDS);
    clshear_film *whole = test_render(made->scene, settings);
    for (int i = 0; i < SIZE * SIZE; i++) {
        const float a = clshear_film_channel(whole, "G")[i],
                    b = clshear_film_channel(merged, "G")[i];
        off += fabsf(a - b) > 1e-4f * a;
    }
    assert_at_most(off, SIZE * SIZE / 100);
    for (int i = 0; i < SHARDS; i++)
        clshear_film_free(films[i]);
    clshear_film_free(merged);
    clshear_film_free(whole);
    clshear_scene_free(scene);
    clshear_context_free(context);
    clshear_settings_free(narrow);
    clshear_settings_free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(merged_shards_are_the_render),
        cmocka_unit_test(missing_shards_are_named),
        cmocka_unit_test(foreign_shards_are_refused),
        cmocka_unit_test(impossible_shards_are_refused),
        cmocka_unit_test(packets_of_other_widths_merge),
    };
    return cmocka_run_group_tests(tests, test_open_cornell, test_close);
}
