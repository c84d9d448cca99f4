/* Progress on standard error, and Ctrl-C. */
#ifndef CS_PROGRAM_REPORT_PROGRESS_H
#define CS_PROGRAM_REPORT_PROGRESS_H

#include <clshear/clshear.h>

typedef struct progress_line {
    int quiet;
    int on_terminal;
    int last_percent;
} progress_line;

/* From here on, Ctrl-C asks the render to stop; a second one ends the process. */
void catch_interrupt(void);
int is_interrupted(void);

progress_line progress_start(int quiet);

/* A callback for clshear_settings_set_progress; `user` is a progress_line. */
int progress_report(void *user, const clshear_progress *progress);

/* Ends the line on a terminal. */
void progress_end(const progress_line *progress);

#endif
