/* The table of settings, as include/clshear/setting_list.h has it, for loops over all of them. */
#ifndef CS_SETTINGS_TABLE_H
#define CS_SETTINGS_TABLE_H

#include "clshear/clshear.h"

/* Place of a setting in the table: CS_INDEX_SPP, ... */
enum {
#define CS_SETTING_INDEX(identifier, ...) CS_INDEX_##identifier,
    CLSHEAR_SETTING_LIST(CS_SETTING_INDEX)
#undef CS_SETTING_INDEX
    CS_SETTING_COUNT
};

/* What a setting is used for besides the render itself. */
typedef enum cs_setting_use {
    CS_USE_PRIVATE, /* nothing */
    CS_USE_RECORD,  /* is written to the metadata */
    CS_USE_RECIPE   /* the same, and must be equal when a render is continued */
} cs_setting_use;

/* One name of a CHOICE; lists end with a NULL name. */
typedef struct cs_choice {
    const char *name;
    const char *meaning;
} cs_choice;

/* A line of the table; the columns are described in setting_list.h. */
typedef struct cs_setting {
    clshear_setting setting;
    const char *name;
    const char *aliases; /* separated by spaces */
    clshear_setting_kind kind;
    size_t values;
    size_t most;
    const char *fallback;
    double low;
    double high;
    const cs_choice *choices; /* NULL unless it is a CHOICE */
    cs_setting_use use;
    const char *argument;
    const char *help;
} cs_setting;

extern const cs_setting cs_setting_table[CS_SETTING_COUNT];

/* Place of a setting in the table, or CS_SETTING_COUNT for a number that is none. */
size_t cs_setting_index(clshear_setting setting);

/* Place of the setting that has `name`, of `length` characters, among its names. */
size_t cs_setting_named(const char *name, size_t length);

/* Entries of a list of choices. */
int cs_choice_count(const cs_choice *choices);

/* Number of the choice called `text`, or -1. */
int cs_choice_find(const cs_choice *choices, const char *text);

#endif
