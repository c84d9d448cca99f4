#include "render/record.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

/* "blade-rotation" -> "clshear.bladeRotation". */
static void attribute_name(const cs_setting *setting, char *name, size_t size)
{
    size_t length = (size_t)snprintf(name, size, "clshear.");
    int capital = 0;
    for (const char *c = setting->name; *c != '\0' && length + 1 < size; c++) {
        if (*c != '-') name[length++] = (char)(capital ? toupper((unsigned char)*c) : *c);
        capital = *c == '-';
    }
    name[length] = '\0';
}

/* Integers that metadata cannot hold as such, and values of several numbers, are texts. */
static clshear_status record(const clshear_settings *settings, size_t index, clshear_film *film)
{
    char name[64], text[512];
    const cs_setting *entry = &cs_setting_table[index];
    const double *numbers = settings->values[index].numbers;
    const int is_int = entry->kind == CLSHEAR_SWITCH ||
                       (entry->kind == CLSHEAR_INTEGER && entry->high <= INT32_MAX);
    attribute_name(entry, name, sizeof name);
    if (entry->values == 1 && entry->most == 1 && is_int)
        return cs_film_set_int(film, name, (int32_t)numbers[0]);
    if (entry->values == 1 && entry->most == 1 && entry->kind == CLSHEAR_NUMBER)
        return cs_film_set_float(film, name, (float)numbers[0]);
    cs_settings_print(settings, index, text, sizeof text);
    return cs_film_annotate(film, name, text);
}

static int has_value(const clshear_settings *settings, size_t index)
{
    return settings->values[index].is_set || *cs_setting_table[index].fallback != '\0';
}

clshear_status cs_record_settings(const clshear_settings *settings, clshear_film *film)
{
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < CS_SETTING_COUNT; i++)
        if (cs_setting_table[i].use != CS_USE_PRIVATE && has_value(settings, i))
            CS_TRY(record(settings, i, film));
done:
    return status;
}

void cs_record_list(const clshear_settings *settings, cs_setting_use use, char *text, size_t size)
{
    char value[256];
    size_t used = 0;
    *text = '\0';
    for (size_t i = 0; i < CS_SETTING_COUNT && used < size; i++) {
        if (cs_setting_table[i].use != use) continue;
        cs_settings_print(settings, i, value, sizeof value);
        used +=
            (size_t)snprintf(text + used, size - used, "%s=%s;", cs_setting_table[i].name, value);
    }
}
