/* The table of settings: what is refused, by bounds, counts and kinds; and structs of older and
 * newer callers. */
#include "support.h"

#include <math.h>
#include <stdio.h>

#include "settings/settings.h"

enum {
    MOST_NUMBERS = 12 /* in one value of a setting */
};

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
        test_ok(test_set_all(settings, entry->setting, entry->values, low));
        test_ok(test_set_all(settings, entry->setting, entry->values, high));
        test_ok(
            clshear_settings_get_numbers(settings, entry->setting, before, MOST_NUMBERS, &count));
        const int whole = entry->kind != CLSHEAR_NUMBER;
        const double wrong[] = {whole ? low - 1.0 : nextafter(low, -INFINITY),
                                whole ? high + 1.0 : nextafter(high, INFINITY), NAN,
                                whole ? low + 0.5 : INFINITY};
        for (int w = 0; w < 4; w++)
            test_refused(test_set_all(settings, entry->setting, entry->values, wrong[w]),
                         CLSHEAR_BAD_ARGUMENT, entry->name);
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
    test_refused(test_set_all(settings, CLSHEAR_DEVICE, 1, 0.0), CLSHEAR_BAD_ARGUMENT, "device");
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
#define WITH_SETTINGS(test) \
    cmocka_unit_test_setup_teardown(test, test_open_settings, test_close_settings)
    const struct CMUnitTest tests[] = {
        WITH_SETTINGS(bounds_are_enforced),     WITH_SETTINGS(counts_are_enforced),
        WITH_SETTINGS(kinds_are_enforced),      WITH_SETTINGS(expectations_have_words),
        WITH_SETTINGS(empty_texts_are_refused), WITH_SETTINGS(unknown_settings_are_refused),
        cmocka_unit_test(the_table_is_open),    cmocka_unit_test(infos_fit_their_callers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
