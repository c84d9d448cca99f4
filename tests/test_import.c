/* Readers of scene files, by what they make of small files; without a device. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/number.h"
#include "image/image_io.h"
#include "import/import.h"
#include "scene/camera.h"

#define SQUARE "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n"
#define COORDINATES "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
#define TEXTURED SQUARE COORDINATES "usemtl t\nf 1/1 2/2 3/3 4/4\n"

/* ----- Support ----- */

static char warnings[8192];

static const char *gltf_square(const char *attributes, const char *material, const char *nodes,
                               const char *more);

static void collect(void *user, const char *line)
{
    const size_t used = strlen(warnings);
    (void)user;
    snprintf(warnings + used, sizeof warnings - used, "%s\n", line);
}

static const char *path_of(const char *name)
{
    static char paths[8][512];
    static int next;
    char *path = paths[next = (next + 1) % 8];
    snprintf(path, 512, "%s/%s", SCRATCH, name);
    return path;
}

static const char *write_bytes(const char *name, const void *bytes, size_t size)
{
    const char *path = path_of(name);
    FILE *stream = fopen(path, "wb");
    assert_non_null(stream);
    assert_int_equal(fwrite(bytes, 1, size, stream), size);
    fclose(stream);
    return path;
}

static const char *write_text(const char *name, const char *text)
{
    return write_bytes(name, text, strlen(text));
}

/* A 2 x 2 picture: red, green, blue, white; the first row is the upper one. */
static void write_picture(const char *name)
{
    const unsigned char bytes[] = {'P', '6', '\n', '2', ' ', '2', '\n', '2', '5', '5', '\n', 255,
                                   0,   0,   0,    255, 0,   0,   0,    255, 255, 255, 255};
    write_bytes(name, bytes, sizeof bytes);
}

static clshear_status read_smooth(const char *path, double degrees, cs_scene *scene,
                                  cs_error *error)
{
    const cs_log log = {.warn = collect};
    const cs_import_options options = {.smooth_degrees = degrees};
    warnings[0] = error->message[0] = '\0';
    cs_scene_init(scene);
    return cs_import_here(path, &options, NULL, scene, &log, error);
}

static cs_scene load(const char *path)
{
    cs_scene scene;
    cs_error error;
    if (read_smooth(path, -1.0, &scene, &error) != CLSHEAR_OK) fail_msg("%s", error.message);
    return scene;
}

static cs_scene load_text(const char *name, const char *text)
{
    return load(write_text(name, text));
}

/* Fails to load, in one line that begins with the file's name and contains `words`. */
static void refuse(const char *path, const char *words)
{
    cs_scene scene;
    cs_error error;
    assert_int_equal(read_smooth(path, -1.0, &scene, &error), CLSHEAR_BAD_FILE);
    if (strstr(error.message, words) == NULL)
        fail_msg("\"%s\" does not contain \"%s\"", error.message, words);
    assert_null(strchr(error.message, '\n'));
    assert_int_equal(strncmp(error.message, path, strlen(path)), 0);
    cs_scene_free(&scene);
}

static void expect_warning(const char *words)
{
    if (strstr(warnings, words) == NULL)
        fail_msg("\"%s\" does not contain \"%s\"", warnings, words);
}

static const cs_material *material_of(const cs_scene *scene, size_t triangle)
{
    const uint32_t *numbers = scene->triangle_materials.items;
    return (const cs_material *)scene->materials.items + numbers[triangle];
}

static void expect_close(const float *values, float a, float b, float c)
{
    const float expected[3] = {a, b, c};
    for (int i = 0; i < 3; i++)
        if (!(fabsf(values[i] - expected[i]) < 1e-4f))
            fail_msg("%g %g %g is not %g %g %g", (double)values[0], (double)values[1],
                     (double)values[2], (double)a, (double)b, (double)c);
}

static const uint32_t *corners_of(const cs_scene *scene, size_t triangle)
{
    return ((const uint32_t(*)[3])scene->indices.items)[triangle];
}

static const cs_vertex *vertex_of(const cs_scene *scene, size_t triangle, int corner)
{
    return (const cs_vertex *)scene->vertices.items + corners_of(scene, triangle)[corner];
}

static const float *position_of(const cs_scene *scene, size_t triangle, int corner)
{
    return ((const float(*)[3])scene->positions.items)[corners_of(scene, triangle)[corner]];
}

static const float *colour_of(const cs_scene *scene, size_t triangle, int corner)
{
    assert_int_equal(scene->colours.count, scene->positions.count);
    return ((const cs_colour *)scene->colours.items)[corners_of(scene, triangle)[corner]].value;
}

static void expect_st(const cs_scene *scene, int corner, float s, float t)
{
    const float *st = vertex_of(scene, 0, corner)->texture;
    if (fabsf(st[0] - s) > 1e-5f || fabsf(st[1] - t) > 1e-5f)
        fail_msg("%g %g is not %g %g", (double)st[0], (double)st[1], (double)s, (double)t);
}

static double area_of(const cs_scene *scene)
{
    double sum = 0.0;
    for (size_t i = 0; i < scene->indices.count; i++) {
        const float *a = position_of(scene, i, 0), *b = position_of(scene, i, 1);
        const float *c = position_of(scene, i, 2);
        sum += 0.5 * fabs((double)((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])));
    }
    return sum;
}

/* ----- OBJ and MTL ----- */

static void marks_line_ends_and_encodings(void **state)
{
    static const char *const texts[] = {
        "\xef\xbb\xbfmtllib red.mtl\n" SQUARE "usemtl r\nf 1 2 3 4\n",
        "mtllib red.mtl\r\nv -1 -1 0\r\nv 1 -1 0\r\nv 1 1 0\r\nv -1 1 0\r\nusemtl r\r\nf 1 2 3 4",
        "mtllib red.mtl\rv -1 -1 0\rv 1 -1 0\rv 1 1 0\rv -1 1 0\rusemtl r\rf 1 2 3 4\r",
        "mtllib red.mtl\n" SQUARE "# a comment \\\nusemtl r\nf 1 2 \\\n 3 4\n",
        "usemtl r\n" SQUARE "f -4 -3 -2 -1\nmtllib red.mtl\n",
        "mtllib red.mtl\nusemtl r\nf 1 2 3 4\n" SQUARE};
    (void)state;
    write_text("red.mtl", "\xef\xbb\xbfnewmtl r\nKd 1 0 0\n");
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        cs_scene scene = load_text("marks.obj", texts[i]);
        assert_int_equal(scene.indices.count, 2);
        expect_close(material_of(&scene, 0)->diffuse, 1, 0, 0);
        assert_string_equal(warnings, "");
        cs_scene_free(&scene);
    }
    for (int big = 0; big < 2; big++) {
        const char *text = texts[5];
        char wide[1024] = {0};
        size_t size = 2;
        memcpy(wide, big ? "\xfe\xff" : "\xff\xfe", 2);
        for (; *text != '\0'; text++, size += 2)
            wide[size + (size_t)big] = *text;
        cs_scene scene = load(write_bytes("wide.obj", wide, size));
        expect_close(material_of(&scene, 0)->diffuse, 1, 0, 0);
        cs_scene_free(&scene);
    }
}

static void maps_are_found_wherever_they_are(void **state)
{
    static const char *const lines[] = {"map_Kd four.ppm",
                                        "map_Kd \"four.ppm\"",
                                        "map_Kd .\\four.ppm",
                                        "map_Kd FOUR.ppm",
                                        "map_Kd C:\\Users\\x\\four.ppm",
                                        "map_Kd -blendu on -texres 64 -imfchan l four.ppm",
                                        "map_kd\t four.ppm  "};
    char text[256];
    (void)state;
    mkdir(path_of("materials"), 0700);
    write_picture("materials/four.ppm");
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        snprintf(text, sizeof text, "newmtl t\nKd 1 1 1\n%s\n", lines[i]);
        write_text("materials/sub.mtl", text);
        cs_scene scene = load_text("sub.obj", "mtllib materials\\sub.mtl\n" TEXTURED);
        assert_string_equal(warnings, "");
        assert_int_equal(scene.textures.count, 1);
        assert_int_equal(material_of(&scene, 0)->texture, 0);
        cs_scene_free(&scene);
    }
}

static void map_options_are_obeyed(void **state)
{
    (void)state;
    write_picture("four.ppm");
    write_text("options.mtl", "newmtl t\nKd 1 1 1\nmap_Kd -s 2 3 1 -o 0.5 0.25 0 -clamp on "
                              "-mm 0.25 0.5 four.ppm\n");
    cs_scene scene = load_text("options.obj", "mtllib options.mtl\n" TEXTURED);
    const cs_texture *texture = scene.textures.items;
    texture += material_of(&scene, 0)->texture;
    assert_int_equal(texture->wrap, CS_TEXTURE_CLAMP | CS_TEXTURE_CLAMP << CS_TEXTURE_WRAP_BITS);
    expect_st(&scene, 0, 0.5f, 0.25f);
    expect_st(&scene, 2, 2.5f, 3.25f);
    const uint16_t *texel = (const uint16_t *)scene.texels.items + 4 * texture->first;
    assert_int_equal(texel[0], 0x3a00); /* 0.75 */
    assert_int_equal(texel[1], 0x3400); /* 0.25 */
    assert_string_equal(warnings, "");
    cs_scene_free(&scene);
}

/* Exporters of MTL leave Kd 0 beside a map; in glTF black is black. */
static void black_beside_a_map(void **state)
{
    (void)state;
    write_picture("four.ppm");
    write_text("black.mtl", "newmtl t\nKd 0 0 0\nmap_Kd four.ppm\n");
    cs_scene scene = load_text("black.obj", "mtllib black.mtl\n" TEXTURED);
    expect_close(material_of(&scene, 0)->diffuse, 1, 1, 1);
    cs_scene_free(&scene);
    write_picture("my four.ppm");
    scene = load(gltf_square(",\"TEXCOORD_0\":1",
                             "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0},"
                             "\"baseColorFactor\":[0,0,0,1]}}",
                             "{\"mesh\":0}", ""));
    expect_close(material_of(&scene, 0)->diffuse, 0, 0, 0);
    cs_scene_free(&scene);
}

static void what_is_missing_is_told_once(void **state)
{
    (void)state;
    cs_scene scene = load_text("missing.obj", "mtllib gone.mtl\nmtllib gone.mtl\n" SQUARE
                                              "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
    expect_warning("material file gone.mtl not found");
    assert_ptr_equal(strchr(warnings, '\n'), warnings + strlen(warnings) - 1);
    cs_scene_free(&scene);
    write_text("some.mtl", "newmtl a\nKd 1 0 0\nmap_Kd none.png\nnewmtl c\nKd 1 1 1\n"
                           "map_Kd none.png\n");
    scene = load_text("some.obj", "mtllib some.mtl\n" SQUARE COORDINATES
                                  "usemtl a\nf 1/1 2/2 3/3\nusemtl c\nf 1/1 3/3 4/4\n"
                                  "usemtl lost\nf 1 2 4\n");
    expect_warning("texture none.png is not there");
    expect_warning("material \"lost\" is not defined");
    assert_int_equal(strstr(strstr(warnings, "none.png") + 1, "none.png") == NULL, 1);
    expect_close(material_of(&scene, 0)->diffuse, 0.5f, 0.5f, 0.5f);
    cs_scene_free(&scene);
}

static void material_lines(void **state)
{
    (void)state;
    write_text("lines.mtl", "newmtl a\nKd 0.25\nnewmtl b\nKd 2 1 1\nKe 1 2 3\n"
                            "newmtl c\nKd xyz 1 1 1\nPm 1\nPr 0.2\nmap_Bump x.png\nd 0.5\naniso 1\n"
                            "map_Ks y.png\n");
    cs_scene scene =
        load_text("lines.obj", "mtllib lines.mtl\n" SQUARE "usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n"
                               "usemtl c\nf 1 2 4\n");
    expect_close(material_of(&scene, 0)->diffuse, 0.25f, 0.25f, 0.25f);
    expect_close(material_of(&scene, 1)->diffuse, 2, 1, 1);
    expect_close(material_of(&scene, 1)->emission, 1, 2, 3);
    expect_warning("\"b\" has the colour 2 1 1: above 1");
    expect_warning("lines.mtl:7: Kd \"xyz 1 1 1\" is not a number");
    expect_warning("texture x.png is not there; it is left out");
    expect_warning("\"c\": not supported, left out: anisotropy, a map of highlights\n");
    cs_scene_free(&scene);
}

static void vertex_colours_of_obj(void **state)
{
    (void)state;
    cs_scene scene = load_text("colours.obj", "v -1 -1 0 1 0 0\nv 1 -1 0 1 0 0.5 0\nv 1 1 0 0 0 2\n"
                                              "v -2 2 0 2\nf 1 2 3\nf 1 3 4\n");
    expect_close(colour_of(&scene, 0, 0), 1, 0, 0);
    expect_close(colour_of(&scene, 0, 1), 0, 0.21404f, 0); /* the sRGB curve */
    expect_close(colour_of(&scene, 0, 2), 0, 0, 2);
    expect_close(colour_of(&scene, 1, 2), 1, 1, 1); /* none given */
    expect_close(position_of(&scene, 1, 2), -1, 1, 0);
    const uint8_t *flags = scene.triangle_flags.items;
    assert_int_equal(flags[0], CS_FACE_COLOURED);
    const cs_material *materials = scene.materials.items;
    const uint32_t *numbers = scene.triangle_materials.items;
    expect_close(materials[numbers[0]].diffuse, 1, 1, 1); /* what the colours multiply */
    cs_scene_free(&scene);
}

static void texture_without_coordinates(void **state)
{
    (void)state;
    write_picture("four.ppm");
    write_text("plain.mtl", "newmtl t\nKd 1 1 1\nmap_Kd four.ppm\n");
    cs_scene scene = load_text("plain.obj", "mtllib plain.mtl\n" SQUARE COORDINATES
                                            "usemtl t\nf 1/1 2/2 3/3\nf 1 3 4\n");
    const uint8_t *flags = scene.triangle_flags.items;
    assert_int_equal(flags[0], CS_FACE_TEXTURED);
    assert_int_equal(flags[1], 0);
    expect_warning("\"t\" has a texture, but 1 of its triangles have no texture coordinates");
    cs_scene_free(&scene);
}

static void polygons_keep_their_area(void **state)
{
    (void)state;
    char text[8192] = "";
    cs_scene scene = load_text("arrow.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 0.5 0\nv 0 2 0\n"
                                            "f 1 2 3 4 5\nf 5 4 3 2 1\n");
    assert_true(fabs(area_of(&scene) - 2.0 * 2.5) < 1e-6);
    cs_scene_free(&scene);
    double expected = 0.0;
    for (int i = 0; i < 60; i++) { /* a star */
        const double angle = 6.283185307179586 * i / 60, radius = i % 2 == 0 ? 1.0 : 0.4;
        snprintf(text + strlen(text), sizeof text - strlen(text), "v %.9f %.9f 0\n",
                 radius * cos(angle), radius * sin(angle));
        expected += 0.5 * 0.4 * sin(6.283185307179586 / 60);
    }
    strcat(text, "f");
    for (int i = 0; i < 60; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), " %d", i + 1);
    scene = load_text("star.obj", text);
    assert_int_equal(scene.indices.count, 58);
    assert_true(fabs(area_of(&scene) - expected) < 1e-6);
    cs_scene_free(&scene);
}

static void damaged_obj(void **state)
{
    (void)state;
    refuse(write_text("bad.obj", SQUARE "f 1 2 9\n"), "bad.obj:5: the face names vertex 9");
    refuse(write_text("bad.obj", SQUARE "f 1/3 2 3\n"), "bad.obj:5: the face names texture");
    refuse(write_text("bad.obj", SQUARE "f 1 2 0\n"), "bad.obj:5:");
    refuse(write_text("bad.obj", SQUARE "f 1 2 -5\n"), "bad.obj:5:");
    refuse(write_text("bad.obj", SQUARE "f 1 \\\n2 x\n"), "bad.obj:5: \"x\" is no corner");
    refuse(write_text("bad.obj", "v 1 2\n"), "bad.obj:1: a vertex needs three numbers");
    refuse(write_text("bad.obj", "v 1 2 nan\nv 0 0 0\nv 1 0 0\nf 1 2 3\n"), "not a finite number");
    refuse(write_text("bad.obj", SQUARE "l 1 2\n"), "points and lines only");
    refuse(write_text("bad.obj", SQUARE "curv 0 1 1 2\n"), "free-form");
    refuse(write_text("bad.obj", "hello\n"), "is it one?");
    refuse(write_text("bad.obj", ""), "is empty");
    refuse(SCRATCH, "is a folder");
}

/* ----- Smoothness ----- */

#define ROOF "v -1 0 0\nv 0 0 1\nv 1 0 0\nv -1 1 0\nv 0 1 1\nv 1 1 0\n"

static void smoothing_groups_and_angles(void **state)
{
    cs_scene scene;
    cs_error error;
    (void)state;
    /* Two planes that meet at a right angle. */
    scene = load_text("roof.obj", ROOF "s 1\nf 1 2 5 4\nf 2 3 6 5\n");
    expect_close(vertex_of(&scene, 0, 1)->normal, 0, 0, 1);
    cs_scene_free(&scene);
    scene = load_text("roof.obj", ROOF "s 1\nf 1 2 5 4\ns 2\nf 2 3 6 5\n");
    expect_close(vertex_of(&scene, 0, 1)->normal, -0.70711f, 0, 0.70711f);
    cs_scene_free(&scene);
    const char *flat = write_text("flat.obj", ROOF "s off\nf 1 2 5 4\nf 2 3 6 5\n");
    scene = load(flat);
    assert_int_equal(*(const uint8_t *)scene.triangle_flags.items, 0);
    cs_scene_free(&scene);
    assert_int_equal(read_smooth(flat, 80.0, &scene, &error), CLSHEAR_OK);
    expect_close(vertex_of(&scene, 0, 1)->normal, -0.70711f, 0, 0.70711f);
    cs_scene_free(&scene);
    assert_int_equal(read_smooth(flat, 100.0, &scene, &error), CLSHEAR_OK);
    expect_close(vertex_of(&scene, 0, 1)->normal, 0, 0, 1);
    cs_scene_free(&scene);
}

/* ----- PLY ----- */

#define PLY_HEAD                                                                    \
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n" \
    "property float z\n"
#define PLY_POINTS "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n"
#define PLY_FACE "element face 1\nproperty list uchar int vertex_indices\n"

static void layouts_of_ply(void **state)
{
    (void)state;
    cs_scene scene = load_text("strip.ply", PLY_HEAD "element tristrips 1\nproperty list int int "
                                                     "vertex_indices\nend_header\n" PLY_POINTS
                                                     "8 0 1 3 2 -1 0 1 2\n");
    assert_int_equal(scene.indices.count, 3);
    assert_true(fabs(area_of(&scene) - 6.0) < 1e-6);
    expect_close(material_of(&scene, 0)->diffuse, 0.5f, 0.5f, 0.5f);
    cs_scene_free(&scene);
    scene = load_text("red.ply", PLY_HEAD "property uchar red\nproperty uchar green\n"
                                          "property uchar blue\n" PLY_FACE "end_header\n"
                                          "-1 -1 0 255 0 0\n1 -1 0 188 188 188\n1 1 0 255 0 0\n"
                                          "-1 1 0 255 0 0\n4 0 1 2 3\n");
    expect_close(colour_of(&scene, 0, 0), 1, 0, 0);
    assert_true(fabsf(colour_of(&scene, 0, 1)[0] - 0.5029f) < 1e-3f); /* the sRGB curve */
    expect_close(material_of(&scene, 0)->diffuse, 1, 1, 1);
    cs_scene_free(&scene);
    scene = load_text("faces.ply", PLY_HEAD "element face 2\nproperty list uchar int vertex_index\n"
                                            "property float red\nproperty float green\n"
                                            "property float blue\nend_header\n" PLY_POINTS
                                            "3 0 1 2 1 0 0\n3 0 2 3 0 0.5 0\n");
    expect_close(colour_of(&scene, 0, 0), 1, 0, 0);
    expect_close(colour_of(&scene, 1, 0), 0, 0.5f, 0);
    cs_scene_free(&scene);
}

/* A triangle with its numbers in either order of bytes. */
static void bytes_of_ply(void **state)
{
    (void)state;
    for (int big = 0; big < 2; big++) {
        unsigned char bytes[512];
        const float positions[9] = {0, 0, 0, 4, 0, 0, 0, 2, 0};
        size_t size = (size_t)snprintf(
            (char *)bytes, sizeof bytes,
            "ply\r\nformat binary_%s_endian 1.0\r\nelement vertex 3\r\nproperty float x\r\n"
            "property float y\r\nproperty float z\r\nelement face 1\r\n"
            "property list uchar ushort vertex_indices\r\nend_header\r\n",
            big ? "big" : "little");
        for (int i = 0; i < 9; i++) {
            uint32_t word;
            memcpy(&word, &positions[i], sizeof word);
            for (int k = 0; k < 4; k++)
                bytes[size++] = (unsigned char)(word >> (big ? 24 - 8 * k : 8 * k));
        }
        bytes[size++] = 3;
        for (int i = 0; i < 3; i++) {
            bytes[size++] = (unsigned char)(big ? 0 : i);
            bytes[size++] = (unsigned char)(big ? i : 0);
        }
        cs_scene scene = load(write_bytes("bytes.ply", bytes, size));
        assert_true(fabs(area_of(&scene) - 4.0) < 1e-6);
        cs_scene_free(&scene);
        refuse(write_bytes("cut.ply", bytes, size - 1), "longer than the rest of the file");
        refuse(write_bytes("cut.ply", bytes, size - 20), "cut.ply");
    }
}

static void damaged_ply(void **state)
{
    (void)state;
    refuse(write_text("bad.ply", PLY_HEAD), "ends within its head");
    refuse(write_text("bad.ply", "ply\nformat ascii 1.0\nelement vertex 4000000000\n"
                                 "property float x\nproperty float y\nproperty float z\n" PLY_FACE
                                 "end_header\n0 0 0\n"),
           "more than the file can hold");
    refuse(write_text("bad.ply", PLY_HEAD PLY_FACE "end_header\n" PLY_POINTS "3 0 1 4\n"),
           "bad.ply:14: face 0 of 1: it names a vertex that is not there");
    refuse(write_text("bad.ply", PLY_HEAD PLY_FACE "end_header\n" PLY_POINTS "99 0 1 2\n"),
           "longer than the rest of the file");
    refuse(write_text("bad.ply", PLY_HEAD PLY_FACE "end_header\n-1 x 0\n" PLY_POINTS "3 0 1 2\n"),
           "bad.ply:10: vertex 0 of 4: this is not a number");
    refuse(write_text("bad.ply", PLY_HEAD "end_header\n" PLY_POINTS), "4 points but no faces");
    refuse(write_text("bad.ply", PLY_HEAD "property list float int a\nend_header\n" PLY_POINTS),
           "bad.ply:7:");
    refuse(write_text("bad.ply", PLY_HEAD "element range_grid 1\nproperty list uchar int "
                                          "vertex_indices\nend_header\n" PLY_POINTS "1 0\n"),
           "range grids are not supported");
}

/* ----- STL ----- */

#define FACET                                                                    \
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n" \
    "endloop\nendfacet\n"

static size_t binary_stl(unsigned char *bytes, const char *head, uint32_t count)
{
    const float facet[12] = {0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0};
    memset(bytes, 0, 84 + 50 * 2);
    memcpy(bytes, head, strlen(head));
    memcpy(bytes + 80, &count, sizeof count);
    for (size_t i = 0; i < 2; i++)
        memcpy(bytes + 84 + 50 * i, facet, sizeof facet);
    return 84 + 50 * 2;
}

static void kinds_of_stl(void **state)
{
    static const char *const texts[] = {
        "solid x\n" FACET "endsolid x\n",
        "  \n solid\n" FACET "endsolid\nsolid y\n" FACET "endsolid y\n",
        "SOLID X\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\n"
        "VERTEX 1 0 0\nVERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID\n"};
    unsigned char bytes[512];
    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        cs_scene scene = load_text("text.stl", texts[i]);
        assert_int_equal(scene.indices.count, i == 1 ? 2 : 1);
        assert_int_equal(scene.positions.count, 3); /* equal corners are one */
        expect_close(material_of(&scene, 0)->diffuse, 0.5f, 0.5f, 0.5f);
        cs_scene_free(&scene);
    }
    size_t size = binary_stl(bytes, "solid facet", 2);
    cs_scene scene = load(write_bytes("solid.stl", bytes, size));
    assert_int_equal(scene.indices.count, 2);
    cs_scene_free(&scene);
    size = binary_stl(bytes, "trailing", 1); /* a facet's bytes follow what it counts */
    scene = load(write_bytes("trailing.stl", bytes, size));
    assert_int_equal(scene.indices.count, 1);
    cs_scene_free(&scene);
    size = binary_stl(bytes, "COLOR=\xff\x01\x01\xff", 2);
    bytes[84 + 48] = 0xe0;
    bytes[84 + 49] = 0x03;
    scene = load(write_bytes("colour.stl", bytes, size));
    expect_close(colour_of(&scene, 0, 0), 0, 1, 0);
    expect_close(colour_of(&scene, 1, 0), 1, 0, 0);
    cs_scene_free(&scene);
    size = binary_stl(bytes, "cut", 3);
    refuse(write_bytes("cut.stl", bytes, size), "says that it has 3 triangles, but ends after 2");
    refuse(write_text("bad.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"),
           "bad.stl:5: the file ends in a vertex");
    refuse(write_text("bad.stl", "solid x\nfacet\nvertex 0 0 q\n"), "bad.stl:3:");
}

/* ----- glTF ----- */

/* A buffer with 4 positions (48 bytes), 4 pairs of ushort at 48 and 4 of float at 64, 6 bytes of
 * indices at 96, 4 quads of ubyte at 104. */
static char *gltf_buffer_uri(void)
{
    static char uri[512];
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    const float positions[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    const uint16_t pairs[8] = {0, 65535, 65535, 65535, 65535, 0, 0, 0};
    const float others[8] = {0.25f, 0.25f, 0.5f, 0.25f, 0.5f, 0.5f, 0.25f, 0.5f};
    const unsigned char indices[6] = {0, 1, 2, 0, 2, 3};
    unsigned char bytes[120] = {0};
    memcpy(bytes, positions, sizeof positions);
    memcpy(bytes + 48, pairs, sizeof pairs);
    memcpy(bytes + 64, others, sizeof others);
    memcpy(bytes + 96, indices, sizeof indices);
    for (int i = 0; i < 4; i++)
        memcpy(bytes + 104 + 4 * i, (const unsigned char[]){255, 0, 51, 255}, 4);
    size_t used = (size_t)snprintf(uri, sizeof uri, "data:;base64,");
    for (size_t i = 0; i < sizeof bytes; i += 3) {
        const uint32_t word = (uint32_t)bytes[i] << 16 | (uint32_t)bytes[i + 1] << 8 | bytes[i + 2];
        for (int k = 3; k >= 0; k--)
            uri[used++] = letters[word >> 6 * k & 63];
    }
    uri[used] = '\0';
    return uri;
}

/* A square: `attributes` besides its positions, `material`, `more` at the root, `nodes`. */
static const char *gltf_square(const char *attributes, const char *material, const char *nodes,
                               const char *more)
{
    char text[8192];
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[%s],\"materials\":[%s],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0%s},\"indices\":3,"
        "\"material\":0}]}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":48,\"componentType\":5123,\"normalized\":true,"
        "\"count\":4,\"type\":\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":64,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":96,\"componentType\":5121,\"count\":6,"
        "\"type\":\"SCALAR\"},"
        "{\"bufferView\":0,\"byteOffset\":104,\"componentType\":5121,\"normalized\":true,"
        "\"count\":4,\"type\":\"VEC4\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":120}],"
        "\"images\":[{\"uri\":\"my%%20four.ppm\"}],\"textures\":[{\"source\":0,\"sampler\":0}],"
        "\"samplers\":[{\"wrapS\":33071,\"wrapT\":33648}],"
        "\"buffers\":[{\"byteLength\":120,\"uri\":\"%s\"}]%s}",
        nodes, material, attributes, gltf_buffer_uri(), more);
    return write_text("square.gltf", text);
}

static void attributes_of_gltf(void **state)
{
    static const char *const map =
        "{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}";
    (void)state;
    write_picture("my four.ppm");
    cs_scene scene = load(gltf_square(",\"TEXCOORD_0\":1,\"COLOR_0\":4", map, "{\"mesh\":0}", ""));
    assert_int_equal(scene.indices.count, 2);
    expect_st(&scene, 0, 0, 0);
    expect_st(&scene, 2, 1, 1);
    expect_close(colour_of(&scene, 0, 0), 1, 0, 0.2f);
    const cs_texture *texture = scene.textures.items;
    texture += material_of(&scene, 0)->texture;
    assert_int_equal(texture->wrap, CS_TEXTURE_CLAMP | CS_TEXTURE_MIRROR << CS_TEXTURE_WRAP_BITS);
    assert_string_equal(warnings, "");
    cs_scene_free(&scene);
    /* The second set, turned by a right angle, doubled and moved. */
    scene = load(gltf_square(",\"TEXCOORD_0\":1,\"TEXCOORD_1\":2",
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
    refuse(gltf_square("", "{}", "{\"mesh\":0}",
                       ",\"extensionsRequired\":[\"KHR_lights_punctual\",\"ACME_secret\"]"),
           "needs the extension ACME_secret");
    cs_scene scene =
        load(gltf_square("",
                         "{\"name\":\"m\",\"emissiveFactor\":[1,0.5,0],\"normalTexture\":"
                         "{\"index\":0},\"pbrMetallicRoughness\":{\"metallicFactor\":1},"
                         "\"extensions\":{\"KHR_materials_emissive_strength\":"
                         "{\"emissiveStrength\":10},\"ACME_fur\":{}}}",
                         "{\"mesh\":0}", ",\"extensionsRequired\":[\"KHR_mesh_quantization\"]"));
    expect_close(material_of(&scene, 0)->emission, 10, 5, 0);
    expect_close(material_of(&scene, 0)->diffuse, 1, 1, 1);
    expect_warning("\"m\": not supported, left out: ACME_fur\n");
    cs_scene_free(&scene);
}

static void several_cameras_and_lights(void **state)
{
    (void)state;
    cs_scene scene = load(gltf_square(
        "", "{}",
        "{\"mesh\":0,\"children\":[1,2,3]},{\"camera\":0,\"translation\":[0,0,5]},"
        "{\"name\":\"side\",\"camera\":0,\"translation\":[3,0,0],\"extensions\":"
        "{\"KHR_lights_punctual\":{\"light\":0}}},{\"translation\":[0,7,0],\"extensions\":"
        "{\"KHR_lights_punctual\":{\"light\":0}}}",
        ",\"cameras\":[{\"name\":\"front\",\"type\":\"perspective\",\"perspective\":{\"yfov\":0.5,"
        "\"znear\":1}}],\"extensions\":{\"KHR_lights_punctual\":{\"lights\":[{\"type\":\"point\","
        "\"color\":[1,0.5,0],\"intensity\":4}]}}"));
    const cs_scene_camera *cameras = scene.cameras.items;
    const cs_light *lights = scene.lights.items;
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
    expect_warning(
        "2 cameras, of which the first is used; --camera chooses: 0 \"front\", 1 \"side\"");
    cs_scene_free(&scene);
}

static void damaged_gltf(void **state)
{
    (void)state;
    refuse(write_text("bad.gltf", "{\"asset\":"), "bad.gltf:1:");
    refuse(write_text("bad.gltf", "{\"asset\":{\"version\":\"1.0\"}}"), "version 1.0");
    refuse(write_bytes("bad.glb", "glTF\2\0\0\0\377\0\0\0\0\0\0\0JSON", 20), "it was cut");
    refuse(gltf_square(",\"NORMAL\":99", "{}", "{\"mesh\":0}", ""), "accessors[99]");
    refuse(gltf_square("", "{}", "{\"mesh\":7}", ""), "meshes[7]");
    refuse(gltf_square("", "{}", "{\"mesh\":0,\"children\":[0]}", ""), "nodes must be a tree");
    refuse(gltf_square("", "{}", "{\"children\":[1,1]},{\"mesh\":0}", ""), "nodes must be a tree");
    refuse(gltf_square("", "{}", "{}", ""), "no triangles");
    refuse(gltf_square(",\"TEXCOORD_0\":1",
                       "{\"pbrMetallicRoughness\":{\"baseColorTexture\":"
                       "{\"index\":4}}}",
                       "{\"mesh\":0}", ""),
           "textures[4]");
}

/* ----- All formats ----- */

static void far_scenes_keep_their_digits(void **state)
{
    (void)state;
    cs_scene scene = load_text("far.obj", "v 500000.125 4649776.5 0\nv 500001.125 4649776.5 0\n"
                                          "v 500000.125 4649777.25 0\nf 1 2 3\n");
    assert_true(scene.origin[0] == 500001.0 && scene.origin[1] == 4649777.0);
    expect_close(position_of(&scene, 0, 0), -0.875f, -0.5f, 0);
    expect_close(position_of(&scene, 0, 2), -0.875f, 0.25f, 0);
    expect_warning("lies far from the origin, at 500001,4649777,0;");
    cs_scene_free(&scene);
    scene = load_text("near.obj", "v 100 0 0\nv 101 0 0\nv 100 1 0\nf 1 2 3\n");
    assert_true(scene.origin[0] == 0.0);
    assert_string_equal(warnings, "");
    cs_scene_free(&scene);
}

static void alpha_does_not_darken(void **state)
{
    const unsigned char tga[] = {0, 0, 2, 0, 0,  0, 0, 0,   0,   0, 0, 0,
                                 1, 0, 1, 0, 32, 8, 0, 128, 255, 64}; /* blue, green, red, alpha */
    const cs_texel_use use = {CS_TEXELS_COLOUR, 0.0f, 1.0f};
    cs_texels texels;
    cs_error error;
    (void)state;
    const char *path = write_bytes("alpha.tga", tga, sizeof tga);
    assert_int_equal(cs_image_read_texels(path, path, NULL, 0, &use, &texels, &error), CLSHEAR_OK);
    assert_int_equal(texels.halves[0], 0x3c00);                            /* 1 */
    assert_true(texels.halves[1] >= 0x32e0 && texels.halves[1] <= 0x3300); /* 0.2158 */
    assert_true(texels.halves[3] >= 0x3400 && texels.halves[3] <= 0x3408); /* 64 / 255 */
    free(texels.halves);
}

static void jpeg_has_its_limit(void **state)
{
    static float plane[70000];
    const char *names[] = {"R", "G", "B"};
    const float *planes[] = {plane, plane, plane};
    const cs_picture picture = {.width = 70000,
                                .height = 1,
                                .full_width = 70000,
                                .full_height = 1,
                                .channel_count = 3,
                                .names = names,
                                .planes = planes};
    cs_error error;
    (void)state;
    assert_int_equal(cs_image_write(path_of("wide.jpg"), &picture, &error), CLSHEAR_BAD_FILE);
    assert_non_null(strstr(error.message, "JPEG holds at most 65500"));
}

static void numbers_know_no_locale(void **state)
{
    char text[32];
    double value = 0.0;
    (void)state;
    setlocale(LC_ALL, "de_DE.UTF-8"); /* where it is installed */
    cs_scene scene = load_text("comma.obj", "v 0.5 0 0\nv 1.5 0 0\nv 0.5 1 0\nf 1 2 3\n");
    expect_close(position_of(&scene, 0, 0), 0.5f, 0, 0);
    cs_scene_free(&scene);
    assert_string_equal(cs_format_number(text, sizeof text, 0.329327822, 9), "0.329327822");
    assert_string_equal(cs_format_number(text, sizeof text, 1e-7, 9), "1e-07");
    setlocale(LC_ALL, "C");
    const char *odd = "+1.5e3,";
    assert_ptr_equal(cs_parse_number(odd, odd + 7, &value), odd + 6);
    assert_true(value == 1500.0);
    const char *large = "-1e999", *tiny = "1e-999";
    cs_parse_number(large, large + 6, &value);
    assert_true(isinf(value) && value < 0.0);
    cs_parse_number(tiny, tiny + 6, &value);
    assert_true(value == 0.0);
}

/* ----- The wall ----- */

static void fake_helper(const char *body)
{
    char text[512];
    snprintf(text, sizeof text, "#!/bin/sh\n%s\n", body);
    const char *path = write_text("fake-import", text);
    chmod(path, 0700);
    setenv("CLSHEAR_IMPORT", path, 1);
}

static void expect_wall(const char *body, const char *words)
{
    const cs_log log = {.warn = collect};
    const cs_import_options options = {.smooth_degrees = -1.0};
    const char *path = write_text("wall.obj", SQUARE "f 1 2 3 4\n");
    cs_scene scene;
    cs_error error;
    fake_helper(body);
    cs_scene_init(&scene);
    assert_int_equal(cs_scene_import(path, &options, &scene, &log, &error), CLSHEAR_BAD_FILE);
    if (strstr(error.message, words) == NULL)
        fail_msg("\"%s\" does not contain \"%s\"", error.message, words);
    cs_scene_free(&scene);
    unsetenv("CLSHEAR_IMPORT");
}

static void the_wall_holds(void **state)
{
    (void)state;
    expect_wall("kill -SEGV $$", "the importer crashed (Segmentation fault)");
    expect_wall("kill -XCPU $$", "took longer than");
    expect_wall("exit 3", "ended before it was done");
    expect_wall("head -c 100000 /dev/zero; exit 0", "ended before it was done");
    expect_wall("printf 'AYRA\\014\\0\\0\\0\\377\\377\\377\\377\\377\\377\\377\\17'",
                "ended before");
}

/* The same scene through the real program, where it is built. */
static void the_wall_lets_scenes_through(void **state)
{
    const cs_log log = {.warn = collect};
    const cs_import_options options = {.smooth_degrees = -1.0};
    const char *path = write_text("through.obj", "mtllib gone.mtl\n" SQUARE "f 1 2 3 4\n");
    cs_scene here = load(path), there;
    cs_error error;
    (void)state;
    warnings[0] = '\0';
    cs_scene_init(&there);
    assert_int_equal(cs_scene_import(path, &options, &there, &log, &error), CLSHEAR_OK);
    assert_int_equal(there.indices.count, here.indices.count);
    assert_int_equal(there.positions.count, here.positions.count);
    assert_memory_equal(there.positions.items, here.positions.items, 3 * 4 * here.positions.count);
    assert_memory_equal(there.bounds, here.bounds, sizeof here.bounds);
    expect_warning("material file gone.mtl not found");
    cs_scene_free(&here);
    cs_scene_free(&there);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(marks_line_ends_and_encodings),
        cmocka_unit_test(maps_are_found_wherever_they_are),
        cmocka_unit_test(map_options_are_obeyed),
        cmocka_unit_test(black_beside_a_map),
        cmocka_unit_test(what_is_missing_is_told_once),
        cmocka_unit_test(material_lines),
        cmocka_unit_test(vertex_colours_of_obj),
        cmocka_unit_test(texture_without_coordinates),
        cmocka_unit_test(polygons_keep_their_area),
        cmocka_unit_test(damaged_obj),
        cmocka_unit_test(smoothing_groups_and_angles),
        cmocka_unit_test(layouts_of_ply),
        cmocka_unit_test(bytes_of_ply),
        cmocka_unit_test(damaged_ply),
        cmocka_unit_test(kinds_of_stl),
        cmocka_unit_test(attributes_of_gltf),
        cmocka_unit_test(extensions_of_gltf),
        cmocka_unit_test(several_cameras_and_lights),
        cmocka_unit_test(damaged_gltf),
        cmocka_unit_test(far_scenes_keep_their_digits),
        cmocka_unit_test(alpha_does_not_darken),
        cmocka_unit_test(jpeg_has_its_limit),
        cmocka_unit_test(numbers_know_no_locale),
        cmocka_unit_test(the_wall_holds),
        cmocka_unit_test(the_wall_lets_scenes_through),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
