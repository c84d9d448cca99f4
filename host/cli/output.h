/* Text and data files of commands: complete or not at all. */
#ifndef CS_CLI_OUTPUT_H
#define CS_CLI_OUTPUT_H

#include <stdio.h>

/* Finds out before long work whether a result can be kept: CLI_DONE, or CLI_FAILED with a line
 * printed. NULL and "-", standard output, can be written. `flag` is named in the message. */
int cli_check_place(const char *flag, const char *path);
/* The same for several. */
int cli_check_places(const char *flag, const char *const *paths, int count);

/* Writes a file with what `write` puts out; "-" is standard output. A file appears under its name
 * only when it is complete, so one that was there survives a failure; links are followed, devices
 * and pipes written as they are. Returns CLI_DONE or CLI_FAILED, with a line printed. */
int cli_write_file(const char *path, void (*write)(FILE *stream, const void *user),
                   const void *user);

#endif
