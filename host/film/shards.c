#include "film/shards.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A number from 1 on at `*text`, which moves behind it; 0: there is none. */
static int number_at(const char **text)
{
    char *end;
    if (**text < '0' || **text > '9') return 0;
    const long number = strtol(*text, &end, 10);
    *text = end;
    return number >= 1 && number <= CS_MOST_SHARDS ? (int)number : 0;
}

/* Notes "a" or "a-b" at `*text`. Returns 0 if there is none, or it is not new. */
static int note_range(const char **text, cs_shards *shards)
{
    const int first = number_at(text);
    int last = first;
    if (**text == '-') {
        ++*text;
        last = number_at(text);
    }
    if (first == 0 || last < first || last > shards->count) return 0;
    for (int k = first; k <= last; k++) {
        if (shards->has[k - 1]) return 0;
        shards->has[k - 1] = 1;
        shards->held++;
        if (shards->first == 0 || k < shards->first) shards->first = k;
    }
    return 1;
}

clshear_status cs_shards_read(const char *text, cs_shards *shards, cs_error *error)
{
    const char *slash = strchr(text, '/'), *at = text;
    *shards = (cs_shards){0};
    if (slash != NULL) {
        const char *count = slash + 1;
        shards->count = number_at(&count);
        if (*count != '\0') shards->count = 0;
    }
    if (shards->count > 0) shards->has = calloc((size_t)shards->count, 1);
    if (shards->count > 0 && shards->has == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for %d shards", shards->count);
    int good = shards->count > 0;
    while (good) {
        good = note_range(&at, shards);
        if (!good || at == slash) break;
        good = *at++ == ',';
    }
    if (good) return CLSHEAR_OK;
    cs_shards_free(shards);
    return cs_fail(error, CLSHEAR_BAD_ARGUMENT,
                   "shard %.40s: must be K/N, with K from 1 to N, up to %d", text, CS_MOST_SHARDS);
}

void cs_shards_free(cs_shards *shards)
{
    free(shards->has);
    *shards = (cs_shards){0};
}

int cs_shards_add(cs_shards *shards, const cs_shards *more)
{
    for (int k = 1; k <= shards->count; k++)
        if (shards->has[k - 1] && more->has[k - 1]) return k;
    for (int k = 1; k <= shards->count; k++)
        shards->has[k - 1] |= more->has[k - 1];
    shards->held += more->held;
    if (more->first < shards->first) shards->first = more->first;
    return 0;
}

void cs_shards_print(const cs_shards *shards, int held, char *text, size_t size)
{
    const size_t reserve = 24;
    size_t used = 0;
    *text = '\0';
    for (int k = 1; k <= shards->count; k++) {
        if (shards->has[k - 1] != held) continue;
        int last = k;
        while (last < shards->count && shards->has[last] == held)
            last++;
        if (used + reserve > size) {
            snprintf(text + used, size - used, ",...");
            return;
        }
        used += (size_t)snprintf(text + used, size - used, last > k ? "%s%d-%d" : "%s%d",
                                 used > 0 ? "," : "", k, last);
        k = last;
    }
    if (held) snprintf(text + used, size - used, "/%d", shards->count);
}
