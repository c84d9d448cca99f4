/* From words to a job. */
#ifndef CS_CLI_PARSE_H
#define CS_CLI_PARSE_H

#include "cli/job.h"

/* Reads the settings file, if there is one, and then the command line, which wins. Prints what is
 * wrong, in one line. Returns CLI_DONE, CLI_FAILED or CLI_USAGE. */
int cli_parse(int argc, char **argv, cli_job *job);

#endif
