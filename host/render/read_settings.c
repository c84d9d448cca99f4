#include "render/read_settings.h"

#include <stdlib.h>
#include <string.h>

enum {
    VALUE_SIZE = 4096 /* bytes of a value as text; one is a path */
};

static const size_t indices[CS_READ_SETTINGS] = {
    CS_INDEX_SMOOTH,        CS_INDEX_FRAME, CS_INDEX_FPS,      CS_INDEX_SHUTTER,
    CS_INDEX_SHUTTER_ANGLE, CS_INDEX_TO,    CS_INDEX_TURNTABLE};

static clshear_status print_values(cs_read_settings *kept, const clshear_settings *settings,
                                   cs_error *error)
{
    char text[VALUE_SIZE];
    for (size_t i = 0; i < CS_READ_SETTINGS; i++) {
        cs_settings_print(settings, indices[i], text, sizeof text);
        kept->value[i] = strdup(text);
        if (kept->value[i] == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory");
    }
    return CLSHEAR_OK;
}

clshear_status cs_read_settings_keep(cs_read_settings *kept, const clshear_settings *settings,
                                     cs_error *error)
{
    clshear_settings fallbacks = {0};
    if (settings != NULL) return print_values(kept, settings, error);
    clshear_status status = cs_settings_init(&fallbacks, error);
    if (status == CLSHEAR_OK) status = print_values(kept, &fallbacks, error);
    cs_settings_free(&fallbacks);
    return status;
}

void cs_read_settings_free(cs_read_settings *kept)
{
    for (size_t i = 0; i < CS_READ_SETTINGS; i++)
        free(kept->value[i]);
    *kept = (cs_read_settings){{NULL}};
}

void cs_read_settings_compare(const cs_read_settings *kept, const clshear_settings *settings,
                              const cs_log *log)
{
    char text[VALUE_SIZE];
    for (size_t i = 0; i < CS_READ_SETTINGS && kept->value[i] != NULL; i++) {
        const char *read = kept->value[i];
        cs_settings_print(settings, indices[i], text, sizeof text);
        if (strcmp(text, read) == 0) continue;
        cs_warn(log, "%s: the scene was loaded with %s, not with %s, and stays so",
                cs_setting_table[indices[i]].name, *read != '\0' ? read : "no value",
                *text != '\0' ? text : "no value");
    }
}
