/* The format is described in docs/notes/devices.md; tools/replay.c reads it. */
#include "device/recorder.h"

#include <stdlib.h>
#include <string.h>

#include "base/array.h"
#include "base/checksum.h"
#include "base/output_file.h"
#include "clshear/version.h"
#include "device/program.h"

static const char magic[8] = "CLSHCAP1";

/* A buffer as the file has it. */
typedef struct known_buffer {
    uint64_t number;
    unsigned writes;
} known_buffer;

struct cs_recorder {
    cs_device *device;
    char *path;
    cs_output_file file;
    uint64_t sum;     /* of all bytes so far: Fowler, Noll and Vo's FNV-1a */
    cs_array buffers; /* known_buffer; their places are the file's numbers */
    cs_u32 programs;
    cs_u32 program_numbers[CS_FEATURE_SETS][CS_PROGRAM_COUNT]; /* from 1 on; 0: not written */
};

/* Failed writes are seen when the file is closed. */
static void put(cs_recorder *recorder, const void *data, size_t size)
{
    recorder->sum = cs_checksum_add(recorder->sum, data, size);
    fwrite(data, 1, size, recorder->file.stream);
}

static void put_u32(cs_recorder *recorder, size_t value)
{
    const cs_u32 word = (cs_u32)value;
    put(recorder, &word, sizeof word);
}

static void put_u64(cs_recorder *recorder, uint64_t value)
{
    put(recorder, &value, sizeof value);
}

/* A chunk's name of four letters and the bytes that follow. */
static void put_head(cs_recorder *recorder, const char *name, size_t size)
{
    put(recorder, name, 4);
    put_u64(recorder, size);
}

static void put_info(cs_recorder *recorder)
{
    char text[1024];
    const int length = snprintf(
        text, sizeof text, "clshear " CLSHEAR_VERSION_STRING " on %s, driver %s, packets of %d",
        recorder->device->name, recorder->device->driver, recorder->device->packet);
    put_head(recorder, "info", (size_t)length);
    put(recorder, text, (size_t)length);
}

static cs_u32 put_program(cs_recorder *recorder, cs_program program, cs_u32 features)
{
    cs_u32 *number = &recorder->program_numbers[features][program];
    char options[CS_PROGRAM_OPTIONS];
    const char *texts[2];
    if (*number != 0) return *number - 1;
    *number = ++recorder->programs;
    cs_program_options(recorder->device->id, recorder->device->packet, features, options);
    cs_program_texts(program, texts);
    const size_t sizes[] = {strlen(options), strlen(texts[0]), strlen(texts[1])};
    put_head(recorder, "prog", 4 + sizes[0] + sizes[1] + sizes[2]);
    put_u32(recorder, sizes[0]);
    put(recorder, options, sizes[0]);
    put(recorder, texts[0], sizes[1]);
    put(recorder, texts[1], sizes[2]);
    return *number - 1;
}

/* Appends the longest run of equal words from `*at` on, or of words that do not repeat: twice its
 * length, plus 1 where they are equal, then the one or all. Returns 0 when out of memory. */
static int pack_run(const uint64_t *words, size_t count, size_t *at, cs_array *packed)
{
    const size_t first = *at, most = (size_t)1 << 30;
    size_t end = first + 1;
    if (count - first > most) count = first + most;
    while (end < count && words[end] == words[first])
        end++;
    const int equal = end > first + 1;
    while (!equal && end < count && (end + 1 == count || words[end] != words[end + 1]))
        end++;
    const cs_u32 head = 2u * (cs_u32)(end - first) + (cs_u32)equal;
    const size_t size = (equal ? 1 : end - first) * sizeof *words;
    unsigned char *bytes = cs_array_extend(packed, sizeof head + size);
    if (bytes == NULL) return 0;
    memcpy(bytes, &head, sizeof head);
    memcpy(bytes + sizeof head, words + first, size);
    *at = end;
    return 1;
}

/* What the device has in the buffer. */
static clshear_status put_contents(cs_recorder *recorder, size_t place, const cs_buffer *buffer,
                                   cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t count = (buffer->size + 7) / 8;
    uint64_t *words = calloc(count, sizeof *words);
    cs_array packed = {.item_size = 1};
    CS_REQUIRE(words != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for a capsule");
    CS_TRY(cs_buffer_read(buffer, 0, buffer->size, words, error));
    for (size_t i = 0; i < count;)
        CS_REQUIRE(pack_run(words, count, &i, &packed), CLSHEAR_OUT_OF_MEMORY,
                   "out of memory for a capsule");
    put_head(recorder, "buff", 4 + 8 + packed.count);
    put_u32(recorder, place);
    put_u64(recorder, buffer->size);
    put(recorder, packed.items, packed.count);
done:
    cs_array_free(&packed);
    free(words);
    return status;
}

/* The file's number of a buffer; as many as there are buffers if it has none. */
static size_t place_of(const cs_recorder *recorder, const cs_buffer *buffer)
{
    const known_buffer *known = recorder->buffers.items;
    size_t place = 0;
    while (place < recorder->buffers.count && known[place].number != buffer->number)
        place++;
    return place;
}

/* A buffer that the file does not have, or that the host has written to since. */
static clshear_status put_buffer(cs_recorder *recorder, const cs_buffer *buffer, cs_error *error)
{
    const size_t place = place_of(recorder, buffer);
    const unsigned writes = atomic_load(&buffer->writes);
    if (place == recorder->buffers.count && cs_array_extend(&recorder->buffers, 1) == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "out of memory for a capsule");
    known_buffer *known = (known_buffer *)recorder->buffers.items + place;
    if (known->number == buffer->number && known->writes == writes) return CLSHEAR_OK;
    *known = (known_buffer){buffer->number, writes};
    return put_contents(recorder, place, buffer, error);
}

static void put_argument(cs_recorder *recorder, const cs_argument *argument)
{
    const int is_value = argument->buffer == NULL && argument->value != NULL;
    put_u32(recorder, is_value ? argument->size : 0);
    if (is_value)
        put(recorder, argument->value, argument->size);
    else /* a buffer's number from 1 on, or 0 for none */
        put_u32(recorder, argument->buffer != NULL ? place_of(recorder, argument->buffer) + 1 : 0);
}

clshear_status cs_recorder_launch(cs_recorder *recorder, const cs_recorded_launch *launch,
                                  cs_error *error)
{
    const size_t name_size = strlen(launch->kernel);
    const cs_argument *arguments = launch->arguments;
    const cs_u32 program = put_program(recorder, launch->program, launch->features);
    size_t size = 4 + 8 + 8 + 4 + name_size + 4;
    for (size_t i = 0; i < launch->argument_count; i++) {
        size += 4 + 4;
        if (arguments[i].buffer == NULL && arguments[i].value != NULL)
            size += arguments[i].size - 4;
        if (arguments[i].buffer == NULL) continue;
        const clshear_status status = put_buffer(recorder, arguments[i].buffer, error);
        if (status != CLSHEAR_OK) return status;
    }
    put_head(recorder, "run ", size);
    put_u32(recorder, program);
    put_u64(recorder, launch->global);
    put_u64(recorder, launch->local);
    put_u32(recorder, name_size);
    put(recorder, launch->kernel, name_size);
    put_u32(recorder, launch->argument_count);
    for (size_t i = 0; i < launch->argument_count; i++)
        put_argument(recorder, &arguments[i]);
    return CLSHEAR_OK;
}

clshear_status cs_recorder_open(cs_device *device, const char *path, cs_recorder **result,
                                cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    cs_recorder *recorder = calloc(1, sizeof *recorder);
    CS_REQUIRE(recorder != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for a capsule");
    recorder->device = device;
    recorder->sum = CS_CHECKSUM_OF_NOTHING;
    recorder->buffers.item_size = sizeof(known_buffer);
    recorder->path = strdup(path);
    CS_REQUIRE(recorder->path != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for a capsule");
    const int reason = cs_output_open(path, &recorder->file);
    CS_REQUIRE(reason == 0, CLSHEAR_BAD_FILE, "%s: cannot be written: %s", path, strerror(reason));
    put(recorder, magic, sizeof magic);
    put_info(recorder);
    pthread_mutex_lock(&device->lock);
    const int is_taken = device->recorder != NULL;
    if (!is_taken) device->recorder = recorder;
    pthread_mutex_unlock(&device->lock);
    CS_REQUIRE(!is_taken, CLSHEAR_BAD_ARGUMENT,
               "%s: the launches of this context are being recorded already", path);
    *result = recorder;
    recorder = NULL;
done:
    cs_recorder_close(recorder, 0, 0.0, error);
    return status;
}

clshear_status cs_recorder_result(cs_recorder *recorder, const cs_buffer *buffer,
                                  const cs_recorded_layout *layout, cs_error *error)
{
    clshear_status status = CLSHEAR_OK;
    const size_t place = place_of(recorder, buffer), size = sizeof(cs_u32) * layout->item_words;
    unsigned char *bytes = malloc(layout->items * size);
    CS_REQUIRE(bytes != NULL, CLSHEAR_OUT_OF_MEMORY, "out of memory for a capsule");
    if (place == recorder->buffers.count) goto done;
    CS_TRY(cs_buffer_read(buffer, 0, layout->items * size, bytes, error));
    put_head(recorder, "want", 4 + sizeof *layout + (4 + 12 + 12) * (size_t)layout->items);
    put_u32(recorder, place);
    put(recorder, layout, sizeof *layout);
    for (size_t i = 0; i < layout->items; i++) {
        const unsigned char *item = bytes + i * size;
        put(recorder, item + 4 * (size_t)layout->sum, 12);
        put(recorder, item + 4 * (size_t)layout->carry, 12);
        put(recorder, item + 4 * (size_t)layout->divisor, 4);
    }
done:
    free(bytes);
    return status;
}

clshear_status cs_recorder_close(cs_recorder *recorder, int good, double samples, cs_error *error)
{
    if (recorder == NULL) return CLSHEAR_OK;
    clshear_status status = CLSHEAR_OK;
    pthread_mutex_lock(&recorder->device->lock);
    if (recorder->device->recorder == recorder) recorder->device->recorder = NULL;
    pthread_mutex_unlock(&recorder->device->lock);
    if (recorder->file.stream != NULL) {
        put_head(recorder, "end ", sizeof samples + sizeof recorder->sum);
        put(recorder, &samples, sizeof samples);
        put_u64(recorder, recorder->sum);
        const int reason = cs_output_end(&recorder->file, good);
        if (good && reason != 0)
            status = cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be written: %s", recorder->path,
                             strerror(reason));
    }
    cs_array_free(&recorder->buffers);
    free(recorder->path);
    free(recorder);
    return status;
}
