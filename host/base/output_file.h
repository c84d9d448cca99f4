/* Output files under a temporary name until they are complete. */
#ifndef CS_BASE_OUTPUT_FILE_H
#define CS_BASE_OUTPUT_FILE_H

#include <stdio.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A file being written. Symbolic links are followed. Devices and pipes are written in place,
 * because a rename would replace them. Initialise to zero. */
typedef struct cs_output_file {
    char *target; /* final path; owned */
    char *part;   /* temporary path beside the target, or the target itself; owned */
    FILE *stream;
    int is_durable; /* set after opening: a power cut leaves the new file or the one before */
} cs_output_file;

/* Returns 1 if the path is a device, a pipe or a folder, else 0. */
int cs_is_special_file(const char *path);

/* Why what is at the path cannot be read as a file, for a message that begins with the path; NULL
 * for a regular file, and where nothing is there. */
const char *cs_not_a_file(const char *path);

/* Sets the paths without opening a file. Returns 0, or errno. */
int cs_output_begin(const char *path, cs_output_file *file);

/* Sets the paths and opens `stream`. Returns 0, or errno without anything to release. */
int cs_output_open(const char *path, cs_output_file *file);

/* Closes the stream if it is open. Renames the file to its target if `good` and no write failed,
 * else deletes it. Returns 0, or errno of the first failure in this call: the file has its name all
 * the same if only the name of a durable file is not on the disk. */
int cs_output_end(cs_output_file *file, int good);

#ifdef __cplusplus
}
#endif

#endif
