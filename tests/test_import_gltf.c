/* glTF files, by what the reader makes of small ones. */
#include "import_support.h"

#include <stdio.h>

#include "scene/camera.h"

static void attributes_of_gltf(void **state)
{
    static const char *const map =
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}";
    (void)state;
    import_picture("my four.ppm");
    cs_scene scene =
        import_load(import_gltf_square(",\"TEXCOORD_0\":1,\"COLOR_0\":4", map, "{\"mesh\":0}", ""));
    assert_int_equal(scene.indices.count, 2);
    expect_st(&scene, 0, 0, 0);
    expect_st(&scene, 2, 1, 1);
    expect_close(import_colour(&scene, 0, 0), 1, 0, 0.2f);
    const cs_texture *texture = scene.textures.items;
    texture += import_material(&scene, 0)->texture;
    assert_int_equal(texture->lookup, CS_TEXTURE_CLAMP | CS_TEXTURE_MIRROR << CS_TEXTURE_WRAP_BITS);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    /* The second set, turned by a right angle, doubled and moved. */
    scene = import_load(
        import_gltf_square(",\"TEXCOORD_0\":1,\"TEXCOORD_1\":2",
                           "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0,"
                           "\"texCoord\":0,\"extensions\":{\"KHR_texture_transform\":{"
                           "\"texCoord\":1,\"rotation\":1.5707963267948966,\"scale\":[2,2],"
                           "\"offset\":[0.125,0]}}}}}",
                           "{\"mesh\":0}", ""));
    expect_st(&scene, 1, 0.125f + 0.5f, 1.0f + 1.0f); /* u' = v, v' = -u, of (0.5, 0.25) */
    cs_scene_free(&scene);
}

static void extensions_of_gltf(void **state)
{
    (void)state;
    import_refused(
        import_gltf_square("", "{}", "{\"mesh\":0}",
                           ",\"extensionsRequired\":[\"KHR_lights_punctual\",\"ACME_secret\"]"),
        "needs the extension ACME_secret");
    cs_scene scene = import_load(
        import_gltf_square("",
                           "{\"name\":\"m\",\"emissiveFactor\":[1,0.5,0],\"normalTexture\":"
                           "{\"index\":0},\"pbrMetallicRoughness\":{\"metallicFactor\":1},"
                           "\"extensions\":{\"KHR_materials_emissive_strength\":"
                           "{\"emissiveStrength\":10},\"ACME_fur\":{}}}",
                           "{\"mesh\":0}", ",\"extensionsRequired\":[\"KHR_mesh_quantization\"]"));
    expect_close(import_material(&scene, 0)->emission, 10, 5, 0);
    expect_close(import_material(&scene, 0)->diffuse, 1, 1, 1);
    import_warned("\"m\": not supported, left out: ACME_fur\n");
    cs_scene_free(&scene);
    import_picture("my four.ppm");
    scene = import_load(import_gltf_square(
        ",\"TEXCOORD_0\":1", "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}",
        "{\"mesh\":0}", ",\"samplers\":[{\"magFilter\":9728}]"));
    const cs_texture *texture = scene.textures.items;
    texture += import_material(&scene, 0)->texture;
    assert_int_equal(texture->lookup, CS_TEXTURE_REPEAT | CS_TEXTURE_NEAREST);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
}

/* What a file may require, and what it may hold without harm. */
static void harmless_gltf(void **state)
{
    (void)state;
    cs_scene scene = import_load(import_gltf_square(
        ",\"COLOR_0\":4",
        "{\"name\":\"a\\u0007b\",\"alphaMode\":\"BLEND\",\"extensions\":{\"ACME_fur\":{}}}",
        "{\"mesh\":0,\"children\":[1],\"extras\":{\"id\":99999999999999999999,\"n\":\"a\\u0000b\"}}"
        ","
        "{\"mesh\":0,\"camera\":0,\"extensions\":{\"KHR_node_visibility\":{\"visible\":false}}}",
        ",\"cameras\":[{\"type\":\"perspective\",\"perspective\":{\"yfov\":1,\"znear\":1}}],"
        "\"extensionsRequired\":[\"KHR_materials_ior\",\"KHR_materials_transmission\","
        "\"KHR_materials_pbrSpecularGlossiness\",\"KHR_materials_variants\"]"));
    assert_int_equal(scene.indices.count, 2);
    assert_int_equal(scene.cameras.count, 1); /* what is hidden may still look */
    import_warned("\"a?b\": not supported, left out: ACME_fur\n"); /* no code for the terminal */
    cs_scene_free(&scene);
    import_refused(import_gltf_square("", "{}", "{\"mesh\":0}",
                                      ",\"extensionsRequired\":[\"KHR_texture_basisu\"]"),
                   "needs the extension KHR_texture_basisu");
}

/* The front of a triangle is where its corners go round counter-clockwise, unless the node mirrors
 * it. */
static void mirrored_nodes(void **state)
{
    static const char *const nodes[] = {"{\"mesh\":0}", "{\"mesh\":0,\"scale\":[-1,1,1]}",
                                        "{\"mesh\":0,\"scale\":[-1,-1,1]}"};
    (void)state;
    for (size_t i = 0; i < sizeof nodes / sizeof *nodes; i++) {
        cs_scene scene = import_load(import_gltf_square("", "{}", nodes[i], ""));
        const float *a = import_position(&scene, 0, 0), *b = import_position(&scene, 0, 1);
        const float *c = import_position(&scene, 0, 2);
        assert_true((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0.0f);
        cs_scene_free(&scene);
    }
}

/* Data without base64, whose bytes are 0 too; and base64 with %XX. */
static void percents_in_data(void **state)
{
    static const char *const data[] = {
        "data:,%00%00%80%3F%00%00%00%00%00%00%00%00%00%00%00%00%00%00%80%3F%00%00%00%00"
        "%00%00%00%00%00%00%00%00%00%00%80%3f",
        "data:;base64,AACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAI%41%2F"};
    char text[1024];
    (void)state;
    for (size_t i = 0; i < sizeof data / sizeof *data; i++) {
        snprintf(text, sizeof text,
                 "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"meshes\":[{"
                 "\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
                 "\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
                 "\"bufferViews\":[{\"buffer\":0,\"byteLength\":36}],"
                 "\"buffers\":[{\"byteLength\":36,\"uri\":\"%s\"}]}",
                 data[i]);
        cs_scene scene = import_text("data.gltf", text);
        expect_close(import_position(&scene, 0, 0), 1, 0, 0);
        expect_close(import_position(&scene, 0, 1), 0, 1, 0);
        expect_close(import_position(&scene, 0, 2), 0, 0, 1);
        cs_scene_free(&scene);
    }
}

static void several_cameras_and_lights(void **state)
{
    (void)state;
    cs_scene scene = import_load(import_gltf_square(
        "", "{}",
        "{\"mesh\":0,\"children\":[1,2,3]},{\"camera\":0,\"translation\":[0,0,5]},"
        "{\"name\":\"side\",\"camera\":0,\"translation\":[3,0,0],\"extensions\":"
        "{\"KHR_lights_punctual\":{\"light\":0}}},{\"translation\":[0,7,0],\"extensions\":"
        "{\"KHR_lights_punctual\":{\"light\":0}}}",
        ",\"cameras\":[{\"name\":\"front\",\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5,"
        "\"znear\":1}}],\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\","
        "\"color\":[1,0.5,0],\"intensity\":4,\"range\":3.40282347e38}]}}"));
    const cs_scene_camera *cameras = scene.cameras.items;
    const cs_light *lights = scene.lights.items;
    assert_null(strstr(import_warnings, "range"));
    assert_int_equal(scene.cameras.count, 2);
    assert_int_equal(scene.lights.count, 2);
    expect_close(cameras[0].view.eye, 0, 0, 5);
    expect_close(cameras[1].view.eye, 3, 0, 0);
    assert_int_equal(cs_camera_find(&scene, "side"), 1);
    assert_int_equal(cs_camera_find(&scene, "front"), 0);
    assert_int_equal(cs_camera_find(&scene, "1"), 1);
    assert_int_equal(cs_camera_find(&scene, "2"), -1);
    assert_int_equal(cs_camera_find(&scene, "top"), -1);
    expect_close(lights[0].position, 3, 0, 0);
    expect_close(lights[1].position, 0, 7, 0);
    expect_close(lights[1].colour, 4, 2, 0);
    import_warned(
        "2 cameras, of which the first is used; --camera chooses: 0 \"front\", 1 \"side\"");
    cs_scene_free(&scene);
}

/* Names of images with a scheme or a question, and images that are nowhere. */
static void names_of_images(void **state)
{
    static const char *const map =
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}";
    char images[512];
    (void)state;
    import_picture("four.ppm");
    const char *const names[] = {"four.ppm?version=3#top", "file://four.ppm"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(images, sizeof images, ",\"images\":[{\"uri\":\"%s\"}]", names[i]);
        cs_scene scene =
            import_load(import_gltf_square(",\"TEXCOORD_0\":1", map, "{\"mesh\":0}", images));
        assert_string_equal(import_warnings, "");
        cs_scene_free(&scene);
    }
    cs_scene scene = import_load(import_gltf_square(",\"TEXCOORD_0\":1", map, "{\"mesh\":0}",
                                                    ",\"images\":[{\"uri\":\"\"}]"));
    import_warned("texture image 0 is not there; it is mid-grey");
    cs_scene_free(&scene);
}

static void damaged_gltf(void **state)
{
    (void)state;
    import_refused(test_file("bad.gltf", "{\"asset\":"), "bad.gltf:1:");
    import_refused(test_file("bad.glb", "version https://git-lfs.github.com/spec/v1\n"),
                   "git lfs pull");
    import_refused(test_file("bad.glb", "<html></html>"), "is a web page");
    import_refused(test_bytes("bad.gltf", "\x1f\x8b\b", 3), "unpack it");
    import_refused(test_file("bad.gltf", "{\"asset\":{\"version\":\"1.0\"}}"), "version 1.0");
    import_refused(test_bytes("bad.glb", "glTF\2\0\0\0\377\0\0\0\0\0\0\0JSON", 20), "it was cut");
    import_refused(import_gltf_square(",\"NORMAL\":99", "{}", "{\"mesh\":0}", ""), "accessors[99]");
    import_refused(import_gltf_square("", "{}", "{\"mesh\":7}", ""), "meshes[7]");
    import_refused(import_gltf_square("", "{}", "{\"mesh\":0,\"children\":[0]}", ""),
                   "nodes must be a tree");
    import_refused(import_gltf_square("", "{}", "{\"children\":[1,1]},{\"mesh\":0}", ""),
                   "nodes must be a tree");
    import_refused(import_gltf_square("", "{}", "{}", ""), "no triangles");
    import_refused(import_gltf_square(",\"TEXCOORD_0\":1",
                                      "{\"pbrMetallicRoughness\":{\"baseColorTexture\":"
                                      "{\"index\":4}}}",
                                      "{\"mesh\":0}", ""),
                   "textures[4]");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(attributes_of_gltf), cmocka_unit_test(extensions_of_gltf),
        cmocka_unit_test(harmless_gltf),      cmocka_unit_test(mirrored_nodes),
        cmocka_unit_test(percents_in_data),   cmocka_unit_test(several_cameras_and_lights),
        cmocka_unit_test(damaged_gltf),       cmocka_unit_test(names_of_images),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
