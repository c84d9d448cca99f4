/* Values of flags. */
#ifndef CS_PROGRAM_OPTIONS_VALUE_H
#define CS_PROGRAM_OPTIONS_VALUE_H

#include "options/options.h"

/* Stores a value where the row wants it. Returns whether it is what it must be. */
int flag_store(program_options *options, const program_flag *row, const char *text);

/* What a value must be, in words. */
const char *flag_expectation(program_options *options, const program_flag *row);

/* Formatted text that lives as long as the options. */
const char *options_text(program_options *options, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

#endif
