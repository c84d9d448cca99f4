#include "scene/import.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "scene/camera.h"
#include "scene/missing.h"
#include "scene/texture.h"

static const float mid_grey = 0.5f;

/* Assimp gives a material it does not know this diffuse colour. */
static const float assimp_unknown = 0.6f;

static void read_colour(const struct aiMaterial *material, const char *key, float *colour)
{
    struct aiColor4D value;
    if (aiGetMaterialColor(material, key, 0, 0, &value) != aiReturn_SUCCESS) return;
    colour[0] = fmaxf(value.r, 0.0f);
    colour[1] = fmaxf(value.g, 0.0f);
    colour[2] = fmaxf(value.b, 0.0f);
}

static clshear_status add_material(cs_scene *scene, const struct aiScene *file,
                                   const struct aiMaterial *source, const char *path,
                                   int materials_missing, const cs_log *log, cs_error *error)
{
    cs_material look = {.texture = CS_NO_TEXTURE};
    for (int c = 0; c < 3; c++)
        look.diffuse[c] = mid_grey;
    read_colour(source, "$clr.diffuse", look.diffuse);
    read_colour(source, "$clr.base", look.diffuse);
    read_colour(source, "$clr.emissive", look.emission);
    if (materials_missing && look.diffuse[0] == assimp_unknown &&
        look.diffuse[1] == assimp_unknown && look.diffuse[2] == assimp_unknown)
        for (int c = 0; c < 3; c++)
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
    cs_material *added = cs_array_extend(&scene->materials, 1);
    if (added == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    *added = look;
    return CLSHEAR_OK;
}

static clshear_status add_mesh(cs_scene *scene, const struct aiMesh *source, const char *path,
                               cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    size_t count = 0;
    uint32_t *indices = malloc(sizeof(uint32_t) * 3 * ((size_t)source->mNumFaces + 1));
    CS_REQUIRE(indices != NULL, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    for (unsigned i = 0; i < source->mNumFaces; i++) {
        const struct aiFace *face = &source->mFaces[i];
        if (face->mNumIndices != 3) continue; /* points and lines have no area */
        memcpy(indices + 3 * count, face->mIndices, 3 * sizeof(uint32_t));
        count++;
    }
    clshear_mesh mesh = {
        .positions = &source->mVertices[0].x,
        .normals = source->mNormals != NULL ? &source->mNormals[0].x : NULL,
        .indices = indices,
        .vertex_count = source->mNumVertices,
        .triangle_count = count,
    };
    const struct aiVector3D *texture = source->mTextureCoords[0];
    CS_TRY(cs_scene_add_mesh(scene, &mesh, texture != NULL ? &texture[0].x : NULL,
                             source->mMaterialIndex, path, error));
done:
    free(indices);
    return status;
}

static clshear_status add_light(cs_scene *scene, const struct aiLight *source, const char *path,
                                const cs_log *log, cs_error *error)
{
    clshear_light light = {.kind = CLSHEAR_LIGHT_POINT};
    const struct aiVector3D *from = &source->mPosition;
    float sign = 1.0f, fade = source->mAttenuationQuadratic;
    if (source->mType == aiLightSource_DIRECTIONAL) {
        light.kind = CLSHEAR_LIGHT_DIRECTIONAL;
        from = &source->mDirection;
        sign = -1.0f;
    } else if (source->mType == aiLightSource_SPOT) {
        cs_warn(log, "%s: spot light \"%s\" is taken as a point light", path, source->mName.data);
    } else if (source->mType != aiLightSource_POINT) {
        cs_warn(log, "%s: light \"%s\" is of a kind that is not supported; left out", path,
                source->mName.data);
        return CLSHEAR_OK;
    }
    const float position[3] = {from->x, from->y, from->z};
    const float colour[3] = {source->mColorDiffuse.r, source->mColorDiffuse.g,
                             source->mColorDiffuse.b};
    if (light.kind == CLSHEAR_LIGHT_DIRECTIONAL || !(fade > 0.0f)) fade = 1.0f;
    for (int i = 0; i < 3; i++) {
        light.vector[i] = sign * position[i];
        light.colour[i] = colour[i] / fade;
    }
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
    for (unsigned i = 0; i < file->mNumMeshes; i++)
        CS_TRY(add_mesh(scene, file->mMeshes[i], path, error));
    for (unsigned i = 0; i < file->mNumLights; i++)
        CS_TRY(add_light(scene, file->mLights[i], path, log, error));
    if (file->mNumCameras > 0) cs_camera_import(scene, file->mCameras[0]);
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

static int warn_of_missing_materials(const cs_missing *missing, const char *path,
                                     const cs_log *log)
{
    int count = 0;
    for (int i = 0; i < missing->count; i++) {
        if (!has_suffix(missing->paths[i], ".mtl")) continue;
        cs_warn(log, "%s: material file %s not found; its materials are mid-grey", path,
                missing->paths[i]);
        count++;
    }
    return count;
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

clshear_status cs_scene_import(const char *path, cs_scene *scene, const cs_log *log,
                               cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const struct aiScene *file = NULL;
    cs_missing missing = {0};
    struct aiFileIO io = cs_recording_file_io(&missing);
    CS_TRY(check_readable(path, error));
    file = aiImportFileEx(path,
                          aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                              aiProcess_PreTransformVertices,
                          &io);
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
