#include "scene/import.h"

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "scene/camera.h"
#include "scene/missing.h"
#include "scene/node.h"
#include "scene/texture.h"

static const float mid_grey = 0.5f;

/* Assimp gives this diffuse colour to OBJ materials it knows nothing of. */
static const float assimp_unknown = 0.6f;

/* Whether the material is Assimp's stand-in for one that the file does not define. */
static int is_stand_in(const struct aiMaterial *material, const float *colour, int missing)
{
    struct aiString name = {0};
    aiGetMaterialString(material, "?mat.name", 0, 0, &name);
    if (!missing && strcmp(name.data, "DefaultMaterial") != 0) return 0;
    return colour[0] == assimp_unknown && colour[1] == assimp_unknown &&
           colour[2] == assimp_unknown;
}

/* Replaces what no colour can be by 0, with a warning; `what` it belongs to. */
static void make_colour(float *colour, const char *path, const char *what, const char *name,
                        const cs_log *log)
{
    if (cs_is_colour(colour)) return;
    cs_warn(log, "%s: %s \"%s\" has the colour %g %g %g, which must be 0 to 1e15; taken as 0", path,
            what, name, (double)colour[0], (double)colour[1], (double)colour[2]);
    colour[0] = colour[1] = colour[2] = 0.0f;
}

static void read_colour(const struct aiMaterial *material, const char *key, const char *path,
                        const cs_log *log, float *colour)
{
    struct aiColor4D value;
    struct aiString name = {0};
    if (aiGetMaterialColor(material, key, 0, 0, &value) != aiReturn_SUCCESS) return;
    memcpy(colour, &value.r, 3 * sizeof *colour);
    aiGetMaterialString(material, "?mat.name", 0, 0, &name);
    make_colour(colour, path, "material", name.data, log);
}

static clshear_status add_material(cs_scene *scene, const struct aiScene *file,
                                   const struct aiMaterial *source, const char *path,
                                   int materials_missing, const cs_log *log, cs_error *error)
{
    cs_material look = {.texture = CS_NO_TEXTURE};
    for (int c = 0; c < 3; c++)
        look.diffuse[c] = mid_grey;
    read_colour(source, "$clr.diffuse", path, log, look.diffuse);
    read_colour(source, "$clr.base", path, log, look.diffuse);
    read_colour(source, "$clr.emissive", path, log, look.emission);
    const int stand_in = is_stand_in(source, look.diffuse, materials_missing);
    for (int c = 0; c < 3 && stand_in; c++)
        look.diffuse[c] = mid_grey;
    struct aiString image;
    enum aiReturn found = aiGetMaterialTexture(source, aiTextureType_DIFFUSE, 0, &image, NULL, NULL,
                                               NULL, NULL, NULL, NULL);
    if (found != aiReturn_SUCCESS)
        found = aiGetMaterialTexture(source, aiTextureType_BASE_COLOR, 0, &image, NULL, NULL, NULL,
                                     NULL, NULL, NULL);
    if (found == aiReturn_SUCCESS) {
        clshear_status status =
            cs_texture_add(scene, file, path, image.data, &look.texture, log, error);
        if (status != CLSHEAR_OK) return status;
        for (int c = 0; c < 3 && look.texture == CS_NO_TEXTURE; c++)
            look.diffuse[c] = mid_grey;
        int black = look.diffuse[0] + look.diffuse[1] + look.diffuse[2] == 0.0f;
        for (int c = 0; c < 3 && black; c++) /* exporters leave Kd 0 beside a map */
            look.diffuse[c] = 1.0f;
    }
    if (aiGetMaterialTextureCount(source, aiTextureType_EMISSIVE) > 0)
        cs_warn(log, "%s: textured emission is not supported; taken as even", path);
    cs_material *added = cs_array_extend(&scene->materials, 1);
    if (added == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    *added = look;
    return CLSHEAR_OK;
}

/* What add_instance needs besides the mesh. */
typedef struct importing {
    cs_scene *scene;
    const char *path;
    cs_error *error;
} importing;

/* The triangles among the faces, as indices; points and lines have no area. */
static size_t collect_triangles(const struct aiMesh *source, uint32_t *indices)
{
    size_t count = 0;
    for (unsigned i = 0; i < source->mNumFaces; i++) {
        const struct aiFace *face = &source->mFaces[i];
        if (face->mNumIndices != 3) continue;
        memcpy(indices + 3 * count, face->mIndices, 3 * sizeof(uint32_t));
        count++;
    }
    return count;
}

/* Copies of positions and normals in world space. */
static void transform(const struct aiMesh *source, const struct aiMatrix4x4 *matrix,
                      struct aiVector3D *positions, struct aiVector3D *normals)
{
    struct aiMatrix3x3 turn;
    aiMatrix3FromMatrix4(&turn, matrix);
    aiMatrix3Inverse(&turn); /* normals transform by the inverse transpose */
    aiTransposeMatrix3(&turn);
    for (unsigned i = 0; i < source->mNumVertices; i++) {
        positions[i] = source->mVertices[i];
        aiTransformVecByMatrix4(&positions[i], matrix);
        if (source->mNormals == NULL) continue;
        normals[i] = source->mNormals[i];
        aiTransformVecByMatrix3(&normals[i], &turn);
    }
}

static clshear_status add_instance(void *user, const struct aiMesh *source,
                                   const struct aiMatrix4x4 *matrix)
{
    const importing *work = user;
    cs_error *error = work->error;
    clshear_status status = CLSHEAR_OK;
    const size_t vertices = (size_t)source->mNumVertices + 1;
    uint32_t *indices = malloc(sizeof(uint32_t) * 3 * ((size_t)source->mNumFaces + 1));
    struct aiVector3D *positions = malloc(vertices * sizeof *positions);
    struct aiVector3D *normals = malloc(vertices * sizeof *normals);
    CS_REQUIRE(indices != NULL && positions != NULL && normals != NULL, CLSHEAR_OUT_OF_MEMORY,
               "%s: out of memory", work->path);
    transform(source, matrix, positions, normals);
    clshear_mesh mesh = {
        .positions = &positions[0].x,
        .normals = source->mNormals != NULL ? &normals[0].x : NULL,
        .indices = indices,
        .vertex_count = source->mNumVertices,
        .triangle_count = collect_triangles(source, indices),
    };
    const struct aiVector3D *texture = source->mTextureCoords[0];
    CS_TRY(cs_scene_add_mesh(work->scene, &mesh, texture != NULL ? &texture[0].x : NULL,
                             source->mMaterialIndex, work->path, error));
done:
    free(indices);
    free(positions);
    free(normals);
    return status;
}

static clshear_status add_light(cs_scene *scene, const struct aiScene *file,
                                const struct aiLight *source, const char *path, const cs_log *log,
                                cs_error *error)
{
    clshear_light light = {.kind = CLSHEAR_LIGHT_POINT};
    struct aiMatrix4x4 matrix = cs_node_matrix(file, source->mName.data);
    struct aiVector3D from = source->mPosition;
    float sign = 1.0f, fade = source->mAttenuationQuadratic;
    if (source->mType == aiLightSource_DIRECTIONAL) {
        light.kind = CLSHEAR_LIGHT_DIRECTIONAL;
        from = source->mDirection;
        matrix.a4 = matrix.b4 = matrix.c4 = 0.0f; /* directions do not move */
        sign = -1.0f;
    } else if (source->mType == aiLightSource_SPOT) {
        cs_warn(log, "%s: spot light \"%s\" is taken as a point light", path, source->mName.data);
    } else if (source->mType != aiLightSource_POINT) {
        cs_warn(log, "%s: light \"%s\" is of a kind that is not supported; left out", path,
                source->mName.data);
        return CLSHEAR_OK;
    }
    aiTransformVecByMatrix4(&from, &matrix);
    const float position[3] = {from.x, from.y, from.z};
    const float colour[3] = {source->mColorDiffuse.r, source->mColorDiffuse.g,
                             source->mColorDiffuse.b};
    if (light.kind == CLSHEAR_LIGHT_DIRECTIONAL || !(fade > 0.0f)) fade = 1.0f;
    for (int i = 0; i < 3; i++) {
        light.position[i] = light.direction[i] = sign * position[i];
        light.colour[i] = colour[i] / fade;
    }
    make_colour(light.colour, path, "light", source->mName.data, log);
    return cs_scene_add_light(scene, &light, error);
}

static clshear_status convert(cs_scene *scene, const struct aiScene *file, const char *path,
                              int materials_missing, const cs_log *log, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    for (unsigned i = 0; i < file->mNumMaterials; i++)
        CS_TRY(add_material(scene, file, file->mMaterials[i], path, materials_missing, log, error));
    if (file->mNumMaterials == 0) {
        cs_material *grey = cs_array_extend(&scene->materials, 1);
        CS_REQUIRE(grey != NULL, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
        *grey = (cs_material){.diffuse = {mid_grey, mid_grey, mid_grey}, .texture = CS_NO_TEXTURE};
    }
    importing work = {scene, path, error};
    CS_TRY(cs_node_visit_meshes(file, add_instance, &work));
    for (unsigned i = 0; i < file->mNumLights; i++)
        CS_TRY(add_light(scene, file, file->mLights[i], path, log, error));
    if (file->mNumCameras > 0 && !cs_camera_import(scene, file))
        cs_warn(log, "%s: its camera has no perspective; left out", path);
    CS_TRY(cs_scene_finish(scene, path, error));
done:
    return status;
}

static int has_suffix(const char *text, const char *suffix)
{
    size_t length = strlen(text), tail = strlen(suffix);
    if (length < tail) return 0;
    for (size_t i = 0; i < tail; i++)
        if (tolower((unsigned char)text[length - tail + i]) != suffix[i]) return 0;
    return 1;
}

/* Reports the material files that were asked for and not found; returns how many. Where none was
 * found, Assimp also asks for one called like the scene, which nobody named. */
static int warn_of_missing_materials(const cs_missing *missing, const char *path, const cs_log *log)
{
    const char *slash = strrchr(path, '/');
    const char *stem = slash != NULL ? slash + 1 : path;
    const size_t length = strcspn(stem, ".");
    int count = 0;
    for (int i = 0; i < missing->count; i++) {
        const char *name = strrchr(missing->paths[i], '/');
        name = name != NULL ? name + 1 : missing->paths[i];
        if (!has_suffix(name, ".mtl")) continue;
        int fallback = strncmp(name, stem, length) == 0 && strcmp(name + length, ".mtl") == 0;
        if (count > 0 && fallback) continue;
        cs_warn(log, "%s: material file %s not found; its materials are mid-grey", path, name);
        count++;
    }
    return count;
}

/* Assimp's own steps trust the indices, so they are checked before any of those runs. */
static clshear_status check_indices(const struct aiScene *file, const char *path, cs_error *error)
{
    for (unsigned m = 0; m < file->mNumMeshes; m++) {
        const struct aiMesh *mesh = file->mMeshes[m];
        for (unsigned i = 0; i < mesh->mNumFaces; i++)
            for (unsigned k = 0; k < mesh->mFaces[i].mNumIndices; k++)
                if (mesh->mFaces[i].mIndices[k] >= mesh->mNumVertices)
                    return cs_fail(error, CLSHEAR_BAD_FILE,
                                   "%s: face %u names vertex %u, but there are %u; repair the mesh",
                                   path, i, mesh->mFaces[i].mIndices[k], mesh->mNumVertices);
    }
    return CLSHEAR_OK;
}

static clshear_status check_readable(const char *path, cs_error *error)
{
    struct stat about;
    FILE *stream = fopen(path, "rb");
    if (stream == NULL)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be opened: %s", path, strerror(errno));
    int is_folder = fstat(fileno(stream), &about) == 0 && S_ISDIR(about.st_mode);
    fclose(stream);
    if (is_folder)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: is a folder, not a scene file", path);
    return CLSHEAR_OK;
}

/* With the importer locked. */
static clshear_status import(const char *path, cs_scene *scene, const cs_log *log, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const struct aiScene *file = NULL;
    cs_missing missing = {0};
    struct aiFileIO io = cs_recording_file_io(&missing);
    CS_TRY(check_readable(path, error));
    file = aiImportFileEx(path, 0, &io);
    if (file != NULL) {
        CS_TRY(check_indices(file, path, error));
        file = aiApplyPostProcessing(file, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
    }
    CS_REQUIRE(file != NULL, CLSHEAR_BAD_FILE, "%s: %.*s", path,
               (int)strcspn(aiGetErrorString(), "\n"), aiGetErrorString());
    int materials_missing = warn_of_missing_materials(&missing, path, log);
    CS_TRY(convert(scene, file, path, materials_missing, log, error));
    if (scene->degenerate > 0)
        cs_warn(log, "%s: %zu triangles without area are left out", path, scene->degenerate);
done:
    if (file != NULL) aiReleaseImport(file);
    return status;
}

clshear_status cs_scene_import(const char *path, cs_scene *scene, const cs_log *log,
                               cs_error *error)
{
    /* Assimp keeps its last error and its log for the whole process. */
    static pthread_mutex_t one_at_a_time = PTHREAD_MUTEX_INITIALIZER;
    pthread_mutex_lock(&one_at_a_time);
    const clshear_status status = import(path, scene, log, error);
    pthread_mutex_unlock(&one_at_a_time);
    return status;
}
