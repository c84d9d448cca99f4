#include "helper/node.h"

#include <assimp/cimport.h>
#include <limits.h>
#include <string.h>

/* outer * inner: inner is applied first. */
static struct aiMatrix4x4 product(struct aiMatrix4x4 outer, const struct aiMatrix4x4 *inner)
{
    aiMultiplyMatrix4(&outer, inner);
    return outer;
}

/* Names need not be unique: nodes with more than `meshes` meshes are passed over. */
static int find(const struct aiNode *node, const char *name, unsigned meshes,
                struct aiMatrix4x4 *matrix)
{
    if (strcmp(node->mName.data, name) == 0 && node->mNumMeshes <= meshes) {
        *matrix = node->mTransformation;
        return 1;
    }
    for (unsigned i = 0; i < node->mNumChildren; i++)
        if (find(node->mChildren[i], name, meshes, matrix)) {
            *matrix = product(node->mTransformation, matrix);
            return 1;
        }
    return 0;
}

struct aiMatrix4x4 cs_node_matrix(const struct aiScene *file, const char *name)
{
    struct aiMatrix4x4 matrix;
    aiIdentityMatrix4(&matrix);
    if (file->mRootNode != NULL && !find(file->mRootNode, name, 0, &matrix))
        find(file->mRootNode, name, UINT_MAX, &matrix);
    return matrix;
}

void cs_node_transform(const struct aiMatrix4x4 *m, const struct aiVector3D *v, double one,
                       double *result)
{
    const double x = (double)v->x, y = (double)v->y, z = (double)v->z;
    result[0] = (double)m->a1 * x + (double)m->a2 * y + (double)m->a3 * z + one * (double)m->a4;
    result[1] = (double)m->b1 * x + (double)m->b2 * y + (double)m->b3 * z + one * (double)m->b4;
    result[2] = (double)m->c1 * x + (double)m->c2 * y + (double)m->c3 * z + one * (double)m->c4;
}

typedef struct walk {
    const struct aiScene *file;
    clshear_status (*visit)(void *user, const struct aiMesh *mesh,
                            const struct aiMatrix4x4 *matrix);
    void *user;
} walk;

static clshear_status visit_node(const walk *work, const struct aiNode *node,
                                 struct aiMatrix4x4 outer)
{
    clshear_status status = CLSHEAR_OK;
    const struct aiMatrix4x4 matrix = product(outer, &node->mTransformation);
    for (unsigned i = 0; i < node->mNumMeshes && status == CLSHEAR_OK; i++)
        status = work->visit(work->user, work->file->mMeshes[node->mMeshes[i]], &matrix);
    for (unsigned i = 0; i < node->mNumChildren && status == CLSHEAR_OK; i++)
        status = visit_node(work, node->mChildren[i], matrix);
    return status;
}

clshear_status cs_node_visit_meshes(const struct aiScene *file,
                                    clshear_status (*visit)(void *user, const struct aiMesh *mesh,
                                                            const struct aiMatrix4x4 *matrix),
                                    void *user)
{
    const walk work = {file, visit, user};
    struct aiMatrix4x4 identity;
    aiIdentityMatrix4(&identity);
    if (file->mRootNode == NULL) return CLSHEAR_OK;
    return visit_node(&work, file->mRootNode, identity);
}
