/* Lists of words separated by spaces. */
#ifndef CS_PROGRAM_REPORT_WORDS_H
#define CS_PROGRAM_REPORT_WORDS_H

#include <stddef.h>

/* Moves to the next word of a list; returns its length, 0 at the end. */
size_t next_word(const char **list);

/* Whether the list has that word, of `length` characters. */
int has_word(const char *list, const char *word, size_t length);

/* Writes a list as "a, b or c", truncated to `size` bytes. */
void write_words(const char *list, char *text, size_t size);

/* Edits (insert, delete, replace) from one word to the other (Levenshtein 1966). */
size_t word_distance(const char *a, size_t a_length, const char *b, size_t b_length);

/* Whether a file's name ends in one of the endings, with dots, of a list, and is more than that. */
int has_ending(const char *endings, const char *path);

#endif
