/* Films of the shards of a render, put together. */
#ifndef CS_FILM_MERGE_H
#define CS_FILM_MERGE_H

#include "film/film.h"

/* Implements clshear_film_merge. */
clshear_status cs_film_merge(const clshear_film *const *films, size_t count, clshear_film **merged,
                             cs_error *error);

#endif
