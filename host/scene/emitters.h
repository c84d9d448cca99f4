/* Emissive triangles, and the two ways to choose one of them. */
#ifndef CS_SCENE_EMITTERS_H
#define CS_SCENE_EMITTERS_H

#include "scene/scene.h"

typedef struct cs_emitters {
    cs_array table; /* cs_emitter, in the order of the triangles */
    cs_array nodes; /* cs_emitter_node; empty if the table is */
    double power;   /* areas times luminances of those whose radiance does not vary */
    double light;   /* mean luminance that the scene's surfaces emit */
    uint32_t even;  /* emitters whose radiance does not vary over the triangle */
} cs_emitters;

/* Fills in zeros. Freed by cs_emitters_free. */
clshear_status cs_emitters_make(const cs_scene *scene, cs_emitters *emitters, cs_error *error);
void cs_emitters_free(cs_emitters *emitters);

/* Builds the tree over the table, of at least one emitter, and writes the leaves' indices into it.
 * scene: how the emitters move; NULL: not at all. */
clshear_status cs_emitter_tree_build(const cs_scene *scene, cs_array *table, cs_array *nodes,
                                     cs_error *error);

/* Writes the emitters' numbers into triangles, which are in any order. */
void cs_emitters_number(const cs_emitters *emitters, cs_triangle *triangles, size_t count);

#endif
