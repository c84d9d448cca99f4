/* The table of settings: bounds, kinds, texts; and structs of older and newer callers. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "clshear/analysis.h"
#include "settings/settings.h"

static clshear_settings *fresh(void)
{
    clshear_settings *settings = NULL;
    test_ok(clshear_settings_create(&settings));
    return settings;
}

static int open_settings(void **state)
{
    *state = fresh();
    return 0;
}

static int close_settings(void **state)
{
    clshear_settings_free(*state);
    return 0;
}

enum {
    MOST_NUMBERS = 12 /* in one value of a setting */
};

/* Fills one value of a setting with `value`, except where the order of numbers matters. */
static size_t numbers_of(const cs_setting *entry, double value, double *numbers)
{
    for (size_t i = 0; i < entry->values; i++)
        numbers[i] = value;
    return entry->values;
}

static clshear_status set_all(clshear_settings *settings, const cs_setting *entry, double value)
{
    double numbers[MOST_NUMBERS];
    return clshear_settings_set_numbers(settings, entry->setting, numbers,
                                        numbers_of(entry, value, numbers));
}

/* For every row, both bounds are allowed and values just outside are refused. A refusal names the
 * setting and changes nothing. The crop's numbers must rise and packets are powers of two; see
 * below. */
static void bounds_are_enforced(void **state)
{
    clshear_settings *settings = *state;
    for (size_t i = 0; i < CS_SETTING_COUNT; i++) {
        const cs_setting *entry = &cs_setting_table[i];
        double low, high, before[MOST_NUMBERS], after[MOST_NUMBERS];
        size_t count;
        test_ok(clshear_setting_bounds(entry->setting, &low, &high));
        if (entry->kind == CLSHEAR_TEXT || entry->setting == CLSHEAR_CROP) continue;
        test_ok(set_all(settings, entry, low));
        test_ok(set_all(settings, entry, high));
        test_ok(
            clshear_settings_get_numbers(settings, entry->setting, before, MOST_NUMBERS, &count));
        const int whole = entry->kind != CLSHEAR_NUMBER;
        const double wrong[] = {whole ? low - 1.0 : nextafter(low, -INFINITY),
                                whole ? high + 1.0 : nextafter(high, INFINITY), NAN,
                                whole ? low + 0.5 : INFINITY};
        for (int w = 0; w < 4; w++)
            test_refused(set_all(settings, entry, wrong[w]), CLSHEAR_BAD_ARGUMENT, entry->name);
        test_ok(
            clshear_settings_get_numbers(settings, entry->setting, after, MOST_NUMBERS, &count));
        assert_int_equal(count, entry->values);
        assert_memory_equal(before, after, count * sizeof *before);
    }
    test_refused(clshear_settings_set_integer(settings, CLSHEAR_PACKET, 5), CLSHEAR_BAD_ARGUMENT,
                 "1, 4, 8 or 16");
    test_refused(clshear_settings_set_text(settings, CLSHEAR_CROP, "0,65537,0,1"),
                 CLSHEAR_BAD_ARGUMENT, "crop");
    test_refused(clshear_settings_set_text(settings, CLSHEAR_CROP, "4,4,0,1"), CLSHEAR_BAD_ARGUMENT,
                 "X0 < X1");
}

/* The count of numbers is checked too. */
static void counts_are_enforced(void **state)
{
    clshear_settings *settings = *state;
    static const double numbers[6 * 65] = {0};
    test_refused(clshear_settings_set_numbers(settings, CLSHEAR_EYE, numbers, 2),
                 CLSHEAR_BAD_ARGUMENT, "eye: 2 numbers");
    test_refused(clshear_settings_set_numbers(settings, CLSHEAR_EYE, numbers, 6),
                 CLSHEAR_BAD_ARGUMENT, "eye: 6 numbers");
    test_refused(clshear_settings_set_numbers(settings, CLSHEAR_EYE, numbers, 0),
                 CLSHEAR_BAD_ARGUMENT, "eye: 0 numbers");
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_LIGHT, numbers, 6 * (size_t)64));
    test_refused(clshear_settings_set_numbers(settings, CLSHEAR_LIGHT, numbers, 6 * (size_t)65),
                 CLSHEAR_BAD_ARGUMENT, "light");
    test_refused(clshear_settings_set_text(settings, CLSHEAR_LIGHT, "0,0,0,0,0,0"),
                 CLSHEAR_BAD_ARGUMENT, "more than 64 times");
    test_refused(clshear_settings_set_text(settings, CLSHEAR_EYE, "1,2"), CLSHEAR_BAD_ARGUMENT,
                 "X,Y,Z");
    test_refused(clshear_settings_set_text(settings, CLSHEAR_EYE, "1,2,3,4"), CLSHEAR_BAD_ARGUMENT,
                 "X,Y,Z");
}

/* Setters and getters of the wrong kind fail. */
static void kinds_are_enforced(void **state)
{
    clshear_settings *settings = *state;
    for (size_t i = 0; i < CS_SETTING_COUNT; i++) {
        const cs_setting *entry = &cs_setting_table[i];
        const clshear_setting setting = entry->setting;
        const int one = entry->values == 1 && entry->most == 1;
        const int integer = one && entry->kind != CLSHEAR_NUMBER && entry->kind != CLSHEAR_TEXT;
        const int number = one && entry->kind == CLSHEAR_NUMBER;
        int64_t whole = (int64_t)entry->low;
        double real = entry->low;
        if (entry->setting == CLSHEAR_FOV) real = 1.0;
        assert_int_equal(clshear_settings_set_integer(settings, setting, whole),
                         integer ? CLSHEAR_OK : CLSHEAR_BAD_ARGUMENT);
        assert_int_equal(clshear_settings_get_integer(settings, setting, &whole),
                         integer ? CLSHEAR_OK : CLSHEAR_BAD_ARGUMENT);
        assert_int_equal(clshear_settings_set_number(settings, setting, real),
                         number ? CLSHEAR_OK : CLSHEAR_BAD_ARGUMENT);
        assert_int_equal(clshear_settings_get_number(settings, setting, &real),
                         number ? CLSHEAR_OK : CLSHEAR_BAD_ARGUMENT);
        assert_int_equal(clshear_settings_is_set(settings, setting), integer || number);
    }
    test_refused(clshear_settings_set_integer(settings, CLSHEAR_FOV, 40), CLSHEAR_BAD_ARGUMENT,
                 "fov: is a number; this function is for a whole number");
    test_refused(set_all(settings, &cs_setting_table[CS_INDEX_DEVICE], 0.0), CLSHEAR_BAD_ARGUMENT,
                 "device");
}

/* What is no number is refused in words, however many numbers the setting has. */
static void expectations_have_words(void **state)
{
    clshear_settings *settings = *state;
    for (size_t i = 0; i < CS_SETTING_COUNT; i++) {
        const cs_setting *entry = &cs_setting_table[i];
        if (entry->kind != CLSHEAR_NUMBER && entry->kind != CLSHEAR_INTEGER) continue;
        test_refused(clshear_settings_set_text(settings, entry->setting, "words"),
                     CLSHEAR_BAD_ARGUMENT, "must be ");
    }
    test_refused(clshear_settings_set_text(settings, CLSHEAR_QUAD, "1,2"), CLSHEAR_BAD_ARGUMENT,
                 "must be twelve numbers");
}

/* A text that is empty names nothing: no file, no device, no camera. */
static void empty_texts_are_refused(void **state)
{
    clshear_settings *settings = *state;
    for (size_t i = 0; i < CS_SETTING_COUNT; i++) {
        const cs_setting *entry = &cs_setting_table[i];
        if (entry->kind != CLSHEAR_TEXT) continue;
        test_refused(clshear_settings_set_text(settings, entry->setting, ""), CLSHEAR_BAD_ARGUMENT,
                     "is empty: give ");
        assert_false(clshear_settings_is_set(settings, entry->setting));
    }
}

/* Printed values can be read and print the same again, fallbacks too. Unsetting restores the
 * fallbacks. */
static void texts_come_back(void **state)
{
    clshear_settings *settings = *state, *other = fresh();
    for (size_t i = 0; i < CS_SETTING_COUNT; i++) {
        const cs_setting *entry = &cs_setting_table[i];
        const clshear_setting setting = entry->setting;
        char first[512], second[512];
        if (*entry->fallback != '\0') {
            test_ok(clshear_settings_get_text(settings, setting, first, sizeof first));
            assert_string_equal(first, entry->fallback);
            assert_false(clshear_settings_is_set(settings, setting));
        } else
            test_refused(clshear_settings_get_text(settings, setting, first, sizeof first),
                         CLSHEAR_BAD_ARGUMENT, entry->name);
        if (entry->kind == CLSHEAR_TEXT)
            test_set(settings, setting, "a text, with = and #");
        else if (setting == CLSHEAR_CROP)
            test_set(settings, setting, "1,20,3,40");
        else
            test_ok(set_all(settings, entry,
                            entry->kind == CLSHEAR_NUMBER
                                ? fmin(entry->high, 0.1 + entry->low + 1.0)
                                : entry->high));
        test_ok(clshear_settings_get_text(settings, setting, first, sizeof first));
        test_set(other, setting, "%s", first);
        test_ok(clshear_settings_get_text(other, setting, second, sizeof second));
        assert_string_equal(first, second);
        clshear_settings_unset(other, setting);
        assert_false(clshear_settings_is_set(other, setting));
        if (*entry->fallback == '\0') continue;
        test_ok(clshear_settings_get_text(other, setting, second, sizeof second));
        assert_string_equal(second, entry->fallback);
    }
    clshear_settings_free(other);
}

/* Floats are printed with enough digits: 0.1f reads back as 0.1f. */
static void floats_survive_texts(void **state)
{
    clshear_settings *settings = *state;
    static const float values[] = {0.1f, 1.0f / 3.0f, 16777216.0f, 1e-7f, 930.123474f};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        char text[64];
        double read;
        test_set_number(settings, CLSHEAR_FOCAL_DISTANCE, (double)values[i]);
        test_ok(clshear_settings_get_text(settings, CLSHEAR_FOCAL_DISTANCE, text, sizeof text));
        test_set(settings, CLSHEAR_FOCAL_DISTANCE, "%s", text);
        test_ok(clshear_settings_get_number(settings, CLSHEAR_FOCAL_DISTANCE, &read));
        assert_near((float)read, values[i], 0);
    }
}

static void a_text_needs_room(void **state)
{
    char text[1] = "";
    test_refused(clshear_settings_get_text(*state, CLSHEAR_SPP, text, 0), CLSHEAR_BAD_ARGUMENT,
                 "text has no room: size is 0");
    test_ok(clshear_settings_get_text(*state, CLSHEAR_SPP, text, 1));
}

static void the_last_answer_counts(void **state)
{
    clshear_settings *settings = *state;
    static const clshear_setting pairs[][2] = {{CLSHEAR_LENS_RADIUS, CLSHEAR_F_STOP},
                                               {CLSHEAR_F_STOP, CLSHEAR_LENS_RADIUS},
                                               {CLSHEAR_FOCAL_DISTANCE, CLSHEAR_FOCUS_PIXEL},
                                               {CLSHEAR_FOCUS_PIXEL, CLSHEAR_FOCAL_DISTANCE}};
    int64_t aperture;
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < 2; k++)
            test_set(settings, pairs[i][k], pairs[i][k] == CLSHEAR_FOCUS_PIXEL ? "1,2" : "2");
        assert_false(clshear_settings_is_set(settings, pairs[i][0]));
        assert_true(clshear_settings_is_set(settings, pairs[i][1]));
    }
    test_set(settings, CLSHEAR_BLADES, "5");
    test_ok(clshear_settings_get_integer(settings, CLSHEAR_APERTURE, &aperture));
    assert_int_equal(aperture, CLSHEAR_APERTURE_POLYGON);
    test_set(settings, CLSHEAR_APERTURE, "square");
    test_ok(clshear_settings_get_integer(settings, CLSHEAR_APERTURE, &aperture));
    assert_int_equal(aperture, CLSHEAR_APERTURE_SQUARE);
}

/* Some value other than the fallback. */
static void set_some(clshear_settings *settings, const cs_setting *entry)
{
    double low, high;
    test_ok(clshear_setting_bounds(entry->setting, &low, &high));
    if (entry->setting == CLSHEAR_CROP)
        test_set(settings, CLSHEAR_CROP, "1,20,3,40");
    else if (entry->kind == CLSHEAR_TEXT)
        test_set(settings, entry->setting, "a text");
    else
        test_ok(set_all(settings, entry, high));
}

static void expect_equal_values(const clshear_settings *a, const clshear_settings *b)
{
    for (size_t i = 0; i < CS_SETTING_COUNT; i++) {
        const cs_setting_value *x = &a->values[i], *y = &b->values[i];
        assert_int_equal(x->is_set, y->is_set);
        assert_int_equal(x->count, y->count);
        if (x->numbers != NULL)
            assert_memory_equal(x->numbers, y->numbers, x->count * sizeof *x->numbers);
        assert_string_equal(x->text != NULL ? x->text : "", y->text != NULL ? y->text : "");
    }
}

/* A setting that unsets another one leaves nothing of it, alone or in settings that override:
 * together they are as the last one by itself. */
static void unset_alternatives_are_gone(void **state)
{
    int pairs = 0;
    (void)state;
    for (size_t a = 0; a < CS_SETTING_COUNT; a++)
        for (size_t b = 0; b < CS_SETTING_COUNT; b++) {
            const cs_setting *first = &cs_setting_table[a], *last = &cs_setting_table[b];
            clshear_settings *both = fresh(), *alone = fresh(), *under = fresh();
            set_some(both, first);
            set_some(under, first);
            set_some(both, last);
            set_some(alone, last);
            test_ok(clshear_settings_override(under, alone));
            if (a != b && !clshear_settings_is_set(both, first->setting)) {
                expect_equal_values(both, alone);
                expect_equal_values(under, alone);
                pairs++;
            }
            clshear_settings_free(both);
            clshear_settings_free(alone);
            clshear_settings_free(under);
        }
    assert_int_equal(pairs, 2 * 10);
}

static void unknown_settings_are_refused(void **state)
{
    clshear_settings *settings = *state;
    const clshear_setting none = (clshear_setting)12345;
    clshear_setting found;
    const char *name;
    char text[16];
    double number = 1.0;
    int64_t whole;
    size_t count;
    test_refused(clshear_settings_set_text(settings, none, "1"), CLSHEAR_BAD_ARGUMENT, "12345");
    test_refused(clshear_settings_set_integer(settings, none, 1), CLSHEAR_BAD_ARGUMENT, "12345");
    test_refused(clshear_settings_set_number(settings, none, 1), CLSHEAR_BAD_ARGUMENT, "12345");
    test_refused(clshear_settings_set_numbers(settings, none, &number, 1), CLSHEAR_BAD_ARGUMENT,
                 "12345");
    test_refused(clshear_settings_get_text(settings, none, text, sizeof text), CLSHEAR_BAD_ARGUMENT,
                 "12345");
    test_refused(clshear_settings_get_integer(settings, none, &whole), CLSHEAR_BAD_ARGUMENT,
                 "12345");
    test_refused(clshear_settings_get_numbers(settings, none, &number, 1, &count),
                 CLSHEAR_BAD_ARGUMENT, "12345");
    test_refused(clshear_setting_bounds(none, &number, &number), CLSHEAR_BAD_ARGUMENT, "12345");
    test_refused(clshear_setting_find("no-such", &found), CLSHEAR_BAD_ARGUMENT, "no-such");
    assert_int_equal(clshear_settings_is_set(settings, none), 0);
    assert_int_equal(clshear_setting_choice(none, 0, &name, NULL), 0);
    assert_int_equal(clshear_setting_choice(CLSHEAR_SPP, 0, &name, NULL), 0);
    clshear_settings_unset(settings, none);
}

/* The table can be enumerated, and every name and alias is found. */
static void the_table_is_open(void **state)
{
    clshear_setting_info info = {.struct_size = sizeof info};
    clshear_setting found;
    size_t count = 0;
    (void)state;
    for (; clshear_setting_describe(count, &info); count++) {
        char aliases[64];
        test_ok(clshear_setting_find(info.name, &found));
        assert_int_equal(found, info.setting);
        snprintf(aliases, sizeof aliases, "%s", info.aliases);
        for (char *word = strtok(aliases, " "); word != NULL; word = strtok(NULL, " ")) {
            test_ok(clshear_setting_find(word, &found));
            assert_int_equal(found, info.setting);
        }
        assert_above(strlen(info.help), 0);
        assert_at_most(strlen(info.help), 53);
        assert_int_equal(*info.argument == '\0', info.kind == CLSHEAR_SWITCH);
        const char *name, *meaning;
        assert_int_equal(clshear_setting_choice(info.setting, 0, &name, &meaning),
                         info.kind == CLSHEAR_CHOICE);
    }
    assert_int_equal(count, CS_SETTING_COUNT);
}

/* A copy is independent of the original. */
static void copies_are_independent(void **state)
{
    clshear_settings *settings = fresh(), *copy = NULL;
    const float luminance[2] = {1, 2};
    char text[64];
    size_t count;
    double number;
    (void)state;
    test_set(settings, CLSHEAR_DEVICE, "one");
    test_set(settings, CLSHEAR_LIGHT, "1,2,3,4,5,6");
    test_ok(clshear_settings_set_aperture(settings, luminance, 2, 1));
    test_ok(clshear_settings_copy(settings, &copy));
    test_set(settings, CLSHEAR_DEVICE, "two");
    test_set(settings, CLSHEAR_LIGHT, "1,2,3,4,5,6");
    test_set(settings, CLSHEAR_SPP, "4");
    clshear_settings_free(settings);
    test_ok(clshear_settings_get_text(copy, CLSHEAR_DEVICE, text, sizeof text));
    assert_string_equal(text, "one");
    test_ok(clshear_settings_get_numbers(copy, CLSHEAR_LIGHT, &number, 1, &count));
    assert_int_equal(count, 6);
    assert_false(clshear_settings_is_set(copy, CLSHEAR_SPP));
    test_ok(clshear_settings_get_text(copy, CLSHEAR_APERTURE, text, sizeof text));
    assert_string_equal(text, "image");
    clshear_settings_free(copy);
}

/* The struct of an older program is shorter: memory after it stays unchanged. The struct of a newer
 * program is longer: members unknown to the library stay unchanged. */
static void infos_fit_their_callers(void **state)
{
    struct {
        clshear_setting_info info;
        unsigned char newer[16];
    } given;
    (void)state;
    memset(&given, 0xa5, sizeof given);
    given.info.struct_size = offsetof(clshear_setting_info, aliases);
    assert_int_equal(clshear_setting_describe(0, &given.info), 1);
    assert_string_equal(given.info.name, "spp");
    const unsigned char *rest = (const unsigned char *)&given.info.aliases;
    while (rest < given.newer + sizeof given.newer)
        assert_int_equal(*rest++, 0xa5);
    given.info.struct_size = sizeof given;
    assert_int_equal(clshear_setting_describe(0, &given.info), 1);
    assert_int_equal(given.info.most, 1);
    assert_int_equal(given.info.struct_size, sizeof given);
    for (size_t i = 0; i < sizeof given.newer; i++)
        assert_int_equal(given.newer[i], 0xa5);
}

int main(void)
{
#define WITH_SETTINGS(test) cmocka_unit_test_setup_teardown(test, open_settings, close_settings)
    const struct CMUnitTest tests[] = {
        WITH_SETTINGS(bounds_are_enforced),
        WITH_SETTINGS(counts_are_enforced),
        WITH_SETTINGS(kinds_are_enforced),
        WITH_SETTINGS(expectations_have_words),
        WITH_SETTINGS(empty_texts_are_refused),
        WITH_SETTINGS(texts_come_back),
        WITH_SETTINGS(floats_survive_texts),
        WITH_SETTINGS(the_last_answer_counts),
        WITH_SETTINGS(a_text_needs_room),
        cmocka_unit_test(unset_alternatives_are_gone),
        WITH_SETTINGS(unknown_settings_are_refused),
        cmocka_unit_test(the_table_is_open),
        cmocka_unit_test(copies_are_independent),
        cmocka_unit_test(infos_fit_their_callers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
