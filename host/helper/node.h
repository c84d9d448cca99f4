/* Nodes of an Assimp scene: where things are in the world. */
#ifndef CS_HELPER_NODE_H
#define CS_HELPER_NODE_H

#include <assimp/scene.h>

#include "base/status.h"

/* Transformation to the world of the node called `name`; the identity if there is none. */
struct aiMatrix4x4 cs_node_matrix(const struct aiScene *file, const char *name);

/* Transforms a place (`one` 1) or a direction (0). */
void cs_node_transform(const struct aiMatrix4x4 *m, const struct aiVector3D *v, double one,
                       double *result);

/* Calls `visit` for every mesh of every node, with the node's transformation to the world. Stops at
 * the first failure and returns it. */
clshear_status cs_node_visit_meshes(const struct aiScene *file,
                                    clshear_status (*visit)(void *user, const struct aiMesh *mesh,
                                                            const struct aiMatrix4x4 *matrix),
                                    void *user);

#endif
