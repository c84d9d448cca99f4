#include "helper/other.h"

#include <assimp/cimport.h>
#include <assimp/commonMetaData.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "helper/collada.h"
#include "helper/collada_camera.h"
#include "helper/collada_edit.h"
#include "helper/collada_sets.h"
#include "helper/light.h"
#include "helper/metadata.h"
#include "helper/node.h"
#include "helper/three_mf.h"
#include "import/colour.h"
#include "import/find_file.h"

typedef struct importing {
    cs_model *model;
    const struct aiScene *file;
    cs_error *error;
} importing;

static void take_colour(const struct aiMaterial *material, const char *key, float *colour)
{
    struct aiColor4D value;
    if (aiGetMaterialColor(material, key, 0, 0, &value) == aiReturn_SUCCESS)
        memcpy(colour, &value.r, 3 * sizeof *colour);
}

/* The image inside the scene file that `name` means: "*N", or the name of one; NULL if none. */
static const struct aiTexture *embedded_image(const struct aiScene *file, const char *name)
{
    for (unsigned i = 0; i < file->mNumTextures; i++) {
        char number[16];
        snprintf(number, sizeof number, "*%u", i);
        if (strcmp(name, number) == 0 || strcmp(name, file->mTextures[i]->mFilename.data) == 0)
            return file->mTextures[i];
    }
    return NULL;
}

static cs_wrap wrap_of(enum aiTextureMapMode mode)
{
    return mode == aiTextureMapMode_Clamp    ? CS_WRAP_CLAMP
           : mode == aiTextureMapMode_Mirror ? CS_WRAP_MIRROR
                                             : CS_WRAP_REPEAT;
}

/* A map of one of two kinds, the first that the material has. */
static clshear_status take_map(const importing *work, const struct aiMaterial *source,
                               const enum aiTextureType types[2], cs_map *map)
{
    struct aiString name;
    enum aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap,
                                      aiTextureMapMode_Wrap};
    unsigned set = 0;
    char folder[CS_FILE_PATH], found[CS_FILE_PATH];
    const char *folders[] = {folder};
    if (aiGetMaterialTexture(source, types[0], 0, &name, NULL, &set, NULL, NULL, modes, NULL) !=
            aiReturn_SUCCESS &&
        aiGetMaterialTexture(source, types[1], 0, &name, NULL, &set, NULL, NULL, modes, NULL) !=
            aiReturn_SUCCESS)
        return CLSHEAR_OK;
    map->wrap[0] = wrap_of(modes[0]);
    map->wrap[1] = wrap_of(modes[1]);
    map->set = set < AI_MAX_NUMBER_OF_TEXTURECOORDS ? (int)set : 0;
    const struct aiTexture *embedded = embedded_image(work->file, name.data);
    if (embedded != NULL && embedded->mHeight == 0)
        return cs_model_add_image(work->model, "", name.data, embedded->pcData, embedded->mWidth,
                                  &map->image, work->error);
    cs_folder_of(work->model->path, folder, sizeof folder);
    const int there = cs_find_file(name.data, folders, 1, found);
    return cs_model_add_image(work->model, there ? found : "", there ? found : name.data, NULL, 0,
                              &map->image, work->error);
}

/* Opacity, by a number or an image. */
static clshear_status take_opacity(const importing *work, const struct aiMaterial *source,
                                   cs_material_description *material)
{
    static const enum aiTextureType types[] = {aiTextureType_OPACITY, aiTextureType_OPACITY};
    float opacity = 1.0f;
    unsigned count = 1;
    if (aiGetMaterialFloatArray(source, "$mat.opacity", 0, 0, &opacity, &count) !=
            aiReturn_SUCCESS ||
        !(opacity < 1.0f))
        opacity = 1.0f;
    material->alpha_map.use.kind = CS_TEXELS_OPACITY;
    const clshear_status status = take_map(work, source, types, &material->alpha_map);
    if (!(opacity > 0.0f) && cs_map_is_used(&material->alpha_map)) opacity = 1.0f;
    material->base_colour[3] = opacity;
    if (opacity < 1.0f || cs_map_is_used(&material->alpha_map))
        material->alpha_mode = CS_ALPHA_BLEND;
    return status;
}

static clshear_status add_material(const importing *work, const struct aiMaterial *source)
{
    static const enum aiTextureType base_types[] = {aiTextureType_DIFFUSE,
                                                    aiTextureType_BASE_COLOR};
    struct aiString name = {0};
    cs_material_description *material = cs_model_extend(&work->model->materials, 1);
    if (material == NULL) return cs_model_full(work->model, work->error);
    aiGetMaterialString(source, "?mat.name", 0, 0, &name);
    cs_material_init(material, name.data);
    take_colour(source, "$clr.diffuse", material->base_colour);
    take_colour(source, "$clr.base", material->base_colour);
    take_colour(source, "$clr.emissive", material->emissive);
    material->emissive_map.missing = aiGetMaterialTextureCount(source, aiTextureType_EMISSIVE) > 0;
    material->normal_map.missing = aiGetMaterialTextureCount(source, aiTextureType_NORMALS) > 0;
    material->normal_map.missing |= aiGetMaterialTextureCount(source, aiTextureType_HEIGHT) > 0;
    clshear_status status = take_map(work, source, base_types, &material->base_map);
    if (status == CLSHEAR_OK) status = take_opacity(work, source, material);
    cs_material_whiten(material);
    return status;
}

/* ----- Meshes ----- */

/* Colours of vertices, of which `first` is the first. Programs write what they show, as in OBJ. */
static clshear_status add_colours(const importing *work, const struct aiMesh *source, size_t first)
{
    cs_model *model = work->model;
    const int has_alpha = cs_is_collada(model->path); /* other readers leave anything there */
    const struct aiColor4D *colours = source->mColors[0];
    clshear_status status = CLSHEAR_OK;
    for (size_t i = 0; i < source->mNumVertices && colours != NULL && status == CLSHEAR_OK; i++) {
        const float *rgb = &colours[i].r;
        float colour[3];
        for (int c = 0; c < 3; c++)
            colour[c] = cs_colour_value((double)rgb[c], 1);
        model->has_unused_alpha |= has_alpha && colours[i].a < 1.0f;
        status = cs_model_set_colour(model, first + i, colour, work->error);
    }
    return status;
}

static clshear_status add_vertices(const importing *work, const struct aiMesh *source,
                                   const struct aiMatrix4x4 *matrix, const struct aiVector3D *st)
{
    cs_model *model = work->model;
    const size_t count = source->mNumVertices, first = model->positions.count;
    struct aiMatrix4x4 turn = *matrix;
    aiMatrix4Inverse(&turn); /* normals transform by the inverse transpose */
    aiTransposeMatrix4(&turn);
    double(*positions)[3] = cs_model_extend(&model->positions, count);
    float(*normals)[3] = cs_model_extend(&model->normals, source->mNormals != NULL ? count : 0);
    float(*textures)[2] = cs_model_extend(&model->textures, st != NULL ? count : 0);
    if (positions == NULL || normals == NULL || textures == NULL)
        return cs_model_full(model, work->error);
    for (size_t i = 0; i < count; i++) {
        cs_node_transform(matrix, &source->mVertices[i], 1.0, positions[i]);
        if (source->mNormals != NULL) {
            double normal[3];
            cs_node_transform(&turn, &source->mNormals[i], 0.0, normal);
            for (int axis = 0; axis < 3; axis++)
                normals[i][axis] = isfinite(normal[axis]) ? (float)normal[axis] : 0.0f;
        }
        if (st != NULL) {
            textures[i][0] = st[i].x;
            textures[i][1] = st[i].y;
        }
    }
    return add_colours(work, source, first);
}

static clshear_status add_face(const importing *work, const struct aiMesh *source,
                               const struct aiFace *face, const cs_corner *first, cs_array *corners)
{
    corners->count = 0;
    cs_corner *corner = cs_array_extend(corners, face->mNumIndices);
    if (corner == NULL) return cs_model_full(work->model, work->error);
    for (unsigned k = 0; k < face->mNumIndices; k++) {
        const uint32_t index = face->mIndices[k];
        if (index >= source->mNumVertices)
            return cs_fail(work->error, CLSHEAR_BAD_FILE,
                           "%s: a face names vertex %u, but there are %u; repair the mesh",
                           work->model->path, index, source->mNumVertices);
        corner[k] = (cs_corner){first->position + index, CS_NO_INDEX, CS_NO_INDEX};
        if (first->normal != CS_NO_INDEX) corner[k].normal = first->normal + index;
        if (first->texture != CS_NO_INDEX) corner[k].texture = first->texture + index;
    }
    return cs_model_add_polygon(work->model, corner, face->mNumIndices, source->mMaterialIndex, 0,
                                work->error);
}

/* Returns the texture coordinates of the set that a material asks for. If the mesh lacks this set,
 * the next lower set counts, since Assimp leaves no gap between a mesh's sets. Returns NULL if the
 * mesh has no coordinates. */
static const struct aiVector3D *coordinates_of(const struct aiMesh *mesh, const cs_map *placing)
{
    int set = placing != NULL ? placing->set : 0;
    while (set > 0 && mesh->mTextureCoords[set] == NULL)
        set--;
    return mesh->mTextureCoords[set];
}

static clshear_status add_instance(void *user, const struct aiMesh *source,
                                   const struct aiMatrix4x4 *matrix)
{
    const importing *work = user;
    const cs_model *model = work->model;
    const cs_material_description *materials = model->materials.items;
    cs_array corners = {.item_size = sizeof(cs_corner)};
    const cs_map *placing = NULL;
    if (source->mMaterialIndex < model->materials.count)
        placing = cs_material_placing(&materials[source->mMaterialIndex]);
    const struct aiVector3D *st = coordinates_of(source, placing);
    const cs_corner first = {(uint32_t)model->positions.count,
                             source->mNormals != NULL ? (uint32_t)model->normals.count
                                                      : CS_NO_INDEX,
                             st != NULL ? (uint32_t)model->textures.count : CS_NO_INDEX};
    clshear_status status = add_vertices(work, source, matrix, st);
    for (unsigned i = 0; i < source->mNumFaces && status == CLSHEAR_OK; i++)
        if (source->mFaces[i].mNumIndices > 0)
            status = add_face(work, source, &source->mFaces[i], &first, &corners);
    cs_array_free(&corners);
    return status;
}

/* ----- Lights and cameras ----- */

static clshear_status add_light(const importing *work, const struct aiLight *source)
{
    cs_model_light light;
    if (!cs_light_read(work->file, source, &light)) {
        cs_warn(work->model->log, "%s: light \"%s\" is of a kind that is not supported; left out",
                work->model->path, light.name);
        return CLSHEAR_OK;
    }
    cs_model_light *added = cs_model_extend(&work->model->lights, 1);
    if (added == NULL) return cs_model_full(work->model, work->error);
    *added = light;
    return CLSHEAR_OK;
}

static clshear_status add_camera(const importing *work, const struct aiCamera *source)
{
    const struct aiMatrix4x4 matrix = cs_node_matrix(work->file, source->mName.data);
    cs_model_camera *camera = cs_model_extend(&work->model->cameras, 1);
    if (camera == NULL) return cs_model_full(work->model, work->error);
    const double aspect = source->mAspect > 0.0f ? (double)source->mAspect : 1.0;
    snprintf(camera->name, sizeof camera->name, "%.*s", CS_MODEL_NAME - 1, source->mName.data);
    cs_node_transform(&matrix, &source->mPosition, 1.0, camera->eye);
    cs_node_transform(&matrix, &source->mLookAt, 0.0, camera->forward);
    cs_node_transform(&matrix, &source->mUp, 0.0, camera->up);
    camera->height = 2.0 * (double)source->mOrthographicWidth / aspect;
    camera->fov = 2.0 * atan(tan(0.5 * (double)source->mHorizontalFOV) / aspect);
    if (cs_is_collada(work->model->path)) {
        const double *up = camera->up;
        const struct aiVector3D of = source->mUp;
        const double before = (double)(of.x * of.x + of.y * of.y + of.z * of.z);
        const double after = up[0] * up[0] + up[1] * up[1] + up[2] * up[2];
        cs_collada_extent(source, before > 0.0 ? sqrt(after / before) : 1.0, camera);
    }
    return CLSHEAR_OK;
}

/* Whether a material is Assimp's own for meshes without one, which is a grey: 0.8 in FBX, else 0.6.
 */
static int is_default(const struct aiScene *file, const cs_material_description *material)
{
    const char *format = cs_metadata_text(file, AI_METADATA_SOURCE_FORMAT);
    const float grey = strstr(format, "FBX") != NULL ? 0.8f : 0.6f;
    if (strcmp(material->name, AI_DEFAULT_MATERIAL_NAME) != 0) return 0;
    if (cs_map_is_used(&material->base_map) || cs_map_is_used(&material->alpha_map)) return 0;
    for (int c = 0; c < 3; c++)
        if (material->base_colour[c] != grey || material->emissive[c] > 0.0f) return 0;
    return material->base_colour[3] == 1.0f;
}

static void make_default(const importing *work)
{
    cs_material_description *all = work->model->materials.items;
    for (size_t i = 0; i < work->model->materials.count; i++)
        if (is_default(work->file, &all[i])) cs_model_plain(work->model, all[i].name, &all[i]);
}

/* Exporters of Collada and others write an opacity of 0 for opaque. */
static void show_invisible(const importing *work)
{
    cs_material_description *all = work->model->materials.items;
    size_t count = 0;
    for (size_t i = 0; i < work->model->materials.count; i++) {
        if (all[i].base_colour[3] > 0.0f) continue;
        all[i].base_colour[3] = 1.0f;
        all[i].alpha_mode = CS_ALPHA_OPAQUE;
        count++;
    }
    if (count > 0)
        cs_warn(work->model->log,
                "%s: the opacity 0 of %zu material%s is taken as opaque, as some programs mean it",
                work->model->path, count, count > 1 ? "s" : "");
}

static clshear_status convert(const importing *work)
{
    const struct aiScene *file = work->file;
    clshear_status status = CLSHEAR_OK;
    for (unsigned i = 0; i < file->mNumMaterials; i++)
        CS_TRY(add_material(work, file->mMaterials[i]));
    CS_TRY(cs_node_visit_meshes(file, add_instance, (void *)work));
    make_default(work);
    show_invisible(work);
    for (unsigned i = 0; i < file->mNumLights; i++)
        CS_TRY(add_light(work, file->mLights[i]));
    for (unsigned i = 0; i < file->mNumCameras; i++)
        CS_TRY(add_camera(work, file->mCameras[i]));
done:
    return status;
}

/* Assimp turns 3DS, in which +Z is up, so that +Y is. Turns it back: coordinates are the file's,
 * and a file that breaks the convention, as many do, is shown upright by --z-up=0. FBX says which
 * axis is up, and Assimp does not turn it. */
static void set_upright(const struct aiScene *file, cs_model *model)
{
    const char *dot = strrchr(model->path, '.');
    struct aiMatrix4x4 back = {1, 0, 0, 0, 0, 0, -1, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    model->z_up = cs_metadata_number(file, "UpAxis", 1.0) == 2.0 &&
                  cs_metadata_number(file, "UpAxisSign", 1.0) > 0.0;
    if (dot == NULL || strcasecmp(dot, ".3ds") != 0) return;
    model->z_up = 1;
    aiMultiplyMatrix4(&back, &file->mRootNode->mTransformation);
    file->mRootNode->mTransformation = back;
}

static void report_losses(const cs_model *model, const cs_collada_losses *lost, size_t conflicts)
{
    if (lost->holes > 0)
        cs_warn(model->log, "%s: holes of polygons are not supported: %zu closed; export triangles",
                model->path, lost->holes);
    if (lost->morphs > 0)
        cs_warn(model->log, "%s: morph targets are not supported: the first shape of %zu mesh%s",
                model->path, lost->morphs, lost->morphs > 1 ? "es" : "");
    if (lost->skews > 0)
        cs_warn(model->log,
                "%s: %zu skew%s without an angle below 90 degrees and two axes; left out",
                model->path, lost->skews, lost->skews > 1 ? "s" : "");
    if (conflicts > 0)
        cs_warn(model->log,
                "%s: its materials give one name to several sets of texture coordinates: the first "
                "of them counts; give each set its own name",
                model->path);
}

/* Opens a file with Assimp. `file` becomes NULL where Assimp cannot read it. No step of Assimp's
 * post-processing runs, since these trust the indices of the file, which are checked later. */
static clshear_status open_file(cs_bytes *bytes, const cs_model *model, const struct aiScene **file,
                                cs_error *error)
{
    cs_collada_losses lost = {0};
    size_t conflicts = 0;
    if (!cs_is_collada(model->path)) {
        *file = aiImportFile(model->path, 0);
        return CLSHEAR_OK;
    }
    clshear_status status = cs_collada_tidy(bytes, model->path, error);
    if (status == CLSHEAR_OK) status = cs_collada_edit(bytes, &lost, error);
    if (status == CLSHEAR_OK) status = cs_collada_edit_cameras(bytes, error);
    if (status == CLSHEAR_OK) status = cs_collada_number_sets(bytes, &conflicts, error);
    report_losses(model, &lost, conflicts);
    if (status == CLSHEAR_OK)
        *file = aiImportFileFromMemory(bytes->data, (unsigned)bytes->size, 0, "dae");
    return status;
}

clshear_status cs_read_other(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    const struct aiScene *file = NULL;
    if (cs_is_3mf(model->path)) return cs_read_3mf(bytes, model, error);
    clshear_status status = open_file(bytes, model, &file, error);
    if (status != CLSHEAR_OK) return status;
    if (file == NULL && strstr(aiGetErrorString(), "bad_alloc") != NULL)
        return cs_fail(error, CLSHEAR_BAD_FILE,
                       "%s: asks for more memory than a file of its size may; it is damaged",
                       model->path);
    if (file == NULL && strstr(aiGetErrorString(), "No suitable reader") != NULL)
        return cs_fail(error, CLSHEAR_BAD_FILE,
                       "%s: no reader knows this format by its name or its first bytes; OBJ, glTF, "
                       "PLY, STL, OFF and 3MF are read",
                       model->path);
    if (file == NULL && strstr(aiGetErrorString(), "File came out empty") != NULL)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: has no scene that shows anything",
                       model->path);
    if (file == NULL)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %.*s", model->path,
                       (int)strcspn(aiGetErrorString(), "\n"), aiGetErrorString());
    const importing work = {model, file, error};
    set_upright(file, model);
    status = convert(&work);
    if (status == CLSHEAR_OK && model->triangles.count == 0)
        status = cs_fail(error, CLSHEAR_BAD_FILE, "%s: there are no triangles in it", model->path);
    aiReleaseImport(file);
    return status;
}
