#include "gltf_sheet.h"

#include <math.h>
#include <stdio.h>

/* ----- A mesh: a hilly sheet ----- */

float sheet_positions[SHEET_VERTICES][3], sheet_normals[SHEET_VERTICES][3],
    sheet_textures[SHEET_VERTICES][2];
uint8_t sheet_colours[SHEET_VERTICES][4];
uint16_t sheet_indices[SHEET_TRIANGLES][3];

void sheet_make(void)
{
    for (int i = 0; i < SHEET_VERTICES; i++) {
        const float x = (float)(i % SHEET_SIDE), y = (float)i / SHEET_SIDE;
        const float slope[3] = {-0.3f * cosf(x), 0.3f * sinf(y), 1.0f};
        const float length = sqrtf(slope[0] * slope[0] + slope[1] * slope[1] + 1.0f);
        memcpy(sheet_positions[i], (float[3]){x, y, 0.3f * (sinf(x) + cosf(y))},
               sizeof sheet_positions[i]);
        for (int axis = 0; axis < 3; axis++)
            sheet_normals[i][axis] = slope[axis] / length;
        memcpy(sheet_textures[i], (float[2]){x / SHEET_SIDE, y / SHEET_SIDE},
               sizeof sheet_textures[i]);
        memcpy(sheet_colours[i], (uint8_t[4]){(uint8_t)(3 * i), (uint8_t)(255 - i), 17, 255},
               sizeof sheet_colours[i]);
    }
    for (int i = 0; i < SHEET_TRIANGLES; i++) {
        const int corner = i / 2 % (SHEET_SIDE - 1) + i / 2 / (SHEET_SIDE - 1) * SHEET_SIDE;
        const int other = i % 2 == 0 ? corner + 1 : corner + SHEET_SIDE + 1;
        const int third = i % 2 == 0 ? corner + SHEET_SIDE + 1 : corner + SHEET_SIDE;
        sheet_indices[i][0] = (uint16_t)corner;
        sheet_indices[i][1] = (uint16_t)other;
        sheet_indices[i][2] = (uint16_t)third;
    }
}

/* ----- Files ----- */

void sheet_append(sheet_parts *to, int part, const void *bytes, size_t size)
{
    assert_true(to->used + size + 4 <= sizeof to->bytes);
    to->begin[part] = to->used;
    to->size[part] = size;
    memcpy(to->bytes + to->used, bytes, size);
    to->used += (size + 3) / 4 * 4;
}

const size_t sheet_strides[5] = {12, 12, 8, 4, 2};
const size_t sheet_counts[5] = {SHEET_VERTICES, SHEET_VERTICES, SHEET_VERTICES, SHEET_VERTICES,
                                3 * SHEET_TRIANGLES};
const void *const sheet_items[5] = {sheet_positions, sheet_normals, sheet_textures, sheet_colours,
                                    sheet_indices};

static const char attributes[] =
    "\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2,\"COLOR_0\":3},\"indices\":4";

static const char *given(const char *text)
{
    return text != NULL ? text : "";
}

const char *sheet_write(const char *name, const sheet_parts *data, const sheet_contents *what)
{
    const char *types[5] = {"5126,\"type\":\"VEC3\"", "5126,\"type\":\"VEC3\"",
                            "5126,\"type\":\"VEC2\"", "5121,\"normalized\":true,\"type\":\"VEC4\"",
                            "5123,\"type\":\"SCALAR\""};
    if (what->normals != NULL) types[1] = what->normals;
    static char text[1 << 14];
    char accessors[2048] = "", file[128];
    size_t used = 0;
    for (int i = 0; i < 5; i++) {
        char view[32] = "";
        if (!what->is_bare) snprintf(view, sizeof view, "\"bufferView\":%d,", i);
        used += (size_t)snprintf(accessors + used, sizeof accessors - used,
                                 "%s{%s\"count\":%zu,\"componentType\":%s}", i > 0 ? "," : "", view,
                                 sheet_counts[i], types[i]);
    }
    snprintf(file, sizeof file, "%s.bin", name);
    test_bytes(file, data->bytes, data->used);
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"extensionsRequired\":[\"%s\"],\"scenes\":[{"
             "\"nodes\":[0]}],\"nodes\":[{\"mesh\":0%s}],\"meshes\":[{\"primitives\":[{%s,"
             "\"material\":0%s}]}],\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":"
             "{\"index\":0}}}],\"textures\":[{\"source\":0}],\"images\":[{\"uri\":"
             "\"my%%20four.ppm\"}],\"buffers\":[{\"uri\":\"%s\",\"byteLength\":%zu},{\"byteLength\""
             ":100000,\"extensions\":{\"EXT_meshopt_compression\":{\"fallback\":true}}}],"
             "\"bufferViews\":[%s],\"accessors\":[%s%s]}",
             what->required != NULL ? what->required : "KHR_texture_transform",
             given(what->of_node), attributes, given(what->of_primitive), file, data->used,
             what->views, accessors, given(what->accessors));
    import_picture("my four.ppm");
    return test_file(name, text);
}

const char *sheet_write_plain(const char *name, const char *of_primitive, const char *required)
{
    static sheet_parts data;
    char views[1024] = "";
    size_t used = 0;
    data.used = 0;
    for (int i = 0; i < 5; i++) {
        sheet_append(&data, i, sheet_items[i], sheet_counts[i] * sheet_strides[i]);
        used += (size_t)snprintf(views + used, sizeof views - used,
                                 "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}",
                                 i > 0 ? "," : "", data.begin[i], data.size[i]);
    }
    return sheet_write(
        name, &data,
        &(sheet_contents){.views = views, .of_primitive = of_primitive, .required = required});
}

/* ----- Scenes ----- */

static clshear_status read_scene(const char *path, cs_scene *scene, cs_error *error)
{
    const cs_log log = {.warn = import_collect};
    const cs_import_options options = {.smooth_degrees = -1.0};
    import_warnings[0] = '\0';
    cs_scene_init(scene);
    return cs_scene_import(path, &options, scene, &log, error);
}

cs_scene sheet_load(const char *path)
{
    cs_scene scene;
    cs_error error;
    if (read_scene(path, &scene, &error) != CLSHEAR_OK) fail_msg("%s", error.message);
    assert_string_equal(import_warnings, "");
    return scene;
}

void sheet_refused(const char *path, const char *words)
{
    cs_scene scene;
    cs_error error;
    assert_int_equal(read_scene(path, &scene, &error), CLSHEAR_BAD_FILE);
    if (strstr(error.message, words) == NULL)
        fail_msg("\"%s\" does not contain \"%s\"", error.message, words);
    cs_scene_free(&scene);
}
