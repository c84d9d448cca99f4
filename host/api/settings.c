/* Public functions of settings. */
#include <stdlib.h>

#include "api/arguments.h"
#include "settings/settings.h"

clshear_status clshear_settings_create(clshear_settings **settings)
{
    CS_NEEDS(settings);
    cs_error *error = cs_thread_error();
    clshear_settings *made = calloc(1, sizeof *made);
    if (made == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for settings");
    const clshear_status status = cs_settings_init(made, error);
    if (status == CLSHEAR_OK)
        *settings = made;
    else
        clshear_settings_free(made);
    return status;
}

clshear_status clshear_settings_copy(const clshear_settings *settings, clshear_settings **copy)
{
    CS_NEEDS(settings);
    CS_NEEDS(copy);
    cs_error *error = cs_thread_error();
    clshear_settings *made = calloc(1, sizeof *made);
    if (made == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for settings");
    const clshear_status status = cs_settings_copy(settings, made, error);
    if (status == CLSHEAR_OK)
        *copy = made;
    else
        clshear_settings_free(made);
    return status;
}

CS_FREES(settings)

/* Finds the table's entry of a setting of either kind. Returns NULL and stores a message if the
 * setting is unknown or of a third kind. */
static const cs_setting *entry_of(clshear_setting setting, clshear_setting_kind kind,
                                  clshear_setting_kind other, const char *what)
{
    static const char *const kinds[] = {[CLSHEAR_SWITCH] = "a switch",
                                        [CLSHEAR_INTEGER] = "a whole number",
                                        [CLSHEAR_NUMBER] = "a number",
                                        [CLSHEAR_CHOICE] = "a choice",
                                        [CLSHEAR_TEXT] = "a text"};
    cs_error *error = cs_thread_error();
    const size_t index = cs_setting_index(setting);
    if (index == CS_SETTING_COUNT) {
        cs_fail(error, CLSHEAR_BAD_ARGUMENT, "setting %d is not known", (int)setting);
        return NULL;
    }
    const cs_setting *entry = &cs_setting_table[index];
    if (entry->kind == kind || entry->kind == other) return entry;
    cs_fail(error, CLSHEAR_BAD_ARGUMENT, "%s: is %s; this function is for %s", entry->name,
            entry->most > 1 ? "a list" : kinds[entry->kind], what);
    return NULL;
}

static const cs_setting *integer_entry(clshear_setting setting)
{
    const size_t index = cs_setting_index(setting);
    const int is_known = index < CS_SETTING_COUNT;
    const int is_switch = is_known && cs_setting_table[index].kind == CLSHEAR_SWITCH;
    const int is_list = is_known && cs_setting_table[index].most > 1; /* of choices */
    const clshear_setting_kind kind = is_switch ? CLSHEAR_SWITCH : CLSHEAR_INTEGER;
    return entry_of(setting, kind, is_list ? kind : CLSHEAR_CHOICE, "a whole number");
}

clshear_status clshear_settings_set_integer(clshear_settings *settings, clshear_setting setting,
                                            int64_t value)
{
    CS_NEEDS(settings);
    const double number = (double)value;
    if (integer_entry(setting) == NULL) return CLSHEAR_BAD_ARGUMENT;
    return cs_settings_set(settings, setting, &number, 1, cs_thread_error());
}

clshear_status clshear_settings_set_number(clshear_settings *settings, clshear_setting setting,
                                           double value)
{
    CS_NEEDS(settings);
    if (entry_of(setting, CLSHEAR_NUMBER, CLSHEAR_NUMBER, "a number") == NULL)
        return CLSHEAR_BAD_ARGUMENT;
    return cs_settings_set(settings, setting, &value, 1, cs_thread_error());
}

clshear_status clshear_settings_set_numbers(clshear_settings *settings, clshear_setting setting,
                                            const double *numbers, size_t count)
{
    CS_NEEDS(settings);
    CS_NEEDS(numbers);
    return cs_settings_set(settings, setting, numbers, count, cs_thread_error());
}

clshear_status clshear_settings_set_text(clshear_settings *settings, clshear_setting setting,
                                         const char *text)
{
    CS_NEEDS(settings);
    CS_NEEDS(text);
    const size_t index = cs_setting_index(setting);
    if (index == CS_SETTING_COUNT)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "setting %d is not known",
                       (int)setting);
    return cs_settings_set_text(settings, index, text, cs_thread_error());
}

clshear_status clshear_settings_set_aperture(clshear_settings *settings, const float *luminance,
                                             int width, int height)
{
    CS_NEEDS(settings);
    CS_NEEDS(luminance);
    cs_aperture_image image = {.width = width, .height = height};
    image.luminance = (float *)(uintptr_t)luminance; /* only read: settings copy it */
    return cs_settings_set_aperture(settings, &image, cs_thread_error());
}

clshear_status clshear_settings_override(clshear_settings *settings, const clshear_settings *over)
{
    CS_NEEDS(settings);
    CS_NEEDS(over);
    return cs_settings_override(settings, over, cs_thread_error());
}

void clshear_settings_unset(clshear_settings *settings, clshear_setting setting)
{
    const size_t index = cs_setting_index(setting);
    if (settings != NULL && index < CS_SETTING_COUNT) cs_settings_unset(settings, index);
}

int clshear_settings_is_set(const clshear_settings *settings, clshear_setting setting)
{
    const size_t index = cs_setting_index(setting);
    return settings != NULL && index < CS_SETTING_COUNT && settings->values[index].is_set;
}

/* Fails unless the setting has a value: one that was set, or a fallback. */
static clshear_status check_value(const clshear_settings *settings, clshear_setting setting)
{
    const size_t index = cs_setting_index(setting);
    if (settings->values[index].is_set || *cs_setting_table[index].fallback != '\0')
        return CLSHEAR_OK;
    return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "%s: is not set",
                   cs_setting_table[index].name);
}

/* Fails unless the value is one number. */
static clshear_status check_number(const clshear_settings *settings, clshear_setting setting)
{
    const cs_setting *entry = &cs_setting_table[cs_setting_index(setting)];
    if (entry->values == 1) return check_value(settings, setting);
    return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "%s: is %zu numbers, not one",
                   entry->name, entry->values);
}

clshear_status clshear_settings_get_integer(const clshear_settings *settings,
                                            clshear_setting setting, int64_t *value)
{
    CS_NEEDS(settings);
    CS_NEEDS(value);
    if (integer_entry(setting) == NULL) return CLSHEAR_BAD_ARGUMENT;
    const clshear_status status = check_number(settings, setting);
    if (status == CLSHEAR_OK)
        *value = (int64_t)settings->values[cs_setting_index(setting)].numbers[0];
    return status;
}

clshear_status clshear_settings_get_number(const clshear_settings *settings,
                                           clshear_setting setting, double *value)
{
    CS_NEEDS(settings);
    CS_NEEDS(value);
    if (entry_of(setting, CLSHEAR_NUMBER, CLSHEAR_NUMBER, "a number") == NULL)
        return CLSHEAR_BAD_ARGUMENT;
    const clshear_status status = check_number(settings, setting);
    if (status == CLSHEAR_OK) *value = settings->values[cs_setting_index(setting)].numbers[0];
    return status;
}

clshear_status clshear_settings_get_numbers(const clshear_settings *settings,
                                            clshear_setting setting, double *numbers,
                                            size_t capacity, size_t *count)
{
    CS_NEEDS(settings);
    if (capacity > 0) CS_NEEDS(numbers);
    CS_NEEDS(count);
    const size_t index = cs_setting_index(setting);
    if (index == CS_SETTING_COUNT || cs_setting_table[index].kind == CLSHEAR_TEXT)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "setting %d has no numbers",
                       (int)setting);
    const clshear_status status = check_value(settings, setting);
    if (status != CLSHEAR_OK) return status;
    const cs_setting_value *value = &settings->values[index];
    for (size_t i = 0; i < value->count && i < capacity; i++)
        numbers[i] = value->numbers[i];
    *count = value->count;
    return CLSHEAR_OK;
}

clshear_status clshear_settings_get_text(const clshear_settings *settings, clshear_setting setting,
                                         char *text, size_t size)
{
    CS_NEEDS(settings);
    CS_NEEDS(text);
    const size_t index = cs_setting_index(setting);
    if (index == CS_SETTING_COUNT)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "setting %d is not known",
                       (int)setting);
    if (size == 0)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "text has no room: size is 0");
    const clshear_status status = check_value(settings, setting);
    if (status == CLSHEAR_OK) cs_settings_print(settings, index, text, size);
    return status;
}

clshear_status clshear_settings_read(clshear_settings *settings, const char *path,
                                     int (*other)(void *user, const char *file, int line,
                                                  const char *name, const char *value),
                                     void *user)
{
    CS_NEEDS(settings);
    CS_NEEDS_NAME(path);
    return cs_settings_read(settings, path, other, user, cs_thread_error());
}

void clshear_settings_set_progress(clshear_settings *settings,
                                   int (*progress)(void *user, const clshear_progress *state),
                                   void *user)
{
    if (settings == NULL) return;
    settings->progress = progress;
    settings->progress_user = user;
}

void clshear_settings_set_preview(clshear_settings *settings, int (*wanted)(void *user),
                                  void (*show)(void *user, clshear_film *film), void *user)
{
    if (settings == NULL) return;
    settings->preview = (cs_preview){wanted, show, user};
}
