#include "report/words.h"

#include <stdio.h>
#include <string.h>
#include <strings.h>

enum {
    LONGEST = 40
};

size_t next_word(const char **list)
{
    *list += strspn(*list, " ");
    return strcspn(*list, " ");
}

int has_word(const char *list, const char *word, size_t length)
{
    for (size_t size = next_word(&list); size > 0; size = next_word(&list)) {
        if (size == length && strncmp(list, word, size) == 0) return 1;
        list += size;
    }
    return 0;
}

void write_words(const char *list, char *text, size_t size)
{
    size_t used = 0;
    *text = '\0';
    for (size_t length = next_word(&list); length > 0 && used < size;) {
        const char *word = list;
        const size_t its = length;
        list += length;
        length = next_word(&list);
        const char *separator = used == 0 ? "" : length == 0 ? " or " : ", ";
        used += (size_t)snprintf(text + used, size - used, "%s%.*s", separator, (int)its, word);
    }
}

int has_ending(const char *endings, const char *path)
{
    const char *dot = strrchr(path, '.');
    if (dot == NULL || dot == path || dot[-1] == '/') return 0;
    for (size_t size = next_word(&endings); size > 0; size = next_word(&endings)) {
        if (strlen(dot) == size && strncasecmp(endings, dot, size) == 0) return 1;
        endings += size;
    }
    return 0;
}

static size_t least(size_t a, size_t b)
{
    return a < b ? a : b;
}

size_t word_distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    size_t row[LONGEST + 1];
    if (a_length > LONGEST || b_length > LONGEST) return LONGEST;
    for (size_t j = 0; j <= b_length; j++)
        row[j] = j;
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            const size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = least(replaced, least(row[j], row[j - 1]) + 1);
        }
    }
    return row[b_length];
}
