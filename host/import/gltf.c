/* glTF 2.0 and GLB: the container, the JSON, what it requires. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/number.h"
#include "import/find_file.h"
#include "import/gltf_reader.h"
#include "import/readers.h"

static const char *const supported[] = {"KHR_lights_punctual", "KHR_texture_transform",
                                        "KHR_mesh_quantization", "EXT_texture_webp",
                                        "KHR_node_visibility", "EXT_mesh_gpu_instancing",
                                        "EXT_meshopt_compression", "KHR_draco_mesh_compression",
                                        /* a centre that all is relative to; shown without */
                                        "CESIUM_RTC",
                                        /* what the file has at rest stands */
                                        "KHR_animation_pointer",
                                        /* tells who made what */
                                        "KHR_xmp_json_ld",
                                        /* chooses among materials; the primitive's own stands */
                                        "KHR_materials_variants"};

int cs_is_gltf(const cs_bytes *bytes, const char *path)
{
    const int is_binary = bytes->size >= 4 && memcmp(bytes->data, "glTF", 4) == 0;
    return is_binary || cs_has_suffix(path, ".gltf") || cs_has_suffix(path, ".glb");
}

clshear_status gltf_complain(const gltf_reader *reader, const char *place, long long index,
                             const char *format, ...)
{
    cs_error what;
    char where[64] = "";
    va_list arguments;
    va_start(arguments, format);
    cs_fail_with(&what, CLSHEAR_BAD_FILE, format, arguments);
    va_end(arguments);
    if (index >= 0) snprintf(where, sizeof where, "[%lld]", index);
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: %s%s: %.512s", reader->model->path, place,
                   where, what.message);
}

void gltf_note(gltf_reader *reader, gltf_remark remark, const char *place, long long index)
{
    gltf_places *places = &reader->places[remark];
    if (places->count++ > 0) return;
    if (index >= 0)
        snprintf(places->first, sizeof places->first, "%s[%lld]", place, index);
    else
        snprintf(places->first, sizeof places->first, "%s", place);
}

void gltf_tell(const gltf_reader *reader)
{
    static const char *const words[GLTF_REMARKS] = {
        [GLTF_DOUBLED] = "in the scene more than once, or a child there, too; shown once",
        [GLTF_MORE_JOINTS] =
            "more than four joints of a vertex are not supported; the first four move it",
        [GLTF_BASISU] = "no image that can be read (extension KHR_texture_basisu)",
        [GLTF_WITHOUT_IMAGE] = "no image that can be read (extension not known)",
        [GLTF_WITHOUT_AREA] = "points and lines are left out",
        [GLTF_STANDS_STILL] = "moves no node, but something else, which stands still"};
    for (int i = 0; i < GLTF_REMARKS; i++) {
        const gltf_places *places = &reader->places[i];
        char more[32] = "";
        if (places->count > 1) snprintf(more, sizeof more, " and %zu more", places->count - 1);
        if (places->count > 0)
            cs_warn(reader->model->log, "%s: %s%s: %s", reader->model->path, places->first, more,
                    words[i]);
    }
}

json_t *gltf_at(const gltf_reader *reader, const char *name, long long index)
{
    const json_t *array = json_object_get(reader->root, name);
    json_t *item = index >= 0 ? json_array_get(array, (size_t)index) : NULL;
    if (json_is_object(item)) return item;
    if (index < 0)
        cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: an index into %s %s", reader->model->path,
                name, index == -1 ? "is missing" : "is no whole number of 0 or more");
    else if ((size_t)index < json_array_size(array))
        gltf_complain(reader, name, index, "is no object of JSON");
    else
        cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: %s[%lld] is asked for, but there are %zu",
                reader->model->path, name, index, json_array_size(array));
    return NULL;
}

size_t gltf_count(const gltf_reader *reader, const char *name)
{
    return json_array_size(json_object_get(reader->root, name));
}

double gltf_number(const json_t *object, const char *key, double fallback)
{
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : fallback;
}

long long gltf_index(const json_t *object, const char *key)
{
    const json_t *value = json_object_get(object, key);
    if (value == NULL || json_is_null(value)) return -1;
    const double number = json_is_number(value) ? json_number_value(value) : -2.0;
    if (!(number >= 0.0 && number < 9e15)) return -2;
    return (long long)number;
}

const char *gltf_text(const json_t *object, const char *key, const char *fallback)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text != NULL ? text : fallback;
}

void gltf_numbers(const json_t *object, const char *key, double *numbers, size_t count)
{
    const json_t *array = json_object_get(object, key);
    for (size_t i = 0; i < count && i < json_array_size(array); i++) {
        const json_t *value = json_array_get(array, i);
        if (json_is_number(value)) numbers[i] = json_number_value(value);
    }
}

void gltf_floats(const json_t *object, const char *key, float *numbers, size_t count)
{
    double wide[4];
    for (size_t i = 0; i < count; i++)
        wide[i] = (double)numbers[i];
    gltf_numbers(object, key, wide, count);
    for (size_t i = 0; i < count; i++)
        numbers[i] = (float)wide[i];
}

json_t *gltf_extension(const json_t *object, const char *name)
{
    json_t *extension = json_object_get(json_object_get(object, "extensions"), name);
    return json_is_object(extension) ? extension : NULL;
}

/* ----- Container ----- */

static uint32_t word_at(const char *at)
{
    const unsigned char *byte = (const unsigned char *)at;
    return (uint32_t)byte[0] | (uint32_t)byte[1] << 8 | (uint32_t)byte[2] << 16 |
           (uint32_t)byte[3] << 24;
}

static int is_binary_chunk(const char *at, const char *end)
{
    return end - at >= 8 && memcmp(at + 4, "BIN", 4) == 0;
}

/* Finds the binary chunk behind the JSON; others are passed over. */
static clshear_status find_chunk(gltf_reader *reader, const char *at, const char *end)
{
    while (end - at >= 8) {
        const size_t size = word_at(at), left = (size_t)(end - at) - 8;
        if (is_binary_chunk(at, end)) {
            if (size > left)
                return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: its binary chunk was cut",
                               reader->model->path);
            reader->chunk = (const unsigned char *)at + 8;
            reader->chunk_size = size;
            return CLSHEAR_OK;
        }
        if (size > left) return CLSHEAR_OK;
        at += 8 + size;
    }
    return CLSHEAR_OK;
}

/* Where chunks go on behind the JSON: some leave the blanks that fill it up to a multiple of four
 * bytes out of its size. */
static const char *chunks_behind(const cs_bytes *bytes, size_t json_end)
{
    const char *at = bytes->data + json_end, *end = bytes->data + bytes->size;
    const size_t filled = (json_end + 3) / 4 * 4;
    if (is_binary_chunk(at, end) || filled > bytes->size) return at;
    return is_binary_chunk(bytes->data + filled, end) ? bytes->data + filled : at;
}

/* Finds the JSON in a GLB, and its binary chunk. */
static clshear_status open_binary(gltf_reader *reader, const cs_bytes *bytes, char **text,
                                  size_t *size)
{
    const char *path = reader->model->path;
    if (bytes->size < 20)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: is shorter than the head of a GLB file; it was cut", path);
    const uint32_t version = word_at(bytes->data + 4), whole = word_at(bytes->data + 8);
    if (version != 2)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: is glTF of version %u; version 2 is read", path, version);
    if (whole > bytes->size)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: has %zu bytes of the %u that its head says; it was cut", path,
                       bytes->size, whole);
    *size = word_at(bytes->data + 12);
    if (memcmp(bytes->data + 16, "JSON", 4) != 0 || *size > bytes->size - 20)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: its first chunk is no whole JSON",
                       path);
    *text = bytes->data + 20;
    return find_chunk(reader, chunks_behind(bytes, 20 + *size), bytes->data + bytes->size);
}

/* Trailing bytes, whole numbers beyond 64 bits and \u0000 in names are no harm: exporters leave
 * keys of their own in extras. */
enum {
    json_flags = JSON_DISABLE_EOF_CHECK | JSON_DECODE_INT_AS_REAL | JSON_ALLOW_NUL
};

/* The version, which some exporters write as a number or leave out. glTF 1.0 had no arrays. */
static void find_version(const json_t *root, char *version, size_t size)
{
    const json_t *given = json_object_get(json_object_get(root, "asset"), "version");
    const int has_arrays = json_is_array(json_object_get(root, "meshes"));
    if (json_is_number(given))
        cs_format_number(version, size, json_number_value(given), 6);
    else
        snprintf(version, size, "%.20s",
                 json_is_string(given) ? json_string_value(given)
                 : has_arrays          ? "2.0"
                                       : "1.0");
}

/* Refuses another version, and a file that says that readers of 2.0 cannot understand it. */
static clshear_status check_version(const gltf_reader *reader)
{
    char version[32];
    const char *path = reader->model->path;
    const json_t *least = json_object_get(json_object_get(reader->root, "asset"), "minVersion");
    const char *text = json_is_string(least) ? json_string_value(least) : "";
    double number = json_number_value(least); /* 0 where it is none */
    find_version(reader->root, version, sizeof version);
    if (version[0] != '2' || (version[1] != '.' && version[1] != '\0'))
        return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                       "%s: is glTF of version %s; version 2.0 is read", path, version);
    cs_parse_number(text, text + strlen(text), &number);
    if (!(number > 2.0)) return CLSHEAR_OK;
    return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                   "%s: needs a reader of glTF %s (asset.minVersion); version 2.0 is read", path,
                   cs_format_number(version, sizeof version, number, 6));
}

/* Reads the JSON; if that fails, once more with its strings mended, since names in another coding
 * than UTF-8 are no harm. */
static json_t *load_json(const gltf_reader *reader, char *text, size_t size, json_error_t *wrong)
{
    json_t *root = json_loadb(text, size, json_flags, wrong);
    const size_t mended = root == NULL ? gltf_mend_strings(text, size) : 0;
    if (mended == 0) return root;
    root = json_loadb(text, size, json_flags, wrong);
    if (root != NULL)
        cs_warn(reader->model->log,
                "%s: %zu characters in its names are no UTF-8; they are read as \"?\"",
                reader->model->path, mended);
    return root;
}

static clshear_status parse(gltf_reader *reader, char *text, size_t size)
{
    const char *path = reader->model->path;
    json_error_t wrong;
    if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) { /* a byte order mark in a GLB */
        text += 3;
        size -= 3;
    }
    reader->root = load_json(reader, text, size, &wrong);
    if (reader->root == NULL)
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s:%d:%d: %s", path, wrong.line,
                       wrong.column, wrong.text);
    if (!json_is_object(reader->root))
        return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: is JSON, but no glTF", path);
    return check_version(reader);
}

/* Extensions without which the file says it cannot be understood. */
static clshear_status check_required(const gltf_reader *reader)
{
    const json_t *required = json_object_get(reader->root, "extensionsRequired");
    for (size_t i = 0; i < json_array_size(required); i++) {
        const char *name = json_string_value(json_array_get(required, i));
        int known = name != NULL && gltf_reads_of_material(name);
        for (size_t k = 0; name != NULL && k < sizeof supported / sizeof *supported; k++)
            known |= strcmp(name, supported[k]) == 0;
        if (!known)
            return cs_fail(reader->error, CLSHEAR_BAD_FILE,
                           "%s: needs the extension %.80s, which is not supported; export it "
                           "without",
                           reader->model->path, name != NULL ? name : "?");
    }
    return CLSHEAR_OK;
}

/* Tells of lights that come by other extensions than the one that is read. */
static void report_lights(const gltf_reader *reader)
{
    const json_t *used = json_object_get(reader->root, "extensionsUsed");
    for (size_t i = 0; i < json_array_size(used); i++) {
        const char *name = json_string_value(json_array_get(used, i));
        if (name != NULL && strstr(name, "_lights_") != NULL &&
            strcmp(name, "KHR_lights_punctual") != 0)
            cs_warn(reader->model->log, "%s: the lights of %.80s are not supported; left out",
                    reader->model->path, name);
    }
}

static clshear_status check(const gltf_reader *reader)
{
    if (reader->model->triangles.count > 0) return CLSHEAR_OK;
    return cs_fail(reader->error, CLSHEAR_BAD_FILE, "%s: %s", reader->model->path,
                   reader->model->without_area > 0 ? "holds points and lines only; export triangles"
                                                   : "there are no triangles in its scene");
}

/* Allocates an entry for each buffer, buffer view and accessor of the file; all begin empty. */
static clshear_status reserve(gltf_reader *reader)
{
    reader->buffer_count = gltf_count(reader, "buffers");
    reader->view_count = gltf_count(reader, "bufferViews");
    reader->accessor_count = gltf_count(reader, "accessors");
    reader->buffers = calloc(reader->buffer_count + 1, sizeof *reader->buffers);
    reader->views = calloc(reader->view_count + 1, sizeof *reader->views);
    reader->unpacked = calloc(reader->accessor_count + 1, sizeof *reader->unpacked);
    if (reader->buffers != NULL && reader->views != NULL && reader->unpacked != NULL)
        return CLSHEAR_OK;
    return cs_model_full(reader->model, reader->error);
}

static void free_reader(gltf_reader *reader)
{
    for (size_t i = 0; i < reader->buffer_count && reader->buffers != NULL; i++)
        free(reader->buffers[i].owned);
    for (size_t i = 0; i < reader->view_count && reader->views != NULL; i++)
        free(reader->views[i].owned);
    for (size_t i = 0; i < reader->accessor_count && reader->unpacked != NULL; i++)
        free(reader->unpacked[i].values);
    free(reader->buffers);
    free(reader->views);
    free(reader->unpacked);
    free(reader->nodes);
    json_decref(reader->root);
    free(reader);
}

static clshear_status read_all(gltf_reader *reader, cs_bytes *bytes)
{
    clshear_status status = CLSHEAR_OK;
    cs_error *error = reader->error;
    char *text = bytes->data;
    size_t size = bytes->size;
    const int is_binary = size >= 4 && memcmp(text, "glTF", 4) == 0;
    if (is_binary) {
        CS_TRY(open_binary(reader, bytes, &text, &size));
    } else {
        CS_TRY(cs_bytes_to_utf8(bytes, reader->model->path, error));
        text = bytes->data;
        size = bytes->size;
    }
    CS_TRY(parse(reader, text, size));
    CS_TRY(check_required(reader));
    report_lights(reader);
    CS_TRY(reserve(reader));
    CS_TRY(gltf_materials(reader));
    CS_TRY(gltf_animate(reader));
    CS_TRY(gltf_nodes(reader));
    CS_TRY(check(reader));
    gltf_tell(reader);
done:
    return status;
}

clshear_status cs_read_gltf(cs_bytes *bytes, cs_model *model, cs_error *error)
{
    gltf_reader *reader = malloc(sizeof *reader);
    if (reader == NULL) return cs_model_full(model, error);
    *reader = (gltf_reader){.model = model, .error = error, .default_material = -1};
    cs_folder_of(model->path, reader->folder, sizeof reader->folder);
    const clshear_status status = read_all(reader, bytes);
    free_reader(reader);
    return status;
}
