/* glTF whose geometry is compressed, by Draco and by meshoptimizer: the scene is that of the same
 * file without. */
#include "gltf_sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <meshoptimizer.h>

#include "pack_mesh.h"

static const test_mesh sheet = {SHEET_VERTICES,   SHEET_TRIANGLES,   sheet_positions[0],
                                sheet_normals[0], sheet_textures[0], sheet_colours[0],
                                sheet_indices[0]};

static const char draco[] = ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0,"
                            "\"attributes\":{\"POSITION\":0,\"NORMAL\":1,\"TEXCOORD_0\":2,"
                            "\"COLOR_0\":3}}}";

/* Without its last `cut` bytes. */
static const char *write_draco(const char *name, int is_short, size_t cut, const char *of_primitive)
{
    static sheet_parts data;
    unsigned char bytes[SHEET_BYTES / 2];
    char view[128];
    const size_t size = test_pack_draco(&sheet, is_short, bytes, sizeof bytes);
    assert_true(size > 100);
    data.used = 0;
    sheet_append(&data, 0, bytes, size > cut ? size - cut : 0);
    snprintf(view, sizeof view, "{\"buffer\":0,\"byteLength\":%zu}", data.size[0]);
    return sheet_write(name, &data,
                       &(sheet_contents){.views = view,
                                         .is_bare = 1,
                                         .of_primitive = of_primitive,
                                         .required = "KHR_draco_mesh_compression"});
}

/* Compresses a part. Normals go through the filter OCTAHEDRAL, coordinates through EXPONENTIAL. */
static size_t pack_part(int part, unsigned char *bytes, size_t most)
{
    uint16_t around[SHEET_VERTICES][4];
    unsigned int wide[3 * SHEET_TRIANGLES];
    float whole[SHEET_VERTICES][4], scaled[SHEET_VERTICES][2];
    for (int i = 0; i < 3 * SHEET_TRIANGLES; i++)
        wide[i] = sheet_indices[i / 3][i % 3];
    if (part == 4) return meshopt_encodeIndexBuffer(bytes, most, wide, 3 * SHEET_TRIANGLES);
    const void *from = sheet_items[part];
    size_t stride = sheet_strides[part];
    for (int i = 0; i < SHEET_VERTICES; i++)
        memcpy(whole[i], sheet_normals[i], sizeof sheet_normals[i]), whole[i][3] = 0.0f;
    if (part == 1) {
        meshopt_encodeFilterOct(around, SHEET_VERTICES, 8, 16, &whole[0][0]);
        from = around;
        stride = 8;
    } else if (part == 2) {
        meshopt_encodeFilterExp(scaled, SHEET_VERTICES, 8, 24, &sheet_textures[0][0]);
        from = scaled;
    }
    return meshopt_encodeVertexBuffer(bytes, most, from, SHEET_VERTICES, stride);
}

/* spoil: a part that has lost its last ten bytes; -1: none. stride_of_normals: what their
 * view says of it besides the extension; they are filled up to eight bytes. */
static const char *write_meshopt(const char *name, int spoil, const char *stride_of_normals)
{
    static const char *const modes[5] = {
        "\"ATTRIBUTES\"", "\"ATTRIBUTES\",\"filter\":\"OCTAHEDRAL\"",
        "\"ATTRIBUTES\",\"filter\":\"EXPONENTIAL\"", "\"ATTRIBUTES\"", "\"TRIANGLES\""};
    static sheet_parts data;
    char views[2048] = "";
    size_t used = 0;
    data.used = 0;
    for (int i = 0; i < 5; i++) {
        unsigned char bytes[SHEET_BYTES / 8];
        const size_t size = pack_part(i, bytes, sizeof bytes),
                     stride = i == 1 ? 8 : sheet_strides[i];
        assert_in_range(size, 10, sizeof bytes);
        sheet_append(&data, i, bytes, i == spoil ? size - 10 : size);
        used += (size_t)snprintf(
            views + used, sizeof views - used,
            "%s{\"buffer\":1,\"byteLength\":%zu,%s\"extensions\":{\"EXT_meshopt_compression\":{"
            "\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu,\"byteStride\":%zu,\"count\":%zu,"
            "\"mode\":%s}}}",
            i > 0 ? "," : "", sheet_counts[i] * stride, i == 1 ? stride_of_normals : "",
            data.begin[i], data.size[i], stride, sheet_counts[i], modes[i]);
    }
    return sheet_write(name, &data,
                       &(sheet_contents){.views = views,
                                         .normals = "5122,\"normalized\":true,\"type\":\"VEC3\"",
                                         .required = "EXT_meshopt_compression"});
}

static int is_near(const float *a, const float *b, int count, double within)
{
    for (int i = 0; i < count; i++)
        if (!(fabs((double)a[i] - (double)b[i]) <= within)) return 0;
    return 1;
}

/* Whether triangles are the same but for where their corners begin. */
static int is_same(const cs_scene *a, size_t i, const cs_scene *b, size_t j, int turn,
                   double within)
{
    for (int k = 0; k < 3; k++) {
        const int other = (k + turn) % 3;
        const cs_vertex *one = import_vertex(a, i, k), *two = import_vertex(b, j, other);
        if (!is_near(import_position(a, i, k), import_position(b, j, other), 3, 8.0 * within) ||
            !is_near(one->normal, two->normal, 3, within) ||
            !is_near(one->texture, two->texture, 2, within) ||
            !is_near(import_colour(a, i, k), import_colour(b, j, other), 3, 1e-6))
            return 0;
    }
    return 1;
}

/* Expects the same triangles, in any order. */
static void expect_same(const cs_scene *a, const cs_scene *b, double within)
{
    assert_int_equal(a->indices.count, SHEET_TRIANGLES);
    assert_int_equal(b->indices.count, SHEET_TRIANGLES);
    for (size_t i = 0; i < SHEET_TRIANGLES; i++) {
        int found = 0;
        for (size_t j = 0; j < SHEET_TRIANGLES; j++)
            for (int turn = 0; turn < 3; turn++)
                found += is_same(a, i, b, j, turn, within);
        assert_int_equal(found, 1);
    }
}

static void draco_is_the_same(void **state)
{
    (void)state;
    cs_scene plain = sheet_load(sheet_write_plain("plain.gltf", "", NULL));
    for (int is_short = 0; is_short < 2; is_short++) {
        cs_scene packed = sheet_load(write_draco("draco.gltf", is_short, 0, draco));
        /* 14 bits of eight units are 0.0005; Draco's normals have as many on the octahedron. */
        expect_same(&plain, &packed, is_short ? 3e-4 : 0.0);
        cs_scene_free(&packed);
    }
    /* A strip is unpacked to single triangles, too. */
    char strip[512];
    snprintf(strip, sizeof strip, "%s,\"mode\":5", draco);
    cs_scene packed = sheet_load(write_draco("draco.gltf", 0, 0, strip));
    expect_same(&plain, &packed, 0.0);
    cs_scene_free(&packed);
    cs_scene_free(&plain);
}

/* A file with both uses what it has in plain form, unless it says that this cannot be understood.
 */
static void draco_beside_plain(void **state)
{
    (void)state;
    cs_scene plain = sheet_load(sheet_write_plain("plain.gltf", "", NULL));
    cs_scene both = sheet_load(sheet_write_plain("both.gltf", draco, NULL));
    expect_same(&plain, &both, 0.0);
    cs_scene_free(&plain);
    cs_scene_free(&both);
    /* The first buffer view has positions, and no Draco's mesh. */
    sheet_refused(sheet_write_plain("both.gltf", draco, "KHR_draco_mesh_compression"),
                  "KHR_draco_mesh_compression: its data are damaged");
}

static void meshopt_is_the_same(void **state)
{
    (void)state;
    cs_scene plain = sheet_load(sheet_write_plain("plain.gltf", "", NULL));
    for (int has_stride = 0; has_stride < 2; has_stride++) {
        cs_scene packed =
            sheet_load(write_meshopt("meshopt.gltf", -1, has_stride ? "\"byteStride\":8," : ""));
        expect_same(&plain, &packed, 5e-5); /* 16 bits of normals */
        cs_scene_free(&packed);
    }
    cs_scene_free(&plain);
}

static void damaged_data(void **state)
{
    static const char words[] =
        "damaged.gltf: meshes[0].primitives[0]: KHR_draco_mesh_compression: ";
    (void)state;
    sheet_refused(write_draco("damaged.gltf", 0, 10, draco), words);
    sheet_refused(write_draco("damaged.gltf", 1, 10, draco), words);
    sheet_refused(write_draco("damaged.gltf", 0, SHEET_BYTES, draco), words);
    sheet_refused(write_draco("damaged.gltf", 0, 0,
                              ",\"extensions\":{\"KHR_draco_mesh_compression\":{\"bufferView\":0,"
                              "\"attributes\":{\"POSITION\":7}}}"),
                  "KHR_draco_mesh_compression: has no attribute of the number 7");
    for (int part = 0; part < 5; part++) {
        char view[64];
        snprintf(view, sizeof view, "bufferViews[%d]: EXT_meshopt_compression: its ", part);
        sheet_refused(write_meshopt("damaged.gltf", part, ""), view);
    }
}

/* Without the program that unpacks. */
static void without_the_module(void **state)
{
    (void)state;
    import_refused(write_draco("draco.gltf", 0, 0, draco), "is read by the program clshear-import");
    import_refused(write_meshopt("meshopt.gltf", -1, ""), "is read by the program clshear-import");
}

/* meshoptimizer asserts what its arguments must be. */
static void views_that_do_not_fit(void **state)
{
    static const char *const members[] = {
        "\"byteStride\":0,\"count\":81,\"mode\":\"ATTRIBUTES\"",
        "\"byteStride\":10,\"count\":81,\"mode\":\"ATTRIBUTES\"",
        "\"byteStride\":260,\"count\":81,\"mode\":\"ATTRIBUTES\"",
        "\"byteStride\":12,\"count\":81,\"mode\":\"ATTRIBUTES\",\"filter\":\"OCTAHEDRAL\"",
        "\"byteStride\":12,\"count\":81,\"mode\":\"ATTRIBUTES\",\"filter\":\"QUATERNION\"",
        "\"byteStride\":12,\"count\":81,\"mode\":\"ATTRIBUTES\",\"filter\":\"OTHER\"",
        "\"byteStride\":12,\"count\":81,\"mode\":\"TRIANGLES\"",
        "\"byteStride\":4,\"count\":80,\"mode\":\"TRIANGLES\"",
        "\"byteStride\":4,\"count\":81,\"mode\":\"OTHER\"",
        "\"byteStride\":4,\"count\":81,\"mode\":\"INDICES\",\"filter\":\"EXPONENTIAL\"",
        "\"byteStride\":12,\"count\":99999999,\"mode\":\"ATTRIBUTES\"",
        "\"byteStride\":12,\"count\":-1,\"mode\":\"ATTRIBUTES\"",
        "\"count\":81"};
    (void)state;
    for (size_t i = 0; i < sizeof members / sizeof *members; i++) {
        static sheet_parts data;
        char views[512];
        data.used = 64;
        snprintf(views, sizeof views,
                 "{\"buffer\":1,\"byteLength\":972,\"extensions\":{\"EXT_meshopt_compression\":{"
                 "\"buffer\":0,\"byteLength\":64,%s}}}",
                 members[i]);
        sheet_refused(sheet_write("views.gltf", &data, &(sheet_contents){.views = views}),
                      "views.gltf: bufferViews[0]: EXT_meshopt_compression");
    }
}

static int set_up(void **state)
{
    (void)state;
    sheet_make();
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(draco_is_the_same),   cmocka_unit_test(draco_beside_plain),
        cmocka_unit_test(meshopt_is_the_same), cmocka_unit_test(damaged_data),
        cmocka_unit_test(without_the_module),  cmocka_unit_test(views_that_do_not_fit),
    };
    return cmocka_run_group_tests(tests, set_up, NULL);
}
