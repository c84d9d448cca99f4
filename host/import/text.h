/* Scene files as bytes and as lines. */
#ifndef CS_IMPORT_TEXT_H
#define CS_IMPORT_TEXT_H

#include <stddef.h>

#include "base/status.h"

/* The bytes of a file, with a 0 behind the last. Start from zeros. */
typedef struct cs_bytes {
    char *data; /* owned */
    size_t size;
} cs_bytes;

/* Reads a regular file; the message names it. */
clshear_status cs_bytes_read(const char *path, cs_bytes *bytes, cs_error *error);
void cs_bytes_free(cs_bytes *bytes);

/* Removes the byte order mark of a text. UTF-16 that begins with one becomes UTF-8. */
clshear_status cs_bytes_to_utf8(cs_bytes *bytes, const char *path, cs_error *error);

/* A walk over the lines of a text, which it cuts into strings. Lines end with LF, CR or both. A
 * backslash at the end of a line that is no comment joins it with the next. */
typedef struct cs_lines {
    char *at;
    char *end;
    size_t number; /* of the current line in the file, from 1; the first of those joined */
    size_t joined; /* further lines in it */
} cs_lines;

cs_lines cs_lines_of(cs_bytes *bytes);

/* The next line, or NULL. */
char *cs_lines_next(cs_lines *lines);

/* The next word of a line, cut off and 0-terminated; NULL where there is none. `at` moves on. */
char *cs_next_word(char **at);

/* What is left of a line, without blanks around it and without quotes that enclose all of it. */
char *cs_rest_of_line(char *at);

/* Cuts a text where a comment begins behind a blank; 0 where there is none. */
int cs_cut_comment(char *text);

/* Reads a whole number at `*at` and moves on; 0 where there is none or it does not fit. */
int cs_parse_whole(const char **at, long long *value);

#endif
