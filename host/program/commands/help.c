#include "commands/help.h"

#include <stdio.h>
#include <string.h>

#include "report/words.h"

enum {
    COLUMNS = 80,
    HELP_COLUMN = 27
};

const char *setting_group(clshear_setting setting)
{
    static const struct {
        int first;
        const char *name;
    } groups[] = {{1, "Samples"},  {20, "Image"},      {40, "Camera"}, {50, "Lens"},
                  {60, "Light"},   {70, "Scene file"}, {80, "Device"}, {90, "Stopping"},
                  {100, "Motion"}, {110, "Live view"}};
    const char *name = "Others";
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++)
        if ((int)setting >= groups[i].first) name = groups[i].name;
    return name;
}

void write_flag_help(const named_flag *flag, char *text, size_t size)
{
    const char *help = flag->row != NULL ? flag->row->help : flag->setting.help;
    const char *fallback = flag->row != NULL ? flag->row->fallback : flag->setting.fallback;
    const char *argument = flag->row != NULL ? flag->row->argument : flag->setting.argument;
    const int is_shown = *fallback != '\0' && *argument != '\0';
    snprintf(text, size, "%s%s%s%s", help, is_shown ? " (" : "", is_shown ? fallback : "",
             is_shown ? ")" : "");
}

/* Words from the column of helps on, in as many lines as they need. */
static void print_wrapped(const char *text)
{
    int column = HELP_COLUMN;
    for (size_t length = next_word(&text); length > 0; length = next_word(&text)) {
        if (column > HELP_COLUMN && column + (int)length >= COLUMNS) {
            printf("\n%*s", HELP_COLUMN, "");
            column = HELP_COLUMN;
        }
        column += printf("%s%.*s", column > HELP_COLUMN ? " " : "", (int)length, text);
        text += length;
    }
    printf("\n");
}

static void print_flag(const named_flag *flag)
{
    char left[64], help[256];
    const char *names = flag->row != NULL ? flag->row->names : flag->setting.name;
    const char *argument = flag->row != NULL ? flag->row->argument : flag->setting.argument;
    const int length =
        snprintf(left, sizeof left, "  --%.*s %s", (int)strcspn(names, " "), names, argument);
    write_flag_help(flag, help, sizeof help);
    printf("%-*s", HELP_COLUMN, left);
    if (length >= HELP_COLUMN) printf("\n%*s", HELP_COLUMN, "");
    print_wrapped(help);
}

void print_help(const program_command *command)
{
    const int all_settings = *command->name == '\0' || command->settings != NULL;
    const char *group = NULL;
    named_flag flag;
    printf("usage: %s\n", command->usage);
    for (size_t i = 0; command_flag(command, i, &flag); i++) {
        if (flag.row == NULL && !all_settings) break;
        if (flag.row == NULL && *command->name == '\0' &&
            setting_group(flag.setting.setting) != group) {
            group = setting_group(flag.setting.setting);
            printf("\n%s\n", group);
        }
        print_flag(&flag);
    }
    if (!all_settings)
        printf("\nThe settings of clshear --help say sampler, camera, lens, light and so on.\n");
    printf("\n%s", command->notes);
}
