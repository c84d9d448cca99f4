/* glTF files that exporters write in their own way, against the specification or at its edges. */
#include "import_support.h"

#include <locale.h>
#include <stdio.h>
#include <stdlib.h>

/* A triangle whose positions are base64, with `more` after its accessor, in its primitive and its
 * file: keys that come again replace the first. */
static const char *triangle(const char *accessor, const char *primitive, const char *more)
{
    static char text[1 << 19];
    snprintf(text, sizeof text,
             "{\"nodes\":[{\"mesh\":0}],\"meshes\":[{\"primitives\":[{\"attributes\":"
             "{\"POSITION\":0}%s}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,"
             "\"count\":3,\"type\":\"VEC3\"}%s],\"bufferViews\":[{\"buffer\":0,\"byteLength\":36},"
             "{\"buffer\":1,\"byteLength\":3},{\"buffer\":1,\"byteOffset\":1,\"byteLength\":2},{"
             "\"buffer\":2,\"byteLength\":12}],"
             "\"buffers\":[{\"byteLength\":36,\"uri\":"
             "\"data:;base64,AACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/\"},"
             "{\"byteLength\":3,\"uri\":\"data:,%%00%%01%%02\"},{\"byteLength\":12,\"uri\":\"data:;"
             "base64,AAAAAAEAAAACAAAA\"}]%s}",
             primitive, accessor, more);
    return text;
}

/* Indices whose sparse part replaces the last two of three zeros. */
static void sparse_indices(void **state)
{
    (void)state;
    for (int is_based = 0; is_based < 2; is_based++) {
        char accessor[512];
        snprintf(accessor, sizeof accessor,
                 ",{%s\"componentType\":5121,\"count\":3,\"type\":\"SCALAR\",\"sparse\":{"
                 "\"count\":2,\"indices\":{\"bufferView\":2,\"componentType\":%d},"
                 "\"values\":{\"bufferView\":2}}}",
                 is_based ? "\"bufferView\":1," : "", is_based ? 5121 : 5120);
        cs_scene scene = import_text("sparse.gltf", triangle(accessor, ",\"indices\":1",
                                                             ",\"asset\":{\"version\":\"2.0\"}"));
        assert_int_equal(scene.indices.count, 1);
        expect_close(import_position(&scene, 0, 0), 1, 0, 0);
        expect_close(import_position(&scene, 0, 2), 0, 0, 1);
        cs_scene_free(&scene);
    }
}

/* Indices of which an exporter says that they have a sign. */
static void signed_indices(void)
{
    static const char *const files[] = {
        ",{\"bufferView\":1,\"componentType\":5120,\"count\":3,\"type\":\"SCALAR\"}",
        ",{\"bufferView\":3,\"componentType\":5124,\"count\":3,\"type\":\"SCALAR\"}"};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        cs_scene scene = import_text("signed.gltf", triangle(files[i], ",\"indices\":1",
                                                             ",\"asset\":{\"version\":\"2.0\"}"));
        assert_int_equal(scene.indices.count, 1);
        expect_close(import_position(&scene, 0, 0), 1, 0, 0);
        expect_close(import_position(&scene, 0, 2), 0, 0, 1);
        assert_string_equal(import_warnings, "");
        cs_scene_free(&scene);
    }
}

/* The version is a number here, also where the program's locale has decimal commas, if such a one
 * is installed. */
static void numbers_of_versions(void)
{
    static const char *const texts[] = {"2.0", "2", "2.1", "\"2\"",
                                        "\"2.1\",\"minVersion\":\"2.0\""};
    char asset[64];
    for (int with_commas = 0; with_commas < 2; with_commas++) {
        if (with_commas && setlocale(LC_ALL, "de_DE.UTF-8") == NULL) continue;
        for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
            snprintf(asset, sizeof asset, ",\"asset\":{\"version\":%s}", texts[i]);
            cs_scene scene = import_text("version.gltf", triangle("", "", asset));
            cs_scene_free(&scene);
        }
        import_refused(test_file("old.gltf", "{\"asset\":{\"version\":1.5}}"), "version 1.5;");
        import_refused(test_file("new.gltf", "{\"asset\":{\"version\":20}}"), "version 20;");
        import_refused(
            test_file("least.gltf",
                      triangle("", "", ",\"asset\":{\"version\":\"2.1\",\"minVersion\":\"2.1\"}")),
            "needs a reader of glTF 2.1 (asset.minVersion); version 2.0 is read");
    }
    setlocale(LC_ALL, "C");
}

/* What exporters write that the specification does not have, but whose meaning is plain. */
static void slips_of_exporters(void **state)
{
    static const char *const nulls =
        ",\"material\":null,\"indices\":null,\"mode\":null,\"extensions\":null,\"targets\":null";
    static const char *const files[] = {"", ",\"asset\":{\"version\":2.0}",
                                        ",\"asset\":{\"version\":\"2.0\"},\"scene\":null"};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        cs_scene scene = import_text("slip.gltf", triangle("", nulls, files[i]));
        assert_int_equal(scene.indices.count, 1);
        assert_string_equal(import_warnings, "");
        cs_scene_free(&scene);
    }
    import_refused(test_file("one.gltf", "{\"meshes\":{\"a\":{}}}"), "version 1.0");
    numbers_of_versions();
    signed_indices();
    import_refused(import_gltf_square("", "{}", "{\"mesh\":-1}", ""),
                   "an index into meshes is no whole number of 0 or more");
    import_refused(import_gltf_square("", "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{}}}",
                                      "{\"mesh\":0}", ""),
                   "an index into textures is missing");
    cs_scene scene = import_load(import_gltf_square(
        "", "{}", "{\"mesh\":0,\"children\":[1]},{\"mesh\":0,\"translation\":[9,0,0]}",
        ",\"scenes\":[{\"nodes\":[1,0,0]}]"));
    import_warned("nodes[0] and 1 more: in the scene more than once");
    assert_int_equal(scene.indices.count, 4);
    cs_scene_free(&scene);
    scene = import_load(import_gltf_square("", "{}", "{\"mesh\":0}",
                                           ",\"extensionsUsed\":[\"EXT_lights_image_based\"]"));
    import_warned("the lights of EXT_lights_image_based are not supported; left out");
    cs_scene_free(&scene);
}

/* Bytes that are taken for parts of 255 without being called so; a skin whose vertices have no
 * weight, and joints that are not there. */
static void colours_and_skins_of_exporters(void **state)
{
    static const char *const bytes =
        ",{\"bufferView\":0,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"}"
        ",{\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"}";
    (void)state;
    cs_scene scene = import_text(
        "bytes.gltf", triangle(bytes, ",\"attributes\":{\"POSITION\":0,\"COLOR_0\":1}", ""));
    expect_close(import_colour(&scene, 0, 0), 0, 0, 128.0f / 255.0f);
    cs_scene_free(&scene);
    scene = import_text("skin.gltf",
                        triangle(bytes,
                                 ",\"attributes\":{\"POSITION\":0,\"JOINTS_0\":1,\"WEIGHTS_0\":2}",
                                 ",\"nodes\":[{\"mesh\":0,\"skin\":0,\"translation\":[9,9,9]},"
                                 "{\"translation\":[0,0,3]}],\"skins\":[{\"joints\":[1]}]"));
    expect_close(import_position(&scene, 0, 0), 1, 0, 3);
    cs_scene_free(&scene);
}

/* A chain of joints, whose places are found once each: they move on and back, the last one by 3. */
static void long_skeleton(void **state)
{
    enum {
        JOINTS = 4000,
        ROOM = JOINTS * 80
    };
    static const char *const data =
        ",{\"bufferView\":0,\"componentType\":5121,\"count\":3,\"type\":\"VEC4\"}"
        ",{\"componentType\":5126,\"count\":3,\"type\":\"VEC4\"}";
    char *more = malloc(ROOM);
    size_t used = (size_t)snprintf(more, ROOM, ",\"nodes\":[{\"mesh\":0,\"skin\":0}");
    (void)state;
    for (int i = 1; i <= JOINTS; i++)
        used += (size_t)snprintf(more + used, ROOM - used,
                                 i == JOINTS ? ",{\"translation\":[0,0,%d]}"
                                             : ",{\"translation\":[0,0,%d],\"children\":[%d]}",
                                 i == JOINTS ? 3
                                 : i % 2     ? 1
                                             : -1,
                                 i + 1);
    used += (size_t)snprintf(more + used, ROOM - used, "],\"skins\":[{\"joints\":[%d", JOINTS);
    for (int i = 1; i < JOINTS; i++)
        used += (size_t)snprintf(more + used, ROOM - used, ",%d", i);
    snprintf(more + used, ROOM - used, "]}]");
    cs_scene scene =
        import_text("chain.gltf", triangle(data,
                                           ",\"attributes\":{\"POSITION\":0,\"JOINTS_0\":1,"
                                           "\"WEIGHTS_0\":2}",
                                           more));
    expect_close(import_position(&scene, 0, 0), 1, 0, 4);
    cs_scene_free(&scene);
    free(more);
}

/* Names in Latin-1, names that were cut within a character, and line breaks in them. */
static void names_in_other_codings(void **state)
{
    static const char *const names[] = {"Stra\xdf"
                                        "e",
                                        "half \\ud83d of a pair", "\xf0\x9f\x98", "two\nlines"};
    char node[128];
    (void)state;
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(node, sizeof node, "{\"mesh\":0,\"name\":\"%s\"}", names[i]);
        cs_scene scene = import_load(import_gltf_square("", "{}", node, ""));
        assert_int_equal(scene.indices.count, 2);
        import_warned("no UTF-8; they are read as \"?\"");
        cs_scene_free(&scene);
    }
    cs_scene scene = import_load(import_gltf_square(
        "", "{}", "{\"mesh\":0,\"name\":\"\xc3\xa9\xe2\x82\xac\\ud83d\\ude00\\\"\"}",
        ",\"extensionsRequired\":[\"CESIUM_RTC\",\"KHR_xmp_json_ld\"]"));
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    import_refused(import_gltf_square("", "{}", "{\"mesh\":0,\"name\":\"\xdf\",}", ""), "expected");
}

/* A GLB whose JSON begins with a byte order mark, and whose data come behind a chunk that nobody
 * knows, or behind blanks that are no part of the JSON. */
static void chunks_of_glb(void **state)
{
    static const char json[] =
        "\xef\xbb\xbf{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
        "\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{\"bufferView\":0,"
        "\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":36}],\"buffers\":[{\"byteLength\":36,\"uri\":\"\"}]} ";
    const float positions[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    const uint32_t sizes[] = {sizeof json - 1, 4, sizeof positions};
    const void *const data[] = {json, "data", positions};
    static const char *const kinds[] = {"JSON", "ODD", "BIN"};
    (void)state;
    for (int is_filled = 0; is_filled < 2; is_filled++) {
        unsigned char bytes[512] = {'g', 'l', 'T', 'F', 2};
        size_t used = 12;
        for (int i = 0; i < 3; i += 1 + is_filled) {
            memcpy(bytes + used, &sizes[i], 4);
            snprintf((char *)bytes + used + 4, 5, "%s", kinds[i]);
            memcpy(bytes + used + 8, data[i], sizes[i]);
            used += 8 + sizes[i];
            while (is_filled && i == 0 && used % 4 != 0)
                bytes[used++] = ' ';
        }
        cs_scene scene = import_load(test_bytes("odd.glb", bytes, used));
        expect_close(import_position(&scene, 0, 1), 0, 1, 0);
        cs_scene_free(&scene);
    }
    assert_true(sizes[0] % 4 != 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sparse_indices),
        cmocka_unit_test(slips_of_exporters),
        cmocka_unit_test(colours_and_skins_of_exporters),
        cmocka_unit_test(long_skeleton),
        cmocka_unit_test(names_in_other_codings),
        cmocka_unit_test(chunks_of_glb),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
