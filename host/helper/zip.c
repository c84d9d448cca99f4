#include "helper/zip.h"

#include <limits.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <zlib.h>

enum {
    END = 22,         /* bytes of the record that ends an archive */
    FAR_END = 56,     /* of the same with 64 bits */
    FAR_POINTER = 20, /* of what points to it */
    ENTRY = 46,       /* of an entry of the directory, without its name */
    LOCAL = 30,       /* of the head before the bytes, the same */
    MOST_COMMENT = 65535,
    MOST_RATIO = 1032 /* of deflate */
};

static uint64_t number_at(const unsigned char *at, int bytes)
{
    uint64_t value = 0;
    for (int i = 0; i < bytes; i++)
        value |= (uint64_t)at[i] << 8 * i;
    return value;
}

static int is_there(const cs_zip *zip, uint64_t place, size_t bytes)
{
    return place <= zip->size && bytes <= zip->size - place;
}

/* The directory by the record of 64 bits that a pointer before `end` names; `otherwise` if none. */
static uint64_t far_directory(const cs_zip *zip, size_t end, uint64_t otherwise)
{
    if (end < FAR_POINTER || memcmp(zip->data + end - FAR_POINTER, "PK\6\7", 4) != 0)
        return otherwise;
    const uint64_t place = number_at(zip->data + end - FAR_POINTER + 8, 8);
    if (!is_there(zip, place, FAR_END) || memcmp(zip->data + place, "PK\6\6", 4) != 0)
        return otherwise;
    return number_at(zip->data + place + 48, 8);
}

int cs_zip_open(const void *data, size_t size, cs_zip *zip)
{
    *zip = (cs_zip){.data = data, .size = size};
    for (size_t back = END; back <= size && back <= END + MOST_COMMENT; back++) {
        const size_t end = size - back;
        if (memcmp(zip->data + end, "PK\5\6", 4) != 0) continue;
        const uint64_t near = number_at(zip->data + end + 16, 4);
        const uint64_t place = near == UINT32_MAX ? far_directory(zip, end, near) : near;
        if (!is_there(zip, place, 0)) return 0;
        zip->directory = (size_t)place;
        return 1;
    }
    return 0;
}

/* Sizes and a place that do not fit 32 bits are in the extra field 1, in this order. */
static void read_far(const unsigned char *at, size_t size, uint64_t *values[3])
{
    while (size >= 4) {
        const size_t length = (size_t)number_at(at + 2, 2);
        if (length > size - 4) return;
        if (number_at(at, 2) == 1) {
            size_t used = 0;
            for (int i = 0; i < 3; i++)
                if (*values[i] == UINT32_MAX && used + 8 <= length) {
                    *values[i] = number_at(at + 4 + used, 8);
                    used += 8;
                }
        }
        at += 4 + length;
        size -= 4 + length;
    }
}

int cs_zip_next(const cs_zip *zip, size_t *place, cs_zip_entry *entry)
{
    if (!is_there(zip, *place, ENTRY)) return 0;
    const unsigned char *at = zip->data + *place;
    if (memcmp(at, "PK\1\2", 4) != 0) return 0;
    const size_t name = (size_t)number_at(at + 28, 2), extra = (size_t)number_at(at + 30, 2);
    const size_t comment = (size_t)number_at(at + 32, 2);
    if (!is_there(zip, *place, ENTRY + name + extra + comment)) return 0;
    uint64_t unpacked = number_at(at + 24, 4), packed = number_at(at + 20, 4);
    uint64_t local = number_at(at + 42, 4);
    uint64_t *values[3] = {&unpacked, &packed, &local};
    read_far(at + ENTRY + name, extra, values);
    *entry = (cs_zip_entry){.name = (const char *)at + ENTRY,
                            .name_length = name,
                            .is_encrypted = (at[8] & 1) != 0,
                            .method = (unsigned)number_at(at + 10, 2),
                            .packed = (size_t)packed,
                            .unpacked = (size_t)unpacked,
                            .place = (size_t)local,
                            .next = *place + ENTRY + name + extra + comment};
    *place = entry->next;
    return 1;
}

int cs_zip_find(const cs_zip *zip, const char *name, cs_zip_entry *entry)
{
    name += *name == '/';
    const size_t length = strlen(name);
    for (size_t place = zip->directory; cs_zip_next(zip, &place, entry);) {
        const int slash = entry->name_length > 0 && entry->name[0] == '/';
        if (entry->name_length == length + (size_t)slash &&
            strncasecmp(entry->name + slash, name, length) == 0)
            return 1;
    }
    return 0;
}

/* Fills `bytes`, which has room for all; 0 where the packed bytes are damaged. */
static int inflate_all(const unsigned char *packed, size_t size, cs_bytes *bytes)
{
    z_stream stream = {0};
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) return 0;
    stream.next_in = (unsigned char *)(uintptr_t)packed; /* zlib does not write there */
    stream.avail_in = (uInt)size;
    stream.next_out = (unsigned char *)bytes->data;
    stream.avail_out = (uInt)bytes->size;
    const int end = inflate(&stream, Z_FINISH);
    const int is_whole = end == Z_STREAM_END && stream.avail_out == 0;
    inflateEnd(&stream);
    return is_whole;
}

clshear_status cs_zip_read(const cs_zip *zip, const cs_zip_entry *entry, const char *path,
                           cs_bytes *bytes, cs_error *error)
{
    const int length = (int)entry->name_length;
    if (entry->is_encrypted || (entry->method != 0 && entry->method != 8))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: \"%.*s\" in it is %s; write it plainly", path,
                       length, entry->name,
                       entry->is_encrypted ? "encrypted" : "packed in a way that is not supported");
    size_t begin = zip->size;
    if (is_there(zip, entry->place, LOCAL)) {
        const unsigned char *local = zip->data + entry->place;
        begin = entry->place + LOCAL + (size_t)number_at(local + 26, 2) +
                (size_t)number_at(local + 28, 2);
    }
    const int fits = is_there(zip, begin, entry->packed) && entry->unpacked < UINT_MAX &&
                     entry->packed < UINT_MAX && entry->unpacked / MOST_RATIO <= entry->packed;
    char *data = fits ? malloc(entry->unpacked + 1) : NULL;
    if (fits && data == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY,
                       "%s: out of memory for the %zu bytes of "
                       "\"%.*s\" in it",
                       path, entry->unpacked, length, entry->name);
    *bytes = (cs_bytes){data, fits ? entry->unpacked : 0};
    int is_whole = fits;
    if (fits && entry->method == 8)
        is_whole = inflate_all(zip->data + begin, entry->packed, bytes);
    else if (fits && entry->packed == entry->unpacked)
        memcpy(data, zip->data + begin, entry->packed);
    else
        is_whole = 0;
    if (!is_whole) {
        cs_bytes_free(bytes);
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: \"%.*s\" in it is damaged, or was cut", path,
                       length, entry->name);
    }
    data[bytes->size] = '\0';
    return CLSHEAR_OK;
}
