/* Progress on standard error, and Ctrl-C. */
#ifndef CS_CLI_PROGRESS_H
#define CS_CLI_PROGRESS_H

#include "clshear/clshear.h"

typedef struct cli_progress {
    int quiet;
    int on_terminal;
    int last_percent;
} cli_progress;

/* From here on, Ctrl-C asks the render to stop; a second one ends the process. */
void cli_catch_interrupt(void);
int cli_interrupted(void);

cli_progress cli_progress_start(int quiet);

/* A callback for clshear_options.progress; `user` is a cli_progress. */
int cli_progress_report(void *user, const clshear_progress *progress);

/* Ends the line on a terminal. */
void cli_progress_end(const cli_progress *progress);

#endif
