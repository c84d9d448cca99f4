/* C++ because C has no conversion of numbers that is independent of the locale. */
#include "base/number.h"

#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <system_error>

/* Whether a number that no double can hold is too small rather than too large. */
static bool is_tiny(const char *text, const char *end)
{
    for (; text != end; text++)
        if ((*text == 'e' || *text == 'E') && text + 1 != end) return text[1] == '-';
    return false;
}

/* Reads the rest of an infinity or a NaN as Microsoft's C library printed them before 2015, with a
 * number in front: 1.#INF, -1.#IND, 1.#QNAN0. `text` is behind the point, and `*value` the number
 * before it, whose sign counts. Returns the end of it, or `text` where there is no such thing. */
static const char *end_of_windows_nan(const char *text, const char *end, double *value)
{
    static const struct {
        const char *word;
        double value;
    } words[] = {{"#IND", std::numeric_limits<double>::quiet_NaN()},
                 {"#QNAN", std::numeric_limits<double>::quiet_NaN()},
                 {"#SNAN", std::numeric_limits<double>::quiet_NaN()},
                 {"#INF", std::numeric_limits<double>::infinity()}};
    for (const auto &entry : words) {
        const std::size_t length = std::strlen(entry.word);
        if (static_cast<std::size_t>(end - text) < length) continue;
        if (std::strncmp(text, entry.word, length) != 0) continue;
        *value = *value < 0.0 ? -entry.value : entry.value;
        text += length;
        while (text != end && *text == '0')
            text++;
        return text;
    }
    return text;
}

extern "C" const char *cs_parse_number(const char *text, const char *end, double *value)
{
    const char *begin = text != end && *text == '+' ? text + 1 : text;
    if (begin != text && begin != end && *begin == '-') return text;
    const std::from_chars_result found = std::from_chars(begin, end, *value);
    if (found.ptr == begin) return text;
    if (found.ec == std::errc::result_out_of_range) {
        const double size =
            is_tiny(begin, found.ptr) ? 0.0 : std::numeric_limits<double>::infinity();
        *value = *begin == '-' ? -size : size;
    }
    return found.ptr[-1] == '.' ? end_of_windows_nan(found.ptr, end, value) : found.ptr;
}

extern "C" const char *cs_format_number(char *text, size_t size, double value, int digits)
{
    if (size == 0) return text;
    const std::to_chars_result made =
        std::to_chars(text, text + size - 1, value, std::chars_format::general, digits);
    *(made.ec == std::errc() ? made.ptr : text) = '\0';
    return text;
}
