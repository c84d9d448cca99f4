/* The mean brightness of parts of an image that surfaces emit by. */
#ifndef CS_SCENE_EMISSION_MAP_H
#define CS_SCENE_EMISSION_MAP_H

#include "scene/scene.h"

/* Sums over blocks of texels, from the upper left corner of the image on (Crow 1984). */
typedef struct cs_emission_map {
    const cs_texture *texture;
    size_t across; /* blocks */
    size_t down;
    double *sums; /* luminance of all blocks above and to the left: (across + 1) * (down + 1) */
} cs_emission_map;

/* Freed by cs_emission_map_free. */
clshear_status cs_emission_map_make(const cs_scene *scene, const cs_texture *texture,
                                    cs_emission_map *map, cs_error *error);
void cs_emission_map_free(cs_emission_map *map);

/* Mean luminance of the smallest blocks of texels that hold every texel which a bilinear lookup
 * between the texture coordinates `low` and `high` can meet, or of the whole image where they leave
 * it. 0 only where all these texels are black. */
double cs_emission_map_mean(const cs_emission_map *map, const float *low, const float *high);

#endif
