/* From words to a job. All print what is wrong, in one line. */
#ifndef CS_CLI_PARSE_H
#define CS_CLI_PARSE_H

#include "cli/flags.h"

/* Reads the words after the program's (or the command's) name: argv[1] ... The words that are no
 * flags go to `operands`, as many as the command takes. Returns CLI_DONE or CLI_USAGE. */
int cli_parse_words(const cli_command *command, void *job, int argc, char **argv,
                    const char **operands);

/* Reads a settings file: a flag a line. What the job keeps of it lives as long as the process.
 * Returns CLI_DONE, CLI_FAILED or CLI_USAGE. */
int cli_parse_settings(const cli_command *command, void *job, const char *path);

/* What settings files said so far, as words of a line; "" if there was none. */
const char *cli_settings_words(void);

#endif
