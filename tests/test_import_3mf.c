/* 3MF, whose archives are read behind the wall. */
#include "import_support.h"

#include <math.h>
#include <stdio.h>

/* An archive of a file, as it grows. */
typedef struct archive {
    unsigned char bytes[16384], directory[4096];
    size_t size, directory_size;
    unsigned count;
    uint32_t checksum; /* of the last entry */
    int is_packed;     /* entries are in deflate's stored blocks */
    int is_far;        /* sizes and places are in fields of 64 bits */
} archive;

static void put(unsigned char *bytes, size_t *size, const void *data, size_t count)
{
    memcpy(bytes + *size, data, count);
    *size += count;
}

static void put_number(unsigned char *bytes, size_t *size, uint64_t value, int count)
{
    for (int i = 0; i < count; i++)
        bytes[(*size)++] = (unsigned char)(value >> 8 * i);
}

/* The checksum of ZIP. */
static uint32_t checksum_of(const char *text)
{
    uint32_t sum = UINT32_MAX;
    for (; *text != '\0'; text++) {
        sum ^= (unsigned char)*text;
        for (int bit = 0; bit < 8; bit++)
            sum = sum >> 1 ^ ((sum & 1) != 0 ? 0xEDB88320u : 0);
    }
    return ~sum;
}

/* What the head of an entry and the directory have in common, from the version on. */
static void put_head(unsigned char *bytes, size_t *size, const archive *file, uint64_t packed,
                     uint64_t unpacked, size_t name, size_t extra)
{
    put_number(bytes, size, 20, 2);
    put_number(bytes, size, 0, 2);
    put_number(bytes, size, file->is_packed ? 8 : 0, 2);
    put_number(bytes, size, 0, 4); /* time, which nothing reads */
    put_number(bytes, size, file->checksum, 4);
    put_number(bytes, size, packed, 4);
    put_number(bytes, size, unpacked, 4);
    put_number(bytes, size, name, 2);
    put_number(bytes, size, extra, 2);
}

/* Adds an entry of the directory for bytes at a place. */
static void add_to_directory(archive *file, const char *name, uint64_t packed, uint64_t unpacked,
                             uint64_t place)
{
    const uint64_t far = UINT32_MAX;
    unsigned char *bytes = file->directory;
    size_t *size = &file->directory_size;
    put(bytes, size, "PK\1\2\24\0", 6);
    put_head(bytes, size, file, file->is_far ? far : packed, file->is_far ? far : unpacked,
             strlen(name), file->is_far ? 28 : 0);
    put_number(bytes, size, 0, 4); /* comment, disk */
    put_number(bytes, size, 0, 6); /* attributes */
    put_number(bytes, size, file->is_far ? far : place, 4);
    put(bytes, size, name, strlen(name));
    file->count++;
    if (!file->is_far) return;
    put_number(bytes, size, 1, 2);
    put_number(bytes, size, 24, 2);
    put_number(bytes, size, unpacked, 8);
    put_number(bytes, size, packed, 8);
    put_number(bytes, size, place, 8);
}

static void add_entry(archive *file, const char *name, const char *text)
{
    const size_t length = strlen(text), place = file->size;
    const size_t packed = length + (file->is_packed ? 5 : 0);
    file->checksum = checksum_of(text);
    put(file->bytes, &file->size, "PK\3\4", 4);
    put_head(file->bytes, &file->size, file, packed, length, strlen(name), 0);
    put(file->bytes, &file->size, name, strlen(name));
    if (file->is_packed) {
        file->bytes[file->size++] = 1; /* the last block, stored */
        put_number(file->bytes, &file->size, length, 2);
        put_number(file->bytes, &file->size, ~length, 2);
    }
    put(file->bytes, &file->size, text, length);
    add_to_directory(file, name, packed, length, place);
}

/* Writes the file and returns its path. */
static const char *finish(archive *file, const char *name)
{
    const size_t place = file->size;
    put(file->bytes, &file->size, file->directory, file->directory_size);
    put(file->bytes, &file->size, "PK\5\6\0\0\0\0", 8);
    put_number(file->bytes, &file->size, file->count, 2);
    put_number(file->bytes, &file->size, file->count, 2);
    put_number(file->bytes, &file->size, file->directory_size, 4);
    put_number(file->bytes, &file->size, place, 4);
    put_number(file->bytes, &file->size, 0, 2);
    return test_bytes(name, file->bytes, file->size);
}

#define MODEL(resources, build)                                                             \
    "<?xml version=\"1.0\"?><!-- <object id=\"1\"> --><model unit=\"inch\" xmlns=\"core\" " \
    "xmlns:m=\"material\" xmlns:p=\"production\"><resources>" resources                     \
    "</resources><build>" build "</build></model>"
#define TRIANGLE(more) "<triangle v1=\"0\" v2=\"1\" v3=\"2\"" more "/>"
#define OTHER(more) "<triangle v1=\"0\" v2='2' v3=\"3\"" more "></triangle>"
#define MESH(triangles)                                                         \
    "<mesh><vertices><vertex x=\"0\" y=\"0\" z=\"5\"/><vertex x=\"1\" y=\"0\" " \
    "z=\"5\" /><vertex z=\"5\"\n y=\"1\" x=\"1\"/><vertex x=\"0\" y=\"1\" "     \
    "z=\"5\"/></vertices><triangles>" triangles "</triangles></mesh>"
#define OBJECT(id, more, inside) "<object id=\"" id "\" type=\"model\"" more ">" inside "</object>"
#define ITEM(id, more) "<item objectid=\"" id "\"" more "/>"
#define BASE                                                                    \
    "<basematerials id=\"5\"><base name=\"r\" displaycolor=\"#FF0000\"/><base " \
    "name=\"g\" displaycolor=\"#808080ff\"/><base displaycolor=\"#00FF0080\"/>" \
    "</basematerials>"
#define COLOURS                                                    \
    "<m:colorgroup id=\"6\"><m:color color=\"#0000FF\"/><m:color " \
    "color=\"#00FF00\"/></m:colorgroup><m:texture2dgroup id=\"7\" texid=\"8\"/>"

static const char *plain_file(const char *name, const char *model)
{
    archive file = {0};
    add_entry(&file, "3D/3dmodel.model", model);
    return finish(&file, name);
}

static clshear_status load(const char *path, cs_scene *scene, cs_error *error)
{
    const cs_import_options options = {.smooth_degrees = -1.0};
    const cs_log log = {.warn = import_collect};
    import_warnings[0] = error->message[0] = '\0';
    cs_scene_init(scene);
    return cs_scene_import(path, &options, scene, &log, error);
}

static cs_scene load_well(const char *path)
{
    cs_scene scene;
    cs_error error;
    if (load(path, &scene, &error) != CLSHEAR_OK) fail_msg("%s", error.message);
    return scene;
}

static void expect_refusal(const char *path, const char *words)
{
    cs_scene scene;
    cs_error error;
    assert_int_equal(load(path, &scene, &error), CLSHEAR_BAD_FILE);
    if (strstr(error.message, words) == NULL)
        fail_msg("\"%s\" does not contain \"%s\"", error.message, words);
    assert_int_equal(strncmp(error.message, path, strlen(path)), 0);
    cs_scene_free(&scene);
}

/* A component turns by 90 degrees about Z after it has moved, and the item moves after that. */
static void components_in_their_places(void **state)
{
    (void)state;
    cs_scene scene = load_well(plain_file(
        "places.3mf",
        MODEL(OBJECT("2", "",
                     "<components><component objectid=\"1\" transform=\"0 1 0 -1 0 0 0 0 1 10 0 "
                     "0\"/></components>") OBJECT("1", "", MESH(TRIANGLE("")))
                  OBJECT("3", "", MESH("")),
              ITEM("2", " transform=\"2 0 0 0 2 0 0 0 2 0 100 0\""))));
    assert_int_equal(scene.indices.count, 1);
    assert_int_equal(scene.z_up, 1);
    expect_close(import_position(&scene, 0, 0), 20, 100, 10);
    expect_close(import_position(&scene, 0, 1), 20, 102, 10);
    expect_close(import_position(&scene, 0, 2), 18, 102, 10);
    expect_close(import_material(&scene, 0)->diffuse, 0.5f, 0.5f, 0.5f);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
}

/* Triangles have their own colours, or those of the object; bytes are on the sRGB curve. */
static void colours_of_triangles(void **state)
{
    (void)state;
    cs_scene scene = load_well(plain_file(
        "base.3mf",
        MODEL(BASE OBJECT("1", " pid=\"5\" pindex=\"1\"",
                          MESH(TRIANGLE(" pid=\"5\" p1=\"2\"") OTHER("") TRIANGLE(" p1=\"0\""))),
              ITEM("1", ""))));
    expect_close(import_material(&scene, 0)->diffuse, 0, 1, 0);
    assert_true(fabsf(import_material(&scene, 0)->alpha - 128.0f / 255.0f) < 1e-5f);
    expect_close(import_material(&scene, 1)->diffuse, 0.21586f, 0.21586f, 0.21586f);
    expect_close(import_material(&scene, 2)->diffuse, 1, 0, 0);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    scene = load_well(plain_file(
        "colours.3mf",
        MODEL(COLOURS OBJECT("1", "",
                             MESH(TRIANGLE(" pid=\"6\" p1=\"0\"")
                                      OTHER(" pid=\"6\" p1=\"0\" p2=\"1\" p3=\"0\"")
                                          TRIANGLE(" pid=\"7\" p1=\"0\" paint_color=\"4\""))),
              ITEM("1", ""))));
    expect_close(import_material(&scene, 0)->diffuse, 0, 0, 1);
    expect_close(import_material(&scene, 1)->diffuse, 1, 1, 1);
    expect_close(import_colour(&scene, 0, 0), 1, 1, 1);
    expect_close(import_colour(&scene, 1, 0), 0, 0, 1);
    expect_close(import_colour(&scene, 1, 1), 0, 1, 0);
    import_warned("has textures, which are not supported");
    import_warned("has paint of a slicer, which is not supported");
    cs_scene_free(&scene);
    scene = load_well(plain_file(
        "fading.3mf",
        MODEL(BASE OBJECT("1", "", MESH(TRIANGLE(" pid=\"5\" p1=\"0\" p2=\"2\" p3=\"1\""))),
              ITEM("1", ""))));
    const cs_colour *colours = scene.colours.items;
    expect_close(colours[import_corners(&scene, 0)[1]].value, 0, 1, 0);
    assert_true(fabsf(colours[import_corners(&scene, 0)[1]].alpha - 128.0f / 255.0f) < 1e-5f);
    assert_true(colours[import_corners(&scene, 0)[0]].alpha == 1.0f);
    assert_int_equal(import_material(&scene, 0)->flags, CS_MATERIAL_BLEND);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    scene = load_well(plain_file(
        "wrong.3mf",
        MODEL(BASE OBJECT("1", " pid=\"5\" pindex=\"9\"", MESH(TRIANGLE(""))), ITEM("1", ""))));
    import_warned("some triangles name colours that are not there");
    cs_scene_free(&scene);
}

/* Expects that the first triangle's colour is told to be wrong, and that it has none. */
static void expect_plain(const char *model)
{
    cs_scene scene = load_well(plain_file("plain.3mf", model));
    import_warned("some triangles name colours that are not there");
    expect_close(import_material(&scene, 0)->diffuse, 0.5f, 0.5f, 0.5f);
    cs_scene_free(&scene);
}

/* Numbers that are not whole, or below 0, are no others that happen to lie near. */
static void numbers_that_are_wrong(void **state)
{
    (void)state;
    expect_plain(
        MODEL(BASE OBJECT("1", "", MESH(TRIANGLE(" pid=\"5\" p1=\"0.3\""))), ITEM("1", "")));
    expect_plain(
        MODEL(BASE OBJECT("1", "", MESH(TRIANGLE(" pid=\"5\" p1=\"0 1\""))), ITEM("1", "")));
    expect_plain(
        MODEL(BASE OBJECT("1", " pid=\"5\" pindex=\"-1\"", MESH(TRIANGLE(""))), ITEM("1", "")));
    expect_plain(MODEL(BASE "<basematerials id=\"x\"><base displaycolor=\"#FF0000\"/>"
                            "</basematerials>" OBJECT("1", " pid=\"5\" pindex=\"1\"",
                                                      MESH(TRIANGLE(" pid=\"5.2\" p1=\"0\""))),
                       ITEM("1", "")));
}

/* Among many groups each triangle finds its own, and the last one of those that share an id. */
static void many_groups(void **state)
{
    char model[12288];
    size_t used = (size_t)snprintf(model, sizeof model, "<model><resources>");
    (void)state;
    for (int i = 0; i < 120; i++)
        used += (size_t)snprintf(model + used, sizeof model - used,
                                 "<basematerials id=\"%d\"><base displaycolor=\"%s\"/>"
                                 "</basematerials>",
                                 i % 100, i < 100 ? "#FF0000" : "#0000FF");
    snprintf(model + used, sizeof model - used, "%s",
             OBJECT("1", "",
                    MESH(TRIANGLE(" pid=\"19\" p1=\"0\"") OTHER(" pid=\"20\" p1=\"0\"") TRIANGLE(
                        " pid=\"100\" p1=\"0\""))) "</resources>"
                                                   "<build>" ITEM("1", "") "</build>"
                                                                           "</model>");
    cs_scene scene = load_well(plain_file("groups.3mf", model));
    expect_close(import_material(&scene, 0)->diffuse, 0, 0, 1);
    expect_close(import_material(&scene, 1)->diffuse, 1, 0, 0);
    expect_close(import_material(&scene, 2)->diffuse, 0.5f, 0.5f, 0.5f);
    import_warned("some triangles name colours that are not there");
    cs_scene_free(&scene);
}

/* What two tags stand for is told once. */
static void volumes_are_told_once(void **state)
{
    static const char words[] = "has volumes, which are not supported; left out";
    (void)state;
    cs_scene scene = load_well(plain_file(
        "volumes.3mf",
        MODEL("<volumetricstack id=\"3\"/><volumedata/>" OBJECT("1", "", MESH(TRIANGLE(""))),
              ITEM("1", ""))));
    import_warned(words);
    assert_null(strstr(strstr(import_warnings, words) + 1, words));
    cs_scene_free(&scene);
}

/* Objects in parts of their own, as slicers write them, packed or not, with fields of 64 bits. */
static void parts_of_their_own(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; kind++) {
        archive file = {.is_packed = kind & 1, .is_far = kind >> 1};
        add_entry(&file, "_rels/.rels",
                  "<Relationships><Relationship Type=\"x/thumbnail\" Target=\"/a.png\"/>"
                  "<Relationship Target=\"/3D/root.model\" Type=\"http://x/3dmodel\"/>"
                  "</Relationships>");
        add_entry(&file, "3D/Objects/one.model",
                  MODEL(OBJECT("1", "", MESH(TRIANGLE(""))), ITEM("1", "")));
        add_entry(&file, "3D/root.model",
                  "\xef\xbb\xbf" MODEL(OBJECT("1", "",
                                              "<components><component "
                                              "p:path=\"/3D/Objects/one.model\" objectid=\"1\" "
                                              "transform=\"1 0 0 0 1 0 0 0 1 7 0 0\"/>"
                                              "</components>"),
                                       ITEM("1", "")));
        cs_scene scene = load_well(finish(&file, "parts.3mf"));
        assert_int_equal(scene.indices.count, 1);
        expect_close(import_position(&scene, 0, 0), 7, 0, 5);
        cs_scene_free(&scene);
    }
}

static void damaged_files(void **state)
{
    static const struct {
        const char *model;
        const char *words;
    } files[] = {
        {MODEL(OBJECT("1", "", MESH("<triangle v1=\"0\" v2=\"1\" v3=\"4\"/>")), ITEM("1", "")),
         "triangle 0 of object 1 names vertex 4, but there are 4"},
        {MODEL(OBJECT("1", "", MESH("<triangle v1=\"0\" v2=\"1\" v3=\"-1\"/>")), ITEM("1", "")),
         "a <triangle> in it has no usable \"v3\": line 2 of \"/3D/3dmodel.model\""},
        {MODEL(OBJECT("1", "", MESH("<triangle v1=\"0\" v2=\"1.3\" v3=\"2\"/>")), ITEM("1", "")),
         "a <triangle> in it has no usable \"v2\""},
        {MODEL(OBJECT("1.2", "", MESH(TRIANGLE(""))), ITEM("1", "")),
         "a <object> in it has no usable \"id\""},
        {MODEL("", ITEM("9", "")), "names object 9, which is not there"},
        {MODEL(OBJECT("1", "", MESH(TRIANGLE(""))), ""), "nothing in it is to be built"},
        {MODEL(OBJECT("1", "", "<components><component objectid=\"1\"/></components>"),
               ITEM("1", "")),
         "lie within each other without an end"},
        {MODEL(OBJECT("1", "", MESH(TRIANGLE(""))), ITEM("1", " transform=\"1 0 0\"")),
         "a <item> in it has no usable \"transform\""},
        {MODEL(OBJECT("1", "", MESH(TRIANGLE(""))), ITEM("1", " path=\"/a\"")),
         "\"/a\" is not in it"},
        {"<model>\n<build>\n</model>", "line 3 of \"/3D/3dmodel.model\" in it is no XML"},
        {"<model>\n<build>\n", "line 2 of \"/3D/3dmodel.model\" in it is no XML"},
        {"", "\"/3D/3dmodel.model\" in it is no XML"},
    };
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        expect_refusal(plain_file("damaged.3mf", files[i].model), files[i].words);
    expect_refusal(test_file("damaged.3mf", "hello"), "is no ZIP archive");
    archive file = {.is_packed = 1};
    add_entry(&file, "3D/3dmodel.model", MODEL("", ""));
    file.bytes[30 + 16] = 7; /* no kind of block */
    expect_refusal(finish(&file, "damaged.3mf"), "\"3D/3dmodel.model\" in it is damaged");
    archive wrong = {0};
    add_entry(&wrong, "3D/3dmodel.model", MODEL("", ""));
    wrong.bytes[30 + 16 + 9]++; /* not as its checksum says */
    expect_refusal(finish(&wrong, "damaged.3mf"), "\"3D/3dmodel.model\" in it is damaged");
}

/* Entities are not resolved, neither those of other files nor the part's own. */
static void entities_stay_out(void **state)
{
    (void)state;
    expect_refusal(plain_file("entity.3mf",
                              "<!DOCTYPE model [<!ENTITY one SYSTEM \"entity.txt\">]>"
                              "<model><resources>" OBJECT(
                                  "&one;", "", MESH(TRIANGLE(""))) "</resources></model>"),
                   "in it is no XML");
    expect_refusal(plain_file("entity.3mf",
                              "<!DOCTYPE model [<!ENTITY one \"1\">]><model>"
                              "<resources>" OBJECT("&one;", "", "") "</resources></model>"),
                   "a <object> in it has no usable \"id\"");
    cs_scene scene = load_well(
        plain_file("amp.3mf", MODEL(OBJECT("&#49;", "", MESH(TRIANGLE(""))), ITEM("1", ""))));
    assert_int_equal(scene.indices.count, 1);
    cs_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(components_in_their_places),
        cmocka_unit_test(colours_of_triangles),
        cmocka_unit_test(numbers_that_are_wrong),
        cmocka_unit_test(volumes_are_told_once),
        cmocka_unit_test(many_groups),
        cmocka_unit_test(parts_of_their_own),
        cmocka_unit_test(damaged_files),
        cmocka_unit_test(entities_stay_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
