/* Numbers as text, with a decimal point whatever the locale of the process says. */
#ifndef CS_BASE_NUMBER_H
#define CS_BASE_NUMBER_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Reads the number that begins at `text` and ends before `end`, at the latest: returns the place
 * behind it, or `text` where there is none. What is too large becomes infinite, what is too small
 * 0. No blanks are skipped. */
const char *cs_parse_number(const char *text, const char *end, double *value);

/* Writes `value` with that many significant digits, as printf's %g does. Returns `text`. */
const char *cs_format_number(char *text, size_t size, double value, int digits);

#ifdef __cplusplus
}
#endif

#endif
