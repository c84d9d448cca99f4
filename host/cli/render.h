/* Rendering from the command line. */
#ifndef CS_CLI_RENDER_H
#define CS_CLI_RENDER_H

#include "cli/flags.h"
#include "cli/job.h"

extern const cli_command cli_render_command;

cli_job cli_job_defaults(void);

/* Renders what the words ask for; returns the exit code. */
int cli_render(int argc, char **argv);

#endif
