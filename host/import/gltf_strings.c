/* Strings of JSON that exporters wrote in another coding than UTF-8, or cut within a character. */
#include <stdlib.h>
#include <string.h>

#include "import/gltf_reader.h"

/* Bytes of the UTF-8 character at `at`, 0 if there is none. */
static size_t character_size(const unsigned char *at, size_t left)
{
    static const uint32_t least[] = {0, 0x80, 0x800, 0x10000}; /* that needs so many more bytes */
    const size_t more = *at < 0x80 ? 0 : *at < 0xe0 ? 1 : *at < 0xf0 ? 2 : 3;
    uint32_t point = more == 0 ? *at : *at & (0x3fU >> more);
    if ((*at >= 0x80 && *at < 0xc0) || *at >= 0xf8 || more >= left) return 0;
    for (size_t i = 1; i <= more; i++) {
        if ((at[i] & 0xc0) != 0x80) return 0;
        point = point << 6 | (at[i] & 0x3fU);
    }
    const int is_surrogate = point >= 0xd800 && point < 0xe000;
    return point < least[more] || point > 0x10ffff || is_surrogate ? 0 : more + 1;
}

/* The number of an escape \uXXXX, or 0. */
static uint32_t escaped_unit(const char *at, size_t left)
{
    if (left < 6 || at[0] != '\\' || at[1] != 'u') return 0;
    const char digits[5] = {at[2], at[3], at[4], at[5]};
    char *end;
    const unsigned long unit = strtoul(digits, &end, 16);
    return end == digits + 4 ? (uint32_t)unit : 0;
}

/* Passes over the escape at `at`; half of a surrogate pair becomes that of a question mark. */
static size_t pass_escape(char *at, size_t left, size_t *mended)
{
    static const char mark[] = {'0', '0', '3', 'f'};
    const uint32_t unit = escaped_unit(at, left);
    if (unit < 0xd800 || unit >= 0xe000) return left < 2 ? left : 2;
    const uint32_t next = escaped_unit(at + 6, left - 6);
    if (unit < 0xdc00 && next >= 0xdc00 && next < 0xe000) return 12;
    memcpy(at + 2, mark, sizeof mark);
    ++*mended;
    return 6;
}

size_t gltf_mend_strings(char *text, size_t size)
{
    size_t mended = 0;
    int is_inside = 0;
    for (size_t i = 0; i < size;) {
        const size_t length = character_size((const unsigned char *)text + i, size - i);
        if (is_inside && text[i] == '\\') {
            i += pass_escape(text + i, size - i, &mended);
            continue;
        }
        is_inside ^= text[i] == '"';
        if (is_inside && (length == 0 || (unsigned char)text[i] < ' ')) {
            text[i] = '?';
            mended++;
        }
        i += length > 0 ? length : 1;
    }
    return mended;
}
