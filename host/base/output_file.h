/* Files that appear under their name only when they are complete. */
#ifndef CS_BASE_OUTPUT_FILE_H
#define CS_BASE_OUTPUT_FILE_H

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A file being written. Links are followed; devices and pipes are written as they are, since no new
 * file must replace them. Start from zeros. */
typedef struct cs_output_file {
    char *target; /* what the file will be called */
    char *part;   /* what is written to: a file beside the target, or the target */
    FILE *stream;
} cs_output_file;

/* Whether a path is a device, a pipe or the like. */
int cs_is_special_file(const char *path);

/* Finds out where to write, without opening it. Returns 0, or errno. */
int cs_output_begin(const char *path, cs_output_file *file);

/* cs_output_begin, then opens `stream`. Returns 0, or errno after cleaning up. */
int cs_output_open(const char *path, cs_output_file *file);

/* Closes the stream, if there is one. Where `good` and all is written the file gets its name, else
 * it is removed. Returns 0, or errno of what failed here. */
int cs_output_end(cs_output_file *file, int good);

#ifdef __cplusplus
}
#endif

#endif
