/* Progress on standard error, and signals that ask the program to stop. */
#ifndef CS_PROGRAM_REPORT_PROGRESS_H
#define CS_PROGRAM_REPORT_PROGRESS_H

#include <clshear/clshear.h>

typedef struct progress_line {
    int quiet;
    int on_terminal;
    int last_percent;
    int catches; /* whether signals are caught */
} progress_line;

/* Notes that hangups are to be ignored, as nohup asks, and catches SIGUSR1. Call it first:
 * compilers of OpenCL drivers install handlers of their own. */
void progress_note_signals(void);

/* Lets the process go on where the reader of what it prints leaves (`2>&1 | head`): by default, the
 * next line ends it, and a render without its picture. */
void progress_outlive_reader(void);

/* Whether SIGUSR1 came since the last call: it asks for the picture so far. */
int preview_wanted(void);

/* The signal that asked the render to stop; 0: none. */
int interrupting_signal(void);

progress_line progress_start(int quiet);

/* A callback for clshear_settings_set_progress; `user` is a progress_line. From the first samples
 * that count on, Ctrl-C, SIGTERM and SIGHUP ask the render to stop, the second time each ends the
 * process. Before, there is nothing to keep, and they end it at once. */
int progress_report(void *user, const clshear_progress *progress);

/* Ends the line on a terminal. */
void progress_end(const progress_line *progress);

#endif
