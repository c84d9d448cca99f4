/* Which flag was meant. */
#include <string.h>

#include "cli/flags.h"

enum {
    LONGEST = 40
};

static int least(int a, int b)
{
    return a < b ? a : b;
}

/* Edits (insert, delete, replace) from one word to the other (Levenshtein 1966). */
static int distance(const char *a, size_t a_length, const char *b, size_t b_length)
{
    int row[LONGEST + 1];
    if (a_length > LONGEST || b_length > LONGEST) return LONGEST;
    for (size_t j = 0; j <= b_length; j++)
        row[j] = (int)j;
    for (size_t i = 1; i <= a_length; i++) {
        int diagonal = row[0];
        row[0] = (int)i;
        for (size_t j = 1; j <= b_length; j++) {
            int replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = least(replaced, least(row[j], row[j - 1]) + 1);
        }
    }
    return row[b_length];
}

const char *cli_nearest_flag(const cli_command *command, const char *name, size_t length)
{
    static char nearest[LONGEST + 1];
    int best = least((int)length / 2 + 2, 4);
    const char *found = NULL;
    for (size_t i = 0; i < command->flag_count; i++) {
        const char *known = command->flags[i].names;
        while (*known != '\0') {
            size_t size = strcspn(known, " ");
            int edits = distance(name, length, known, size);
            if (size > 1 && edits < best) {
                best = edits;
                memcpy(nearest, known, size);
                nearest[size] = '\0';
                found = nearest;
            }
            known += size;
            known += strspn(known, " ");
        }
    }
    return found;
}
