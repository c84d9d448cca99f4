/* The table of settings (include/clshear/setting_list.h) as an array, for loops over all
 * settings. */
#ifndef CS_SETTINGS_TABLE_H
#define CS_SETTINGS_TABLE_H

#include "clshear/clshear.h"

/* Index of each setting in the table: CS_INDEX_SPP, ... */
enum {
#define CS_SETTING_INDEX(identifier, ...) CS_INDEX_##identifier,
    CLSHEAR_SETTING_LIST(CS_SETTING_INDEX)
#undef CS_SETTING_INDEX
    CS_SETTING_COUNT
};

/* Further uses of a setting besides the render itself. */
typedef enum cs_setting_use {
    CS_USE_PRIVATE, /* none */
    CS_USE_RECORD,  /* recorded in the metadata */
    CS_USE_RECIPE   /* recorded, and must be equal when a render is continued */
} cs_setting_use;

/* A name of a CHOICE. Lists end with a NULL name. */
typedef struct cs_choice {
    const char *name;
    const char *meaning;
} cs_choice;

/* A line of the table. setting_list.h describes the columns. */
typedef struct cs_setting {
    clshear_setting setting;
    const char *name;
    const char *aliases; /* other names, separated by spaces */
    clshear_setting_kind kind;
    size_t values;
    size_t most;
    const char *fallback;
    double low;
    double high;
    const cs_choice *choices; /* names of a CHOICE; NULL for other kinds */
    cs_setting_use use;
    const char *argument;
    const char *help;
} cs_setting;

extern const cs_setting cs_setting_table[CS_SETTING_COUNT];

/* Index of a setting in the table, or CS_SETTING_COUNT for an unknown number. */
size_t cs_setting_index(clshear_setting setting);

/* Index of the setting with this name or alias, of `length` characters, or CS_SETTING_COUNT. */
size_t cs_setting_named(const char *name, size_t length);

/* Length of a list of choices. */
int cs_choice_count(const cs_choice *choices);

/* Number of the choice named `text`, or -1. */
int cs_choice_find(const cs_choice *choices, const char *text);

#endif
