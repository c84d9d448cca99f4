#include "report/failure.h"

#include <stdarg.h>
#include <stdio.h>

/* Control characters, which names and settings files may have, do not reach the terminal. */
int complain(int code, const char *format, ...)
{
    char line[8192];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(line, sizeof line, format, arguments);
    va_end(arguments);
    for (char *c = line; *c != '\0'; c++)
        if ((unsigned char)*c < ' ' || *c == '\x7f') *c = '?';
    fprintf(stderr, "clshear: %s\n", line);
    return code;
}

int exit_status_of(clshear_status status)
{
    if (status == CLSHEAR_OK) return EXIT_DONE;
    return complain(status == CLSHEAR_BAD_ARGUMENT ? EXIT_USAGE : EXIT_FAILED, "%s",
                    clshear_message());
}
