/* Settings of a render: one value for each line of the table of settings. */
#ifndef CS_SETTINGS_SETTINGS_H
#define CS_SETTINGS_SETTINGS_H

#include "base/status.h"
#include "optics/optics.h"
#include "settings/table.h"

typedef struct cs_setting_value {
    int is_set;      /* 0: holds the fallback, or zeros if the render chooses the value */
    double *numbers; /* `count` numbers; NULL for a TEXT */
    size_t count;    /* numbers in `numbers`, a multiple of those in one value */
    char *text;      /* value of a TEXT; NULL: not set */
} cs_setting_value;

/* As in clshear_settings_set_preview. */
typedef struct cs_preview {
    int (*wanted)(void *user);
    void (*show)(void *user, clshear_film *film);
    void *user;
} cs_preview;

struct clshear_settings {
    cs_setting_value values[CS_SETTING_COUNT];
    cs_aperture_image aperture; /* transmittance of an image aperture; owned */
    int (*progress)(void *user, const clshear_progress *state);
    void *progress_user;
    cs_preview preview;
};

/* Read a setting by its identifier, as in cs_integer(settings, SPP). */
#define cs_is_set(settings, identifier) ((settings)->values[CS_INDEX_##identifier].is_set)
#define cs_numbers(settings, identifier) ((settings)->values[CS_INDEX_##identifier].numbers)
#define cs_number(settings, identifier) (cs_numbers(settings, identifier)[0])
#define cs_integer(settings, identifier) ((int64_t)cs_number(settings, identifier))
#define cs_text(settings, identifier) ((const char *)(settings)->values[CS_INDEX_##identifier].text)

/* Sets every setting to its fallback. Initialise `settings` to zero; free it with cs_settings_free,
 * also after a failure. */
clshear_status cs_settings_init(clshear_settings *settings, cs_error *error);
clshear_status cs_settings_copy(const clshear_settings *from, clshear_settings *to,
                                cs_error *error);
void cs_settings_free(clshear_settings *settings);

/* Implements clshear_settings_override. */
clshear_status cs_settings_override(clshear_settings *settings, const clshear_settings *over,
                                    cs_error *error);

/* Sets all numbers of a setting, after a check of kind, bounds and count. */
clshear_status cs_settings_set(clshear_settings *settings, clshear_setting setting,
                               const double *numbers, size_t count, cs_error *error);
/* The same for a setting of one number. */
clshear_status cs_settings_set_number(clshear_settings *settings, clshear_setting setting,
                                      double number, cs_error *error);

/* Sets a setting from text. A setting with a list of values gets one more. */
clshear_status cs_settings_set_text(clshear_settings *settings, size_t index, const char *text,
                                    cs_error *error);
/* Sets a TEXT; takes over the memory of `text`. */
void cs_settings_keep_text(clshear_settings *settings, size_t index, char *text);

void cs_settings_unset(clshear_settings *settings, size_t index);

/* Stores a copy of the image, after a check. */
clshear_status cs_settings_set_aperture(clshear_settings *settings, const cs_aperture_image *image,
                                        cs_error *error);

/* Reads the numbers of one value without a check of their bounds. Returns 0 if the text is not a
 * value of the setting's kind. */
int cs_setting_parse(const cs_setting *setting, const char *text, double *numbers);

/* Prints the value in the form that cs_settings_set_text reads. Prints "" if the setting is not set
 * and has no fallback. */
void cs_settings_print(const clshear_settings *settings, size_t index, char *text, size_t size);

/* Describes the valid values in words: "a whole number, 1 to 65536". */
void cs_setting_expectation(const cs_setting *setting, char *text, size_t size);

/* Implements clshear_settings_read. */
clshear_status cs_settings_read(clshear_settings *settings, const char *path,
                                int (*other)(void *user, const char *file, int line,
                                             const char *name, const char *value),
                                void *user, cs_error *error);

#endif
