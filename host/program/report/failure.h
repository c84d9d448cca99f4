/* How the program ends, and what it says of failures. */
#ifndef CS_PROGRAM_REPORT_FAILURE_H
#define CS_PROGRAM_REPORT_FAILURE_H

#include <clshear/common.h>

enum {
    EXIT_DONE = 0,
    EXIT_FAILED = 1,
    EXIT_USAGE = 2,
    EXIT_SIGNAL = 128 /* plus the signal that interrupted the program: 130 for Ctrl-C */
};

/* Prints one line, "clshear: ...", on standard error. Names, and lines of settings files, may hold
 * line ends and codes that terminals obey; a '?' is printed for each, as in the library's own
 * messages. */
void remark(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* The same; returns `code`. */
int complain(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Prints the library's message unless the status is CLSHEAR_OK. Returns EXIT_DONE, EXIT_USAGE for a
 * value that the library refuses, or EXIT_FAILED. */
int exit_status_of(clshear_status status);

#endif
