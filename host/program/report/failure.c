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

int complain_of_library(void)
{
    return complain(EXIT_FAILED, "%s", clshear_message());
}

int exit_status_of(clshear_status status)
{
    return status == CLSHEAR_OK ? EXIT_DONE : complain_of_library();
}
