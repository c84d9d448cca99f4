/* Bytes of glTF: URIs, buffers and their views. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "import/find_file.h"
#include "import/gltf_reader.h"

/* ----- URIs ----- */

int gltf_is_data(const char *uri)
{
    return strncasecmp(uri, "data:", 5) == 0;
}

static int sextet(char letter)
{
    static const char letters[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (letter == '-') return 62; /* as in URLs */
    if (letter == '_') return 63;
    const char *found = letter != '\0' ? strchr(letters, letter) : NULL;
    return found != NULL ? (int)(found - letters) : -1;
}

/* Decodes base64 in place, up to the first letter that is none; returns the number of bytes. */
static size_t decode_base64(char *bytes)
{
    const char *text = bytes;
    size_t size = 0;
    uint32_t bits = 0;
    int count = 0;
    for (; *text != '\0' && *text != '='; text++) {
        const int value = sextet(*text);
        if (value < 0) continue; /* line breaks */
        bits = bits << 6 | (uint32_t)value;
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes[size++] = (char)(bits >> count & 0xff);
    }
    return size;
}

/* data:[type][;...][;base64],... */
static clshear_status decode_data(const gltf_reader *reader, const char *place, long long index,
                                  const char *uri, char **owned, size_t *size)
{
    const char *comma = strchr(uri, ',');
    if (comma == NULL)
        return gltf_complain(reader, place, index, "its data: URI has no comma before the data");
    const int is_base64 = comma - uri >= 7 && strncasecmp(comma - 7, ";base64", 7) == 0;
    *owned = malloc(strlen(comma) + 1);
    if (*owned == NULL) return cs_model_full(reader->model, reader->error);
    memcpy(*owned, comma + 1, strlen(comma));
    *size = cs_decode_percent(*owned); /* base64 may have %2B, %2F and %3D */
    if (is_base64) *size = decode_base64(*owned);
    return CLSHEAR_OK;
}

int gltf_find_file(const gltf_reader *reader, const char *uri, char *found)
{
    static const char scheme[] = "file://";
    const char *folders[] = {reader->folder};
    char plain[CS_FILE_PATH], ignored[CS_FILE_PATH];
    if (cs_find_file(uri, folders, 1, found)) return 1;
    const size_t skipped = strncasecmp(uri, scheme, strlen(scheme)) == 0 ? strlen(scheme) : 0;
    const int length = (int)strcspn(uri + skipped, "?#");
    snprintf(plain, sizeof plain, "%.*s", length, uri + skipped);
    if (strcmp(plain, uri) == 0 || !cs_find_file(plain, folders, 1, ignored)) return 0;
    memcpy(found, ignored, sizeof ignored);
    return 1;
}

clshear_status gltf_uri(const gltf_reader *reader, const char *place, long long index,
                        const char *uri, char **owned, size_t *size)
{
    char found[CS_FILE_PATH];
    cs_bytes bytes = {0};
    if (gltf_is_data(uri)) return decode_data(reader, place, index, uri, owned, size);
    if (!gltf_find_file(reader, uri, found))
        return gltf_complain(reader, place, index, "its file %.200s is not there", uri);
    const clshear_status status = cs_bytes_read(found, &bytes, reader->error);
    *owned = bytes.data;
    *size = bytes.size;
    return status;
}

/* ----- Buffers ----- */

static clshear_status load_buffer(gltf_reader *reader, long long index)
{
    const json_t *json = gltf_at(reader, "buffers", index);
    if (json == NULL) return CLSHEAR_BAD_FILE;
    gltf_buffer *buffer = &reader->buffers[index];
    const char *uri = gltf_text(json, "uri", "");
    if (*uri == '\0') uri = NULL;
    const long long length = gltf_index(json, "byteLength");
    if (buffer->data != NULL) return CLSHEAR_OK;
    if (gltf_extension(json, "EXT_meshopt_compression") != NULL && uri == NULL)
        return gltf_complain(reader, "buffers", index,
                             "is there in compressed form alone (EXT_meshopt_compression), but "
                             "something asks for its own bytes");
    if (uri == NULL && (index != 0 || reader->chunk == NULL))
        return gltf_complain(reader, "buffers", index, "has no uri, and the file no binary chunk");
    if (uri == NULL) {
        buffer->data = reader->chunk;
        buffer->size = reader->chunk_size;
    } else {
        clshear_status status =
            gltf_uri(reader, "buffers", index, uri, &buffer->owned, &buffer->size);
        if (status != CLSHEAR_OK) return status;
        buffer->data = (const unsigned char *)buffer->owned;
    }
    if (length < 0)
        return gltf_complain(reader, "buffers", index, "has no byteLength of 0 or more");
    if ((size_t)length > buffer->size)
        return gltf_complain(reader, "buffers", index, "has %zu bytes, but byteLength says %lld",
                             buffer->size, length);
    buffer->size = (size_t)length;
    return CLSHEAR_OK;
}

clshear_status gltf_range(gltf_reader *reader, const json_t *json, long long index,
                          const unsigned char **data, size_t *size)
{
    const long long number = gltf_index(json, "buffer"), length = gltf_index(json, "byteLength");
    const long long offset = gltf_index(json, "byteOffset");
    clshear_status status = load_buffer(reader, number);
    if (status != CLSHEAR_OK) return status;
    const gltf_buffer *buffer = &reader->buffers[number];
    const size_t begin = offset > 0 ? (size_t)offset : 0;
    if (length < 0 || offset == -2)
        return gltf_complain(reader, "bufferViews", index, "its numbers cannot be");
    if (begin > buffer->size || (size_t)length > buffer->size - begin)
        return gltf_complain(reader, "bufferViews", index,
                             "ends at byte %zu, but its buffer has %zu", begin + (size_t)length,
                             buffer->size);
    *data = buffer->data + begin;
    *size = (size_t)length;
    return CLSHEAR_OK;
}

clshear_status gltf_view(gltf_reader *reader, long long index, const unsigned char **data,
                         size_t *size, size_t *stride)
{
    const json_t *json = gltf_at(reader, "bufferViews", index);
    if (json == NULL) return CLSHEAR_BAD_FILE;
    const long long step = gltf_index(json, "byteStride");
    if (step == -2 || step > 65535)
        return gltf_complain(reader, "bufferViews", index, "its numbers cannot be");
    *stride = step > 0 ? (size_t)step : 0;
    if (gltf_is_packed(json)) return gltf_packed_view(reader, index, json, data, size);
    return gltf_range(reader, json, index, data, size);
}
