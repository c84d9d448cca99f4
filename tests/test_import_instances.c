/* EXT_mesh_gpu_instancing of glTF. */
#include "gltf_sheet.h"

#include <stdio.h>

/* Writes a sheet with an accessor that has no items; of_node: more members of the node. */
static const char *write_instances(const char *of_node)
{
    static sheet_parts data;
    char views[1024] = "";
    size_t used = 0;
    sheet_make();
    data.used = 0;
    for (int i = 0; i < 5; i++) {
        sheet_append(&data, i, sheet_items[i], sheet_counts[i] * sheet_strides[i]);
        used += (size_t)snprintf(views + used, sizeof views - used,
                                 "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}",
                                 i > 0 ? "," : "", data.begin[i], data.size[i]);
    }
    return sheet_write("placed.gltf", &data,
                       &(sheet_contents){.views = views,
                                         .accessors = ",{\"count\":0,\"componentType\":5126,"
                                                      "\"type\":\"VEC3\"}",
                                         .of_node = of_node});
}

/* Three of them: moved, turned by a right angle about Z in signed bytes, and scaled. */
static void instances_of_a_node(void **state)
{
    static const float moves[3][3] = {{100, 0, 0}, {200, 0, 0}, {300, 0, 0}};
    static const int8_t turns[3][4] = {{0, 0, 0, 127}, {0, 0, 90, 90}, {0, 0, 0, 127}};
    static const float scales[3][3] = {{1, 1, 1}, {1, 1, 1}, {1, 2, 3}};
    static const char of_node[] = ",\"translation\":[0,0,1000],\"extensions\":{"
                                  "\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":5,"
                                  "\"ROTATION\":6,\"SCALE\":7}}}";
    static sheet_parts data;
    char views[1024] = "";
    size_t used = 0;
    (void)state;
    sheet_make();
    data.used = 0;
    for (int i = 0; i < 5; i++)
        sheet_append(&data, i, sheet_items[i], sheet_counts[i] * sheet_strides[i]);
    const size_t begin = data.used;
    sheet_append(&data, 0, moves, sizeof moves);
    sheet_append(&data, 0, turns, sizeof turns);
    sheet_append(&data, 0, scales, sizeof scales);
    const size_t begins[8] = {0,     data.begin[1], data.begin[2], data.begin[3], data.begin[4],
                              begin, begin + 36,    begin + 48};
    const size_t sizes[8] = {972, 972, 648, 324, 768, 36, 12, 36};
    for (int i = 0; i < 8; i++)
        used += (size_t)snprintf(views + used, sizeof views - used,
                                 "%s{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}",
                                 i > 0 ? "," : "", begins[i], sizes[i]);
    cs_scene scene = sheet_load(sheet_write(
        "instances.gltf", &data,
        &(sheet_contents){.views = views,
                          .accessors =
                              ",{\"bufferView\":5,\"count\":3,\"componentType\":5126,\"type\":"
                              "\"VEC3\"},{\"bufferView\":6,\"count\":3,\"componentType\":5120,"
                              "\"normalized\":true,\"type\":\"VEC4\"},{\"bufferView\":7,\"count\":"
                              "3,\"componentType\":5126,\"type\":\"VEC3\"}",
                          .of_node = of_node,
                          .required = "EXT_mesh_gpu_instancing"}));
    assert_int_equal(scene.indices.count, 3 * SHEET_TRIANGLES);
    for (size_t i = 0; i < SHEET_TRIANGLES; i++)
        for (int k = 0; k < 3; k++) {
            const float *p = sheet_positions[sheet_indices[i][k]];
            expect_close(import_position(&scene, i, k), 100 + p[0], p[1], 1000 + p[2]);
            expect_close(import_position(&scene, SHEET_TRIANGLES + i, k), 200 - p[1], p[0],
                         1000 + p[2]);
            expect_close(import_position(&scene, 2 * SHEET_TRIANGLES + i, k), 300 + p[0], 2 * p[1],
                         1000 + 3 * p[2]);
        }
    cs_scene_free(&scene);
}

/* Attributes of other numbers of instances, none among them, and one that places nothing. The
 * accessors 0 and 1 have an item for each vertex, 5 has none. */
static void attributes_that_do_not_fit(void **state)
{
    static const struct {
        const char *attributes;
        const char *words; /* NULL: it is read */
        size_t instances;
    } files[] = {{"\"TRANSLATION\":5,\"SCALE\":1", "81 instances, but 0 have another attribute", 0},
                 {"\"TRANSLATION\":2", "is no VEC3 for the TRANSLATION of instances", 0},
                 {"\"TRANSLATION\":0,\"SCALE\":1", NULL, SHEET_VERTICES},
                 {"\"_ID\":5", NULL, 1}};
    (void)state;
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        char node[256];
        snprintf(node, sizeof node,
                 ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{%s}}}",
                 files[i].attributes);
        const char *path = write_instances(node);
        if (files[i].words != NULL) {
            sheet_refused(path, files[i].words);
            continue;
        }
        cs_scene scene = sheet_load(path);
        assert_int_equal(scene.indices.count, files[i].instances * SHEET_TRIANGLES);
        cs_scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(instances_of_a_node),
        cmocka_unit_test(attributes_that_do_not_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
