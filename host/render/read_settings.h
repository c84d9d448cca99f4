/* The settings that a scene's file was read with. */
#ifndef CS_RENDER_READ_SETTINGS_H
#define CS_RENDER_READ_SETTINGS_H

#include "base/status.h"
#include "settings/settings.h"

enum {
    CS_READ_SETTINGS = 7 /* that say how a file is read */
};

/* Their values as text, owned; NULL: no file was read. */
typedef struct cs_read_settings {
    char *value[CS_READ_SETTINGS];
} cs_read_settings;

/* Keeps them; `settings` may be NULL. Start from zeros; free it after a failure, too. */
clshear_status cs_read_settings_keep(cs_read_settings *kept, const clshear_settings *settings,
                                     cs_error *error);
void cs_read_settings_free(cs_read_settings *kept);

/* Warns of each that `settings` has another value of: the file's has the effect, and the picture's
 * metadata would name the other. */
void cs_read_settings_compare(const cs_read_settings *kept, const clshear_settings *settings,
                              const cs_log *log);

#endif
