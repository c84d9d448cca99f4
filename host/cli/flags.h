/* The table of flags: one for the command line, settings files and the help. */
#ifndef CS_CLI_FLAGS_H
#define CS_CLI_FLAGS_H

#include <stddef.h>
#include <stdio.h>

#include "cli/job.h"

typedef struct cli_flag {
    const char *names;    /* separated by spaces, the main one first, without dashes */
    const char *argument; /* shown in the help; NULL: takes none */
    const char *help;
    /* Stores `value`; returns NULL, or what the value should have been. */
    const char *(*store)(cli_job *job, const char *value);
} cli_flag;

extern const cli_flag cli_flags[];
extern const size_t cli_flag_count;

/* The flag called `name` (without dashes), or NULL. */
const cli_flag *cli_find_flag(const char *name, size_t length);

/* The known name nearest to `name`, or NULL if none is near. Valid until the next call. */
const char *cli_nearest_flag(const char *name, size_t length);

cli_job cli_job_defaults(void);
void cli_print_help(FILE *stream);

#endif
