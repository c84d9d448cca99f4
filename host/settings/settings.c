#include "settings/settings.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static clshear_status out_of_memory(cs_error *error)
{
    return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for settings");
}

clshear_status cs_settings_init(clshear_settings *settings, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < CS_SETTING_COUNT; i++) {
        cs_setting_value *value = &settings->values[i];
        const cs_setting *entry = &cs_setting_table[i];
        if (entry->kind == CLSHEAR_TEXT) continue;
        value->numbers = calloc(entry->values, sizeof *value->numbers);
        CS_REQUIRE(value->numbers != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for settings");
        value->count = entry->values;
        cs_setting_parse(entry, entry->fallback, value->numbers);
    }
done:
    return status;
}

/* Replaces a value by a copy of another. Leaves it unchanged when out of memory. */
static clshear_status copy_value(const cs_setting_value *from, cs_setting_value *to,
                                 cs_error *error)
{
    cs_setting_value copy = {.is_set = from->is_set, .count = from->count};
    if (from->text != NULL) copy.text = strdup(from->text);
    if (from->numbers != NULL) copy.numbers = malloc(from->count * sizeof *copy.numbers);
    if ((from->text != NULL && copy.text == NULL) ||
        (from->numbers != NULL && copy.numbers == NULL)) {
        free(copy.text);
        free(copy.numbers);
        return out_of_memory(error);
    }
    if (copy.numbers != NULL)
        memcpy(copy.numbers, from->numbers, from->count * sizeof *copy.numbers);
    free(to->text);
    free(to->numbers);
    *to = copy;
    return CLSHEAR_OK;
}

clshear_status cs_settings_copy(const clshear_settings *from, clshear_settings *to, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    to->progress = from->progress;
    to->progress_user = from->progress_user;
    to->preview = from->preview;
    for (size_t i = 0; i < CS_SETTING_COUNT; i++)
        CS_TRY(copy_value(&from->values[i], &to->values[i], error));
    if (from->aperture.luminance != NULL)
        CS_TRY(cs_aperture_image_copy(&from->aperture, &to->aperture, error));
done:
    return status;
}

void cs_settings_free(clshear_settings *settings)
{
    for (size_t i = 0; i < CS_SETTING_COUNT; i++) {
        free(settings->values[i].numbers);
        free(settings->values[i].text);
    }
    cs_aperture_image_free(&settings->aperture);
    *settings = (clshear_settings){0};
}

void cs_settings_unset(clshear_settings *settings, size_t index)
{
    const cs_setting *entry = &cs_setting_table[index];
    cs_setting_value *value = &settings->values[index];
    free(value->text);
    value->text = NULL;
    for (size_t i = 0; value->numbers != NULL && i < entry->values; i++)
        value->numbers[i] = 0.0;
    if (value->numbers != NULL) value->count = entry->values;
    if (value->numbers != NULL) cs_setting_parse(entry, entry->fallback, value->numbers);
    value->is_set = 0;
}

/* Pairs of settings that exclude each other: the one that is set last counts. */
static const int alternatives[][2] = {
    {CS_INDEX_LENS_RADIUS, CS_INDEX_F_STOP},
    {CS_INDEX_LENS_RADIUS, CS_INDEX_BLUR},
    {CS_INDEX_F_STOP, CS_INDEX_BLUR},
    {CS_INDEX_FOCAL_DISTANCE, CS_INDEX_FOCUS_PIXEL},
    {CS_INDEX_FOCAL_DISTANCE, CS_INDEX_FOCUS_POINT},
    {CS_INDEX_FOCUS_PIXEL, CS_INDEX_FOCUS_POINT},
    {CS_INDEX_EYE, CS_INDEX_ORBIT},
    {CS_INDEX_TARGET, CS_INDEX_ORBIT},
    {CS_INDEX_CAMERA, CS_INDEX_ORBIT},
    {CS_INDEX_FOV, CS_INDEX_ORTHOGRAPHIC},
};

/* Unsets the alternatives of a setting that was just set. Setting the blades chooses the
 * polygon. */
static void unset_alternatives(clshear_settings *settings, size_t index)
{
    const double polygon = CLSHEAR_APERTURE_POLYGON;
    for (size_t i = 0; i < sizeof alternatives / sizeof *alternatives; i++)
        for (int k = 0; k < 2; k++)
            if ((size_t)alternatives[i][k] == index)
                cs_settings_unset(settings, (size_t)alternatives[i][1 - k]);
    if (index != CS_INDEX_BLADES) return;
    cs_number(settings, APERTURE) = polygon;
    cs_is_set(settings, APERTURE) = 1;
}

void cs_settings_keep_text(clshear_settings *settings, size_t index, char *text)
{
    cs_setting_value *value = &settings->values[index];
    free(value->text);
    value->text = text;
    value->is_set = 1;
    unset_alternatives(settings, index);
}

clshear_status cs_settings_override(clshear_settings *settings, const clshear_settings *over,
                                    cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_aperture_image image = {0};
    for (size_t i = 0; i < CS_SETTING_COUNT; i++)
        if (over->values[i].is_set) unset_alternatives(settings, i);
    for (size_t i = 0; i < CS_SETTING_COUNT; i++)
        if (over->values[i].is_set)
            CS_TRY(copy_value(&over->values[i], &settings->values[i], error));
    if (over->aperture.luminance == NULL) return CLSHEAR_OK;
    CS_TRY(cs_aperture_image_copy(&over->aperture, &image, error));
    cs_aperture_image_free(&settings->aperture);
    settings->aperture = image;
done:
    return status;
}

/* Returns 1 if the numbers are within bounds, and whole where the kind requires it, else 0. */
static int are_allowed(const cs_setting *entry, const double *numbers, size_t count)
{
    const int whole = entry->kind != CLSHEAR_NUMBER;
    const double low = entry->low;
    double high = entry->high;
    if (entry->kind == CLSHEAR_CHOICE) high = cs_choice_count(entry->choices) - 1.0;
    for (size_t i = 0; i < count; i++)
        if (!(numbers[i] >= low && numbers[i] <= high) ||
            (whole && numbers[i] != floor(numbers[i])))
            return 0;
    switch (entry->setting) {
    case CLSHEAR_CROP:
        return numbers[0] < numbers[1] && numbers[2] < numbers[3];
    case CLSHEAR_PACKET:
        return numbers[0] == 1.0 || numbers[0] == 4.0 || numbers[0] == 8.0 || numbers[0] == 16.0;
    default:
        return 1;
    }
}

clshear_status cs_settings_set_number(clshear_settings *settings, clshear_setting setting,
                                      double number, cs_error *error)
{
    return cs_settings_set(settings, setting, &number, 1, error);
}

clshear_status cs_settings_set(clshear_settings *settings, clshear_setting setting,
                               const double *numbers, size_t count, cs_error *error)
{
    char expectation[512];
    const size_t index = cs_setting_index(setting);
    if (index == CS_SETTING_COUNT)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "setting %d is not known", (int)setting);
    const cs_setting *entry = &cs_setting_table[index];
    if (entry->kind == CLSHEAR_TEXT)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s: is a text, not a number", entry->name);
    if (count == 0 || count % entry->values != 0 || count / entry->values > entry->most)
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s: %zu numbers: must be %zu%s", entry->name,
                       count, entry->values, entry->most > 1 ? ", or a multiple of that" : "");
    if (!are_allowed(entry, numbers, count)) {
        cs_setting_expectation(entry, expectation, sizeof expectation);
        return cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s %.9g%s: must be %s", entry->name,
                       numbers[0], count > 1 ? ",..." : "", expectation);
    }
    cs_setting_value *value = &settings->values[index];
    double *room = realloc(value->numbers, count * sizeof *room);
    if (room == NULL) return out_of_memory(error);
    memcpy(room, numbers, count * sizeof *room);
    value->numbers = room;
    value->count = count;
    value->is_set = 1;
    unset_alternatives(settings, index);
    return CLSHEAR_OK;
}

clshear_status cs_settings_set_aperture(clshear_settings *settings, const cs_aperture_image *image,
                                        cs_error *error)
{
    cs_aperture_image copy = {0};
    clshear_status status = cs_aperture_image_check(image, error);
    if (status == CLSHEAR_OK) status = cs_aperture_image_copy(image, &copy, error);
    if (status != CLSHEAR_OK) return status;
    cs_aperture_image_free(&settings->aperture);
    settings->aperture = copy;
    cs_number(settings, APERTURE) = CLSHEAR_APERTURE_IMAGE;
    cs_is_set(settings, APERTURE) = 1;
    return CLSHEAR_OK;
}
