/* What the command that renders is asked for. */
#ifndef CS_PROGRAM_COMMANDS_RENDER_JOB_H
#define CS_PROGRAM_COMMANDS_RENDER_JOB_H

#include "commands/film_files.h"

typedef struct render_job {
    program_options options;
    film_files files;
    text_list reference;
    number_list frames; /* first and last */
    int stats;
    int version;
    int list_devices;
    int list_samplers;
    int has_lens; /* whether the flags gave one */
} render_job;

/* Finds out before long work whether the files can be written and are different ones, and tells the
 * flags that do nothing. Returns an exit status, with a line printed if it is not EXIT_DONE. */
int render_check(const render_job *job);

/* The part of it that is about files. */
int render_check_files(const render_job *job);

#endif
