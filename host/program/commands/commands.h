/* The commands of the program. */
#ifndef CS_PROGRAM_COMMANDS_COMMANDS_H
#define CS_PROGRAM_COMMANDS_COMMANDS_H

#include "options/options.h"

extern const program_command render_command;
extern const program_command points_command;
extern const program_command spectrum_command;
extern const program_command slice_command;
extern const program_command predict_command;
extern const program_command converge_command;
extern const program_command merge_command;

/* All of them, the one without a name first; NULL ends the list. */
extern const program_command *const all_commands[];

/* Runs a command with its words, argv[1] ... Returns the exit status. */
int command_run(const program_command *command, int argc, char **argv);

#endif
