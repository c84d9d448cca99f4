/* Tables of flags: one for a command's line, its settings file and its help. */
#ifndef CS_CLI_FLAGS_H
#define CS_CLI_FLAGS_H

#include <stddef.h>
#include <stdint.h>

#include "clshear/clshear.h"

typedef struct cli_flag {
    const char *names;    /* separated by spaces, the main one first, without dashes */
    const char *argument; /* shown in the help; NULL: takes none */
    const char *help;
    /* Stores `value` in the command's job; returns NULL, or what the value should have been. */
    const char *(*store)(void *job, const char *value);
} cli_flag;

typedef struct cli_command {
    const char *name;    /* NULL: the program itself, which renders */
    const char *summary; /* head of the help, up to and with an example */
    const char *notes;   /* its tail */
    const cli_flag *flags;
    size_t flag_count;
    int most_operands; /* words that are no flags */
} cli_command;

/* The flag called `name` (without dashes), or NULL. */
const cli_flag *cli_find_flag(const cli_command *command, const char *name, size_t length);

/* The known name nearest to `name`, or NULL if none is near. Valid until the next call. */
const char *cli_nearest_flag(const cli_command *command, const char *name, size_t length);

void cli_print_help(const cli_command *command);

/* Readers of values, for store functions: 1, or 0 if the text is something else. */
int cli_read_numbers(const char *text, int count, double *values); /* separated by commas */
int cli_read_floats(const char *text, int count, float *values);
int cli_read_ints(const char *text, int count, double low, double high, int *values);
int cli_read_count(const char *text, double low, uint32_t *value);

/* Two sides of 2 to 8192, W,H or one number for both: NULL, or what they should have been. */
const char *cli_read_sides(const char *text, int *sides);

/* For store functions that keep a sampler's name: NULL, or what it should have been. */
const char *cli_check_sampler(const char *name);

/* The same for a kind of shear. */
const char *cli_read_shear(const char *text, clshear_shear *shear);

#endif
