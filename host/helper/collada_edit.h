/* What Assimp cannot read in Collada files, written so that it can. */
#ifndef CS_HELPER_COLLADA_EDIT_H
#define CS_HELPER_COLLADA_EDIT_H

#include "import/text.h"

/* What is not in the new text. */
typedef struct cs_collada_losses {
    size_t holes;  /* of polygons, which are closed */
    size_t morphs; /* meshes with morph targets, which have their first shape */
    size_t skews;  /* of nodes, without an angle and two axes */
} cs_collada_losses;

/* Colours of three numbers get a fourth, skews become matrices, polygons lose their holes, and
 * skins and meshes with morph targets become plain meshes, skins in the pose in which they are
 * bound, as Blender shows them. A file that is no text is left as it is. */
clshear_status cs_collada_edit(cs_bytes *bytes, cs_collada_losses *lost, cs_error *error);

#endif
