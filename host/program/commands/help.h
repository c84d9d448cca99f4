/* Help on standard output. */
#ifndef CS_PROGRAM_COMMANDS_HELP_H
#define CS_PROGRAM_COMMANDS_HELP_H

#include "options/options.h"

/* The flags of a command and what it does, in 80 columns. Commands other than the first list their
 * own flags, and the settings only where they take some of them. */
void print_help(const program_command *command);

/* The flag's help with its fallback, "samples per pixel (256)". */
void write_flag_help(const named_flag *flag, char *text, size_t size);

/* Heading under which a setting is listed: its number says which, see setting_list.h. */
const char *setting_group(clshear_setting setting);

#endif
