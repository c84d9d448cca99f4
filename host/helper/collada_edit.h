/* What Assimp cannot read in Collada files, written so that it can. */
#ifndef CS_HELPER_COLLADA_EDIT_H
#define CS_HELPER_COLLADA_EDIT_H

#include "import/text.h"

/* How many things the edit has taken out of the file. */
typedef struct cs_collada_losses {
    size_t holes;  /* in polygons; the polygons are whole now */
    size_t morphs; /* instances of meshes with morph targets; only their first shape is left */
    size_t skews;  /* of nodes, without an angle below 90 degrees and two axes */
} cs_collada_losses;

/* Rewrites a Collada file's text in place. Colours of three numbers get a fourth. The positions of
 * vertices come before their other inputs. Skews become matrices. Polygons lose their holes. Meshes
 * with morph targets become plain meshes of their first shape. Skins become plain meshes in the
 * pose in which they were bound to their bones, as Blender shows them. Meshes without a material
 * get Assimp's default one, not the file's first. A file that is no text stays as it is. Fails only
 * without memory. */
clshear_status cs_collada_edit(cs_bytes *bytes, cs_collada_losses *lost, cs_error *error);

#endif
