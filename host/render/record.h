/* Settings in the metadata of a film, and in the recipe that a continued render must share. */
#ifndef CS_RENDER_RECORD_H
#define CS_RENDER_RECORD_H

#include "film/film.h"
#include "settings/settings.h"

enum {
    CS_RECIPE_SIZE = 4096 /* bytes that hold any recipe */
};

/* Writes each setting of the table that is recorded as "clshear.<nameInCamelCase>". */
clshear_status cs_record_settings(const clshear_settings *settings, clshear_film *film);

/* "name=value;..." of each setting of the table with this use. */
void cs_record_list(const clshear_settings *settings, cs_setting_use use, char *text, size_t size);

#endif
