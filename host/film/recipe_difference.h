/* Recipes of renders: "name=value;...". */
#ifndef CS_FILM_RECIPE_DIFFERENCE_H
#define CS_FILM_RECIPE_DIFFERENCE_H

#include <stddef.h>

/* Whether two recipes differ; `name` becomes that of the first thing in which they do. */
int cs_recipe_difference(const char *theirs, const char *mine, char *name, size_t size);

#endif
