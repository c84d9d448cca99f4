/* Text and data files of commands: complete or not at all. */
#ifndef CS_PROGRAM_REPORT_OUTPUT_H
#define CS_PROGRAM_REPORT_OUTPUT_H

#include <stddef.h>
#include <stdio.h>

/* Finds out before long work whether results can be kept. "-", standard output, can. `flag` is
 * named in the message. Returns EXIT_DONE or EXIT_FAILED. */
int check_places(const char *flag, const char *const *paths, size_t count);

/* Whether the file `path` of --`flag` is none of some others, which `owner` names in the message:
 * each would be written over the other. Devices and pipes may be shared. Returns EXIT_DONE or
 * EXIT_USAGE. */
int check_apart(const char *flag, const char *path, const char *owner, const char *const *others,
                size_t count);

/* Writes a file with what `write` puts out; "-" is standard output. Returns EXIT_DONE, or
 * EXIT_FAILED with a line printed. */
int write_file(const char *path, void (*write)(FILE *stream, const void *user), const void *user);

#endif
