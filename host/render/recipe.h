/* What fixes a picture, as text: renders go on only from one of the same recipe. */
#ifndef CS_RENDER_RECIPE_H
#define CS_RENDER_RECIPE_H

#include "film/recipe_difference.h"
#include "render/record.h"
#include "render/render_job.h"

/* What fixes the samples and the picture, but for their number: "name=value;...". `size` is
 * CS_RECIPE_SIZE. */
void cs_recipe_of(const cs_job *job, char *text, size_t size);

/* The same with all that fixes the bits of a render in progress, the version first. */
void cs_recipe_of_state(const cs_job *job, char *text, size_t size);

#endif
