/* A picture of what moves against brute force: the mean of 256 still pictures. The camera moves, a
 * card moves as a node of an animated glTF file, and the lens is open. */
#include "support.h"

#include <math.h>
#include <stdio.h>

enum {
    SIDE = 48,
    PIXELS = SIDE * SIDE,
    SLICES = 256,
    ACROSS = SIDE / 8,
    BLOCKS = ACROSS * ACROSS, /* of 8 x 8 pixels */
    FLOATS = 12 + 2 + 6,
    BYTES = 4 * FLOATS + 12 + 4 /* and six 16-bit indices; a multiple of 3 */
};

static const double eyes[2][6] = {{0.0, 2.0, 6.0, 0.0, 0.5, 0.0}, {0.7, 2.3, 5.8, 0.4, 0.6, 0.1}};

/* A floor, and a card that goes from (-1, 0.2, 0) to (1.2, 0.9, 0.6) within one second. */
static const char *moving_card(void)
{
    static const float numbers[FLOATS] = {-1, 0,  1, 1, 0,  1,    1, 0,    -1,   -1,
                                          0,  -1, 0, 1, -1, 0.2f, 0, 1.2f, 0.9f, 0.6f};
    static const unsigned short indices[6] = {0, 1, 2, 0, 2, 3};
    unsigned char bytes[BYTES] = {0};
    char data[2 * BYTES], text[4096];
    memcpy(bytes, numbers, sizeof numbers);
    memcpy(bytes + sizeof numbers, indices, sizeof indices);
    test_base64(bytes, sizeof bytes, data);
    snprintf(
        text, sizeof text,
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0,1]}],\"nodes\":["
        "{\"mesh\":0,\"scale\":[6,1,6]},{\"mesh\":0,\"scale\":[0.7,1,0.5]}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":3}]}],"
        "\"animations\":[{\"samplers\":[{\"input\":1,\"output\":2}],\"channels\":["
        "{\"sampler\":0,\"target\":{\"node\":1,\"path\":\"translation\"}}]}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":48,\"componentType\":5126,\"count\":2,"
        "\"type\":\"SCALAR\"},"
        "{\"bufferView\":0,\"byteOffset\":56,\"componentType\":5126,\"count\":2,\"type\":\"VEC3\"},"
        "{\"bufferView\":0,\"byteOffset\":80,\"componentType\":5123,\"count\":6,"
        "\"type\":\"SCALAR\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d}],\"buffers\":[{\"byteLength\":%d,"
        "\"uri\":\"data:application/octet-stream;base64,%s\"}]}",
        BYTES, BYTES, data);
    return test_file("card.gltf", text);
}

static clshear_settings *settings_at(double time, uint32_t spp)
{
    clshear_settings *settings = test_settings(NULL, SIDE, SIDE, spp);
    static const double light[6] = {1.5, 5.0, 2.0, 60.0, 50.0, 40.0};
    double at[6];
    for (int i = 0; i < 6; i++)
        at[i] = eyes[0][i] + time * (eyes[1][i] - eyes[0][i]);
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_EYE, at, 3));
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_TARGET, at + 3, 3));
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_LIGHT, light, 6));
    test_set(settings, CLSHEAR_FOV, "40");
    test_set(settings, CLSHEAR_FOCAL_DISTANCE, "6");
    test_set(settings, CLSHEAR_LENS_RADIUS, "0.2");
    test_set(settings, CLSHEAR_BOUNCES, "0");
    test_set(settings, CLSHEAR_SHUTTER, "%.9g,%.9g", time, time);
    return settings;
}

/* Sums of the colours of blocks, and the variances of these sums. */
typedef struct block_sums {
    double sum[3 * BLOCKS];
    double variance[3 * BLOCKS];
} block_sums;

/* Renders the file with these settings, adds the picture with a weight, and frees the settings. */
static void add_render(clshear_context *context, const char *path, clshear_settings *settings,
                       double weight, block_sums *to)
{
    static const char *const names[6] = {"R", "G", "B", "Variance.R", "Variance.G", "Variance.B"};
    clshear_scene *scene = NULL;
    test_ok(clshear_scene_load(context, path, settings, &scene));
    clshear_film *film = test_render(scene, settings);
    for (int c = 0; c < 3; c++)
        for (int i = 0; i < PIXELS; i++) {
            const int block = c * BLOCKS + i / SIDE / 8 * ACROSS + i % SIDE / 8;
            to->sum[block] += weight * (double)clshear_film_channel(film, names[c])[i];
            to->variance[block] +=
                weight * weight * (double)clshear_film_channel(film, names[c + 3])[i];
        }
    clshear_film_free(film);
    clshear_scene_free(scene);
    clshear_settings_free(settings);
}

/* |z| < 6 for each of 108 sums of 64 pixels; their errors come from 64 variances with 15 degrees of
 * freedom and 64 * 256 with one, so z is normal to within a few per cent: false alarms 3e-7
 * together. A third of the blocks see nothing, and have no z. The mean square of z over the other
 * 24, of which the colours are one draw, is chi square over 24 with deviation sqrt(2 / 24) = 0.29:
 * below 1 + 7 * 0.29, so that a small error everywhere shows too; false alarms below 1e-6. */
static void the_picture_is_the_mean_of_256_still_ones(void **state)
{
    (void)state;
    const char *path = moving_card();
    clshear_context *context = test_context();
    static block_sums slices, moving;
    for (int i = 0; i < SLICES; i++) {
        clshear_settings *settings = settings_at((i + 0.5) / SLICES, 16);
        test_set(settings, CLSHEAR_SEED, "%d", i + 1);
        add_render(context, path, settings, 1.0 / SLICES, &slices);
    }
    clshear_settings *settings = settings_at(0.0, 2048);
    test_set(settings, CLSHEAR_REPLICATES, "16");
    test_set(settings, CLSHEAR_SHUTTER, "0,1");
    test_ok(clshear_settings_set_numbers(settings, CLSHEAR_CAMERA_TO, eyes[1], 6));
    add_render(context, path, settings, 1.0, &moving);
    double squares = 0.0, most = 0.0;
    int noisy = 0;
    for (int i = 0; i < 3 * BLOCKS; i++) {
        const double off = moving.sum[i] - slices.sum[i];
        const double variance = moving.variance[i] + slices.variance[i];
        noisy += variance > 0.0;
        squares += off * off / (variance + 1e-20);
        most = fmax(most, fabs(off) / sqrt(variance + 1e-20));
    }
    print_message("mean square of z of %d sums %.2f, largest |z| %.2f\n", noisy, squares / noisy,
                  most);
    assert_int_equal(noisy, 3 * 24);
    assert_above(6.0, most);
    assert_above(3.0, squares / noisy);
    clshear_context_free(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_picture_is_the_mean_of_256_still_ones)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
