/* Values of settings: as texts, instead of each other, over others, and copied. */
#include "support.h"

#include <math.h>

#include "settings/settings.h"

static clshear_settings *fresh(void)
{
    clshear_settings *settings = NULL;
    test_ok(clshear_settings_create(&settings));
    return settings;
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
            test_ok(test_set_all(settings, entry->setting, entry->values,
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
        test_ok(test_set_all(settings, entry->setting, entry->values, high));
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

int main(void)
{
#define WITH_SETTINGS(test) \
    cmocka_unit_test_setup_teardown(test, test_open_settings, test_close_settings)
    const struct CMUnitTest tests[] = {
        WITH_SETTINGS(texts_come_back),
        WITH_SETTINGS(floats_survive_texts),
        WITH_SETTINGS(a_text_needs_room),
        WITH_SETTINGS(the_last_answer_counts),
        cmocka_unit_test(unset_alternatives_are_gone),
        cmocka_unit_test(copies_are_independent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
