/* glTF files, by what they hold besides one scene of plain triangles, and what is said of it. */
#include "import_support.h"

#include <stdio.h>

#include "material_scenes.h"

/* ----- What morph targets change ----- */

/* Writes a triangle of two morph targets, of which the first counts by half and the second not, and
 * reads it. attributes: more of them; target: of the first. Accessors: 1 red (VEC4), 2 from red to
 * green and blue, 3 texture coordinates, 4 what is added to them. */
static cs_scene morphed(const char *attributes, const char *target, const char *more)
{
    static const float data[] = {
        1,  0,     0,    0,     1,  0,     0,    0, 1,              /* 0 */
        1,  0,     0,    1,     1,  0,     0,    1, 1,  0, 0,    1, /* 9 */
        -1, 1,     0.5f, 0,     -1, 1,     0.5f, 0, -1, 1, 0.5f, 0, /* 21 */
        0,  0.25f, 0,    0.25f, 0,  0.25f,                          /* 33 */
        1,  0.5f,  1,    0.5f,  1,  0.5f};                          /* 39 */
    char bytes[512], text[4096];
    test_base64(data, sizeof data, bytes);
    snprintf(text, sizeof text,
             "{\"asset\":{\"version\":\"2.0\"},\"nodes\":[{\"mesh\":0}],\"materials\":[{"
             "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
             "\"images\":[{\"uri\":\"four.ppm\"}],\"textures\":[{\"source\":0}],"
             "\"meshes\":[{\"weights\":[0.5,0],\"primitives\":[{\"material\":0,\"attributes\":"
             "{\"POSITION\":0%s},\"targets\":[{%s},{\"COLOR_0\":2}]}]}],\"accessors\":["
             "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
             "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5126,\"count\":3,\"type\":"
             "\"VEC4\"},{\"bufferView\":0,\"byteOffset\":84,\"componentType\":5126,\"count\":3,"
             "\"type\":\"VEC4\"},{\"bufferView\":0,\"byteOffset\":132,\"componentType\":5126,"
             "\"count\":3,\"type\":\"VEC2\"},{\"bufferView\":0,\"byteOffset\":156,"
             "\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d}],\"buffers\":[{\"byteLength\":%d,"
             "\"uri\":\"data:;base64,%s\"}]%s}",
             attributes, target, (int)sizeof data, (int)sizeof data, bytes, more);
    import_picture("four.ppm");
    return import_text("morphed.gltf", text);
}

static void morphs_of_colours_and_textures(void **state)
{
    (void)state;
    cs_scene scene = morphed(",\"COLOR_0\":1", "\"COLOR_0\":2", "");
    expect_close(import_colour(&scene, 0, 0), 0.5f, 0.5f, 0.25f);
    cs_scene_free(&scene);
    scene = morphed(",\"TEXCOORD_0\":3", "\"TEXCOORD_0\":4", "");
    expect_st(&scene, 0, 0.5f, 1.0f - 0.5f); /* (0, 0.25) and half of (1, 0.5) */
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
}

/* Bytes of colours are parts of 1, in the targets as in what they change, even if the accessor does
 * not say so. */
static void morphs_of_bytes(void **state)
{
    (void)state;
    cs_scene scene = import_load(import_gltf_square(
        "", "{}", "{\"mesh\":0}",
        ",\"meshes\":[{\"weights\":[-0.5],\"primitives\":[{\"attributes\":{\"POSITION\":0,"
        "\"COLOR_0\":1},\"targets\":[{\"COLOR_0\":1}]}]}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":104,\"componentType\":5121,\"count\":3,\"type\":"
        "\"VEC4\"}]"));
    expect_close(import_colour(&scene, 0, 0), 0.5f, 0, 0.1f);
    cs_scene_free(&scene);
}

/* ----- Scenes, points and lines ----- */

static void what_is_not_shown(void **state)
{
    (void)state;
    cs_scene scene = import_load(
        import_gltf_square("", "{}", "{\"mesh\":0},{\"mesh\":0},{\"mesh\":0}",
                           ",\"scene\":1,\"scenes\":[{\"nodes\":[0]},{\"nodes\":[1,2]}]"));
    assert_int_equal(scene.indices.count, 4);
    import_warned("2 scenes, of which number 1 is shown");
    cs_scene_free(&scene);
    scene = import_load(import_gltf_square(
        "", "{}", "{\"mesh\":0}",
        ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":1},"
        "{\"attributes\":{\"POSITION\":0},\"indices\":3},{\"attributes\":{\"POSITION\":0},"
        "\"mode\":0}]}]"));
    assert_int_equal(scene.indices.count, 2);
    import_warned("meshes[0].primitives[0] and 1 more: points and lines are left out");
    cs_scene_free(&scene);
    import_refused(
        import_gltf_square(
            "", "{}", "{\"mesh\":0}",
            ",\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":3}]}]"),
        "holds points and lines only");
}

/* ----- Animations ----- */

/* Reads the square at the time 0 with an animation of one channel, whose curve has a key of `type`,
 * the first position's numbers, at the time 0; is_played as there. */
static clshear_status animated(const char *type, const char *target, const char *more,
                               cs_scene *scene, cs_error *error)
{
    const cs_log log = {.warn = import_collect};
    const cs_import_options options = {.smooth_degrees = -1.0, .is_played = 1};
    char text[2048];
    snprintf(text, sizeof text,
             ",\"animations\":[{\"samplers\":[{\"input\":5,\"output\":6}],\"channels\":[{"
             "\"sampler\":0,\"target\":{%s}}]}%s],\"extensionsRequired\":["
             "\"KHR_animation_pointer\"],\"accessors\":["
             "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},{},{},"
             "{\"bufferView\":0,\"byteOffset\":96,\"componentType\":5121,\"count\":6,"
             "\"type\":\"SCALAR\"},{},{\"componentType\":5126,\"count\":1,\"type\":\"SCALAR\"},"
             "{\"bufferView\":0,\"componentType\":5126,\"count\":1,\"type\":\"%s\"}]",
             target, more, type);
    import_warnings[0] = error->message[0] = '\0';
    cs_scene_init(scene);
    return cs_import_here(import_gltf_square("", "{}", "{\"mesh\":0}", text), &options, NULL, scene,
                          &log, error);
}

static void animations_by_pointers(void **state)
{
    cs_scene scene;
    cs_error error;
    (void)state;
    assert_int_equal(animated("VEC3",
                              "\"path\":\"pointer\",\"extensions\":{\"KHR_animation_pointer\":"
                              "{\"pointer\":\"/nodes/0/translation\"}}",
                              "", &scene, &error),
                     CLSHEAR_OK);
    expect_close(import_position(&scene, 0, 0), -2, -2, 0); /* moved by itself */
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    const char *const others[] = {"/materials/0/emissiveFactor", "/nodes/0/extensions/ACME/size",
                                  "/nodes/x/scale", ""};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        char target[256];
        snprintf(target, sizeof target,
                 "\"path\":\"pointer\",\"extensions\":{\"KHR_animation_pointer\":{\"pointer\":"
                 "\"%s\"}}",
                 others[i]);
        assert_int_equal(animated("VEC3", target, ",{}", &scene, &error), CLSHEAR_OK);
        expect_close(import_position(&scene, 0, 0), -1, -1, 0);
        import_warned("animations[0].channels[0]: moves no node, but something else, which stands "
                      "still\n");
        import_warned("2 animations, of which the first is played\n");
        cs_scene_free(&scene);
    }
}

static void curves_of_other_widths(void **state)
{
    cs_scene scene;
    cs_error error;
    (void)state;
    assert_int_equal(animated("VEC3", "\"node\":0,\"path\":\"rotation\"", "", &scene, &error),
                     CLSHEAR_BAD_FILE);
    assert_non_null(
        strstr(error.message, "animations[0]: a curve of rotation has 3 numbers a key"));
    cs_scene_free(&scene);
}

/* ----- Materials ----- */

/* Layers lie on a surface of the old extension as on one of the new. */
static void layers_on_glossiness(void **state)
{
    (void)state;
    cs_scene scene = material_scene_gltf(
        "{'extensions':{'KHR_materials_pbrSpecularGlossiness':{'specularFactor':[0,0,0]},"
        "'KHR_materials_clearcoat':{'clearcoatFactor':0.75,'clearcoatTexture':{'index':0}},"
        "'KHR_materials_transmission':{'transmissionFactor':0.5}}}");
    const cs_material *material = import_material(&scene, 0);
    assert_true(material->parameters[CS_PARAMETER_COAT] == 0.75f);
    assert_true(material->parameters[CS_PARAMETER_TRANSMISSION] == 0.5f);
    import_warned("a map of the clear coat");
    cs_scene_free(&scene);
}

/* What is asked for is told, unless its factor is 0 or the surface is unlit. */
static void what_materials_ask_for(void **state)
{
    static const struct {
        const char *material, *words; /* "": nothing is said */
    } files[] = {
        {"'alphaMode':'ADD'", "an alphaMode that glTF does not have (taken as OPAQUE)"},
        {"'extensions':{'KHR_materials_iridescence':{'iridescenceFactor':0.5}}",
         "left out: KHR_materials_iridescence\n"},
        {"'extensions':{'KHR_materials_iridescence':{},'KHR_materials_dispersion':{'dispersion':0},"
         "'KHR_materials_anisotropy':{},'KHR_materials_diffuse_transmission':{}}",
         ""},
        {"'extensions':{'KHR_materials_clearcoat':{'clearcoatTexture':{'index':0}},"
         "'KHR_materials_sheen':{'sheenColorTexture':{'index':0}},'KHR_materials_specular':"
         "{'specularFactor':0,'specularColorFactor':[1,0,0],'specularColorTexture':{'index':0}},"
         "'KHR_materials_transmission':{'transmissionTexture':{'index':0}}}",
         ""},
        {"'extensions':{'KHR_materials_unlit':{},'KHR_materials_clearcoat':{'clearcoatFactor':1,"
         "'clearcoatTexture':{'index':0}}}",
         ""}};
    char text[512];
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        snprintf(text, sizeof text, "{%s}", files[i].material);
        cs_scene scene = material_scene_gltf(text);
        if (*files[i].words == '\0')
            assert_string_equal(import_warnings, "");
        else
            import_warned(files[i].words);
        cs_scene_free(&scene);
    }
    cs_scene scene = import_load(import_gltf_square(
        "", "{\"alphaMode\":\"mask\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0.2]}}",
        "{\"mesh\":0}", ""));
    assert_int_equal(import_material(&scene, 0)->flags, CS_MATERIAL_MASK);
    assert_string_equal(import_warnings, "");
    cs_scene_free(&scene);
    import_refused(import_gltf_square("", "1", "{\"mesh\":0}", ""),
                   "materials[0]: is no object of JSON");
}

/* Attributes whose items are too short are refused: they would be read as others. So are joints
 * without weights. */
static void short_attributes(void **state)
{
    static const char *const files[][2] = {
        {",\"NORMAL\":2",
         "meshes[0].primitives[0]: its NORMAL has 2 numbers a vertex, but needs 3"},
        {",\"COLOR_0\":2",
         "meshes[0].primitives[0]: its COLOR_0 has 2 numbers a vertex, but needs 3"},
        {",\"TEXCOORD_0\":3",
         "meshes[0].primitives[0]: its TEXCOORD_0 has 1 number a vertex, but needs 2"}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        import_refused(
            import_gltf_square(files[i][0],
                               "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}",
                               "{\"mesh\":0}", ""),
            files[i][1]);
    import_refused(import_gltf_square(",\"JOINTS_0\":4", "{}", "{\"mesh\":0,\"skin\":0}",
                                      ",\"skins\":[{\"joints\":[0]}]"),
                   "meshes[0].primitives[0]: has JOINTS_0, but no WEIGHTS_0");
}

/* ----- Images within the file ----- */

/* Reads the square with an image of these bytes. */
static cs_scene with_image(const void *bytes, size_t size)
{
    char base64[256], images[512];
    test_base64(bytes, size, base64);
    snprintf(images, sizeof images, ",\"images\":[{\"uri\":\"data:image/png;base64,%s\"}]", base64);
    return import_load(import_gltf_square(
        ",\"TEXCOORD_0\":1", "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}",
        "{\"mesh\":0}", images));
}

static void images_of_other_kinds(void **state)
{
    static const struct {
        const char *bytes;
        size_t size;
        const char *words;
    } kinds[] = {{"\xabKTX 20\xbb\r\n\x1a\n", 12, "KTX2 images are not read from within a file"},
                 {"\0\0\0\x1c"
                  "ftypavif",
                  12, "AVIF images are not read from within a file"},
                 {"<svg xmlns=''/>", 15, "SVG images are not read from within a file"},
                 {"nothing", 7, "not an image that can be read"},
                 {"", 0, "has no bytes"}};
    char line[128];
    (void)state;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        cs_scene scene = with_image(kinds[i].bytes, kinds[i].size);
        snprintf(line, sizeof line, "texture embedded image 0: %s; it is mid-grey\n",
                 kinds[i].words);
        import_warned(line);
        cs_scene_free(&scene);
    }
}

/* A Targa file is known by its end. */
static void targa_within_the_file(void **state)
{
    unsigned char bytes[18 + 1 + 3 + 26] = {
        [0] = 1, [2] = 2, [12] = 1, [14] = 1, [16] = 24, [19] = 0, 0, 255};
    (void)state;
    memcpy(bytes + sizeof bytes - 18, "TRUEVISION-XFILE.", 18);
    cs_scene scene = with_image(bytes, sizeof bytes);
    assert_string_equal(import_warnings, "");
    assert_true(import_material(&scene, 0)->texture != CS_NO_TEXTURE);
    cs_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(morphs_of_colours_and_textures),
        cmocka_unit_test(morphs_of_bytes),
        cmocka_unit_test(what_is_not_shown),
        cmocka_unit_test(animations_by_pointers),
        cmocka_unit_test(curves_of_other_widths),
        cmocka_unit_test(layers_on_glossiness),
        cmocka_unit_test(what_materials_ask_for),
        cmocka_unit_test(short_attributes),
        cmocka_unit_test(images_of_other_kinds),
        cmocka_unit_test(targa_within_the_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
