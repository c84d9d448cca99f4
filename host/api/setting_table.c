/* Public functions that read the table of settings. */
#include "api/arguments.h"
#include "settings/table.h"

int clshear_setting_describe(size_t index, clshear_setting_info *info)
{
    if (index >= CS_SETTING_COUNT || info == NULL) return 0;
    const cs_setting *entry = &cs_setting_table[index];
    const clshear_setting_info described = {.setting = entry->setting,
                                            .kind = entry->kind,
                                            .name = entry->name,
                                            .aliases = entry->aliases,
                                            .argument = entry->argument,
                                            .help = entry->help,
                                            .fallback = entry->fallback,
                                            .values = entry->values,
                                            .most = entry->most};
    cs_struct_out(info, &described, sizeof described);
    return 1;
}

clshear_status clshear_setting_find(const char *name, clshear_setting *setting)
{
    CS_NEEDS(name);
    CS_NEEDS(setting);
    const size_t index = cs_setting_named(name, strlen(name));
    if (index == CS_SETTING_COUNT)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "unknown setting %s", name);
    *setting = cs_setting_table[index].setting;
    return CLSHEAR_OK;
}

clshear_status clshear_setting_bounds(clshear_setting setting, double *low, double *high)
{
    CS_NEEDS(low);
    CS_NEEDS(high);
    const size_t index = cs_setting_index(setting);
    if (index == CS_SETTING_COUNT)
        return cs_fail(cs_thread_error(), CLSHEAR_BAD_ARGUMENT, "setting %d is not known",
                       (int)setting);
    const cs_setting *entry = &cs_setting_table[index];
    *low = entry->low;
    *high = entry->kind == CLSHEAR_CHOICE ? cs_choice_count(entry->choices) - 1.0 : entry->high;
    return CLSHEAR_OK;
}

int clshear_setting_choice(clshear_setting setting, size_t index, const char **name,
                           const char **meaning)
{
    const size_t place = cs_setting_index(setting);
    if (place == CS_SETTING_COUNT || cs_setting_table[place].choices == NULL) return 0;
    const cs_choice *choices = cs_setting_table[place].choices;
    if (index >= (size_t)cs_choice_count(choices)) return 0;
    if (name != NULL) *name = choices[index].name;
    if (meaning != NULL) *meaning = choices[index].meaning;
    return 1;
}
