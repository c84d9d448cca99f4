#include "settings/table.h"

#include <string.h>

#include "clshear/device/sampler/list.h"

/* A choice stands at its number, so that numbers are places in the lists. */
#define CS_CHOICE_ENTRY(identifier, number, name, meaning) [number] = {name, meaning},
#define CS_SAMPLER_CHOICE(identifier, name, draw, light, extra, shape, words, progressive, about) \
    {name, about},

static const cs_choice choices_shear[] = {CLSHEAR_SHEAR_LIST(CS_CHOICE_ENTRY){NULL, NULL}};
static const cs_choice choices_oracle[] = {CLSHEAR_ORACLE_LIST(CS_CHOICE_ENTRY){NULL, NULL}};
static const cs_choice choices_filter[] = {CLSHEAR_FILTER_LIST(CS_CHOICE_ENTRY){NULL, NULL}};
static const cs_choice choices_aperture[] = {CLSHEAR_APERTURE_LIST(CS_CHOICE_ENTRY){NULL, NULL}};
static const cs_choice choices_aov[] = {CLSHEAR_AOV_LIST(CS_CHOICE_ENTRY){NULL, NULL}};
static const cs_choice choices_emitters[] = {CLSHEAR_EMITTERS_LIST(CS_CHOICE_ENTRY){NULL, NULL}};
static const cs_choice choices_tone[] = {CLSHEAR_TONE_LIST(CS_CHOICE_ENTRY){NULL, NULL}};
static const cs_choice choices_sampler[] = {CS_SAMPLER_LIST(CS_SAMPLER_CHOICE){NULL, NULL}};

#define CS_SETTING_ENTRY(identifier, number, name, aliases, kind, values, most, fallback, low, \
                         high, choices, use, argument, help)                                   \
    {CLSHEAR_##identifier,                                                                     \
     name,                                                                                     \
     aliases,                                                                                  \
     CLSHEAR_##kind,                                                                           \
     values,                                                                                   \
     most,                                                                                     \
     fallback,                                                                                 \
     low,                                                                                      \
     high,                                                                                     \
     CS_CHOICES_##kind(choices),                                                               \
     CS_USE_##use,                                                                             \
     argument,                                                                                 \
     help},
#define CS_CHOICES_SWITCH(choices) NULL
#define CS_CHOICES_INTEGER(choices) NULL
#define CS_CHOICES_NUMBER(choices) NULL
#define CS_CHOICES_TEXT(choices) NULL
#define CS_CHOICES_CHOICE(choices) choices_##choices

const cs_setting cs_setting_table[CS_SETTING_COUNT] = {CLSHEAR_SETTING_LIST(CS_SETTING_ENTRY)};

size_t cs_setting_index(clshear_setting setting)
{
    size_t index = 0;
    while (index < CS_SETTING_COUNT && cs_setting_table[index].setting != setting)
        index++;
    return index;
}

/* Returns 1 if `name`, of `length` characters, is a word of the list, else 0. */
static int is_listed(const char *list, const char *name, size_t length)
{
    while (*list != '\0') {
        const size_t size = strcspn(list, " ");
        if (size == length && strncmp(list, name, size) == 0) return 1;
        list += size;
        list += strspn(list, " ");
    }
    return 0;
}

size_t cs_setting_named(const char *name, size_t length)
{
    size_t index = 0;
    while (index < CS_SETTING_COUNT && !is_listed(cs_setting_table[index].name, name, length) &&
           !is_listed(cs_setting_table[index].aliases, name, length))
        index++;
    return index;
}

int cs_choice_find(const cs_choice *choices, const char *text)
{
    for (int i = 0; choices[i].name != NULL; i++)
        if (strcmp(choices[i].name, text) == 0) return i;
    return -1;
}

int cs_choice_count(const cs_choice *choices)
{
    int count = 0;
    while (choices[count].name != NULL)
        count++;
    return count;
}
