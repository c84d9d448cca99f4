/* The textures that materials of files name, from the images to the texels on the device. */
#include "exr_parts.h"
#include "material_scenes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "image/image_io.h"
#include "import/transfer.h"

/* The value of a half that is 0 or between 2^-14 and 2. */
static double value_of(uint16_t half)
{
    return half == 0 ? 0.0 : ldexp(1.0 + (half & 1023) / 1024.0, (half >> 10) - 15);
}

/* The upper left texel of a texture that counts from 1; halves keep 11 bits. */
static void expect_texel(const cs_scene *scene, cs_u32 number, double red, double green,
                         double blue, double alpha)
{
    const double wanted[4] = {red, green, blue, alpha};
    assert_in_range(number, 1, scene->textures.count);
    const cs_texture *texture = (const cs_texture *)scene->textures.items + number - 1;
    const uint16_t(*texels)[4] = scene->texels.items;
    for (int c = 0; c < 4; c++)
        assert_near(value_of(texels[texture->first][c]), wanted[c], 6e-4);
}

static cs_u32 base_of(const cs_scene *scene)
{
    return (cs_u32)(import_material(scene, 0)->texture + 1);
}

/* Colours are on the sRGB curve ((128 / 255) is 0.2158 there), numbers are not, alpha never. */
static void maps_of_gltf(void **state)
{
    (void)state;
    material_even_picture("grey.tga", 128, 255, 0, 51);
    material_even_picture("tone.tga", 128, 128, 255, 255);
    cs_scene scene = material_scene_gltf(
        "{'alphaMode':'BLEND','emissiveFactor':[2,2,2],'emissiveTexture':{'index':1},"
        "'normalTexture':{'index':1,'scale':0.5},'occlusionTexture':{'index':0},"
        "'pbrMetallicRoughness':{'baseColorTexture':{'index':0},"
        "'metallicRoughnessTexture':{'index':1}}}");
    const cs_material *m = import_material(&scene, 0);
    assert_string_equal(import_warnings, "");
    assert_int_equal(m->flags, CS_MATERIAL_BLEND);
    expect_texel(&scene, base_of(&scene), 0.2158, 1, 0, 0.2);
    expect_texel(&scene, m->emission_texture, 0.2158, 0.2158, 1, 1);
    expect_texel(&scene, m->normal_texture, 0.502, 0.502, 1, 1);
    expect_texel(&scene, m->facets_texture, 0.502, 0.502, 1, 1);
    assert_int_equal(m->normal_texture, m->facets_texture); /* read once */
    assert_true(m->normal_scale == 0.5f && m->emission[0] == 2.0f);
    assert_int_equal(*(const uint8_t *)scene.triangle_flags.items, CS_FACE_TEXTURED);
    cs_scene_free(&scene);
    scene = material_scene_gltf(
        "{'alphaMode':'MASK','pbrMetallicRoughness':{'baseColorTexture':{'index':1},"
        "'baseColorFactor':[1,1,1,0.8]}}");
    assert_int_equal(import_material(&scene, 0)->flags, 0); /* alpha is 1 in the image */
    cs_scene_free(&scene);
    scene = material_scene_gltf("{'normalTexture':{'index':1,'extensions':{'KHR_texture_transform':"
                                "{'offset':[0.5,0]}}},'pbrMetallicRoughness':{'baseColorTexture':"
                                "{'index':0}}}");
    import_warned("texture coordinates that differ between its maps");
    cs_scene_free(&scene);
}

static void maps_of_mtl(void **state)
{
    static const unsigned char ramp[16] = {0,   0,   0,   255, 255, 255, 255, 255,
                                           255, 255, 255, 255, 0,   0,   0,   255};
    (void)state;
    material_even_picture("grey.tga", 128, 128, 128, 255);
    material_even_picture("tone.tga", 255, 255, 255, 51);
    material_even_picture("bent.tga", 100, 140, 240, 255);
    material_picture("ramp.tga", ramp);
    cs_scene scene = material_scene_mtl("map_Kd grey.tga\nmap_d tone.tga");
    expect_texel(&scene, base_of(&scene), 0.2158, 0.2158, 0.2158, 0.2); /* has alpha */
    assert_int_equal(import_material(&scene, 0)->flags, CS_MATERIAL_BLEND);
    cs_scene_free(&scene);
    scene = material_scene_mtl("map_d grey.tga");
    expect_texel(&scene, base_of(&scene), 1, 1, 1, 0.502); /* has none */
    cs_scene_free(&scene);
    scene = material_scene_mtl("map_Pr grey.tga\nmap_Pm tone.tga");
    expect_texel(&scene, import_material(&scene, 0)->facets_texture, 1, 0.502, 1, 1);
    assert_true(import_material(&scene, 0)->parameters[CS_PARAMETER_METALLIC] == 1.0f);
    cs_scene_free(&scene);
    scene = material_scene_mtl("Ks 1 1 1\nNs 60\nmap_Ns grey.tga");
    expect_texel(&scene, import_material(&scene, 0)->facets_texture, 1,
                 pow(2.0 / (60 * 0.50196 + 2), 0.25), 1, 1);
    assert_true(import_material(&scene, 0)->parameters[CS_PARAMETER_ROUGHNESS] == 1.0f);
    cs_scene_free(&scene);
    scene = material_scene_mtl("map_Ke grey.tga");
    expect_texel(&scene, import_material(&scene, 0)->emission_texture, 0.2158, 0.2158, 0.2158, 1);
    assert_true(import_material(&scene, 0)->emission[0] == 1.0f);
    cs_scene_free(&scene);
    scene = material_scene_mtl("norm grey.tga");
    expect_texel(&scene, import_material(&scene, 0)->normal_texture, 0.502, 0.502, 0.502, 1);
    cs_scene_free(&scene);
    scene =
        material_scene_mtl("map_Bump -bm 0.3 ramp.tga"); /* as high on both sides of each texel */
    expect_texel(&scene, import_material(&scene, 0)->normal_texture, 0.5, 0.5, 1, 1);
    assert_true(import_material(&scene, 0)->normal_scale == 0.3f);
    cs_scene_free(&scene);
    scene = material_scene_mtl("bump bent.tga"); /* looks like normals */
    expect_texel(&scene, import_material(&scene, 0)->normal_texture, 0.392, 0.549, 0.941, 1);
    cs_scene_free(&scene);
}

/* Writes a PNG of one texel, (128, 128, 255), with a gAMA chunk: its number and checksum. */
static void write_png(const char *name, const unsigned char *gamma)
{
    unsigned char picture[] = {
        0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a, 0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44,
        0x52, 0x00, 0x00, 0x00, 0x01, 0x00, 0x00, 0x00, 0x01, 0x08, 0x02, 0x00, 0x00, 0x00, 0x90,
        0x77, 0x53, 0xde, 0x00, 0x00, 0x00, 0x04, 0x67, 0x41, 0x4d, 0x41, 0x00, 0x00, 0x00, 0x00,
        0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x0c, 0x49, 0x44, 0x41, 0x54, 0x78, 0xda, 0x63,
        0x68, 0x68, 0xf8, 0x0f, 0x00, 0x03, 0x83, 0x02, 0x00, 0x3e, 0x58, 0x28, 0x25, 0x00, 0x00,
        0x00, 0x00, 0x49, 0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
    memcpy(picture + 41, gamma, 8);
    test_bytes(name, picture, sizeof picture);
}

/* WebP's colours are not multiplied by alpha: one texel of (255, 128, 0) with the alpha 64. */
static void alpha_of_webp(void **state)
{
    static const unsigned char picture[] = {0x52, 0x49, 0x46, 0x46, 0x1c, 0x00, 0x00, 0x00, 0x57,
                                            0x45, 0x42, 0x50, 0x56, 0x50, 0x38, 0x4c, 0x10, 0x00,
                                            0x00, 0x00, 0x2f, 0x00, 0x00, 0x00, 0x10, 0x07, 0x50,
                                            0xc0, 0xfe, 0x47, 0x81, 0x02, 0x11, 0xd1, 0xff, 0x00};
    /* OpenImageIO rounds 128 times 64 / 255 to a whole number, 32, which stands for 127.5. */
    const double green = pow((127.5 / 255.0 + 0.055) / 1.055, 2.4);
    (void)state;
    test_bytes("grey.tga", picture, sizeof picture); /* found by its first bytes */
    cs_scene scene =
        material_scene_gltf("{'pbrMetallicRoughness':{'baseColorTexture':{'index':0}}}");
    expect_texel(&scene, base_of(&scene), 1, green, 0, 64.0 / 255.0);
    cs_scene_free(&scene);
}

/* Portable pixmaps are on sRGB's curve, as all integers that do not say otherwise. */
static void curve_of_pixmaps(void **state)
{
    (void)state;
    test_file("grey.ppm", "P3\n1 1\n255\n128 255 0\n");
    cs_scene scene = material_scene_mtl("map_Kd grey.ppm");
    expect_texel(&scene, base_of(&scene), 0.2158, 1, 0, 1);
    cs_scene_free(&scene);
}

/* MTL obeys the chunk: 1 / 2.2 stands for sRGB's curve, 1 is linear. glTF 2.0 has it
 * ignored. */
static void gamma_of_png(void **state)
{
    static const unsigned char usual[8] = {0x00, 0x00, 0xb1, 0x8f, 0x0b, 0xfc, 0x61, 0x05};
    static const unsigned char linear[8] = {0x00, 0x01, 0x86, 0xa0, 0x31, 0xe8, 0x96, 0x5f};
    const double on_curve = pow((128.0 / 255.0 + 0.055) / 1.055, 2.4);
    (void)state;
    write_png("usual.png", usual);
    write_png("linear.png", linear);
    cs_scene scene = material_scene_mtl("Kd 1 1 1\nmap_Kd usual.png");
    expect_texel(&scene, base_of(&scene), on_curve, on_curve, 1, 1);
    cs_scene_free(&scene);
    scene = material_scene_mtl("Kd 1 1 1\nmap_Kd linear.png");
    expect_texel(&scene, base_of(&scene), 128.0 / 255.0, 128.0 / 255.0, 1, 1);
    cs_scene_free(&scene);
    scene = material_scene_mtl("norm usual.png"); /* numbers are as they are */
    expect_texel(&scene, import_material(&scene, 0)->normal_texture, 0.502, 0.502, 1, 1);
    cs_scene_free(&scene);
    write_png("my four.ppm", linear); /* what the square's texture is called */
    scene = import_load(import_gltf_square(
        ",\"TEXCOORD_0\":2", "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}",
        "{\"mesh\":0}", ""));
    expect_texel(&scene, base_of(&scene), on_curve, on_curve, 1, 1);
    cs_scene_free(&scene);
}

/* Halves end at 65504, and there is no light below 0. */
static void texels_beyond_halves(void **state)
{
    static const float texel[3] = {1e6f, -1.0f, NAN};
    unsigned char bytes[24] = "PF\n1 1\n-1.0\n";
    (void)state;
    memcpy(bytes + 12, texel, sizeof texel);
    test_bytes("beyond.pfm", bytes, sizeof bytes);
    cs_scene scene = material_scene_mtl("Kd 1 1 1\nmap_Kd beyond.pfm");
    expect_texel(&scene, base_of(&scene), 65504, 0, 0, 1);
    cs_scene_free(&scene);
}

/* Reads a picture as environments are read, and compares what is red in its texels. */
static void expect_red(const char *path, size_t width, size_t height, const float *red)
{
    cs_error error;
    float *colours = NULL;
    size_t across = 0, down = 0;
    if (cs_image_read_colours(path, &colours, &across, &down, &error) != CLSHEAR_OK)
        fail_msg("%s", error.message);
    assert_int_equal(across, width);
    assert_int_equal(down, height);
    for (size_t i = 0; i < width * height; i++)
        assert_near(colours[3 * i], red[i], 0);
    free(colours);
}

/* Writes an EXR file of one row, `width` texels from `x` on, of a picture of `full` texels. */
static const char *write_exr(const char *name, int x, int width, int full, size_t channels,
                             const char *const *names, const float *const *planes)
{
    cs_error error;
    const char *path = test_path(name);
    const cs_picture picture = {.width = width,
                                .height = 1,
                                .x = x,
                                .full_width = full,
                                .full_height = 1,
                                .channel_count = channels,
                                .names = names,
                                .planes = planes};
    if (cs_image_write(path, &picture, &error) != CLSHEAR_OK) fail_msg("%s", error.message);
    return path;
}

/* The display window is the picture, whether the data are less or more of it. */
static void windows_of_exr(void **state)
{
    static const char *const names[] = {"R", "G", "B"};
    static const float data[] = {2, 3, 4};
    const float *const planes[] = {data, data, data};
    (void)state;
    expect_red(write_exr("part.exr", 1, 2, 4, 3, names, planes), 4, 1, (const float[]){0, 2, 3, 0});
    expect_red(write_exr("more.exr", -1, 3, 1, 3, names, planes), 1, 1, (const float[]){3});
    cs_scene scene = material_scene_mtl("Kd 1 1 1\nmap_Kd part.exr");
    expect_texel(&scene, base_of(&scene), 0, 0, 0, 1);
    cs_scene_free(&scene);
}

/* Colours are found by their names, those of the picture before those of other layers. */
static void layers_of_exr(void **state)
{
    static const char *const only[] = {"AO.R", "AO.G", "AO.B", "Depth.Z", "R"};
    static const char *const view[] = {"View.AO.R",       "View.AO.G",       "View.AO.B",
                                       "View.Combined.R", "View.Combined.G", "View.Combined.B"};
    static const char *const plain[] = {"Z", "albedo.R", "albedo.G", "albedo.B", "R", "G", "B"};
    static const float one[] = {1}, two[] = {2};
    const float *const first[] = {two, two, two, one, one};
    const float *const last[] = {one, one, one, two, two, two}, *seven[7];
    (void)state;
    for (size_t i = 0; i < 7; i++)
        seven[i] = i < 4 ? one : two;
    expect_red(write_exr("only.exr", 0, 1, 1, 5, only, first), 1, 1, two);
    expect_red(write_exr("view.exr", 0, 1, 1, 6, view, last), 1, 1, two);
    expect_red(write_exr("plain.exr", 0, 1, 1, 7, plain, seven), 1, 1, two);
}

/* The same among the parts of a file, whose names count where their channels name no layer. */
static void parts_of_exr(void **state)
{
    static const test_exr_part files[][2] = {
        {{"depth", "Z", 1}, {"main", "R,G,B", 2}},
        {{"a", "albedo.R,albedo.G,albedo.B", 1}, {"b", "combined.R,combined.G,combined.B", 2}},
        {{"a", "albedo.R,albedo.G,albedo.B", 1}, {"rgba", "R,G,B,Z", 2}},
        {{"diffuse", "R,G,B", 1}, {"View.Beauty", "R,G,B", 2}},
        {{"left", "R,G,B", 2}, {"right", "R,G,B", 1}},
        {{"beauty", "R,G,B", 2}, {"depth", "Z", 1}}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        const char *path = test_path("parts.exr");
        assert_int_equal(test_write_exr_parts(path, files[i], 2), 1);
        expect_red(path, 1, 1, (const float[]){2});
    }
}

/* A Radiance file whose head names the axes in another order, or runs along them backwards. */
static void order_of_radiance(void **state)
{
    static const struct {
        const char *head;
        float red[4]; /* of the texels 1, 2, 3, 4 in the file */
    } table[] = {{"-Y 2 +X 2", {1, 2, 3, 4}}, {"-Y 2 -X 2", {2, 1, 4, 3}},
                 {"+Y 2 -X 2", {4, 3, 2, 1}}, {"+Y 2 +X 2", {3, 4, 1, 2}},
                 {"+X 2 -Y 2", {1, 3, 2, 4}}, {"+X 2 +Y 2", {2, 4, 1, 3}},
                 {"-X 2 +Y 2", {4, 2, 3, 1}}, {"-X 2 -Y 2", {3, 1, 4, 2}}};
    static const unsigned char texels[16] = {128, 128, 128, 129, 128, 128, 128, 130,
                                             192, 192, 192, 130, 128, 128, 128, 131};
    unsigned char bytes[80];
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        const int head = snprintf((char *)bytes, sizeof bytes,
                                  "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n%s\n", table[i].head);
        memcpy(bytes + head, texels, sizeof texels);
        expect_red(test_bytes("order.hdr", bytes, (size_t)head + sizeof texels), 2, 2,
                   table[i].red);
    }
}

/* Heights that rise by 0.2 a texel to the right and by 0.4 upwards: the normal is -0.2, -0.4, 1. */
static void heights_become_normals(void **state)
{
    float texels[5 * 5 * 4];
    const double scale = 0.5 / sqrt(1.0 + 0.2 * 0.2 + 0.4 * 0.4);
    (void)state;
    for (int y = 0; y < 5; y++)
        for (int x = 0; x < 5; x++)
            for (int c = 0; c < 4; c++)
                texels[4 * (5 * y + x) + c] = 0.2f * (float)x - 0.4f * (float)y;
    assert_true(cs_texels_convert(CS_TEXELS_BUMPS, texels, 5, 5));
    const float *middle = texels + 4 * (5 * 2 + 2);
    assert_near(middle[0], 0.5 - 0.2 * scale, 1e-6);
    assert_near(middle[1], 0.5 - 0.4 * scale, 1e-6);
    assert_near(middle[2], 0.5 + scale, 1e-6);
}

/* An image within a file, a grey texel, of which materials share one or two textures, is read
 * once. */
static void shared_images(void **state)
{
    static const char *const materials =
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}},"
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":1}}}";
    (void)state;
    cs_scene scene = import_load(import_gltf_square(
        ",\"TEXCOORD_0\":1", materials, "{\"mesh\":0}",
        ",\"textures\":[{\"source\":0},{\"source\":0}],\"images\":[{\"uri\":\"data:image/"
        "png;base64,"
        "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR42mNoAAAAggCB2kUIOwAAAABJRU5ErkJggg"
        "==\"}]"));
    assert_string_equal(import_warnings, "");
    assert_int_equal(scene.materials.count, 3);
    assert_int_equal(scene.textures.count, 1);
    expect_texel(&scene, base_of(&scene), 0.2158, 0.2158, 0.2158, 1);
    cs_scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(maps_of_gltf),           cmocka_unit_test(maps_of_mtl),
        cmocka_unit_test(alpha_of_webp),          cmocka_unit_test(curve_of_pixmaps),
        cmocka_unit_test(gamma_of_png),           cmocka_unit_test(texels_beyond_halves),
        cmocka_unit_test(heights_become_normals), cmocka_unit_test(windows_of_exr),
        cmocka_unit_test(layers_of_exr),          cmocka_unit_test(parts_of_exr),
        cmocka_unit_test(order_of_radiance),      cmocka_unit_test(shared_images),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
