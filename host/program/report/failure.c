#include "report/failure.h"

#include <stdarg.h>
#include <stdio.h>

/* Replaces control characters: those of ASCII, and U+0080 to U+009F, which UTF-8 writes as c2 and
 * one byte more. */
static void make_printable(char *line)
{
    for (unsigned char *at = (unsigned char *)line; *at != '\0'; at++) {
        if (*at < ' ' || *at == 0x7f) *at = '?';
        if (*at == 0xc2 && at[1] >= 0x80 && at[1] < 0xa0) at[0] = at[1] = '?';
    }
}

static void print_line(const char *format, va_list arguments)
{
    char line[8192];
    vsnprintf(line, sizeof line, format, arguments);
    make_printable(line);
    fprintf(stderr, "clshear: %s\n", line);
}

void remark(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_line(format, arguments);
    va_end(arguments);
}

int complain(int code, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    print_line(format, arguments);
    va_end(arguments);
    return code;
}

int exit_status_of(clshear_status status)
{
    if (status == CLSHEAR_OK) return EXIT_DONE;
    return complain(status == CLSHEAR_BAD_ARGUMENT ? EXIT_USAGE : EXIT_FAILED, "%s",
                    clshear_message());
}
