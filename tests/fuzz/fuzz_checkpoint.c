/* The bytes as changes of a checkpoint, from which a small render then goes on. The first byte says
 * which render it is and how the file ends; then come changes: a place (16 bits), a length, as many
 * bytes. So inputs stay good when the layout of checkpoints changes. */
#include <stdlib.h>
#include <string.h>

#include <stdio.h>

#include "clshear/clshear.h"
#include "targets.h"

enum {
    KINDS = 4,
    KIND_BITS = 3,     /* of the first byte */
    KEEP_CHECKSUM = 4, /* the old one, which is wrong after a change */
    CUT = 8,           /* the file ends at the last place */
    MOST_BYTES = 15    /* of a change */
};

typedef struct checkpoint {
    clshear_settings *settings;
    unsigned char *bytes;
    size_t size;
} checkpoint;

static void ok(clshear_status status)
{
    if (status == CLSHEAR_OK) return;
    fprintf(stderr, "%s\n", clshear_message());
    abort();
}

static clshear_scene *scene_of_square(void)
{
    static clshear_scene *scene;
    static const float positions[12] = {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0};
    static const uint32_t indices[6] = {0, 1, 2, 0, 2, 3};
    const clshear_mesh mesh = {.struct_size = sizeof mesh,
                               .positions = positions,
                               .indices = indices,
                               .vertex_count = 4,
                               .triangle_count = 2,
                               .diffuse = {0.5f, 0.5f, 0.5f}};
    clshear_context *context = NULL;
    if (scene != NULL) return scene;
    ok(clshear_context_create(NULL, &context));
    ok(clshear_scene_create(context, &scene));
    ok(clshear_scene_add_mesh(scene, &mesh));
    ok(clshear_scene_complete(scene));
    return scene;
}

static int stop_when_begun(void *user, const clshear_progress *progress)
{
    (void)user;
    return progress->fraction > 0.0;
}

static void read_all(const char *path, checkpoint *into)
{
    FILE *stream = fopen(path, "rb");
    if (stream == NULL) abort();
    fseek(stream, 0, SEEK_END);
    into->size = (size_t)ftell(stream);
    rewind(stream);
    into->bytes = malloc(into->size);
    if (into->bytes == NULL || fread(into->bytes, 1, into->size, stream) != into->size) abort();
    fclose(stream);
}

/* A checkpoint of each kind of state: plain with planes, adaptive, in rounds, with patterns kept.
 */
static const checkpoint *checkpoint_of(int kind)
{
    static const struct {
        clshear_setting setting;
        const char *text;
    } choices[KINDS] = {{CLSHEAR_AOV, "albedo,depth"},
                        {CLSHEAR_ADAPTIVE, "1"},
                        {CLSHEAR_NOISE, "1e-6"},
                        {CLSHEAR_KEEP_PATTERNS, "1"}};
    static checkpoint made[KINDS];
    checkpoint *one = &made[kind];
    clshear_film *film = NULL;
    const char *path = cs_fuzz_path("checkpoint");
    if (one->bytes != NULL) return one;
    ok(clshear_settings_create(&one->settings));
    ok(clshear_settings_set_integer(one->settings, CLSHEAR_WIDTH, 4));
    ok(clshear_settings_set_integer(one->settings, CLSHEAR_HEIGHT, 3));
    ok(clshear_settings_set_integer(one->settings, CLSHEAR_SPP, 64));
    ok(clshear_settings_set_integer(one->settings, CLSHEAR_REPLICATES, 4));
    ok(clshear_settings_set_text(one->settings, CLSHEAR_LIGHT, "1,2,3,20,20,20"));
    ok(clshear_settings_set_text(one->settings, choices[kind].setting, choices[kind].text));
    ok(clshear_settings_set_text(one->settings, CLSHEAR_CHECKPOINT, path));
    clshear_settings_set_progress(one->settings, stop_when_begun, NULL);
    remove(path);
    ok(clshear_render(scene_of_square(), one->settings, &film));
    clshear_film_free(film);
    clshear_settings_set_progress(one->settings, NULL, NULL);
    ok(clshear_settings_set_integer(one->settings, CLSHEAR_RESUME, 1));
    read_all(path, one);
    return one;
}

/* Fowler, Noll and Vo's FNV-1a of all bytes, as the last eight. */
static void mend_checksum(unsigned char *bytes, size_t size)
{
    uint64_t sum = 0xcbf29ce484222325u;
    if (size < sizeof sum) return;
    for (size_t i = 0; i < size - sizeof sum; i++)
        sum = (sum ^ bytes[i]) * 0x100000001b3u;
    memcpy(bytes + size - sizeof sum, &sum, sizeof sum);
}

/* Applies the changes to the bytes; returns the new size. */
static size_t change(unsigned char *bytes, size_t size, const uint8_t *data, size_t left, int ends)
{
    size_t place = size;
    while (left >= 3) {
        const size_t length = data[2] & MOST_BYTES;
        place = ((size_t)data[0] | (size_t)data[1] << 8) % size;
        for (size_t i = 0; i < length && 3 + i < left && place + i < size; i++)
            bytes[place + i] = data[3 + i];
        const size_t taken = 3 + length < left ? 3 + length : left;
        data += taken;
        left -= taken;
    }
    return ends ? place : size;
}

void cs_fuzz_checkpoint(const uint8_t *data, size_t size)
{
    const int flags = size > 0 ? data[0] : 0;
    const checkpoint *one = checkpoint_of(flags & KIND_BITS);
    clshear_film *film = NULL;
    unsigned char *bytes = malloc(one->size);
    if (bytes == NULL) abort();
    memcpy(bytes, one->bytes, one->size);
    if (size > 1) {
        const size_t now = change(bytes, one->size, data + 1, size - 1, flags & CUT);
        if (!(flags & KEEP_CHECKSUM)) mend_checksum(bytes, now);
        cs_fuzz_file("checkpoint", bytes, now);
    } else {
        cs_fuzz_file("checkpoint", bytes, one->size);
    }
    const clshear_status status = clshear_render(scene_of_square(), one->settings, &film);
    if (size <= 1) ok(status); /* unchanged, it goes on */
    clshear_film_free(film);
    free(bytes);
}
