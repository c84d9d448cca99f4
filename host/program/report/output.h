/* Text and data files of commands: complete or not at all. */
#ifndef CS_PROGRAM_REPORT_OUTPUT_H
#define CS_PROGRAM_REPORT_OUTPUT_H

#include <stddef.h>
#include <stdio.h>

enum {
    MOST_OUTPUTS = 40
};

/* The files that a command will write, each with the flag that names it. Start from zeros. */
typedef struct output_files {
    size_t count;
    const char *flags[MOST_OUTPUTS]; /* without dashes */
    const char *paths[MOST_OUTPUTS]; /* "-" is standard output */
} output_files;

/* Adds files, as far as there is room. */
void outputs_add(output_files *files, const char *flag, const char *const *paths, size_t count);

/* Finds out before long work whether the files can be written, and are different ones: each would
 * be written over the other. Standard output, devices and pipes may be shared. Returns an exit
 * status, with a line printed if it is not EXIT_DONE. */
int outputs_check(const output_files *files);

/* The same for files that are read, which none of the outputs may replace. `owner` names them in
 * the message: a flag with its dashes, or "the scene". */
int outputs_spare(const output_files *files, const char *owner, const char *const *paths,
                  size_t count);

/* Writes a file with what `write` puts out; "-" is standard output. Returns EXIT_DONE, or
 * EXIT_FAILED with a line printed. */
int write_file(const char *path, void (*write)(FILE *stream, const void *user), const void *user);

#endif
