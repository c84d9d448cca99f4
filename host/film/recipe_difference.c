#include "film/recipe_difference.h"

#include <stdio.h>
#include <string.h>

int cs_recipe_difference(const char *theirs, const char *mine, char *name, size_t size)
{
    size_t start = 0, i = 0;
    for (; mine[i] == theirs[i] && mine[i] != '\0'; i++)
        if (mine[i] == ';') start = i + 1;
    snprintf(name, size, "%.*s", (int)strcspn(mine + start, "="), mine + start);
    return mine[i] != theirs[i];
}
