#include "import/text.h"

#include <errno.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/output_file.h"

static clshear_status read_stream(FILE *stream, size_t expected, const char *path, cs_bytes *bytes,
                                  cs_error *error)
{
    bytes->data = malloc(expected + 1);
    if (bytes->data == NULL)
        return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory for its %zu bytes", path,
                       expected);
    bytes->size = fread(bytes->data, 1, expected, stream);
    bytes->data[bytes->size] = '\0';
    if (ferror(stream))
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be read: %s", path, strerror(errno));
    return CLSHEAR_OK;
}

clshear_status cs_bytes_read(const char *path, cs_bytes *bytes, cs_error *error)
{
    struct stat about;
    if (stat(path, &about) != 0)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be opened: %s", path, strerror(errno));
    const char *flaw = cs_not_a_file(path);
    if (flaw != NULL) return cs_fail(error, CLSHEAR_BAD_FILE, "%s: %s", path, flaw);
    FILE *stream = fopen(path, "rb");
    if (stream == NULL)
        return cs_fail(error, CLSHEAR_BAD_FILE, "%s: cannot be opened: %s", path, strerror(errno));
    clshear_status status = read_stream(stream, (size_t)about.st_size, path, bytes, error);
    fclose(stream);
    return status;
}

void cs_bytes_free(cs_bytes *bytes)
{
    free(bytes->data);
    *bytes = (cs_bytes){0};
}

/* Writes a code point as UTF-8; returns the number of bytes. */
static size_t put_utf8(uint32_t point, char *target)
{
    if (point < 0x80) {
        target[0] = (char)point;
        return 1;
    }
    const int more = point < 0x800 ? 1 : point < 0x10000 ? 2 : 3;
    const uint32_t marks[] = {0, 0xc0, 0xe0, 0xf0};
    target[0] = (char)(marks[more] | point >> 6 * more);
    for (int i = 1; i <= more; i++)
        target[i] = (char)(0x80 | (point >> 6 * (more - i) & 0x3f));
    return (size_t)more + 1;
}

static uint32_t utf16_unit(const unsigned char *at, int big)
{
    return big ? (uint32_t)at[0] << 8 | at[1] : (uint32_t)at[1] << 8 | at[0];
}

static clshear_status from_utf16(cs_bytes *bytes, int big, const char *path, cs_error *error)
{
    const unsigned char *at = (const unsigned char *)bytes->data + 2;
    const unsigned char *end = (const unsigned char *)bytes->data + bytes->size;
    char *text = malloc(bytes->size / 2 * 3 + 1); /* a unit takes 3 bytes at most */
    size_t size = 0;
    if (text == NULL) return cs_fail(error, CLSHEAR_OUT_OF_MEMORY, "%s: out of memory", path);
    for (; end - at >= 2; at += 2) {
        uint32_t point = utf16_unit(at, big);
        if (point >= 0xd800 && point < 0xdc00 && end - at >= 4) {
            point = 0x10000 + ((point & 0x3ff) << 10 | (utf16_unit(at + 2, big) & 0x3ff));
            at += 2;
        }
        size += put_utf8(point, text + size);
    }
    text[size] = '\0';
    cs_bytes_free(bytes);
    *bytes = (cs_bytes){text, size};
    return CLSHEAR_OK;
}

clshear_status cs_bytes_to_utf8(cs_bytes *bytes, const char *path, cs_error *error)
{
    size_t marks = 0;
    while (bytes->size >= marks + 3 && memcmp(bytes->data + marks, "\xef\xbb\xbf", 3) == 0)
        marks += 3;
    if (marks > 0) {
        bytes->size -= marks;
        memmove(bytes->data, bytes->data + marks, bytes->size + 1);
        return CLSHEAR_OK;
    }
    if (bytes->size >= 2 && memcmp(bytes->data, "\xff\xfe", 2) == 0)
        return from_utf16(bytes, 0, path, error);
    if (bytes->size >= 2 && memcmp(bytes->data, "\xfe\xff", 2) == 0)
        return from_utf16(bytes, 1, path, error);
    return CLSHEAR_OK;
}

cs_lines cs_lines_of(cs_bytes *bytes)
{
    return (cs_lines){.at = bytes->data, .end = bytes->data + bytes->size};
}

static int is_blank(char letter)
{
    return letter == ' ' || letter == '\t' || letter == '\v' || letter == '\f';
}

/* Whether a comment begins in a part of a line. */
static int has_comment(const char *from, const char *to)
{
    for (const char *at = from; at != to; at++)
        if (*at == '#' && (at == from || is_blank(at[-1]))) return 1;
    return 0;
}

char *cs_lines_next(cs_lines *lines)
{
    char *line = lines->at, *part = line;
    if (line == lines->end) return NULL;
    lines->number += 1 + lines->joined;
    lines->joined = 0;
    for (;;) {
        char *at = part;
        while (at != lines->end && *at != '\n' && *at != '\r')
            at++;
        char *next = at;
        if (next != lines->end) next += next[0] == '\r' && next[1] == '\n' ? 2 : 1;
        char *last = at; /* behind the last letter that is no blank */
        while (last != part && is_blank(last[-1]))
            last--;
        const int joins = last != part && last[-1] == '\\' && !has_comment(part, at);
        if (joins) last[-1] = ' ';
        if (!joins || next == lines->end) {
            if (at != lines->end) *at = '\0';
            lines->at = next;
            return line;
        }
        memset(at, ' ', (size_t)(next - at));
        lines->joined++;
        part = next;
    }
}

char *cs_next_word(char **at)
{
    char *word = *at;
    while (is_blank(*word))
        word++;
    if (*word == '\0') return NULL;
    char *end = word;
    while (*end != '\0' && !is_blank(*end))
        end++;
    *at = *end != '\0' ? end + 1 : end;
    *end = '\0';
    return word;
}

char *cs_rest_of_line(char *at)
{
    while (is_blank(*at))
        at++;
    size_t length = strlen(at);
    while (length > 0 && is_blank(at[length - 1]))
        at[--length] = '\0';
    if (length >= 2 && at[0] == '"' && at[length - 1] == '"') {
        at[length - 1] = '\0';
        at++;
    }
    return at;
}

int cs_cut_comment(char *text)
{
    char *mark = strchr(text, '#');
    while (mark != NULL && (mark == text || !is_blank(mark[-1])))
        mark = strchr(mark + 1, '#');
    if (mark == NULL) return 0;
    while (mark != text && is_blank(mark[-1]))
        mark--;
    *mark = '\0';
    return 1;
}

int cs_parse_whole(const char **at, long long *value)
{
    const char *digit = *at;
    const int negative = *digit == '-';
    if (*digit == '-' || *digit == '+') digit++;
    const char *first = digit;
    long long sum = 0;
    for (; *digit >= '0' && *digit <= '9'; digit++) {
        if (sum > 99999999999999LL) return 0;
        sum = 10 * sum + (*digit - '0');
    }
    if (digit == first) return 0;
    *value = negative ? -sum : sum;
    *at = digit;
    return 1;
}
