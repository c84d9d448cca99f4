/* What a command writes, against what it reads. */
#ifndef CS_PROGRAM_COMMANDS_OUTPUTS_H
#define CS_PROGRAM_COMMANDS_OUTPUTS_H

#include "options/options.h"
#include "report/output.h"

/* Finds out before long work whether the outputs can be written, are different files, and replace
 * neither the scene nor a file that a setting names. Returns an exit status, with a line printed if
 * it is not EXIT_DONE. */
int check_outputs(const program_options *options, const output_files *files);

/* What the command line gives a flag, the last time; NULL where it does not. */
const char *value_on_line(const program_options *options, const char *name);

#endif
