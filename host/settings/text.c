/* Conversion of settings to and from text. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "settings/settings.h"

/* As many as a value of a setting may have numbers. */
static const char *const count_words[] = {"",     "a",      "two",   "three", "four",
                                          "five", "six",    "seven", "eight", "nine",
                                          "ten",  "eleven", "twelve"};

/* Appends formatted text, truncated to `size` bytes. */
static void append(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void append(char *text, size_t size, const char *format, ...)
{
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
}

static void list_choices(const cs_setting *setting, char *text, size_t size)
{
    const cs_choice *choices = setting->choices;
    const int with_file = setting->setting == CLSHEAR_APERTURE; /* instead of the choice "image" */
    const int count = cs_choice_count(choices);
    for (int i = 0; i < count; i++) {
        const int last = i + 1 == count && !with_file;
        if (with_file && i == CLSHEAR_APERTURE_IMAGE) continue;
        const char *separator = last ? " or " : ", ";
        append(text, size, "%s%s", i == 0 ? "" : separator, choices[i].name);
    }
    if (with_file) append(text, size, " or an image file");
}

void cs_setting_expectation(const cs_setting *setting, char *text, size_t size)
{
    const int one = setting->values == 1;
    *text = '\0';
    switch (setting->kind) {
    case CLSHEAR_SWITCH:
        append(text, size, "0 or 1");
        return;
    case CLSHEAR_CHOICE:
        list_choices(setting, text, size);
        return;
    case CLSHEAR_TEXT:
        append(text, size, "a text");
        return;
    default:
        break;
    }
    if (setting->setting == CLSHEAR_PACKET) {
        append(text, size, "1, 4, 8 or 16");
        return;
    }
    append(text, size, "%s %s%s", count_words[setting->values],
           setting->kind == CLSHEAR_INTEGER ? "whole number" : "number", one ? "" : "s");
    if (!one) append(text, size, ", %s", setting->argument);
    if (setting->setting == CLSHEAR_CROP)
        append(text, size, ", with X0 < X1 and Y0 < Y1");
    else
        append(text, size, ", %s%.10g to %.10g", one ? "" : "each ", setting->low, setting->high);
}

static clshear_status refuse(const cs_setting *setting, const char *text, cs_error *error)
{
    char expectation[512];
    cs_setting_expectation(setting, expectation, sizeof expectation);
    return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s %.60s: must be %s", setting->name, text,
                   expectation);
}

/* Reads a number, or the name of a choice, that ends at `end`. Returns where it ends, or `text`. */
static const char *read_one(const cs_setting *setting, const char *text, const char *end,
                            double *number)
{
    char name[32];
    if (setting->kind != CLSHEAR_CHOICE) return cs_parse_number(text, end, number);
    if ((size_t)(end - text) >= sizeof name) return text;
    snprintf(name, sizeof name, "%.*s", (int)(end - text), text);
    *number = cs_choice_find(setting->choices, name);
    return *number >= 0.0 ? end : text;
}

static const char *behind_blanks(const char *text)
{
    return text + strspn(text, " \t");
}

/* Reads up to `capacity` values separated by commas, around which blanks may stand. Returns their
 * count, or 0 if there are more or the text has anything else. */
static size_t read_numbers(const cs_setting *setting, const char *text, size_t capacity,
                           double *numbers)
{
    for (size_t i = 0; i < capacity; i++) {
        const char *end = read_one(setting, text, text + strcspn(text, ", \t"), &numbers[i]);
        if (end == text || !isfinite(numbers[i])) return 0;
        if (*end == '\0') return i + 1;
        end = behind_blanks(end);
        if (*end != ',') return 0;
        text = behind_blanks(end + 1);
    }
    return 0;
}

int cs_setting_parse(const cs_setting *setting, const char *text, double *numbers)
{
    if (setting->kind != CLSHEAR_CHOICE)
        return read_numbers(setting, text, setting->values, numbers) == setting->values;
    numbers[0] = cs_choice_find(setting->choices, text);
    return numbers[0] >= 0.0;
}

/* Rounds to float first: kernels use floats, so "0.1" must become the float 0.1. */
static clshear_status set_numbers(clshear_settings *settings, size_t index, const char *text,
                                  cs_error *error)
{
    const cs_setting *entry = &cs_setting_table[index];
    const cs_setting_value *value = &settings->values[index];
    const size_t before = entry->most > 1 && value->is_set ? value->count : 0;
    const size_t capacity = entry->values * entry->most;
    double *all = malloc((before + capacity + 1) * sizeof *all); /* a text has no numbers */
    if (all == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    const size_t added = read_numbers(entry, text, capacity, all + before);
    clshear_status status = CLSHEAR_BAD_ARGUMENT;
    if (added > 0 && added % entry->values == 0 && before + added > capacity) {
        free(all);
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s %.60s: given more than %zu times",
                       entry->name, text, entry->most);
    }
    if (before > 0) memcpy(all, value->numbers, before * sizeof *all);
    if (added > 0) status = cs_settings_set(settings, entry->setting, all, before + added, error);
    free(all);
    return status == CLSHEAR_BAD_ARGUMENT ? refuse(entry, text, error) : status;
}

/* Sets the aperture from an image file, or from a name in the list. */
static clshear_status set_aperture_file(clshear_settings *settings, const char *path,
                                        cs_error *error)
{
    cs_aperture_image image = {0};
    clshear_status status = cs_aperture_image_read(path, &image, error);
    if (status == CLSHEAR_OK) status = cs_settings_set_aperture(settings, &image, error);
    cs_aperture_image_free(&image);
    return status == CLSHEAR_BAD_ARGUMENT ? CLSHEAR_BAD_FILE
                                          : status; /* the bad value came from a file */
}

clshear_status cs_settings_set_text(clshear_settings *settings, size_t index, const char *text,
                                    cs_error *error)
{
    const cs_setting *entry = &cs_setting_table[index];
    if (entry->kind == CLSHEAR_CHOICE && entry->most == 1) {
        double number;
        if (cs_setting_parse(entry, text, &number))
            return cs_settings_set(settings, entry->setting, &number, 1, error);
        if (entry->setting == CLSHEAR_APERTURE && strpbrk(text, "./") != NULL)
            return set_aperture_file(settings, text, error);
        return refuse(entry, text, error);
    }
    if (entry->kind != CLSHEAR_TEXT) return set_numbers(settings, index, text, error);
    if (*text == '\0')
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s is empty: give %s, or leave it out",
                       entry->name, entry->argument);
    char *copy = strdup(text);
    if (copy == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for settings");
    cs_settings_keep_text(settings, index, copy);
    return CLSHEAR_OK;
}

void cs_settings_print(const clshear_settings *settings, size_t index, char *text, size_t size)
{
    const cs_setting *entry = &cs_setting_table[index];
    const cs_setting_value *value = &settings->values[index];
    char number[40];
    *text = '\0';
    if (!value->is_set && *entry->fallback == '\0') return;
    if (entry->kind == CLSHEAR_TEXT)
        append(text, size, "%s", value->text);
    else if (entry->kind == CLSHEAR_CHOICE)
        for (size_t i = 0; i < value->count; i++)
            append(text, size, "%s%s", i > 0 ? "," : "",
                   entry->choices[(int)value->numbers[i]].name);
    else
        for (size_t i = 0; i < value->count; i++)
            append(text, size, "%s%s", i > 0 ? "," : "",
                   cs_format_number(number, sizeof number, value->numbers[i],
                                    entry->kind == CLSHEAR_NUMBER ? 9 : 17));
}
